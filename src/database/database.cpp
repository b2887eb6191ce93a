// SPDX-License-Identifier: Apache-2.0
#include "database/database.h"

#include <fmt/format.h>
#include <sys/mman.h>

#include <algorithm>
#include <bit>
#include <cerrno>
#include <cstring>

#include "base/checksum.h"
#include "base/raw_file.h"

namespace ifa {

namespace fs = std::filesystem;

namespace {

/// So much is read between two looks at the clock and the stop flag, bytes.
constexpr std::size_t kPiece = std::size_t{1} << 22;

template <class T>
std::span<const T> as(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const T*>(bytes.data()), bytes.size() / sizeof(T)};
}

tl::unexpected<Error> damaged(const std::string& what, const fs::path& path) {
  return badInput(what, path.string(), "make it again: ifa database build");
}

}  // namespace

Result<EventDatabase> EventDatabase::open(const fs::path& path) {
  const auto file = RawFile::open(path, RawFile::Mode::kRead);
  if (!file) return tl::unexpected(file.error());
  const auto size = file->size();
  if (!size) return tl::unexpected(size.error());
  std::array<std::byte, sizeof(DatabaseHeader)> start{};
  const auto known = std::span(start).first(std::min<std::size_t>(start.size(), *size));
  if (auto read = file->read(known, 0); !read) return tl::unexpected(read.error());
  const auto header = readHeader(known, *size, kDatabaseMagic, path);
  if (!header) return tl::unexpected(header.error());
  const std::size_t bytes = *size;
  void* map = ::mmap(nullptr, bytes, PROT_READ, MAP_SHARED, file->descriptor(), 0);
  if (map == MAP_FAILED) {
    return badInput(std::string("cannot be mapped: ") + std::strerror(errno), path.string());
  }
  return EventDatabase(path, *header,
                       {static_cast<const std::byte*>(map), [bytes](const std::byte* start_) {
                          ::munmap(const_cast<std::byte*>(start_), bytes);
                        }});
}

std::span<const std::byte> EventDatabase::bytes(std::size_t column, bool filledUp) const {
  const ColumnPlace& place = header_.columns[column];
  const std::uint64_t end =
      column + 1 < kColumns ? header_.columns[column + 1].offset : header_.fileBytes;
  return {map_.get() + place.offset, filledUp ? end - place.offset : place.bytes};
}

Result<void> EventDatabase::check(const Progress& progress) const {
  std::uint64_t done = 0;
  for (std::size_t i = 0; i < kColumns; ++i) {
    Checksum checksum;
    for (auto rest = bytes(i, true); !rest.empty();) {
      const auto piece = rest.first(std::min(kPiece, rest.size()));
      checksum.add(piece);
      rest = rest.subspan(piece.size());
      done += piece.size();
      progress("check", static_cast<double>(done) / static_cast<double>(header_.fileBytes));
      if (progress.stopRequested()) {
        return tl::unexpected<Error>({ErrorCode::kInterrupted, "interrupted", path_.string(), {}});
      }
    }
    if (checksum.value() != header_.columns[i].checksum) {
      return damaged(fmt::format("is damaged: column {} has another checksum", i + 1), path_);
    }
  }
  const auto first = as<std::uint64_t>(bytes(kFirstEvents));
  if (first.front() != 0 || first.back() != header_.events ||
      !std::is_sorted(first.begin(), first.end())) {
    return damaged("has an impossible table of simulations", path_);
  }
  progress("check", 1);
  return {};
}

Result<void> EventDatabase::checkBody(const Body& body) const {
  if (header_.identity.bodyHash == hashOf(body)) return {};
  return badInput(fmt::format("was made of another body: {}, not this {}",
                              nameIn(header_.identity.object), body.definition.name),
                  path_.string(), "make one of this body: ifa database build");
}

Result<void> EventDatabase::checkIdentity(const DatabaseIdentity& wanted) const {
  const std::string difference = differenceOf(header_.identity, wanted);
  if (difference.empty()) return {};
  return badInput("was made otherwise: " + difference, path_.string(),
                  "make it again: ifa database build");
}

std::span<const float> EventDatabase::values(Column column) const {
  return as<float>(bytes(column));
}

std::span<const std::uint8_t> EventDatabase::flags() const {
  return as<std::uint8_t>(bytes(kFlags));
}

EventRecord EventDatabase::record(std::size_t i) const {
  std::array<float, EventRecord::kFloats + 1> words{};
  for (std::size_t c = 0; c < EventRecord::kFloats; ++c) words[c] = as<float>(bytes(c))[i];
  auto record = std::bit_cast<EventRecord>(words);
  record.flags = flags()[i];
  return record;
}

std::size_t EventDatabase::firstEvent(std::size_t k) const {
  return std::min<std::size_t>(as<std::uint64_t>(bytes(kFirstEvents))[k], events());
}

EventName EventDatabase::nameOf(std::size_t event) const {
  const auto first = as<std::uint64_t>(bytes(kFirstEvents));
  const auto after = std::upper_bound(first.begin(), first.end(), event);
  const auto k = static_cast<std::uint64_t>(std::max<std::ptrdiff_t>(after - first.begin(), 1) - 1);
  return {header_.firstSimulation + k, event - std::min<std::uint64_t>(first[k], event)};
}

}  // namespace ifa
