// SPDX-License-Identifier: Apache-2.0
// Targets: marks of every kind.
#include <algorithm>
#include <cmath>
#include <vector>

#include "fuzz/fuzz_targets.h"
#include "fuzz/scratch.h"
#include "signature/csv.h"
#include "signature/labels.h"
#include "signature/midi.h"
#include "signature/signature.h"
#include "signature/signature_json.h"
#include "signature/wav_cues.h"

namespace ifa::fuzz {

namespace {

/// Finite times in order, and the same count and times, but for what nine decimals lose, and what a
/// large number does.
void requireSame(const std::vector<Label>& one, const std::vector<Label>& other) {
  require(one.size() == other.size());
  for (std::size_t i = 0; i < one.size(); ++i) {
    require(std::isfinite(one[i].start) && one[i].end >= one[i].start);
    const double slack = 1e-6 + std::abs(one[i].start) * 1e-15 + std::abs(one[i].end) * 1e-15;
    require(std::abs(one[i].start - other[i].start) <= slack);
    require(std::abs(one[i].end - other[i].end) <= slack);
  }
}

/// All that is done with labels behind their reader.
void useLabels(const std::vector<Label>& labels) {
  const auto signature = signatureWithoutSound(labels, {}, "fuzz");
  if (!signature) return;
  require(!signature->events.empty() && signature->events.front().time == 0);
  const auto again = signatureWithoutSound(labelsFromSignature(*signature), {}, "fuzz");
  require(again && again->events.size() == signature->events.size());
  require(again->terminal == signature->terminal);
}

}  // namespace

void readAsLabels(std::string_view bytes) {
  const auto labels = parseLabels(bytes, "fuzz");
  if (!labels) return;
  useLabels(*labels);
  const auto again = parseLabels(formatLabels(*labels), "fuzz");
  require(again.has_value());
  requireSame(*labels, *again);
}

void readAsCsv(std::string_view bytes) {
  const auto labels = parseCsv(bytes, "fuzz");
  if (!labels) return;
  useLabels(*labels);
  const auto again = parseCsv(formatCsv(*labels), "fuzz");
  require(again.has_value());
  requireSame(*labels, *again);
}

void readAsMidi(std::string_view bytes) {
  for (const bool durations : {false, true}) {
    const auto labels = parseMidi(bytes, "fuzz", {0, 0, durations});
    if (!labels) continue;
    // A score is in order whatever the file.
    require(checkLabels(*labels, 3601, "fuzz").has_value());
    useLabels(*labels);
  }
  static_cast<void>(parseMidi(bytes, "fuzz", {1, 10, true}));
  const auto notes = parseMidiNotes(bytes, "fuzz");
  if (!notes) return;
  require(!notes->empty() &&
          std::is_sorted(notes->begin(), notes->end(),
                         [](const ScoreNote& a, const ScoreNote& b) { return a.time < b.time; }));
}

void readAsCues(std::string_view bytes) {
  const auto path = scratchFile("in.wav", bytes);
  const auto labels = readWavCues(path);
  if (!labels || labels->empty()) return;
  useLabels(*labels);
  Sound sound;
  sound.rate = 48000;
  sound.samples = {0.5F, -0.5F};
  if (!writeWavWithCues(scratch() / "out.wav", path, sound, *labels)) return;
  const auto again = readWavCues(scratch() / "out.wav");
  require(again && again->size() == labels->size());
}

void readAsSignature(std::string_view bytes) {
  const auto signature = parseSignature(bytes, "fuzz");
  if (!signature) return;
  const auto again = parseSignature(formatSignature(*signature), "fuzz");
  require(again && again->events.size() == signature->events.size());
  useLabels(labelsFromSignature(*signature));
}

}  // namespace ifa::fuzz
