// SPDX-License-Identifier: Apache-2.0
#include "film/temporary_file.h"

#include <fcntl.h>
#include <stdlib.h>  // mkostemp is not C++
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

namespace ifa {

// Later failures only follow from the first.
bool TemporaryFile::check(bool good) {
  if (!good && errorNumber_ == 0) errorNumber_ = errno;
  return good;
}

tl::unexpected<Error> TemporaryFile::error() const {
  return badInput(
      "cannot be written: " + std::error_code(errorNumber_, std::generic_category()).message(),
      target_.string(), "check that the folder exists, is writable and has space left");
}

Result<void> TemporaryFile::create(const std::filesystem::path& target) {
  discard();
  target_ = target;
  std::error_code ignored;
  if (std::filesystem::is_directory(target, ignored)) {
    return badInput("is a folder, not a file", target.string(), "give the name of a file");
  }
  std::string name =
      (target.parent_path() / ("." + target.filename().string() + ".XXXXXX")).string();
  file_ = ::mkostemp(name.data(), O_CLOEXEC);
  if (!check(file_ >= 0)) return error();
  name_ = std::move(name);
  return {};
}

bool TemporaryFile::write(const std::uint8_t* bytes, std::size_t count) {
  while (count > 0) {
    const ssize_t written = ::write(file_, bytes, count);
    if (written < 0 && errno == EINTR) continue;
    if (!check(written > 0)) return false;
    bytes += written;
    count -= static_cast<std::size_t>(written);
  }
  return true;
}

std::int64_t TemporaryFile::seek(std::int64_t offset, int whence) {
  const off_t place = ::lseek(file_, offset, whence);
  check(place >= 0);
  return place;
}

std::int64_t TemporaryFile::size() const {
  struct stat status {};
  return ::fstat(file_, &status) == 0 ? status.st_size : -1;
}

Result<void> TemporaryFile::commit() {
  const mode_t mask = ::umask(0);
  ::umask(mask);
  // A disk may take bytes that it has no space for and say so only here, or when it is closed.
  bool good = !failed() && check(::fsync(file_) == 0) && check(::fchmod(file_, 0666 & ~mask) == 0);
  good = check(::close(std::exchange(file_, -1)) == 0) && good;
  good = good && check(::rename(name_.c_str(), target_.c_str()) == 0);
  if (good) {
    name_.clear();
    return {};
  }
  discard();
  return error();
}

void TemporaryFile::discard() {
  if (file_ >= 0) ::close(std::exchange(file_, -1));
  if (!name_.empty()) ::unlink(std::exchange(name_, {}).c_str());
}

}  // namespace ifa
