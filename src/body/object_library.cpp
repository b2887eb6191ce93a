// SPDX-License-Identifier: Apache-2.0
// The library of objects: where it is and what is in it.
#include <algorithm>
#include <system_error>

#include "body/object_file.h"

namespace ifa {

namespace fs = std::filesystem;

namespace {

// Numbers inside names by value, so that d6 comes before d10.
bool naturallyBefore(const std::string& a, const std::string& b) {
  const auto isDigit = [](char c) { return c >= '0' && c <= '9'; };
  const auto isZero = [](char c) { return c == '0'; };
  std::size_t i = 0, j = 0;
  while (i < a.size() && j < b.size()) {
    if (!isDigit(a[i]) || !isDigit(b[j])) {
      if (a[i] != b[j]) return a[i] < b[j];
      ++i, ++j;
      continue;
    }
    const auto number = [&](const std::string& text, std::size_t& at) {
      const auto end =
          std::find_if_not(text.begin() + static_cast<std::ptrdiff_t>(at), text.end(), isDigit);
      const auto start =
          std::find_if_not(text.begin() + static_cast<std::ptrdiff_t>(at), end, isZero);
      at = static_cast<std::size_t>(end - text.begin());
      return std::string(start, end);
    };
    const std::string m = number(a, i), n = number(b, j);
    if (m != n) return m.size() != n.size() ? m.size() < n.size() : m < n;
  }
  return a.size() - i < b.size() - j;
}

std::string joined(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

bool looksLikePath(const std::string& text) {
  return text.find('/') != std::string::npos || fs::path(text).extension() == ".json";
}

}  // namespace

Result<std::vector<std::string>> listObjects() {
  std::error_code code;
  std::vector<std::string> names;
  const fs::path folder = objectsFolder();
  for (fs::directory_iterator entry(folder, code), end; !code && entry != end;
       entry.increment(code)) {
    if (entry->path().extension() == ".json") names.push_back(entry->path().stem().string());
  }
  if (code) {
    return badInput("the library of objects cannot be read: " + code.message(), folder.string(),
                    "set IFA_OBJECTS to the folder that holds it");
  }
  std::sort(names.begin(), names.end(), naturallyBefore);
  return names;
}

Result<fs::path> findObjectFile(const std::string& nameOrPath) {
  if (nameOrPath.empty()) return badInput("no object was named");
  std::error_code code;
  if (!looksLikePath(nameOrPath)) {
    const fs::path inLibrary = objectsFolder() / (nameOrPath + ".json");
    if (fs::is_regular_file(inLibrary, code)) return inLibrary;
  }
  if (fs::is_regular_file(nameOrPath, code)) return fs::path(nameOrPath);
  if (looksLikePath(nameOrPath)) return badInput("no such object file", nameOrPath);
  const auto names = listObjects();
  if (!names) return tl::unexpected(names.error());
  return badInput("there is no object of this name", nameOrPath, "known: " + joined(*names));
}

Result<Body> loadObject(const std::string& nameOrPath) {
  const auto path = findObjectFile(nameOrPath);
  if (!path) return tl::unexpected(path.error());
  auto definition = readObjectFile(*path);
  if (!definition) return tl::unexpected(definition.error());
  return makeBody(std::move(*definition));
}

}  // namespace ifa
