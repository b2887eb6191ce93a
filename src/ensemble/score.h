// SPDX-License-Identifier: Apache-2.0
// Scores: which notes of a MIDI file are played by which bodies (docs/music.md).
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ifa/result.h"
#include "signature/midi.h"

namespace ifa {

/// How the notes of a part are given to its bodies.
enum class Deal {
  kPhrases,  ///< one run of notes after the other, as equal in number as can be
  kTurns,    ///< note by note in turn, for notes faster than one body can play
};

/// Notes that bodies of one kind play.
struct ScorePart {
  std::string name;                             ///< plain: bodies and folders are named by it
  std::string object;                           ///< as of `ifa sync --object`
  std::string surface;                          ///< empty: the object's own
  std::string sound;                            ///< material that is heard; empty: the object's own
  std::optional<std::array<double, 3>> colour;  ///< red, green, blue, 0 to 1, as Kd in an MTL file
  int track = 0, channel = 0;                   ///< from 1; 0: all
  std::vector<int> keys;                        ///< MIDI note numbers; none: all
  int bodies = 1;
  Deal deal = Deal::kPhrases;
  /// Decision: music is no drop. A floor that gives little back lets a body come to rest on its
  /// last note, and what the next jump needs is added at the contact (IFA section 6).
  double restitution = 0.3, energyGain = 10;
  bool rests = true;  ///< on its last note; else it bounces on, heard between the notes
};

struct Score {
  std::filesystem::path midi;
  std::uint64_t seed = 1;
  double clearance = 0;  ///< m between bodies at any time; 0: half of the smallest body's size
  std::vector<ScorePart> parts;
};

inline constexpr std::size_t kMostScoreBodies = 64;

/// Reads a score. Every field is checked, and one that is not known is refused: people write these
/// files. `midi` is relative to the score's folder.
/// Errors: kBadInput, place "file: field".
[[nodiscard]] Result<Score> parseScore(std::string_view text, const std::filesystem::path& path);
[[nodiscard]] Result<Score> readScore(const std::filesystem::path& path);

/// A score without a score file: each channel of each track is a part, with a colour of its own.
[[nodiscard]] Score scoreOfNotes(const std::filesystem::path& midi,
                                 const std::vector<ScoreNote>& notes, const std::string& object);

}  // namespace ifa
