// SPDX-License-Identifier: Apache-2.0
// `ifa detect`: the contacts of a sound, shown as a table or written as marks.
#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <string>
#include <system_error>
#include <vector>

#include "command.h"
#include "signature/marks.h"
#include "signature/signature.h"
#include "sound/onset_detector.h"
#include "sound/sound.h"

namespace ifa::cli {

namespace {

struct DetectOptions {
  std::filesystem::path sound, output;
  DetectorSettings settings;
  bool noTerminal = false;
};

void showTable(Console& console, const std::vector<DetectedContact>& contacts,
               const std::vector<Label>& labels) {
  console.result("   start s       end s  level dB  rise dB  confidence  label");
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const DetectedContact& contact = contacts[i];
    const std::string end =
        contact.end > contact.start ? fmt::format("{:.6f}", contact.end) : std::string("-");
    console.result(fmt::format("{:10.6f}  {:>10}  {:8.1f} {:8.1f}  {:10.2f}  {}", contact.start,
                               end, contact.level, contact.rise, contact.confidence,
                               labels[i].text));
  }
}

int runDetect(const DetectOptions& options, CommandContext& context) {
  std::error_code code;
  if (std::filesystem::equivalent(options.sound, options.output, code)) {
    return context.fail({ErrorCode::kUsage, "the sound would be overwritten",
                         options.output.string(), "name another file with -o"});
  }
  const auto sound = readSound(options.sound);
  if (!sound) return context.fail(sound.error());
  auto contacts = detectContacts(*sound, options.settings);
  if (!contacts) {
    contacts.error().place = options.sound.string();
    return context.fail(contacts.error());
  }
  const auto labels = labelsFromContacts(*contacts, !options.noTerminal);
  if (options.output.empty()) {
    showTable(context.console, *contacts, labels);
    return context.succeed();
  }
  if (const auto written = writeMarks(options.output, options.sound, *sound, labels); !written) {
    return context.fail(written.error());
  }
  context.console.result(fmt::format("{} contact{} written to {}", labels.size(),
                                     labels.size() == 1 ? "" : "s", options.output.string()));
  return context.succeed(options.output.string());
}

}  // namespace

void addDetectCommand(CLI::App& app, CommandContext& context) {
  auto options = std::make_shared<DetectOptions>();
  CLI::App* command = app.add_subcommand("detect", "find the contacts of a sound");
  command->add_option("SOUND", options->sound, "WAV, FLAC, Ogg or MP3")->required();
  command->add_option(
      "-o,--out", options->output,
      "file to write, by its ending: .wav the sound with cue points, .csv or .json the "
      "signature, else an Audacity label track");
  command->add_flag("--no-terminal", options->noTerminal,
                    "the last contact does not bring the object to rest");
  command
      ->add_option("--min-rise", options->settings.minRise,
                   "dB; higher finds fewer, surer contacts")
      ->check(numberFrom(1, 40))
      ->capture_default_str();
  command
      ->add_option("--range", options->settings.range,
                   "dB under the loudest contact where listening stops")
      ->check(numberFrom(1, 100))
      ->capture_default_str();
  command
      ->add_option("--after", options->settings.after,
                   "s after a moment in which an attack's energy is taken")
      ->check(numberFrom(0.0005, 0.1))
      ->capture_default_str();
  command
      ->add_option("--before", options->settings.before,
                   "s before it that this is compared with; longer hides more echoes")
      ->check(numberFrom(0.0005, 0.1))
      ->capture_default_str();
  command->callback([options, &context] {
    context.action = [options, &context] { return runDetect(*options, context); };
  });
}

}  // namespace ifa::cli
