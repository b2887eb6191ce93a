// SPDX-License-Identifier: Apache-2.0
// One track of a Standard MIDI File: its notes and tempo changes, in ticks.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ifa/result.h"

namespace ifa {

struct MidiNote {
  std::uint64_t start = 0, end = 0;  ///< ticks from the track's start
  int channel = 1;                   ///< 1 to 16
  int key = 0;                       ///< 0 to 127
  int velocity = 1;                  ///< 1 to 127
  std::size_t offset = 0;            ///< in the file, bytes
};

struct MidiTempo {
  std::uint64_t tick = 0;
  double microsecondsPerBeat = 500000;
};

struct MidiTrack {
  std::vector<MidiNote> notes;  ///< in order of their starts
  std::vector<MidiTempo> tempos;
};

/// Takes bytes one after the other, never beyond the end.
class MidiBytes {
 public:
  /// @param base  where `bytes` lie in the file, for errors
  MidiBytes(std::string_view bytes, std::string place, std::size_t base = 0)
      : bytes_(bytes), place_(std::move(place)), base_(base) {}

  [[nodiscard]] bool atEnd() const { return position_ >= bytes_.size(); }
  /// Of the next byte, in the file.
  [[nodiscard]] std::size_t offset() const { return base_ + position_; }
  [[nodiscard]] const std::string& place() const { return place_; }

  /// The next `count` bytes, fewer at the end.
  std::string_view take(std::size_t count);
  /// One byte; nothing at the end.
  std::optional<int> byte();
  void putBack() { --position_; }
  /// A big-endian number of so many bytes, at most 4; nothing where the end comes first.
  std::optional<std::uint32_t> number(int bytes);
  /// A variable-length quantity: at most four bytes of seven bits.
  std::optional<std::uint32_t> quantity();

  /// An error that names the file and the next byte.
  [[nodiscard]] tl::unexpected<Error> bad(const std::string& message) const;

 private:
  std::string_view bytes_;
  std::string place_;
  std::size_t base_;
  std::size_t position_ = 0;
};

/// Reads the body of an MTrk chunk up to its end or its end-of-track event. A note that is never
/// ended lasts until then; one that is struck again while it sounds ends there. Errors: kBadInput
/// for an event that is cut off, or a byte that cannot stand where it does.
[[nodiscard]] Result<MidiTrack> readMidiTrack(MidiBytes bytes);

}  // namespace ifa
