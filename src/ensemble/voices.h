// SPDX-License-Identifier: Apache-2.0
// Who plays which note: the notes of a score dealt to its bodies.
#pragma once

#include <string>
#include <vector>

#include "ensemble/score.h"
#include "ifa/contact_signature.h"

namespace ifa {

/// What one body plays.
struct Voice {
  std::string name;              ///< of the body: the part's, with a number where it has several
  std::size_t part = 0;          ///< index into the score's parts
  std::vector<ScoreNote> notes;  ///< in order of time, no two closer than kShortestNoteGap
};

/// Notes that start within this are one contact: the merge gap of the objects, s.
inline constexpr double kOneContact = 0.010;
/// No body plays notes closer than that, s: the jump between them would be 2 mm high.
inline constexpr double kShortestNoteGap = 0.040;
/// Over a longer pause another body falls in, s: a jump over it would be 0.6 m high.
inline constexpr double kLongestNoteGap = 0.7;

/// Deals the notes. Where a body would have to wait longer than kLongestNoteGap, its run is cut and
/// one more body takes over, so there may be more bodies than the part asks for.
/// @param place  the MIDI file, named in errors
/// Errors: kBadInput for a part without notes (telling what there is), notes too fast for its
/// bodies (telling how many would do), more bodies than kMostScoreBodies.
[[nodiscard]] Result<std::vector<Voice>> dealVoices(const Score& score,
                                                    const std::vector<ScoreNote>& notes,
                                                    const std::string& place);

/// What the body of `voice` is to hit.
/// @param lead  s of the sound before the score's time 0
[[nodiscard]] ContactSignature signatureOf(const Voice& voice, bool rests, double lead);

}  // namespace ifa
