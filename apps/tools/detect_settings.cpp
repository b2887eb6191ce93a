// SPDX-License-Identifier: Apache-2.0
// The contacts of a sound by many settings of the detector, for scripts/evaluate_detection.py: a
// process for each would spend its time on starting.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>

#include "sound/onset_detector.h"
#include "sound/sound.h"

int main(int argc, char** argv) {
  CLI::App app{
      "Reads lines \"MIN_RISE AFTER BEFORE\" (dB, s, s) and answers each with a line \"START END\" "
      "for each contact, and an empty one"};
  std::filesystem::path path;
  app.add_option("SOUND", path)->required();
  CLI11_PARSE(app, argc, argv);
  const auto sound = ifa::readSound(path);
  if (!sound) {
    fmt::print(stderr, "{}\n", sound.error().text());
    return 3;
  }
  ifa::DetectorSettings settings;
  while (std::cin >> settings.minRise >> settings.after >> settings.before) {
    if (const auto contacts = ifa::detectContacts(*sound, settings)) {
      for (const ifa::DetectedContact& contact : *contacts) {
        fmt::print("{:.6f} {:.6f}\n", contact.start, contact.end);
      }
    }
    fmt::print("\n");
  }
  return 0;
}
