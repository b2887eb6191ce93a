// SPDX-License-Identifier: Apache-2.0
// A file that is written and read at offsets, and a lock by which one process at a time makes one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <utility>

#include "ifa/result.h"

namespace ifa {

/// An open file. Errors (kBadInput) name the file and what the system says. Not thread safe.
class RawFile {
 public:
  enum class Mode {
    kRead,
    kUpdate,  ///< for reading and writing; made when it is missing
    kReplace  ///< likewise, and emptied
  };
  [[nodiscard]] static Result<RawFile> open(const std::filesystem::path& path, Mode mode);

  RawFile(RawFile&& other) noexcept
      : path_(std::move(other.path_)), file_(std::exchange(other.file_, -1)) {}
  RawFile& operator=(RawFile&&) = delete;
  RawFile(const RawFile&) = delete;
  RawFile& operator=(const RawFile&) = delete;
  ~RawFile();

  /// All of `bytes`; short of an error.
  [[nodiscard]] Result<void> write(std::span<const std::byte> bytes, std::uint64_t offset);
  /// Exactly `bytes.size()` bytes; an error when the file is shorter.
  [[nodiscard]] Result<void> read(std::span<std::byte> bytes, std::uint64_t offset) const;
  [[nodiscard]] Result<std::uint64_t> size() const;
  [[nodiscard]] Result<void> resize(std::uint64_t bytes);
  /// Returns when the disk has it.
  [[nodiscard]] Result<void> sync();

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] int descriptor() const { return file_; }

 private:
  RawFile(std::filesystem::path path, int file) : path_(std::move(path)), file_(file) {}

  std::filesystem::path path_;
  int file_ = -1;
};

/// Held while one process makes `path`; a second one is refused. Ends with the process, however
/// that ends. The lock is a file beside it, `path`.lock, that is removed with the lock.
class FileLock {
 public:
  /// Errors: kBadInput when it is taken, or when the folder cannot be written.
  [[nodiscard]] static Result<FileLock> take(const std::filesystem::path& path);
  /// The same, but waits while another process has it, until `stop` says not to: then the error is
  /// kInterrupted.
  [[nodiscard]] static Result<FileLock> await(const std::filesystem::path& path,
                                              const std::function<bool()>& stop);

  FileLock(FileLock&& other) noexcept = default;
  FileLock& operator=(FileLock&&) = delete;
  ~FileLock();

 private:
  explicit FileLock(RawFile file) : file_(std::move(file)) {}
  /// Nothing where another process has it.
  [[nodiscard]] static Result<std::optional<FileLock>> tryToTake(const std::filesystem::path& path);

  RawFile file_;
};

}  // namespace ifa
