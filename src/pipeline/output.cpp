// SPDX-License-Identifier: Apache-2.0
#include "pipeline/output.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "export/glb.h"
#include "export/motion_csv.h"
#include "export/motion_json.h"
#include "export/usda.h"
#include "pipeline/copy_object.h"
#include "pipeline/manifest.h"
#include "render/timeline.h"
#include "sound/sound.h"

namespace ifa {

namespace fs = std::filesystem;

namespace {

constexpr const char* kSoundName = "sound.wav";

// Silence that `motion` needs in front of the sound, in samples: it begins before its first
// contact.
std::size_t silenceBefore(const Motion& motion, const Heard& heard) {
  const double begin = motion.trajectory.empty() ? 0 : motion.trajectory.front().time;
  const double missing = -begin - heard.signature.firstContact;
  return missing <= 0 ? 0 : static_cast<std::size_t>(std::ceil(missing * heard.sound->rate));
}

Result<void> writeSound(const fs::path& folder, const Motion& motion, const Heard& heard) {
  if (!heard.sound) return writeTimeline(folder / "timeline.svg", motion, Sound{});
  const Sound used = withLeadingSilence(*heard.sound, silenceBefore(motion, heard));
  if (auto written = writeWav(folder / kSoundName, used); !written) return written;
  return writeTimeline(folder / "timeline.svg", motion, used);
}

Result<void> writePictures(const fs::path& folder, const Motion& motion, const Body& body,
                           const std::set<OutputFormat>& formats) {
  Result<void> written;
  if (formats.count(OutputFormat::kGlb) > 0)
    written = writeGlb(folder / "motion.glb", motion, body);
  if (written && formats.count(OutputFormat::kUsda) > 0) {
    written = writeUsda(folder / "motion.usda", motion, body);
  }
  if (written && formats.count(OutputFormat::kCsv) > 0) written = writeCsv(folder, motion);
  return written;
}

Result<void> writeTake(const fs::path& folder, const Motion& motion, const Body& body,
                       const Heard& heard, const std::set<OutputFormat>& formats) {
  if (auto written = copyObject(body.definition, folder); !written) return written;
  if (auto written = writeSound(folder, motion, heard); !written) return written;
  // A search that did not get to a first contact has nothing to show, only a reason.
  if (!motion.trajectory.empty()) {
    if (auto written = writePictures(folder, motion, body, formats); !written) return written;
  }
  if (auto written = writeMotionJson(folder / "motion.json", motion); !written) return written;
  return writeManifest(folder, motion);
}

std::string takeName(std::size_t index) { return "take-" + std::to_string(index + 1); }

}  // namespace

void placeInSound(Motion& motion, const Heard& heard) {
  motion.sound = {};
  if (heard.sound) {
    const auto silence = silenceBefore(motion, heard);
    const double rate = heard.sound->rate;
    const auto samples = static_cast<double>(heard.sound->samples.size() + silence);
    motion.sound = {kSoundName, heard.sound->rate, samples / rate,
                    heard.signature.firstContact + static_cast<double>(silence) / rate};
  } else {
    const double begin = motion.trajectory.empty() ? 0 : motion.trajectory.front().time;
    motion.sound.firstContact = std::max(heard.signature.firstContact, -begin);
  }
}

Result<void> writeTakes(const fs::path& folder, const std::vector<Motion>& takes, bool numbered,
                        const Body& body, const Heard& heard,
                        const std::set<OutputFormat>& formats) {
  if (!numbered) return writeTake(folder, takes.front(), body, heard, formats);
  for (std::size_t i = 0; i < takes.size(); ++i) {
    const fs::path place = folder / takeName(i);
    std::error_code code;
    fs::create_directory(place, code);
    if (code) return badInput("cannot be made: " + code.message(), place.string());
    if (auto written = writeTake(place, takes[i], body, heard, formats); !written) return written;
  }
  return {};
}

std::vector<fs::path> outputNames() {
  std::vector<fs::path> names;
  const auto add = [&](const fs::path& folder) {
    for (const char* name : {"motion.json", "motion.glb", "motion.usda", "motion.csv",
                             "contacts.csv", "timeline.svg", kSoundName}) {
      names.push_back(folder / name);
    }
  };
  add({});
  for (std::size_t i = 0; i < kMaxTakes; ++i) add(takeName(i));
  return names;
}

// Whoever writes beside the sound must not find the sound replaced by its padded copy.
Result<void> refuseToOverwrite(const fs::path& folder, std::vector<fs::path> inputs,
                               const ObjectDefinition& object) {
  auto names = outputNames();
  names.emplace_back(object.name + ".json");
  inputs.emplace_back(object.path);
  std::vector<fs::path> meshes = {object.meshPath, object.hullPath};
  for (const ObjectPart& part : object.parts) meshes.emplace_back(part.meshPath);
  for (const fs::path& mesh : meshes) names.push_back(mesh.filename());
  inputs.insert(inputs.end(), meshes.begin(), meshes.end());
  for (const fs::path& input : inputs) {
    std::error_code code;
    const bool replaced =
        !input.empty() && std::any_of(names.begin(), names.end(), [&](const fs::path& name) {
          return fs::equivalent(folder / name, input, code);
        });
    if (!replaced) continue;
    return tl::unexpected<Error>({ErrorCode::kUsage, "would be overwritten by the result",
                                  input.string(), "choose another output folder"});
  }
  return {};
}

}  // namespace ifa
