// SPDX-License-Identifier: Apache-2.0
#include "base/staged_folder.h"

#include <stdlib.h>  // mkdtemp is POSIX, not C++
#include <sys/stat.h>

#include <algorithm>
#include <system_error>

namespace ifa {

namespace fs = std::filesystem;

namespace {

tl::unexpected<Error> cannotWrite(const fs::path& path, const std::string& why) {
  return badInput("the output folder cannot be written: " + why, path.string(),
                  "choose a folder that you may write to");
}

// The folders that are made are told, so that a failure can take them away again.
Result<std::vector<fs::path>> makeFolders(const fs::path& target) {
  std::vector<fs::path> missing;
  std::error_code code;
  for (fs::path path = target; !path.empty() && !fs::exists(path, code);
       path = path.parent_path()) {
    missing.push_back(path);
  }
  std::reverse(missing.begin(), missing.end());
  fs::create_directories(target, code);
  if (!code && !fs::is_directory(target, code)) {
    return cannotWrite(target, "there is a file of that name");
  }
  if (code) {
    for (auto path = missing.rbegin(); path != missing.rend(); ++path) {
      std::error_code ignored;
      fs::remove(*path, ignored);
    }
    return cannotWrite(target, code.message());
  }
  return missing;
}

// All files below `folder`, relative to it; those named `last` at the end.
std::vector<fs::path> filesBelow(const fs::path& folder, const std::string& last) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_directory()) files.push_back(fs::relative(entry.path(), folder));
  }
  std::sort(files.begin(), files.end());
  std::stable_partition(files.begin(), files.end(),
                        [&](const fs::path& file) { return file.filename() != last; });
  return files;
}

}  // namespace

Result<StagedFolder> StagedFolder::open(const fs::path& wanted) {
  std::error_code code;
  // Without the trailing slash, so that parent_path() is the parent.
  fs::path target = fs::absolute(wanted, code).lexically_normal();
  if (code) return cannotWrite(wanted, code.message());
  if (!target.has_filename()) target = target.parent_path();
  auto made = makeFolders(target);
  if (!made) return tl::unexpected(made.error());
  std::string staging = (target / ".ifa-XXXXXX").string();
  if (::mkdtemp(staging.data()) == nullptr) {
    const std::string why = std::error_code(errno, std::generic_category()).message();
    for (auto path = made->rbegin(); path != made->rend(); ++path) fs::remove(*path, code);
    return cannotWrite(wanted, why);
  }
  return StagedFolder(target, staging, std::move(*made));
}

StagedFolder::StagedFolder(StagedFolder&& other) noexcept
    : target_(std::move(other.target_)),
      staging_(std::move(other.staging_)),
      made_(std::move(other.made_)) {
  other.staging_.clear();
  other.made_.clear();
}

StagedFolder::~StagedFolder() {
  std::error_code ignored;
  if (!staging_.empty()) fs::remove_all(staging_, ignored);
  // remove() takes empty folders only: what somebody else has put there stays.
  for (auto path = made_.rbegin(); path != made_.rend(); ++path) fs::remove(*path, ignored);
}

Result<void> StagedFolder::commit(const std::string& last,
                                  const std::vector<fs::path>& superseded) {
  std::error_code code;
  const auto files = filesBelow(staging_, last);
  // What ties the files together goes first and comes last: in between there is no motion to trust.
  for (const auto& old : superseded) {
    const bool replaced = std::find(files.begin(), files.end(), old) != files.end();
    if (!replaced || old.filename() == last) fs::remove_all(target_ / old, code);
  }
  for (const auto& file : files) {
    const fs::path place = target_ / file;
    fs::create_directories(place.parent_path(), code);
    if (!code) fs::rename(staging_ / file, place, code);
    if (code) return cannotWrite(place, code.message());
  }
  made_.clear();
  return {};
}

}  // namespace ifa
