// SPDX-License-Identifier: Apache-2.0
#include "sound/wav_chunks.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <string_view>

namespace ifa {
namespace {

constexpr std::uint64_t kMaxChunkBytes = std::uint64_t{16} << 20;
constexpr std::size_t kMaxChunks = 10000;

/// So many bytes from `offset` on, fewer at the file's end.
Result<std::string> readSome(const RawFile& file, std::uint64_t offset, std::uint64_t count) {
  const auto size = file.size();
  if (!size) return tl::unexpected<Error>(size.error());
  const std::uint64_t left = *size - std::min(offset, *size);
  std::string bytes(static_cast<std::size_t>(std::min(count, left)), '\0');
  if (auto read = file.read(std::as_writable_bytes(std::span(bytes)), offset); !read) {
    return tl::unexpected<Error>(read.error());
  }
  return bytes;
}

}  // namespace

std::uint64_t littleEndian(std::string_view text, std::size_t offset, int bytes) {
  if (offset > text.size() || text.size() - offset < static_cast<std::size_t>(bytes)) return 0;
  std::uint64_t value = 0;
  for (int i = bytes - 1; i >= 0; --i) {
    value = value << 8 | static_cast<unsigned char>(text[offset + static_cast<std::size_t>(i)]);
  }
  return value;
}

std::string littleEndianBytes(std::uint64_t value, int bytes) {
  std::string text;
  for (int i = 0; i < bytes; ++i) text += static_cast<char>(value >> (8 * i) & 0xFF);
  return text;
}

Result<std::vector<WavChunk>> listWavChunks(const RawFile& file) {
  const auto size = file.size();
  if (!size) return tl::unexpected<Error>(size.error());
  const auto start = readSome(file, 0, 12);
  if (!start) return tl::unexpected<Error>(start.error());
  const bool large = start->starts_with("RF64");
  std::vector<WavChunk> chunks;
  if (!(large || start->starts_with("RIFF")) || !start->ends_with("WAVE")) return chunks;
  std::uint64_t largeData = 0;  // the size of "data" where 32 bits do not hold it
  for (std::uint64_t offset = 12; offset + 8 <= *size;) {
    const auto head = readSome(file, offset, 24);
    if (!head) return tl::unexpected<Error>(head.error());
    if (chunks.size() == kMaxChunks) {
      return badInput(fmt::format("holds more than {} chunks", kMaxChunks), file.path().string());
    }
    WavChunk chunk;
    chunk.id = head->substr(0, 4);
    chunk.offset = offset + 8;
    std::uint64_t told = littleEndian(*head, 4, 4);
    if (large && chunk.id == "ds64") largeData = littleEndian(*head, 16, 8);
    if (large && chunk.id == "data" && told == 0xFFFFFFFF) told = largeData;
    chunk.size = std::min(told, *size - chunk.offset);
    chunk.whole = chunk.size == told;
    if (chunk.id == "LIST" && chunk.size >= 4) chunk.list = head->substr(8, 4);
    offset = chunk.end();
    chunks.push_back(std::move(chunk));
  }
  return chunks;
}

Result<std::string> readWavChunk(const RawFile& file, const WavChunk& chunk) {
  if (chunk.size > kMaxChunkBytes) {
    return badInput(
        fmt::format("the chunk \"{}\" is larger than {} MiB", chunk.id, kMaxChunkBytes >> 20),
        fmt::format("{}, byte {}", file.path().string(), chunk.offset - 8),
        "is this a sound with marks?");
  }
  return readSome(file, chunk.offset, chunk.size);
}

}  // namespace ifa
