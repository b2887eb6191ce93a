// SPDX-License-Identifier: Apache-2.0
#include "base/file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>

#include "base/write_all.h"

namespace ifa {

Result<std::string> readFile(const std::filesystem::path& path, std::size_t maxBytes) {
  std::error_code code;
  const auto status = std::filesystem::status(path, code);
  if (!std::filesystem::exists(status)) return badInput("no such file", path.string());
  if (std::filesystem::is_directory(status))
    return badInput("is a folder, not a file", path.string());
  std::ifstream stream(path, std::ios::binary);
  if (!stream) return badInput("cannot be opened for reading", path.string());
  std::string bytes;
  char block[1 << 16];
  while (stream.read(block, sizeof block), stream.gcount() > 0) {
    bytes.append(block, static_cast<std::size_t>(stream.gcount()));
    if (bytes.size() > maxBytes) {
      return badInput("is larger than " + std::to_string(maxBytes >> 20) + " MiB", path.string());
    }
  }
  if (stream.bad()) return badInput("could not be read to its end", path.string());
  return bytes;
}

bool writeAll(int file, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(file, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

Result<void> writeFileAtomically(const std::filesystem::path& path, std::string_view bytes) {
  std::string temporary = path.string() + ".XXXXXX";
  const int file = ::mkstemp(temporary.data());
  const auto failed = [&]() {
    return badInput(std::string("cannot be written: ") + std::strerror(errno), path.string(),
                    "check that the folder exists, is writable and has space left");
  };
  if (file < 0) return failed();
  const mode_t mask = ::umask(0);
  ::umask(mask);
  bool good = writeAll(file, bytes) && ::fchmod(file, 0666 & ~mask) == 0;
  good = (::close(file) == 0) && good;
  good = good && ::rename(temporary.c_str(), path.c_str()) == 0;
  if (good) return {};
  const auto error = failed();
  ::unlink(temporary.c_str());
  return error;
}

}  // namespace ifa
