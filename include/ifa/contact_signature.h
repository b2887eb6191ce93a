// SPDX-License-Identifier: Apache-2.0
// The contact-time signature of a sound: when contacts begin, how long and how loud they are.
#pragma once

#include <cstddef>
#include <vector>

namespace ifa {

/// Another moment at which a contact may begin, where its mark is in doubt.
struct AlternativeStart {
  double time = 0;  ///< s after the first event's start
  double cost = 0;  ///< log units that taking it costs beside the factors, >= 0
};

/// Of one event; each is one search more.
inline constexpr std::size_t kMaxAlternatives = 16;

/// Log units for leaving out an event of weight 1.
inline constexpr double kDropPrice = 6;

/// One contact event of a sound (IFA section 3).
struct SignatureEvent {
  double time = 0;       ///< start, s after the first event's start
  double duration = 0;   ///< s; 0 for a discrete event
  double amplitude = 1;  ///< relative to the first event's
  double centroid = 0;   ///< eq. 8, s after the event's start; 0 for a discrete event
  double weight = 1;  ///< 1: must be met; less: may be dropped at that price, save first and last
  std::vector<AlternativeStart> alternatives = {};  ///< none of the first event
};

/// Contact-time signature (IFA section 3): events in order of time, the first at 0.
struct ContactSignature {
  std::vector<SignatureEvent> events;
  bool terminal = true;     ///< the last event brings the body to rest
  double firstContact = 0;  ///< s in the sound file at which the first event starts
};

}  // namespace ifa
