// SPDX-License-Identifier: Apache-2.0
// Standard MIDI Files made byte by byte.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <string>
#include <vector>

namespace ifa::test {

inline std::string bytesOf(std::initializer_list<int> values) {
  std::string bytes;
  for (const int value : values) bytes += static_cast<char>(value);
  return bytes;
}

inline std::string bigEndian(std::uint32_t value, int bytes) {
  std::string text;
  for (int i = bytes - 1; i >= 0; --i) text += static_cast<char>(value >> (8 * i) & 0xFF);
  return text;
}

/// A variable-length quantity.
inline std::string quantity(std::uint32_t value) {
  std::string text(1, static_cast<char>(value & 0x7F));
  while ((value >>= 7) > 0) text.insert(text.begin(), static_cast<char>(value & 0x7F) | '\x80');
  return text;
}

inline std::string noteOn(std::uint32_t delta, int key, int velocity, int channel = 1) {
  return quantity(delta) + bytesOf({0x90 | (channel - 1), key, velocity});
}
inline std::string noteOff(std::uint32_t delta, int key, int channel = 1) {
  return quantity(delta) + bytesOf({0x80 | (channel - 1), key, 64});
}
inline std::string tempo(std::uint32_t delta, std::uint32_t microseconds) {
  return quantity(delta) + bytesOf({0xFF, 0x51, 3}) + bigEndian(microseconds, 3);
}

/// @param tracks  their events, without the end of track, which is added
inline std::string midiFile(int format, int division, const std::vector<std::string>& tracks) {
  std::string file = "MThd" + bigEndian(6, 4) + bigEndian(static_cast<std::uint32_t>(format), 2) +
                     bigEndian(static_cast<std::uint32_t>(tracks.size()), 2) +
                     bigEndian(static_cast<std::uint32_t>(division), 2);
  for (const std::string& track : tracks) {
    const std::string body = track + bytesOf({0, 0xFF, 0x2F, 0});
    file += "MTrk" + bigEndian(static_cast<std::uint32_t>(body.size()), 4) + body;
  }
  return file;
}

}  // namespace ifa::test
