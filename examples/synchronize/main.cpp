// SPDX-License-Identifier: Apache-2.0
// Sound and labels to motion with the library alone:
//   synchronize SOUND LABELS OBJECT
// Without arguments it makes up three knocks and synchronises an eraser to them.
#include <ifa/ifa.h>

#include <cstdio>
#include <fstream>

// The last contact is a terminal one: the body comes to rest.
static void writeKnocks(const char* path) {
  std::ofstream(path) << R"({"format": "inverse-foley-signature", "version": 1, "terminal": true,
    "events": [{"time": 0, "duration": 0, "amplitude": 1, "centroid": 0, "weight": 1},
               {"time": 0.21, "duration": 0, "amplitude": 0.6, "centroid": 0, "weight": 1},
               {"time": 0.30, "duration": 0.06, "amplitude": 0.5, "centroid": 0.02, "weight": 1}]})";
}

int main(int argc, char** argv) {
  ifa::SynchronizeSettings settings;
  settings.objects = OBJECTS_FOLDER;
  if (argc == 4) {
    settings.sound = argv[1];
    settings.labels = argv[2];
    settings.object = argv[3];
  } else {
    settings.sound = "knocks.json";
    settings.object = "Eraser";
    writeKnocks("knocks.json");
  }
  const auto result = ifa::synchronize(settings);
  if (!result) {
    std::fprintf(stderr, "%s\n", result.error().text().c_str());
    return static_cast<int>(result.error().code);
  }
  const ifa::Motion& motion = result->takes.front();
  std::printf("%s: %s, score %.2f\n", motion.object.name.c_str(),
              motion.success ? "solved" : motion.failure.c_str(), motion.score);
  for (const ifa::MotionContact& contact : motion.contacts) {
    std::printf("  contact at %.4f s, target %.4f s\n", contact.time, contact.targetTime);
  }
  return motion.success ? 0 : static_cast<int>(ifa::ErrorCode::kNoMotion);
}
