// SPDX-License-Identifier: Apache-2.0
// The sound of a body that is struck by a floor, by modal synthesis (docs/sonify.md).
#pragma once

#include <cstdint>
#include <vector>

#include "body/body.h"
#include "sonify/block_modes.h"
#include "sonify/sound_material.h"
#include "sonify/strike.h"
#include "sound/sound.h"

namespace ifa {

struct SonifySettings {
  SoundMaterial material;  ///< the body's
  SoundFloor floor;
  std::uint64_t seed = 1;  ///< of the floor's modes and of where in a step in contact a blow falls
  double reverberation = 0;  ///< s in which a room's echo falls by 60 dB; 0: no room
  double lead = 0;           ///< s of silence before time 0 of the strikes
  double duration = 0;       ///< s of sound at least
};

inline constexpr int kSonifyRate = 48000;      ///< Hz
inline constexpr double kSonifyPeak = 0.7;     ///< of full scale
inline constexpr double kSonifyTail = 0.5;     ///< s of sound after the last strike
inline constexpr double kSonifyLongest = 600;  ///< s of sound at most

/// A body on a floor, ready to be struck. Holds a reference to the body.
class StruckBody {
 public:
  StruckBody(const Body& body, const SonifySettings& settings);

  /// What is heard of strikes at their times (durations do not matter) in `duration` seconds: the
  /// floor's answer to the forces, the ring of the body and the air that it pushes. One channel, in
  /// units of their own: a sum of strikes gives the sum of their sounds.
  [[nodiscard]] Sound hit(const std::vector<Strike>& strikes, double duration) const;

 private:
  const Body& body_;
  SoundMaterial material_;
  SoundFloor floor_;
  std::uint64_t seed_;
  Block block_;
  std::vector<BlockMode> modes_;
};

/// The strikes in the time of the sound, each at a place of its duration that chance chooses.
/// Those before the sound begins or after kSonifyLongest are left out.
[[nodiscard]] std::vector<Strike> placeStrikes(std::vector<Strike> strikes, double lead,
                                               std::uint64_t seed);

/// One channel, 16 bit, its largest sample at kSonifyPeak. Silence where nothing is struck. The
/// same bits for the same input on one machine.
[[nodiscard]] Sound sonify(const Body& body, const std::vector<Strike>& strikes,
                           const SonifySettings& settings);

/// Makes the largest sample kSonifyPeak, unless all are 0.
void setPeak(Sound& sound);

}  // namespace ifa
