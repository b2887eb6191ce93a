// SPDX-License-Identifier: Apache-2.0
// The cases of an evaluation set on disk.
#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <system_error>

#include "pipeline/evaluate.h"

namespace ifa {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view kSignature = ".signature.json";

/// Numbers inside names compare as numbers: d6 before d10.
bool naturallyBefore(const std::string& a, const std::string& b) {
  const auto digit = [](char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; };
  std::size_t i = 0, j = 0;
  while (i < a.size() && j < b.size()) {
    if (digit(a[i]) && digit(b[j])) {
      std::size_t iEnd = i, jEnd = j;
      while (iEnd < a.size() && digit(a[iEnd])) ++iEnd;
      while (jEnd < b.size() && digit(b[jEnd])) ++jEnd;
      while (i + 1 < iEnd && a[i] == '0') ++i;
      while (j + 1 < jEnd && b[j] == '0') ++j;
      if (iEnd - i != jEnd - j) return iEnd - i < jEnd - j;
      const int order = a.compare(i, iEnd - i, b, j, jEnd - j);
      if (order != 0) return order < 0;
      i = iEnd;
      j = jEnd;
    } else if (a[i] != b[j]) {
      return a[i] < b[j];
    } else {
      ++i;
      ++j;
    }
  }
  return a.size() - i < b.size() - j;
}

std::vector<fs::path> sortedEntries(const fs::path& folder) {
  std::vector<fs::path> entries;
  std::error_code code;
  for (const auto& entry : fs::directory_iterator(folder, code)) entries.push_back(entry.path());
  std::sort(entries.begin(), entries.end(), [](const fs::path& a, const fs::path& b) {
    return naturallyBefore(a.filename().string(), b.filename().string());
  });
  return entries;
}

bool isSoundFile(const fs::path& path) {
  const std::string extension = path.extension().string();
  return extension == ".wav" || extension == ".flac" || extension == ".ogg" || extension == ".mp3";
}

/// The number that a case's name ends in; none where it ends otherwise.
std::optional<char> lastDigit(const std::string& name) {
  if (name.empty() || std::isdigit(static_cast<unsigned char>(name.back())) == 0) return {};
  return name.back();
}

bool chosen(const std::string& name, const EvaluateSettings& settings) {
  if (!settings.parity) return true;
  const auto digit = lastDigit(name);
  return digit && ((*digit - '0') % 2 == 0) == (*settings.parity == Parity::kEven);
}

/// The case of a file; its name is empty when the file is none.
EvaluationCase caseOf(const fs::path& path) {
  EvaluationCase what;
  const std::string file = path.filename().string();
  if (file.size() > kSignature.size() && file.ends_with(kSignature)) {
    what.name = file.substr(0, file.size() - kSignature.size());
    what.sound = path;
  } else if (path.extension() == ".mid") {
    what.name = path.stem().string();
    what.sound = path;
  } else if (isSoundFile(path)) {
    fs::path labels = path;
    labels.replace_extension(".txt");
    std::error_code code;
    if (!fs::is_regular_file(labels, code)) return what;
    what.name = path.stem().string();
    what.sound = path;
    what.labels = labels;
  }
  return what;
}

void addCasesOf(const fs::path& folder, const EvaluateSettings& settings,
                std::vector<EvaluationCase>& cases) {
  const std::string name = folder.filename().string();
  const std::size_t at = name.find('@');
  std::size_t count = 0;
  for (const fs::path& path : sortedEntries(folder)) {
    EvaluationCase what = caseOf(path);
    if (what.name.empty() || !chosen(what.name, settings)) continue;
    if (settings.limit > 0 && count++ >= settings.limit) return;
    std::error_code code;
    const fs::path places = folder / (what.name + ".json");
    if (fs::is_regular_file(places, code)) what.places = places;
    what.object = name.substr(0, at);
    if (at != std::string::npos) what.surface = name.substr(at + 1);
    cases.push_back(std::move(what));
  }
}

}  // namespace

Result<std::vector<EvaluationCase>> findCases(const EvaluateSettings& settings) {
  std::error_code code;
  if (!fs::is_directory(settings.folder, code)) {
    return badInput("is not a folder", settings.folder.string());
  }
  std::vector<EvaluationCase> cases;
  for (const fs::path& path : sortedEntries(settings.folder)) {
    if (fs::is_directory(path, code)) addCasesOf(path, settings, cases);
  }
  if (!cases.empty()) return cases;
  return badInput(
      settings.parity ? "holds no case of that parity" : "holds no case", settings.folder.string(),
      "put NAME.wav with NAME.txt, NAME.signature.json or NAME.mid into a folder that is "
      "named after an object");
}

}  // namespace ifa
