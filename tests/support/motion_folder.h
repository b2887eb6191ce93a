// SPDX-License-Identifier: Apache-2.0
// A folder as a synchronisation leaves it: motion, object, sound. Tests that include this link
// PkgConfig::SNDFILE.
#pragma once

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "audit/analytic_motion.h"
#include "export/motion_json.h"
#include "support/clicks.h"

namespace ifa::test {

/// A die that falls flat, bounces twice, slides and rests; its contacts.
inline Motion makeDieMotion() {
  Body die = makeDieBody();
  Motion motion = makeSlidingMotion(die);
  motion.object = {"d6", "d6.obj", "desk", die.mass, 0.7, 0.35};
  motion.sound = {"sound.wav", kClickRate, 1, 0.25};
  return motion;
}

/// Writes the motion, the die, and a click for each contact.
inline void writeMotionFolder(const std::filesystem::path& folder, const Motion& motion,
                              double soundSeconds = 1) {
  namespace fs = std::filesystem;
  fs::create_directories(folder);
  for (const char* name : {"d6.json", "d6.obj", "d6.mtl"}) {
    fs::copy_file(fs::path(IFA_SOURCE_DIR) / "objects" / name, folder / name);
  }
  std::vector<Click> clicks;
  for (const MotionContact& contact : motion.contacts) {
    clicks.push_back({contact.time + motion.sound.firstContact, 0.8});
  }
  writeClicks(folder / "sound.wav", clicks, soundSeconds);
  const auto written = writeMotionJson(folder / "motion.json", motion);
  if (!written) throw std::runtime_error(written.error().text());
}

/// Names in a folder, in order, without `except` (a motion's own folder).
inline std::vector<std::string> namesBeside(const std::filesystem::path& folder,
                                            const std::string& except) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().filename() != except) names.push_back(entry.path().filename().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace ifa::test
