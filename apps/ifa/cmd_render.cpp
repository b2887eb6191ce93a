// SPDX-License-Identifier: Apache-2.0
// `ifa render`: motions as a film, a contact sheet, a still or a sequence of pictures.
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "command.h"
#include "ifa/film.h"

namespace ifa::cli {

namespace fs = std::filesystem;

namespace {

struct RenderOptions {
  std::vector<fs::path> motions;
  fs::path output;
  FilmOptions film;
  std::string size, quality = "draft", camera;
  std::optional<double> still;
};

const std::map<std::string, CameraKind>& cameraNames() {
  static const std::map<std::string, CameraKind> kNames = {{"auto", CameraKind::kAuto},
                                                           {"fixed", CameraKind::kFixed},
                                                           {"follow", CameraKind::kFollow},
                                                           {"close-up", CameraKind::kCloseUp},
                                                           {"low", CameraKind::kLow}};
  return kNames;
}

/// "1280x720" as width and height. Whether the numbers are good is for the library to say.
Result<void> parseSize(const std::string& text, FilmOptions& film) {
  const auto cross = text.find('x');
  const bool good = cross != std::string::npos &&
                    CLI::detail::lexical_cast(text.substr(0, cross), film.width) &&
                    CLI::detail::lexical_cast(text.substr(cross + 1), film.height) &&
                    film.width > 0 && film.height > 0;
  if (good) return {};
  return tl::unexpected<Error>({ErrorCode::kUsage, "\"" + text + "\" is not a size", "--size",
                                "give width and height, such as 1280x720"});
}

int runRender(RenderOptions options, CommandContext& context) {
  options.film.final = options.quality == "final";
  if (!options.camera.empty()) options.film.camera = cameraNames().at(options.camera);
  if (!options.size.empty()) {
    if (auto good = parseSize(options.size, options.film); !good) return context.fail(good.error());
  }
  const auto told =
      renderMotions(options.motions, options.output, options.film, options.still, context.progress);
  if (!told) return context.fail(told.error());
  for (const std::string& warning : *told) context.console.warn(warning);
  context.console.result(options.output.string());
  return context.succeed(options.output.string());
}

}  // namespace

void addRenderCommand(CLI::App& app, CommandContext& context) {
  auto options = std::make_shared<RenderOptions>();
  CLI::App* command = app.add_subcommand("render", "make a film or pictures of motions");
  command
      ->add_option("MOTION", options->motions,
                   "motion.json, or the folder that holds it; several; or one ensemble.json")
      ->required();
  command
      ->add_option("-o,--out", options->output,
                   "NAME.mp4: film; NAME.png: contact sheet; else a folder for numbered PNGs")
      ->required();
  FilmOptions& film = options->film;
  command->add_option("--quality", options->quality, "draft or final")
      ->check(CLI::IsMember({"draft", "final"}))
      ->capture_default_str();
  command->add_option("--size", options->size, "WIDTHxHEIGHT (default: 640x360, final 1280x720)");
  command->add_option("--fps", film.framesPerSecond, "frames per second")
      ->check(numberFrom(1, 240))
      ->capture_default_str();
  command
      ->add_option("--camera", options->camera,
                   "auto, fixed, follow, close-up or low (default: auto, for contact sheets "
                   "close-up)")
      ->check(CLI::IsMember(cameraNames()));
  command->add_option("--speed", film.speed, "0.25: four times slower; the sound is stretched too")
      ->check(numberFrom(0.01, 4))
      ->capture_default_str();
  command->add_flag("--mute", film.mute, "no sound");
  command
      ->add_option("--shutter", film.shutter,
                   "share of a frame that the shutter is open; 0: no motion blur")
      ->check(numberFrom(0, 1))
      ->capture_default_str();
  command->add_flag("--overlay", film.overlay, "show waveform, playhead and contacts");
  command->add_flag("--side-by-side", film.sideBySide,
                    "a picture for each motion; else they share one floor");
  command->add_option("--floor", film.floor, "desk, wood or carpet (default: the motion's surface)")
      ->check(CLI::IsMember({"desk", "wood", "carpet"}));
  command
      ->add_option("--at", options->still, "for NAME.png: one picture of this second of the sound")
      ->check(numberFrom(-3600, 3600));
  command->callback([options, &context] {
    context.action = [options, &context] { return runRender(*options, context); };
  });
}

}  // namespace ifa::cli
