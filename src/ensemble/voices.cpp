// SPDX-License-Identifier: Apache-2.0
#include "ensemble/voices.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <set>

namespace ifa {

namespace {

using Run = std::vector<ScoreNote>;

bool isOf(const ScoreNote& note, const ScorePart& part) {
  return (part.track == 0 || part.track == note.track) &&
         (part.channel == 0 || part.channel == note.channel) &&
         (part.keys.empty() ||
          std::find(part.keys.begin(), part.keys.end(), note.key) != part.keys.end());
}

/// The part's notes; of those that sound together the loudest, where the first begins.
Run notesOf(const ScorePart& part, const std::vector<ScoreNote>& notes) {
  Run run;
  for (const ScoreNote& note : notes) {
    if (!isOf(note, part)) continue;
    if (!run.empty() && note.time - run.back().time < kOneContact) {
      run.back().velocity = std::max(run.back().velocity, note.velocity);
      continue;
    }
    run.push_back(note);
  }
  return run;
}

std::vector<Run> deal(const Run& notes, const ScorePart& part) {
  const auto count = std::min(static_cast<std::size_t>(part.bodies), notes.size());
  std::vector<Run> runs(count);
  for (std::size_t i = 0; i < notes.size(); ++i) {
    const std::size_t body = part.deal == Deal::kTurns ? i % count : i * count / notes.size();
    runs[body].push_back(notes[i]);
  }
  return runs;
}

/// In pieces without a pause that is too long to be jumped over.
std::vector<Run> cutAtPauses(const std::vector<Run>& runs) {
  std::vector<Run> pieces;
  for (const Run& run : runs) {
    for (std::size_t i = 0; i < run.size(); ++i) {
      const bool first = i == 0 || run[i].time - run[i - 1].time > kLongestNoteGap;
      if (first) pieces.emplace_back();
      pieces.back().push_back(run[i]);
    }
  }
  return pieces;
}

/// Index of the first note that comes too soon after the one before; the size where there is none.
std::size_t firstTooSoon(const Run& run) {
  for (std::size_t i = 1; i < run.size(); ++i) {
    if (run[i].time - run[i - 1].time < kShortestNoteGap) return i;
  }
  return run.size();
}

/// How many bodies in turn would do; 0 where that is more than there may be.
int bodiesInTurn(const Run& notes, ScorePart part) {
  part.deal = Deal::kTurns;
  for (part.bodies = 1; part.bodies <= static_cast<int>(kMostScoreBodies); ++part.bodies) {
    const auto runs = deal(notes, part);
    const bool good = std::all_of(runs.begin(), runs.end(),
                                  [](const Run& run) { return firstTooSoon(run) == run.size(); });
    if (good) return part.bodies;
  }
  return 0;
}

tl::unexpected<Error> tooFast(const Run& notes, const Run& run, const ScorePart& part,
                              const std::string& place) {
  const std::size_t i = firstTooSoon(run);
  const int enough = bodiesInTurn(notes, part);
  return badInput(
      fmt::format("part \"{}\": the notes at {:.3f} and {:.3f} s are too close for one body",
                  part.name, run[i - 1].time, run[i].time),
      place,
      enough == 0 ? "leave some notes out"
                  : fmt::format("give it \"bodies\": {}, \"deal\": \"turns\"", enough));
}

tl::unexpected<Error> noNotes(const ScorePart& part, const std::vector<ScoreNote>& notes,
                              const std::string& place) {
  std::set<std::string> there;
  for (const ScoreNote& note : notes) {
    there.insert(fmt::format("track {} channel {} note {}", note.track, note.channel, note.key));
  }
  if (there.size() > 12) there.erase(std::next(there.begin(), 12), there.end());
  return badInput(fmt::format("has no notes for part \"{}\"", part.name), place,
                  fmt::format("there are: {}", fmt::join(there, "; ")));
}

}  // namespace

Result<std::vector<Voice>> dealVoices(const Score& score, const std::vector<ScoreNote>& notes,
                                      const std::string& place) {
  std::vector<Voice> voices;
  for (std::size_t p = 0; p < score.parts.size(); ++p) {
    const ScorePart& part = score.parts[p];
    const Run own = notesOf(part, notes);
    if (own.empty()) return noNotes(part, notes, place);
    const auto runs = cutAtPauses(deal(own, part));
    for (std::size_t i = 0; i < runs.size(); ++i) {
      if (firstTooSoon(runs[i]) < runs[i].size()) return tooFast(own, runs[i], part, place);
      const std::string name =
          runs.size() == 1 ? part.name : fmt::format("{}-{}", part.name, i + 1);
      voices.push_back({name, p, runs[i]});
    }
  }
  std::set<std::string> names;
  for (const Voice& voice : voices) {
    if (names.insert(voice.name).second) continue;
    return badInput("two bodies would be named " + voice.name, place, "rename one of the parts");
  }
  if (voices.size() <= kMostScoreBodies) return voices;
  return badInput(
      fmt::format("asks for {} bodies, and {} is the most", voices.size(), kMostScoreBodies), place,
      "cut the piece, or fill its pauses: a body jumps over 0.7 s at most");
}

ContactSignature signatureOf(const Voice& voice, bool rests, double lead) {
  ContactSignature signature;
  const ScoreNote& first = voice.notes.front();
  for (const ScoreNote& note : voice.notes) {
    SignatureEvent event;
    event.time = note.time - first.time;
    event.amplitude = note.velocity / first.velocity;
    signature.events.push_back(event);
  }
  signature.terminal = rests;
  signature.firstContact = lead + first.time;
  return signature;
}

}  // namespace ifa
