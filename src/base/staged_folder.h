// SPDX-License-Identifier: Apache-2.0
// An output folder whose files appear together when all of them are done.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "ifa/result.h"

namespace ifa {

/// Files are written into a hidden folder on the same disk and moved into place by `commit`. Until
/// then, and on any failure, the folder is as it was before. Not thread safe.
class StagedFolder {
 public:
  /// Errors: kBadInput when `target` cannot be made or written, before any work is done for it.
  [[nodiscard]] static Result<StagedFolder> open(const std::filesystem::path& target);

  StagedFolder(StagedFolder&& other) noexcept;
  StagedFolder& operator=(StagedFolder&& other) = delete;
  StagedFolder(const StagedFolder&) = delete;
  StagedFolder& operator=(const StagedFolder&) = delete;
  /// Leaves no trace unless committed.
  ~StagedFolder();

  /// Where to write; folders may be made in it.
  [[nodiscard]] const std::filesystem::path& path() const { return staging_; }

  /// Moves everything into the target, `last` (a file's name, in whatever subfolder) at the end.
  /// @param superseded  names in the target that an earlier run may have left: removed first where
  ///                    they are not among the new ones
  [[nodiscard]] Result<void> commit(const std::string& last,
                                    const std::vector<std::filesystem::path>& superseded);

 private:
  StagedFolder(std::filesystem::path target, std::filesystem::path staging,
               std::vector<std::filesystem::path> made)
      : target_(std::move(target)), staging_(std::move(staging)), made_(std::move(made)) {}

  std::filesystem::path target_, staging_;
  std::vector<std::filesystem::path> made_;  ///< folders that did not exist before, outermost first
};

}  // namespace ifa
