// SPDX-License-Identifier: Apache-2.0
#include "pipeline/batch.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <set>
#include <system_error>

#include "export/motion_json.h"
#include "pipeline/output_files.h"
#include "pipeline/settings_hash.h"

namespace ifa {

namespace fs = std::filesystem;

namespace {

std::string lowerCase(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return text;
}

// "a.signature.json" is a signature; other JSON files beside a sound are something else.
std::string stemOf(const fs::path& path) {
  static constexpr std::array kSounds = {".wav", ".flac", ".ogg", ".oga", ".mp3",
                                         ".aif", ".aiff", ".mid", ".midi"};
  const auto extension = lowerCase(path.extension().string());
  if (std::find(kSounds.begin(), kSounds.end(), extension) != kSounds.end()) return path.stem();
  const fs::path inner = path.stem();
  return extension == ".json" && inner.extension() == ".signature" ? inner.stem() : fs::path();
}

bool isMidi(const fs::path& path) {
  const auto extension = lowerCase(path.extension().string());
  return extension == ".mid" || extension == ".midi";
}

fs::path labelsBeside(const fs::path& sound) {
  if (sound.extension() == ".json" || isMidi(sound)) return {};
  for (const char* ending : {".txt", ".csv", ".mid", ".midi"}) {
    std::error_code code;
    fs::path labels = fs::path(sound).replace_extension(ending);
    if (fs::is_regular_file(labels, code)) return labels;
  }
  return {};
}

// A MIDI file beside a sound of the same name tells that one's contacts.
void dropLabels(std::vector<BatchItem>& items) {
  std::set<fs::path> sounds;
  for (const BatchItem& item : items) {
    if (!isMidi(item.sound)) sounds.insert(fs::path(item.sound).replace_extension());
  }
  std::erase_if(items, [&](const BatchItem& item) {
    return isMidi(item.sound) && sounds.count(fs::path(item.sound).replace_extension()) > 0;
  });
}

bool isNewer(const fs::path& path, fs::file_time_type than) {
  std::error_code code;
  const auto written = fs::last_write_time(path, code);
  return !code && written > than;
}

std::vector<fs::path> motionFiles(const fs::path& folder, int takes) {
  if (takes == 1) return {folder / "motion.json"};
  std::vector<fs::path> files;
  for (int i = 1; i <= takes; ++i) files.push_back(folder / fmt::format("take-{}/motion.json", i));
  return files;
}

// A film that was interrupted, or was not asked for then, is missing.
bool holds(const fs::path& folder, const OutputSettings& output) {
  return std::all_of(kOutputFiles.begin(), kOutputFiles.end(), [&](const OutputFile& file) {
    std::error_code code;
    return !file.format || output.formats.count(*file.format) == 0 ||
           fs::is_regular_file(folder / file.name, code);
  });
}

bool isDone(const BatchItem& item, const SynchronizeSettings& settings, const fs::path& folder,
            const OutputSettings& output) {
  const std::string wanted = hashOf(settings, output);
  const std::array<fs::path, 4> inputs = {item.sound, item.labels, settings.object,
                                          settings.graph.database};
  for (const auto& file : motionFiles(folder, settings.takes)) {
    std::error_code code;
    const auto written = fs::last_write_time(file, code);
    if (code || std::any_of(inputs.begin(), inputs.end(),
                            [&](const fs::path& input) { return isNewer(input, written); })) {
      return false;
    }
    const auto motion = readMotionJson(file);
    if (!motion || !motion->success || motion->settings != wanted ||
        !holds(file.parent_path(), output)) {
      return false;
    }
  }
  return true;
}

BatchResult synchronizeOne(const BatchItem& item, SynchronizeSettings settings,
                           const fs::path& folder, const OutputSettings& output,
                           const Progress& progress) {
  settings.sound = item.sound;
  settings.labels = item.labels;
  if (isDone(item, settings, folder, output)) return {item, BatchOutcome::kSkipped, "done before"};
  const auto result = synchronizeToFolder(settings, folder, output, progress);
  if (!result) return {item, BatchOutcome::kFailed, result.error().text()};
  const Motion& best = result->takes.front();
  if (!best.success) return {item, BatchOutcome::kFailed, best.failure};
  return {item, BatchOutcome::kSolved, describe(best)};
}

}  // namespace

Result<std::vector<BatchItem>> findSounds(const fs::path& folder) {
  std::vector<BatchItem> items;
  std::map<std::string, int> stems;
  std::error_code code;
  for (auto entry = fs::directory_iterator(folder, code); !code && entry != fs::end(entry);
       entry.increment(code)) {
    const std::string stem = stemOf(entry->path());
    if (stem.empty() || !entry->is_regular_file()) continue;
    items.push_back({stem, entry->path(), labelsBeside(entry->path())});
  }
  if (code) return badInput("cannot be read: " + code.message(), folder.string());
  if (items.empty()) {
    return badInput("there is no sound in this folder", folder.string(),
                    "sounds are looked for in the folder itself, not in folders below it");
  }
  dropLabels(items);
  for (const BatchItem& item : items) ++stems[item.name];
  for (BatchItem& item : items) {
    if (stems[item.name] > 1) item.name = item.sound.filename().string();
  }
  std::sort(items.begin(), items.end(),
            [](const BatchItem& one, const BatchItem& other) { return one.name < other.name; });
  return items;
}

std::vector<BatchResult> synchronizeAll(const std::vector<BatchItem>& sounds,
                                        const SynchronizeSettings& settings, const fs::path& folder,
                                        const OutputSettings& output, const Progress& progress,
                                        const std::function<void(const BatchResult&)>& tell) {
  std::vector<BatchResult> results;
  for (std::size_t i = 0; i < sounds.size() && !progress.stopRequested(); ++i) {
    Progress inner = progress;
    inner.report = [&](std::string_view stage, double share) {
      progress(fmt::format("[{}/{}] {}: {}", i + 1, sounds.size(), sounds[i].name, stage), share);
    };
    results.push_back(synchronizeOne(sounds[i], settings, folder / sounds[i].name, output, inner));
    if (tell) tell(results.back());
  }
  return results;
}

std::string describe(const Motion& motion) {
  return fmt::format(
      "{} contacts, score {:.2f}, f_v {:.2f}, bend {:.2f} (at most {:.2f}), {:.2f} s",
      motion.contacts.size(), motion.score, motion.meanFv, motion.bend.median, motion.bend.max,
      motion.searchSeconds);
}

}  // namespace ifa
