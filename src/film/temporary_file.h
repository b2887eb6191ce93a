// SPDX-License-Identifier: Apache-2.0
// A file that is written piece by piece and seen under its name only when it is whole.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>

#include "ifa/result.h"

namespace ifa {

/// Hidden, beside the file that it becomes. Removed unless committed. Not thread safe.
class TemporaryFile {
 public:
  TemporaryFile() = default;
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  ~TemporaryFile() { discard(); }

  /// Errors: kBadInput when nothing can be made beside `target`, or when it is a folder.
  [[nodiscard]] Result<void> create(const std::filesystem::path& target);
  /// False when the disk takes no more; `failed` and `error` tell from then on.
  [[nodiscard]] bool write(const std::uint8_t* bytes, std::size_t count);
  /// As lseek(2): the new place, or -1.
  [[nodiscard]] std::int64_t seek(std::int64_t offset, int whence);
  /// Bytes, or -1.
  [[nodiscard]] std::int64_t size() const;
  /// Gives the file its name, once all of it is on the disk. Errors: kBadInput; nothing is left.
  [[nodiscard]] Result<void> commit();
  /// Removes the file if it is still a temporary.
  void discard();

  [[nodiscard]] bool failed() const { return errorNumber_ != 0; }
  [[nodiscard]] tl::unexpected<Error> error() const;
  [[nodiscard]] const std::string& temporaryName() const { return name_; }

 private:
  bool check(bool good);

  std::filesystem::path target_;
  std::string name_;
  int file_ = -1;
  int errorNumber_ = 0;  // the first failure's errno
};

}  // namespace ifa
