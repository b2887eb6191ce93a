// SPDX-License-Identifier: Apache-2.0
#include "signature/signature.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "sound/envelope.h"

namespace ifa {
namespace {

/// Longest signature, s, as in a signature file.
constexpr double kMaxSeconds = 3600;

/// The window in which a discrete event's peak is looked for. IFA section 3.
constexpr double kPeakWindow = 0.020;

/// Eq. 8 over the bins of an envelope, s after the event's start.
/// Decision: a bin counts at its middle, not (as k from 1 to n in the equation would have it) at
/// its end.
double centroidOf(const std::vector<float>& bins) {
  double sum = 0, moment = 0;
  for (std::size_t k = 0; k < bins.size(); ++k) {
    const auto amplitude = static_cast<double>(bins[k]);
    sum += amplitude;
    moment += amplitude * (static_cast<double>(k) + 0.5) * kEnvelopeStep;
  }
  return sum > 0 ? moment / sum : 0;
}

SignatureEvent eventAt(const Sound& sound, const Label& label, double nextStart, double origin) {
  SignatureEvent event;
  event.time = label.start - origin;
  if (label.isPoint()) {
    const double until = std::min(label.start + kPeakWindow, nextStart);
    event.amplitude = static_cast<double>(peakAmplitude(sound, label.start, until));
    return event;
  }
  event.duration = label.end - label.start;
  const auto bins = envelope(sound, label.start, label.end);
  event.amplitude = static_cast<double>(*std::max_element(bins.begin(), bins.end()));
  event.centroid = std::min(centroidOf(bins), event.duration);
  return event;
}

/// The alternatives of a label, s after the first contact, which itself has none.
std::vector<AlternativeStart> alternativesOf(const Label& label, double origin) {
  auto alternatives = label.alternatives;
  for (AlternativeStart& other : alternatives) other.time -= origin;
  return label.start > origin ? alternatives : std::vector<AlternativeStart>();
}

/// What the file itself tells of an event.
SignatureEvent eventOf(const Label& label, double origin) {
  SignatureEvent event;
  event.time = label.start - origin;
  event.duration = label.isPoint() ? 0 : label.end - label.start;
  event.amplitude = label.amplitude.value_or(1);
  // Decision: of a rattle that nobody has heard, the middle.
  event.centroid = std::min(label.centroid.value_or(event.duration / 2), event.duration);
  event.weight = label.weight;
  event.alternatives = alternativesOf(label, origin);
  return event;
}

bool tellTheirAmplitudes(const std::vector<Label>& labels) {
  return std::all_of(labels.begin(), labels.end(),
                     [](const Label& label) { return label.amplitude.has_value(); });
}

/// Contacts that are heard more surely must be met.
constexpr double kSure = 0.9;
/// The largest says how loud both are together, and that they must be met. If the first mark is a
/// false one, the event begins with the second, at the price of leaving out a mark.
void join(Label& label, const Label& next) {
  if (label.weight < 1 && label.alternatives.size() < kMaxAlternatives) {
    label.alternatives.push_back({next.start, kDropPrice * label.weight});
  }
  label.end = std::max(label.end, next.end);
  if (next.amplitude) {
    label.amplitude = std::max(label.amplitude.value_or(0), *next.amplitude);
  }
  label.centroid.reset();
  label.weight = std::max(label.weight, next.weight);
  // The terminal flag is said by the last label.
  if (next.text.ends_with("terminal")) label.text = next.text;
}

Result<void> checkSpan(const std::vector<Label>& labels, const std::string& place) {
  for (const Label& label : labels) {
    // "Not inside" also catches what is no number.
    if (label.start >= 0 && label.end <= kMaxSeconds) continue;
    return badInput(fmt::format("the contact at {:.6f} to {:.6f} s is not within 0 to {:g} s",
                                label.start, label.end, kMaxSeconds),
                    place, "count times from the start, in seconds");
  }
  return checkLabels(labels, kMaxSeconds + 1, place);
}

/// Amplitudes become relative to the first one's.
bool normalise(ContactSignature& signature) {
  const double first = signature.events.front().amplitude;
  if (!(first > 0)) return false;
  for (SignatureEvent& event : signature.events) event.amplitude /= first;
  return true;
}

}  // namespace

std::vector<Label> mergeLabels(const std::vector<Label>& labels, double mergeGap) {
  // Times come with six decimals: a gap of just `mergeGap` must not be closed by rounding.
  const double limit = mergeGap - 1e-9;
  std::vector<Label> merged;
  for (const Label& label : labels) {
    if (merged.empty() || label.start - merged.back().end >= limit) {
      merged.push_back(label);
      continue;
    }
    join(merged.back(), label);
  }
  for (Label& label : merged) {
    if (label.end - label.start >= limit) continue;
    label.end = label.start;
    label.centroid.reset();
  }
  return merged;
}

Result<ContactSignature> signatureFromLabels(const Sound& sound, const std::vector<Label>& labels,
                                             const SignatureSettings& settings,
                                             const std::string& place) {
  if (auto good = checkLabels(labels, sound.duration(), place); !good) {
    return tl::unexpected<Error>(good.error());
  }
  const auto merged = mergeLabels(labels, settings.mergeGap);
  const bool told = tellTheirAmplitudes(merged);
  ContactSignature signature;
  signature.terminal = settings.terminal.value_or(labelsAreTerminal(labels));
  signature.firstContact = merged.front().start;
  for (std::size_t i = 0; i < merged.size(); ++i) {
    const double next = i + 1 < merged.size() ? merged[i + 1].start : sound.duration();
    SignatureEvent event = eventAt(sound, merged[i], next, signature.firstContact);
    if (told) event.amplitude = *merged[i].amplitude;
    if (merged[i].centroid) event.centroid = std::min(*merged[i].centroid, event.duration);
    event.weight = merged[i].weight;
    event.alternatives = alternativesOf(merged[i], signature.firstContact);
    signature.events.push_back(event);
  }
  if (!normalise(signature)) {
    return badInput(
        fmt::format("{} at the first contact, {:.6f} s",
                    told ? "the amplitude is 0" : "the sound is silent", signature.firstContact),
        place, "are these the labels of this sound?");
  }
  return signature;
}

Result<ContactSignature> signatureWithoutSound(const std::vector<Label>& labels,
                                               const SignatureSettings& settings,
                                               const std::string& place) {
  if (auto good = checkSpan(labels, place); !good) return tl::unexpected<Error>(good.error());
  const auto merged = mergeLabels(labels, settings.mergeGap);
  ContactSignature signature;
  signature.terminal = settings.terminal.value_or(labelsAreTerminal(labels));
  signature.firstContact = merged.front().start;
  for (const Label& label : merged) {
    signature.events.push_back(eventOf(label, signature.firstContact));
  }
  if (!normalise(signature)) {
    return badInput("the first contact's amplitude is 0, and all others are relative to it", place,
                    "give it a larger one");
  }
  return signature;
}

std::vector<Label> labelsFromSignature(const ContactSignature& signature) {
  std::vector<Label> labels;
  for (const SignatureEvent& event : signature.events) {
    Label label;
    label.start = signature.firstContact + event.time;
    label.end = label.start + event.duration;
    label.text = fmt::format("c{}", labels.size() + 1);
    label.amplitude = event.amplitude;
    if (event.duration > 0) label.centroid = event.centroid;
    label.weight = event.weight;
    label.alternatives = event.alternatives;
    for (AlternativeStart& other : label.alternatives) other.time += signature.firstContact;
    labels.push_back(std::move(label));
  }
  if (!labels.empty()) labels.back().text += signature.terminal ? " terminal" : " non-terminal";
  return labels;
}

std::vector<Label> labelsFromContacts(const std::vector<DetectedContact>& contacts, bool terminal) {
  std::vector<Label> labels;
  for (const DetectedContact& contact : contacts) {
    Label label;
    label.start = contact.start;
    label.end = std::max(contact.start, contact.end);
    label.text = fmt::format("c{}", labels.size() + 1);
    // In hundredths: the last bits of a confidence depend on the machine.
    if (contact.confidence < kSure) label.weight = std::round(100 * contact.confidence) / 100;
    labels.push_back(std::move(label));
  }
  if (!labels.empty()) labels.back().text += terminal ? " terminal" : " non-terminal";
  return labels;
}

}  // namespace ifa
