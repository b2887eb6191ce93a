// SPDX-License-Identifier: Apache-2.0
#include "signature/signature.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "sound/envelope.h"

namespace ifa {
namespace {

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
    Label& last = merged.back();
    last.end = std::max(last.end, label.end);
    // The terminal flag is said by the last label.
    if (label.text.ends_with("terminal")) last.text = label.text;
  }
  for (Label& label : merged) {
    if (label.end - label.start < limit) label.end = label.start;
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
  ContactSignature signature;
  signature.terminal = settings.terminal.value_or(labelsAreTerminal(labels));
  signature.firstContact = merged.front().start;
  for (std::size_t i = 0; i < merged.size(); ++i) {
    const double next = i + 1 < merged.size() ? merged[i + 1].start : sound.duration();
    signature.events.push_back(eventAt(sound, merged[i], next, signature.firstContact));
  }
  const double first = signature.events.front().amplitude;
  if (first <= 0) {
    return badInput(
        fmt::format("the sound is silent at the first contact, {:.6f} s", signature.firstContact),
        place, "are these the labels of this sound?");
  }
  for (SignatureEvent& event : signature.events) event.amplitude /= first;
  return signature;
}

std::vector<Label> labelsFromContacts(const std::vector<DetectedContact>& contacts, bool terminal) {
  std::vector<Label> labels;
  for (const DetectedContact& contact : contacts) {
    Label label;
    label.start = contact.start;
    label.end = std::max(contact.start, contact.end);
    label.text = fmt::format("c{}", labels.size() + 1);
    labels.push_back(std::move(label));
  }
  if (!labels.empty()) labels.back().text += terminal ? " terminal" : " non-terminal";
  return labels;
}

}  // namespace ifa
