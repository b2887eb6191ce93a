// SPDX-License-Identifier: Apache-2.0
// The chunks of a WAV file, without its samples.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/raw_file.h"
#include "ifa/result.h"

namespace ifa {

struct WavChunk {
  std::string id;            ///< four bytes
  std::uint64_t offset = 0;  ///< of its contents in the file, bytes
  std::uint64_t size = 0;    ///< of its contents as far as they are there, bytes
  bool whole = true;         ///< false where the file ends before the chunk
  std::string list;          ///< what kind of "LIST" it is, four bytes; else empty

  /// Where the next chunk begins.
  [[nodiscard]] std::uint64_t end() const { return offset + size + size % 2; }
};

/// All chunks of a RIFF or RF64 file of kind WAVE, in the file's order; none where it is another
/// file. Reads their heads only. Errors: those of reading, and kBadInput for more than 10,000.
[[nodiscard]] Result<std::vector<WavChunk>> listWavChunks(const RawFile& file);

/// The contents of a chunk of at most 16 MiB. Errors: kBadInput with the byte for a larger one.
[[nodiscard]] Result<std::string> readWavChunk(const RawFile& file, const WavChunk& chunk);

/// A little-endian number of `bytes` bytes at `offset`; 0 where the text is too short.
[[nodiscard]] std::uint64_t littleEndian(std::string_view text, std::size_t offset, int bytes);
/// The same the other way: so many bytes.
[[nodiscard]] std::string littleEndianBytes(std::uint64_t value, int bytes);

}  // namespace ifa
