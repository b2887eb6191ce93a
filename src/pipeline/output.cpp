// SPDX-License-Identifier: Apache-2.0
#include "pipeline/output.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "export/glb.h"
#include "export/motion_csv.h"
#include "export/motion_json.h"
#include "export/usda.h"
#include "pipeline/copy_object.h"
#include "pipeline/manifest.h"
#include "pipeline/output_files.h"
#include "pipeline/write_film.h"
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

/// One take on its way to its folder.
struct Take {
  fs::path folder;
  const Motion& motion;
  const Body& body;
  std::optional<Sound> sound;  ///< as used
};

Result<void> writeSound(const Take& take) {
  const fs::path timeline = take.folder / "timeline.svg";
  if (!take.sound) return writeTimeline(timeline, take.motion, Sound{});
  if (auto written = writeWav(take.folder / kSoundName, *take.sound); !written) return written;
  return writeTimeline(timeline, take.motion, *take.sound);
}

Result<void> writeFilmOf(const Take& take, const OutputSettings& output, const Progress& progress,
                         std::vector<std::string>& warnings) {
  const FilmPart part{&take.motion, &take.body, take.motion.object.name};
  const auto told = writeFilm(take.folder / "motion.mp4", {part},
                              take.sound ? &*take.sound : nullptr, output.film, progress);
  if (!told && told.error().code != ErrorCode::kInterrupted) return tl::unexpected(told.error());
  if (told && !told->empty()) warnings.push_back(*told);
  return {};
}

Result<void> writePictures(const Take& take, const OutputSettings& output, const Progress& progress,
                           std::vector<std::string>& warnings) {
  const auto wanted = [&](OutputFormat format) { return output.formats.count(format) > 0; };
  Result<void> written;
  if (wanted(OutputFormat::kGlb)) {
    AnimationSettings settings;
    settings.floorAndLight = output.glbSet;
    written = writeGlb(take.folder / "motion.glb", take.motion, take.body, settings);
  }
  if (written && wanted(OutputFormat::kUsda)) {
    written = writeUsda(take.folder / "motion.usda", take.motion, take.body);
  }
  if (written && wanted(OutputFormat::kCsv)) written = writeCsv(take.folder, take.motion);
  if (written && wanted(OutputFormat::kMp4)) {
    written = writeFilmOf(take, output, progress, warnings);
  }
  return written;
}

Result<void> writeTake(const Take& take, const OutputSettings& output, const Progress& progress,
                       std::vector<std::string>& warnings) {
  if (auto written = copyObject(take.body.definition, take.folder); !written) return written;
  if (auto written = writeSound(take); !written) return written;
  // A search that did not get to a first contact has nothing to show, only a reason.
  if (!take.motion.trajectory.empty()) {
    if (auto written = writePictures(take, output, progress, warnings); !written) return written;
  }
  if (auto written = writeMotionJson(take.folder / "motion.json", take.motion); !written) {
    return written;
  }
  return writeManifest(take.folder, take.motion);
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

Result<void> checkOutput(const OutputSettings& output) {
  if (output.formats.count(OutputFormat::kMp4) == 0) return {};
  if (!filmsCanBeWritten()) {
    return tl::unexpected<Error>({ErrorCode::kUsage, "this build writes no films", "mp4",
                                  "leave mp4 out of the formats, or build with libav"});
  }
  return checkFilmOptions(withSize(output.film));
}

Result<std::vector<std::string>> writeTakes(const fs::path& folder,
                                            const std::vector<Motion>& takes, bool numbered,
                                            const Body& body, const Heard& heard,
                                            const OutputSettings& output,
                                            const Progress& progress) {
  std::vector<std::string> warnings;
  const std::size_t count = numbered ? takes.size() : 1;
  for (std::size_t i = 0; i < count; ++i) {
    Take take{numbered ? folder / takeName(i) : folder, takes[i], body, {}};
    std::error_code code;
    fs::create_directory(take.folder, code);
    if (code) return badInput("cannot be made: " + code.message(), take.folder.string());
    if (heard.sound) {
      take.sound = withLeadingSilence(*heard.sound, silenceBefore(takes[i], heard));
    }
    if (auto written = writeTake(take, output, progress, warnings); !written) {
      return tl::unexpected(written.error());
    }
  }
  return warnings;
}

std::vector<fs::path> outputNames() {
  std::vector<fs::path> names;
  const auto add = [&](const fs::path& folder) {
    for (const OutputFile& file : kOutputFiles) names.push_back(folder / file.name);
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
