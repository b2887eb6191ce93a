// SPDX-License-Identifier: Apache-2.0
// From labels and sound to the contact-time signature (IFA section 3, docs/method.md 1 and 2).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ifa/contact_signature.h"
#include "ifa/result.h"
#include "signature/labels.h"
#include "sound/onset_detector.h"
#include "sound/sound.h"

namespace ifa {

struct SignatureSettings {
  /// Delta t of IFA section 4, s; the object file's `merge_gap`. Smaller gaps are closed, shorter
  /// events are discrete.
  double mergeGap = 0.010;
  /// Overrides what the last label says (`--no-terminal`: false).
  std::optional<bool> terminal;
};

/// The signature of `sound` with contacts where `labels` say, filtered as motions are; amplitudes
/// and centroids from the sound (a discrete event: the largest |sample| from its start to 20 ms
/// later or the next event's start; a continuous one: the maximum of its envelope). Where every
/// label has an amplitude of its own, those count instead; and a label's own centroid does.
/// @param place  the label file, named in errors
/// Errors: kBadInput when checkLabels fails, or when the sound is silent at the first contact.
[[nodiscard]] Result<ContactSignature> signatureFromLabels(const Sound& sound,
                                                           const std::vector<Label>& labels,
                                                           const SignatureSettings& settings = {},
                                                           const std::string& place = "labels");

/// The signature of contacts that come without a sound (a score, a table), filtered likewise; a
/// label without an amplitude has 1. Errors: kBadInput with the label for times that are out of
/// order, overlap, or lie before 0 or after an hour.
[[nodiscard]] Result<ContactSignature> signatureWithoutSound(const std::vector<Label>& labels,
                                                             const SignatureSettings& settings,
                                                             const std::string& place);

/// The events as labels "c1", "c2"... in the sound's time, with all that is known of them; the last
/// one says "terminal" or "non-terminal". signatureWithoutSound gives the same signature back.
[[nodiscard]] std::vector<Label> labelsFromSignature(const ContactSignature& signature);

/// The merge filter of method.md 2 on labels: gaps under `mergeGap` closed, what is then shorter
/// than it made a point. The start and the text of a merged label are its first's, but a text that
/// ends in "terminal" stays with the last. Where the first is in doubt (weight under 1), the starts
/// of the first kMaxAlternatives others become alternatives.
/// @param labels  in order of time
[[nodiscard]] std::vector<Label> mergeLabels(const std::vector<Label>& labels, double mergeGap);

/// Detected contacts as labels "c1", "c2"... ; the last one says "terminal" or "non-terminal".
/// Whose confidence is under 0.9 has it for a weight: a motion may leave that contact out.
[[nodiscard]] std::vector<Label> labelsFromContacts(const std::vector<DetectedContact>& contacts,
                                                    bool terminal = true);

}  // namespace ifa
