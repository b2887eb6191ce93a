// SPDX-License-Identifier: Apache-2.0
// `ifa sonify`: the sound of a motion, made from its contacts.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <system_error>

#include "command.h"
#include "pipeline/motion_folder.h"
#include "sonify/sonify.h"

namespace ifa::cli {

namespace fs = std::filesystem;

namespace {

struct SonifyOptions {
  fs::path motion, output;
  std::string material;
  SonifySettings settings;
};

/// Decision: an object whose material is not known sounds as plastic, and it is said.
Result<SoundMaterial> materialOf(const SonifyOptions& options, const Body& body, Console& console) {
  if (!options.material.empty()) return findSoundMaterial(options.material);
  auto own = findSoundMaterial(body.definition.material);
  if (own) return own;
  console.warn(own.error().message + ", so acrylic is taken; --material chooses another");
  return findSoundMaterial("acrylic");
}

/// The recording that a motion is synchronised to is not replaced by accident.
bool isOwnSound(const fs::path& output, const MotionFolder& folder) {
  const std::string& name = folder.motion.sound.file;
  std::error_code code;
  return !name.empty() &&
         fs::equivalent(output, fs::absolute(folder.file).parent_path() / name, code);
}

int runSonify(SonifyOptions options, CommandContext& context) {
  const auto folder = readMotionFolder(options.motion);
  if (!folder) return context.fail(folder.error());
  if (isOwnSound(options.output, *folder)) {
    return context.fail({ErrorCode::kUsage, "the motion's own sound would be overwritten",
                         options.output.string(), "name another file with -o"});
  }
  for (const std::string& warning : folder->warnings) context.console.warn(warning);
  const Motion& motion = folder->motion;
  const auto material = materialOf(options, folder->body, context.console);
  if (!material) return context.fail(material.error());
  SonifySettings& settings = options.settings;
  settings.material = *material;
  settings.floor = soundFloor(motion.object.surface);
  settings.lead = std::max(0.0, motion.sound.firstContact);
  settings.duration = motion.sound.duration;
  const auto strikes = strikesOf(motion, folder->body);
  if (strikes.empty()) {
    return context.fail(
        {ErrorCode::kBadInput, "nothing in the motion makes a sound", folder->file.string(), {}});
  }
  const Sound sound = sonify(folder->body, strikes, settings);
  if (const auto written = writeWav(options.output, sound); !written) {
    return context.fail(written.error());
  }
  context.console.result(options.output.string());
  return context.succeed(options.output.string());
}

}  // namespace

void addSonifyCommand(CLI::App& app, CommandContext& context) {
  auto options = std::make_shared<SonifyOptions>();
  CLI::App* command = app.add_subcommand("sonify", "make the sound of a motion");
  command->add_option("MOTION", options->motion, "motion.json, or the folder that holds it")
      ->required();
  command->add_option("-o,--out", options->output, "WAV file to write")->required();
  command
      ->add_option("--material", options->material,
                   "what the body is made of (default: as its object file says)")
      ->check(CLI::IsMember(soundMaterialNames(), CLI::ignore_case));
  command->add_option("--seed", options->settings.seed, "another floor of the same kind")
      ->capture_default_str();
  command
      ->add_option("--reverb", options->settings.reverberation,
                   "s in which the echo of the room falls by 60 dB; 0: no room")
      ->check(numberFrom(0, 10))
      ->capture_default_str();
  command->callback([options, &context] {
    context.action = [options, &context] { return runSonify(*options, context); };
  });
}

}  // namespace ifa::cli
