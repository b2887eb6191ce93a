// SPDX-License-Identifier: Apache-2.0
// `ifa ensemble`: a score in, several bodies that play it out.
#include <fmt/format.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "command.h"
#include "ifa/ensemble.h"

namespace ifa::cli {

namespace fs = std::filesystem;

namespace {

struct EnsembleOptions {
  EnsembleSettings settings;
  OutputSettings files;
  fs::path output;
  bool noFilm = false;
};

void show(Console& console, const EnsembleResult& result) {
  for (const EnsemblePlayer& player : result.players) {
    const Motion& motion = player.motion;
    console.result(motion.success
                       ? fmt::format("{}: {} on {}, {} notes, score {:.2f}, bend at most {:.2f}, "
                                     "{:.1f} s",
                                     player.name, motion.object.name, motion.object.surface,
                                     motion.contacts.size(), motion.score, motion.bend.max,
                                     player.search)
                       : fmt::format("{}: no acceptable motion", player.name));
  }
  if (result.failed() != nullptr) return;
  console.result(
      fmt::format("contacts are off their notes by {:.4f} ms at most", 1e3 * result.worstContact));
  if (result.leastDistance) {
    console.result(fmt::format("nearest: {:.2f} mm, {} at {:.3f} s; placed in {:.1f} s",
                               1e3 * *result.leastDistance, result.leastOf, result.leastTime,
                               result.placing));
  }
}

int runEnsemble(EnsembleOptions options, CommandContext& context) {
  options.files.film.overlay = true;
  if (options.noFilm || !filmsCanBeWritten()) options.files.formats.erase(OutputFormat::kMp4);
  const auto result =
      performToFolder(options.settings, options.output, options.files, context.progress);
  if (!result) return context.fail(result.error());
  for (const std::string& warning : result->warnings) context.console.warn(warning);
  show(context.console, *result);
  if (const EnsemblePlayer* failed = result->failed()) {
    return context.fail(
        {ErrorCode::kNoMotion, failed->name + ": " + failed->motion.failure,
         options.settings.score.string(),
         "more bodies for the part, a larger energy_gain, or \"ending\": \"bounce\" may help"});
  }
  if (result->interrupted) {
    return context.fail(
        {ErrorCode::kInterrupted, "interrupted; everything but the film is written", {}, {}});
  }
  context.console.result(options.output.string());
  return context.succeed(options.output.string());
}

}  // namespace

void addEnsembleCommand(CLI::App& app, CommandContext& context) {
  auto options = std::make_shared<EnsembleOptions>();
  CLI::App* command = app.add_subcommand("ensemble", "let several objects play a score");
  command
      ->add_option("SCORE", options->settings.score,
                   "score file (docs/music.md), or a MIDI file: a part for each channel")
      ->required();
  command->add_option("-o,--out", options->output, "folder for the results")->required();
  command->add_option("--object", options->settings.object,
                      "for a MIDI file: name (see ifa objects) or object file");
  command->add_option("--seed", options->settings.seed, "instead of the score's")
      ->check(CLI::Range(std::uint64_t{0}, std::uint64_t{1'000'000'000'000'000}));
  command->add_option("--planner", options->settings.planner, "hybrid or shoot")
      ->capture_default_str();
  command->add_flag("--no-film", options->noFilm, "no ensemble.mp4; ifa render makes it later");
  command->add_flag("--glb-set", options->files.glbSet, "a floor and a light in ensemble.glb");
  command->callback([options, &context] {
    context.action = [options, &context] { return runEnsemble(*options, context); };
  });
}

}  // namespace ifa::cli
