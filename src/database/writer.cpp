// SPDX-License-Identifier: Apache-2.0
#include "database/writer.h"

#include <cstring>
#include <system_error>

namespace ifa {

namespace fs = std::filesystem;

namespace {

fs::path temporaryOf(const fs::path& path) { return path.string() + ".new"; }

constexpr std::array<std::byte, 64> kZeros{};

}  // namespace

std::vector<std::byte> columnOf(const EventBlock& block, std::size_t column) {
  const std::size_t size = column == kFlags ? 1 : sizeof(float);
  std::vector<std::byte> bytes(size * block.records.size());
  for (std::size_t i = 0; i < block.records.size(); ++i) {
    // The flags are the last word, and their lowest byte comes first.
    const auto* record = reinterpret_cast<const std::byte*>(&block.records[i]);
    std::memcpy(bytes.data() + size * i, record + sizeof(float) * column, size);
  }
  return bytes;
}

DatabaseWriter::DatabaseWriter(fs::path path, const DatabaseHeader& header, RawFile file)
    : path_(std::move(path)), header_(header), file_(std::move(file)) {}

Result<DatabaseWriter> DatabaseWriter::create(const fs::path& path, const DatabaseHeader& header) {
  std::error_code code;
  if (fs::is_directory(path, code)) return badInput("is a folder, not a file", path.string());
  auto file = RawFile::open(temporaryOf(path), RawFile::Mode::kReplace);
  if (!file) return tl::unexpected(file.error());
  DatabaseHeader laidOut = header;
  laidOut.magic = kDatabaseMagic;
  layOut(laidOut);
  DatabaseWriter writer(path, laidOut, std::move(*file));
  if (auto sized = writer.file_.resize(laidOut.fileBytes); !sized) {
    return tl::unexpected(sized.error());
  }
  const std::array<std::uint64_t, 1> zero = {0};
  if (auto put = writer.put(kFirstEvents, std::as_bytes(std::span(zero))); !put) {
    return tl::unexpected(put.error());
  }
  return writer;
}

DatabaseWriter::~DatabaseWriter() {
  if (file_.descriptor() < 0) return;
  std::error_code ignored;
  fs::remove(temporaryOf(path_), ignored);
}

Result<void> DatabaseWriter::put(std::size_t column, std::span<const std::byte> bytes) {
  const std::uint64_t offset = header_.columns[column].offset + written_[column];
  written_[column] += bytes.size();
  checksums_[column].add(bytes);
  return file_.write(bytes, offset);
}

Result<void> DatabaseWriter::append(std::size_t column, std::span<const std::byte> bytes) {
  if (written_[column] + bytes.size() > header_.columns[column].bytes) {
    return tl::unexpected<Error>(
        {ErrorCode::kInternal, "more events than were counted", path_.string(), {}});
  }
  return put(column, bytes);
}

Result<void> DatabaseWriter::appendCounts(std::span<const std::uint32_t> counts) {
  std::vector<std::uint64_t> firsts;
  for (const std::uint32_t count : counts) firsts.push_back(nextEvent_ += count);
  return append(kFirstEvents, std::as_bytes(std::span(firsts)));
}

Result<void> DatabaseWriter::finish() {
  for (std::size_t i = 0; i < kColumns; ++i) {
    if (written_[i] != header_.columns[i].bytes) {
      return tl::unexpected<Error>(
          {ErrorCode::kInternal, "fewer events than were counted", path_.string(), {}});
    }
    const std::size_t over = written_[i] % kZeros.size();
    const auto rest = std::span(kZeros).first(over == 0 ? 0 : kZeros.size() - over);
    if (auto filled = put(i, rest); !filled) return filled;
    header_.columns[i].checksum = checksums_[i].value();
  }
  seal(header_);
  if (auto headed = file_.write(header_.bytes(), 0); !headed) return headed;
  if (auto synced = file_.sync(); !synced) return synced;
  std::error_code code;
  fs::rename(temporaryOf(path_), path_, code);
  if (code) return badInput("cannot be written: " + code.message(), path_.string());
  return {};
}

}  // namespace ifa
