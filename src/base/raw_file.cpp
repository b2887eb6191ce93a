// SPDX-License-Identifier: Apache-2.0
#include "base/raw_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <string>
#include <system_error>
#include <thread>

namespace ifa {

namespace fs = std::filesystem;

namespace {

tl::unexpected<Error> failed(const char* what, const fs::path& path, std::string remedy) {
  return badInput(std::string(what) + ": " + std::strerror(errno), path.string(),
                  std::move(remedy));
}

tl::unexpected<Error> cannotWrite(const fs::path& path) {
  const bool full = errno == ENOSPC || errno == EDQUOT || errno == EFBIG;
  return failed("cannot be written", path,
                full ? "free some space, or choose another disk"
                     : "check that the folder exists and may be written to");
}

tl::unexpected<Error> cannotRead(const fs::path& path) {
  return failed("cannot be read", path, {});
}

}  // namespace

Result<RawFile> RawFile::open(const fs::path& path, Mode mode) {
  const int flags = mode == Mode::kRead     ? O_RDONLY
                    : mode == Mode::kUpdate ? O_RDWR | O_CREAT
                                            : O_RDWR | O_CREAT | O_TRUNC;
  const int file = ::open(path.c_str(), flags | O_CLOEXEC, 0666);
  if (file < 0 && mode != Mode::kRead) return cannotWrite(path);
  if (file < 0 && errno == ENOENT) return badInput("no such file", path.string());
  if (file < 0) return cannotRead(path);
  RawFile opened(path, file);
  struct stat status = {};
  if (::fstat(file, &status) != 0) return cannotRead(path);
  if (!S_ISREG(status.st_mode)) return badInput("is not a file", path.string());
  return opened;
}

RawFile::~RawFile() {
  if (file_ >= 0) ::close(file_);
}

Result<void> RawFile::write(std::span<const std::byte> bytes, std::uint64_t offset) {
  while (!bytes.empty()) {
    const ssize_t count = ::pwrite(file_, bytes.data(), bytes.size(), static_cast<off_t>(offset));
    if (count < 0 && errno == EINTR) continue;
    if (count == 0) errno = ENOSPC;
    if (count <= 0) return cannotWrite(path_);
    bytes = bytes.subspan(static_cast<std::size_t>(count));
    offset += static_cast<std::uint64_t>(count);
  }
  return {};
}

Result<void> RawFile::read(std::span<std::byte> bytes, std::uint64_t offset) const {
  while (!bytes.empty()) {
    const ssize_t count = ::pread(file_, bytes.data(), bytes.size(), static_cast<off_t>(offset));
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return cannotRead(path_);
    if (count == 0) return badInput("ends too early", path_.string());
    bytes = bytes.subspan(static_cast<std::size_t>(count));
    offset += static_cast<std::uint64_t>(count);
  }
  return {};
}

Result<std::uint64_t> RawFile::size() const {
  struct stat status = {};
  if (::fstat(file_, &status) != 0) return cannotRead(path_);
  return static_cast<std::uint64_t>(status.st_size);
}

Result<void> RawFile::resize(std::uint64_t bytes) {
  if (::ftruncate(file_, static_cast<off_t>(bytes)) != 0) return cannotWrite(path_);
  return {};
}

Result<void> RawFile::sync() {
  if (::fsync(file_) != 0) return cannotWrite(path_);
  return {};
}

Result<std::optional<FileLock>> FileLock::tryToTake(const fs::path& path) {
  const fs::path name = path.string() + ".lock";
  while (true) {
    auto file = RawFile::open(name, RawFile::Mode::kUpdate);
    if (!file) return tl::unexpected(file.error());
    if (::flock(file->descriptor(), LOCK_EX | LOCK_NB) != 0) {
      if (errno != EWOULDBLOCK) return cannotWrite(name);
      return std::nullopt;
    }
    // Whoever held it may have removed it in between: then this is a lock that nobody else sees.
    struct stat ours = {}, there = {};
    const bool seen = ::fstat(file->descriptor(), &ours) == 0 &&
                      ::stat(name.c_str(), &there) == 0 && ours.st_ino == there.st_ino &&
                      ours.st_dev == there.st_dev;
    if (seen) return FileLock(std::move(*file));
  }
}

Result<FileLock> FileLock::take(const fs::path& path) {
  auto lock = tryToTake(path);
  if (!lock) return tl::unexpected(lock.error());
  if (*lock) return std::move(**lock);
  return badInput("is being made by another process", path.string(),
                  "wait until that is done, or name another file");
}

Result<FileLock> FileLock::await(const fs::path& path, const std::function<bool()>& stop) {
  constexpr std::chrono::milliseconds kBetweenTries(50);
  while (!stop()) {
    auto lock = tryToTake(path);
    if (!lock) return tl::unexpected(lock.error());
    if (*lock) return std::move(**lock);
    std::this_thread::sleep_for(kBetweenTries);
  }
  return tl::unexpected<Error>({ErrorCode::kInterrupted, "interrupted", path.string(), {}});
}

FileLock::~FileLock() {
  if (file_.descriptor() < 0) return;
  std::error_code ignored;
  fs::remove(file_.path(), ignored);
}

}  // namespace ifa
