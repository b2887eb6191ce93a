// SPDX-License-Identifier: Apache-2.0
// `ifa sync`: sound in, synchronised motion out.
#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <memory>
#include <set>

#include "command.h"
#include "connection/time_warp.h"
#include "graph_options.h"
#include "ifa/synchronize.h"
#include "orient_option.h"
#include "pipeline/batch.h"
#include "pipeline/choose_object.h"
#include "pipeline/output_files.h"
#include "pipeline/wishes.h"

namespace ifa::cli {

namespace fs = std::filesystem;

namespace {

struct SyncOptions {
  SynchronizeSettings settings;
  OutputSettings files;
  std::string formats = filmsCanBeWritten() ? "json,glb,mp4" : "json,glb";
  fs::path output;
  std::vector<std::string> orientations;
  fs::path positions;
  bool noTerminal = false;
};

Result<std::set<OutputFormat>> parseFormats(const std::string& list) {
  static const std::map<std::string, OutputFormat> kKnown = {{"json", OutputFormat::kJson},
                                                             {"glb", OutputFormat::kGlb},
                                                             {"csv", OutputFormat::kCsv},
                                                             {"usda", OutputFormat::kUsda},
                                                             {"mp4", OutputFormat::kMp4}};
  std::set<OutputFormat> formats;
  for (const auto& name : CLI::detail::split(list, ',')) {
    const auto found = kKnown.find(name);
    if (found == kKnown.end()) {
      return tl::unexpected<Error>({ErrorCode::kUsage, "\"" + name + "\" is not a format",
                                    "--formats", "choose from json, glb, mp4, usda, csv"});
    }
    formats.insert(found->second);
  }
  return formats;
}

int noMotion(CommandContext& context, const std::string& message, const fs::path& place,
             const std::string& remedy = {}) {
  return context.fail({ErrorCode::kNoMotion, message, place.string(), remedy});
}

int interrupted(CommandContext& context, const std::string& kept) {
  return context.fail({ErrorCode::kInterrupted, "interrupted; " + kept, {}, {}});
}

std::string fitOf(const Motion& motion) {
  if (!motion.given) return {};
  const bool moved = motion.given->surface != motion.object.surface;
  return fmt::format(", restitution {:.2f} ({:.2f} {}was given)", motion.object.restitution,
                     motion.given->restitution, moved ? "on " + motion.given->surface + " " : "");
}

// How far off the places that were asked for are.
void showPositions(Console& console, const Motion& motion) {
  if (motion.positions.empty()) return;
  double sum = 0, most = 0;
  for (const MotionPosition& wish : motion.positions) {
    const auto& contact = motion.contacts[static_cast<std::size_t>(wish.contact)];
    const double off = (contact.position.head<2>() - wish.place).norm();
    sum += off;
    most = std::max(most, off);
  }
  console.result(fmt::format("  places are missed by {:.1f} mm on average, {:.1f} mm at most",
                             1e3 * sum / static_cast<double>(motion.positions.size()), 1e3 * most));
}

// Marks in doubt that the motion does not meet where they were heard.
void showDoubtfulMarks(Console& console, const Motion& motion) {
  const double first = motion.sound.firstContact;
  for (const double time : motion.dropped) {
    console.result(fmt::format("  the mark at {:.3f} s is left out", first + time));
  }
  for (const MotionContact& contact : motion.contacts) {
    if (contact.moved == 0) continue;
    console.result(fmt::format("  the mark at {:.3f} s is met {:+.1f} ms from there",
                               first + contact.targetTime - contact.moved, 1e3 * contact.moved));
  }
}

// By how much nature was helped where nothing else was found. Of "graph" every passage is warped.
void showEasing(Console& console, const Motion& motion, bool energyAsked) {
  double warp = 0;
  for (const MotionContact& contact : motion.contacts) {
    warp = std::max(warp, TimeWarp{1, contact.retiming}.amount());
  }
  if (motion.energyGain > 0 && !energyAsked) {
    console.result(fmt::format(
        "  nothing found that loses energy at every contact and keeps its pace: one may add up to "
        "{:.0f} % of energy, and a passage is up to {:.0f} % faster or slower",
        100 * motion.energyGain, 100 * warp));
  } else if (warp > 0 && motion.planner != "graph") {
    console.result(
        fmt::format("  a passage is up to {:.0f} % faster or slower", std::ceil(100 * warp)));
  }
}

void showTake(Console& console, const Motion& motion, bool energyAsked, const fs::path& folder) {
  console.result(fmt::format("{} on {}{}: {}", motion.object.name, motion.object.surface,
                             fitOf(motion),
                             motion.success ? describe(motion) : "no acceptable motion"));
  if (motion.success) showEasing(console, motion, energyAsked);
  showPositions(console, motion);
  showDoubtfulMarks(console, motion);
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (roleOf(name) != "object") console.result("  " + entry.path().string());
  }
}

// Which of several objects explains the sound, and how sure that is.
void showRanking(Console& console, const std::vector<ObjectRank>& ranking) {
  if (ranking.empty()) return;
  std::string others;
  for (const ObjectRank& rank : ranking) {
    const std::string likely = fmt::format("{} {:.0f} %", rank.object, 100 * rank.probability);
    if (!rank.planned && rank.probability < 0.005) continue;
    if (rank.planned) {
      console.result(fmt::format("{}: {}{}", likely, rank.solved ? "" : "no: ", rank.reason));
    } else {
      others += (others.empty() ? "" : ", ") + likely;
    }
  }
  if (!others.empty()) console.result("less likely, not planned: " + others);
  const auto good = asGoodAsBest(ranking);
  if (good.size() > 1) {
    console.result(fmt::format("in doubt: {} may have made this sound; taking {}",
                               fmt::join(good, ", "), good.front()));
  }
}

int syncSound(const SyncOptions& options, CommandContext& context) {
  const auto result =
      synchronizeToFolder(options.settings, options.output, options.files, context.progress);
  if (!result) return context.fail(result.error());
  for (const std::string& warning : result->warnings) context.console.warn(warning);
  showRanking(context.console, result->ranking);
  const auto& takes = result->takes;
  const auto wanted = static_cast<std::size_t>(options.settings.takes);
  for (std::size_t i = 0; i < takes.size(); ++i) {
    showTake(context.console, takes[i], options.settings.energyGain > 0,
             wanted > 1 ? options.output / fmt::format("take-{}", i + 1) : options.output);
  }
  if (takes.size() < wanted) {
    context.console.warn(fmt::format("{} of {} different motions found", takes.size(), wanted));
  }
  if (result->interrupted) return interrupted(context, "what was found is kept");
  if (!takes.front().success) {
    const bool canFit = !options.settings.fit && options.settings.planner != "graph";
    return noMotion(context, takes.front().failure, options.settings.sound,
                    canFit ? "--fit looks for a restitution that suits the sound" : "");
  }
  return context.succeed(options.output.string());
}

int syncFolder(const SyncOptions& options, CommandContext& context) {
  if (!options.settings.labels.empty()) {
    return context.fail({ErrorCode::kUsage, "does not go with a folder of sounds", "--labels",
                         "put NAME.txt (or .csv, .mid) beside NAME.wav"});
  }
  const auto sounds = findSounds(options.settings.sound);
  if (!sounds) return context.fail(sounds.error());
  std::vector<BatchResult> failures;
  const auto tell = [&](const BatchResult& result) {
    const bool failed = result.outcome == BatchOutcome::kFailed;
    context.console.result(result.item.name + ": " + (failed ? "FAILED" : result.message));
    if (failed) failures.push_back(result);
  };
  const auto results = synchronizeAll(*sounds, options.settings, options.output, options.files,
                                      context.progress, tell);
  if (context.progress.stopRequested()) return interrupted(context, "what was finished is kept");
  context.console.result(
      fmt::format("{} of {} solved", results.size() - failures.size(), results.size()));
  for (const auto& failure : failures) {
    context.console.result("failed: " + failure.item.name + ": " + failure.message);
  }
  if (failures.empty()) return context.succeed(options.output.string());
  return noMotion(context, fmt::format("{} of {} sounds failed", failures.size(), results.size()),
                  options.settings.sound);
}

int runSync(SyncOptions options, CommandContext& context) {
  if (options.noTerminal) options.settings.terminal = false;
  const auto formats = parseFormats(options.formats);
  if (!formats) return context.fail(formats.error());
  options.files.formats = *formats;
  for (const std::string& text : options.orientations) {
    const auto wish = parseOrientation(text);
    if (!wish) return context.fail(wish.error());
    options.settings.orientations.push_back(*wish);
  }
  if (!options.positions.empty()) {
    auto positions = readPositions(options.positions);
    if (!positions) return context.fail(positions.error());
    options.settings.positions = std::move(*positions);
  }
  std::error_code code;
  const bool isFolder = fs::is_directory(options.settings.sound, code);
  return isFolder ? syncFolder(options, context) : syncSound(options, context);
}

void addSearchOptions(CLI::App& command, SyncOptions& options) {
  auto& settings = options.settings;
  command.add_option("--surface", settings.surface, "surface of the object file");
  command.add_option("--restitution", settings.restitution, "instead of the surface's")
      ->check(CLI::Range(0.0, 0.95));
  command.add_flag("--fit", settings.fit,
                   "look for the restitution, and the surface if none is named, that suit best");
  command.add_option("--planner", settings.planner, "hybrid, shoot or graph")
      ->capture_default_str();
  command.add_option("--takes", settings.takes, "number of different motions, best first")
      ->check(CLI::Range(1, kMaxTakes))
      ->capture_default_str();
  command.add_option("--seed", settings.seed, "seed of the search")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  command.add_option("--time-limit", settings.timeLimitSeconds, "seconds; cuts the search off")
      ->check(CLI::Range(0.001, 1e6));
  command
      .add_option("--energy-gain", settings.energyGain,
                  "share of energy that a contact may add, for music")
      ->check(CLI::Range(0.0, 10.0));
  command.add_flag("--no-terminal", options.noTerminal,
                   "the last contact does not bring the object to rest");
  command.add_option("--orient", options.orientations,
                     "CONTACT:FACE=up|down, as last:6=up; CONTACT a number from 1 or last, FACE of "
                     "the object file or x,y,z of the mesh; a direction x,y,z for up; repeatable");
  command.add_option(
      "--positions", options.positions,
      "file with places in the plane: contact (a number or last), x and y in metres, tabs "
      "between");
  addGraphOptions(command, settings.graph);
}

void addMidiOptions(CLI::App& command, MidiOptions& midi) {
  command.add_option("--midi-track", midi.track, "only notes of this track of a MIDI file, from 1")
      ->check(CLI::Range(1, 65535));
  command.add_option("--midi-channel", midi.channel, "only notes of this channel")
      ->check(CLI::Range(1, 16));
  command.add_flag("--midi-durations", midi.durations,
                   "notes are rattles that last until they end, not clicks");
}

}  // namespace

void addSyncCommand(CLI::App& app, CommandContext& context) {
  auto options = std::make_shared<SyncOptions>();
  CLI::App* command = app.add_subcommand("sync", "make a motion that fits a contact sound");
  command
      ->add_option(
          "SOUND", options->settings.sound,
          "WAV, FLAC, Ogg or MP3; contacts alone (MIDI, signature JSON, CSV); or a folder of them")
      ->required();
  command
      ->add_option(
          "--object", options->settings.object,
          "name (see ifa objects) or object file; \"auto\" or a list with commas: the best of them")
      ->required();
  command->add_option("--labels", options->settings.labels,
                      "contacts of the sound: Audacity labels, WAV with cue points, CSV, JSON or "
                      "MIDI (default: its own cue points, else they are detected)");
  command->add_flag("--ignore-cues", options->settings.ignoreCues,
                    "detect the contacts though the sound has cue points");
  addMidiOptions(*command, options->settings.midi);
  command->add_option("-o,--out", options->output, "folder for the results")->required();
  addSearchOptions(*command, *options);
  command
      ->add_option("--pre-roll", options->settings.preRollSeconds,
                   "seconds of flight before the first contact")
      ->check(CLI::Range(0.0, 10.0))
      ->capture_default_str();
  command->add_option("--formats", options->formats, "list of json, glb, mp4, usda, csv")
      ->capture_default_str();
  command
      ->add_option("--fps", options->files.film.framesPerSecond,
                   "frames per second of the film (ifa render has more options)")
      ->check(numberFrom(1, 240))
      ->capture_default_str();
  command->add_flag("--glb-set", options->files.glbSet, "a floor and a light in motion.glb");
  command->callback([options, &context] {
    context.action = [options, &context] { return runSync(*options, context); };
  });
}

}  // namespace ifa::cli
