// SPDX-License-Identifier: Apache-2.0
#include "signature/midi_track.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace ifa {

std::string_view MidiBytes::take(std::size_t count) {
  const auto taken = bytes_.substr(position_, count);
  position_ += taken.size();
  return taken;
}

std::optional<int> MidiBytes::byte() {
  if (atEnd()) return std::nullopt;
  return static_cast<unsigned char>(bytes_[position_++]);
}

std::optional<std::uint32_t> MidiBytes::number(int bytes) {
  std::uint32_t value = 0;
  for (int i = 0; i < bytes; ++i) {
    const auto next = byte();
    if (!next) return std::nullopt;
    value = value << 8 | static_cast<std::uint32_t>(*next);
  }
  return value;
}

std::optional<std::uint32_t> MidiBytes::quantity() {
  std::uint32_t value = 0;
  for (int i = 0; i < 4; ++i) {
    const auto next = byte();
    if (!next) return std::nullopt;
    value = value << 7 | (static_cast<std::uint32_t>(*next) & 0x7FU);
    if (*next < 0x80) return value;
  }
  return std::nullopt;
}

tl::unexpected<Error> MidiBytes::bad(const std::string& message) const {
  return badInput(message, fmt::format("{}, byte {}", place_, offset()),
                  "export it again as a Standard MIDI File");
}

namespace {

constexpr int kMeta = 0xFF;
constexpr int kTempo = 0x51;
constexpr int kEndOfTrack = 0x2F;
constexpr std::size_t kNone = static_cast<std::size_t>(-1);

class TrackReader {
 public:
  explicit TrackReader(MidiBytes bytes) : bytes_(std::move(bytes)) {
    for (auto& keys : sounding_) keys.fill(kNone);
  }

  Result<MidiTrack> read() {
    while (!bytes_.atEnd() && !ended_) {
      const auto delta = bytes_.quantity();
      if (!delta) return bytes_.bad("the time of an event is cut off or has more than four bytes");
      tick_ += *delta;
      if (auto good = readEvent(); !good) return tl::unexpected<Error>(good.error());
    }
    for (const auto& keys : sounding_) {
      for (const std::size_t index : keys) {
        if (index != kNone) track_.notes[index].end = tick_;
      }
    }
    return std::move(track_);
  }

 private:
  Result<void> readEvent() {
    const std::size_t start = bytes_.offset();
    const auto first = bytes_.byte();
    if (!first) return cutOff();
    if (*first == kMeta) return readMeta();
    if (*first == 0xF0 || *first == 0xF7) return skipExclusive();
    if (*first > 0xF0) {
      bytes_.putBack();
      return bytes_.bad(fmt::format("a file cannot hold the event {:02X}", *first));
    }
    if (*first < 0x80) {
      bytes_.putBack();
      // Decision: exclusive and meta events leave the running status as it is: the standard ends
      // it there, but files that go on exist, and every player reads them.
      if (status_ == 0) return bytes_.bad("data comes before any event");
    } else {
      status_ = *first;
    }
    return readVoice(start);
  }

  Result<void> readVoice(std::size_t start) {
    const int kind = status_ >> 4;
    const bool single = kind == 0xC || kind == 0xD;
    const auto one = dataByte();
    const auto two = single ? std::optional<int>(0) : dataByte();
    if (!one || !two) return cutOff();
    if (kind == 0x9 && *two > 0) {
      strike(*one, *two, start);
    } else if (kind == 0x8 || kind == 0x9) {
      release(*one);
    }
    return {};
  }

  std::optional<int> dataByte() {
    const auto value = bytes_.byte();
    if (!value || *value < 0x80) return value;
    bytes_.putBack();
    return std::nullopt;
  }

  std::size_t& soundingAt(int key) {
    return sounding_[static_cast<std::size_t>(status_ & 0xF)][static_cast<std::size_t>(key)];
  }

  void strike(int key, int velocity, std::size_t offset) {
    release(key);
    soundingAt(key) = track_.notes.size();
    track_.notes.push_back({tick_, tick_, (status_ & 0xF) + 1, key, velocity, offset});
  }

  void release(int key) {
    std::size_t& index = soundingAt(key);
    if (index != kNone) track_.notes[index].end = tick_;
    index = kNone;
  }

  Result<void> skipExclusive() {
    const auto length = bytes_.quantity();
    if (!length || bytes_.take(*length).size() < *length) return cutOff();
    return {};
  }

  Result<void> readMeta() {
    const auto kind = bytes_.byte();
    const auto length = bytes_.quantity();
    if (!kind || !length) return cutOff();
    const auto data = bytes_.take(*length);
    if (data.size() < *length) return cutOff();
    ended_ = *kind == kEndOfTrack;
    if (*kind != kTempo || data.size() < 3) return {};
    const auto microseconds = MidiBytes(data, {}).number(3).value_or(0);
    if (microseconds == 0) return bytes_.bad("a beat of no length is no tempo");
    track_.tempos.push_back({tick_, static_cast<double>(microseconds)});
    return {};
  }

  tl::unexpected<Error> cutOff() const { return bytes_.bad("an event is cut off"); }

  MidiBytes bytes_;
  MidiTrack track_;
  std::array<std::array<std::size_t, 128>, 16> sounding_;  ///< indices of notes, by channel and key
  std::uint64_t tick_ = 0;
  int status_ = 0;  ///< of the last voice event
  bool ended_ = false;
};

}  // namespace

Result<MidiTrack> readMidiTrack(MidiBytes bytes) { return TrackReader(std::move(bytes)).read(); }

}  // namespace ifa
