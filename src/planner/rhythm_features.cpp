// SPDX-License-Identifier: Apache-2.0
#include "planner/rhythm_features.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/parallel.h"
#include "base/portable_math.h"
#include "base/random.h"
#include "dynamics/simulator.h"
#include "sampler/drop_statistics.h"
#include "sampler/initial_state.h"

namespace ifa {

namespace {

/// Seed of the drops; fixed, so that plans do not depend on it.
constexpr std::uint64_t kSeed = 0x7265626f756e64ULL;
constexpr double kLongestDrop = 10;  // s
constexpr double kMisheard = 0.3;    ///< relative error of the amplitudes
constexpr double kLeastGap = 2e-3, kLeastAmplitude = 1e-3;

double logAmplitude(double amplitude) { return portableLog(std::max(amplitude, kLeastAmplitude)); }

/// Misheard like a person's labels.
ContactSignature heardOf(const std::vector<ContactEvent>& events, double mergeGap,
                         RandomStream& random) {
  ContactSignature signature;
  for (const ContactEvent& event : events) {
    const double wrong = random.uniform(1 - kMisheard, 1 + kMisheard);
    const double duration = event.filteredDuration(mergeGap);
    const double centroid = duration > 0 ? event.centroid : 0;
    signature.events.push_back({event.start - events[0].start, duration,
                                wrong * event.amplitude / events[0].amplitude, centroid, 1});
  }
  return signature;
}

/// Nothing where fewer than two events are heard.
std::optional<RhythmSample> sampleOfDrop(const Body& body, SurfaceProperties surface,
                                         const RecorderSettings& recorder,
                                         const RestitutionSpan& span, std::uint64_t index) {
  RandomStream random(kSeed, index);
  RhythmSample sample;
  sample.restitution = surface.restitution = random.uniform(span.least, span.most);
  const DropResult drop =
      simulateDrop(body, surface, sampleInitialState(body, kSeed, index), kLongestDrop);
  const std::vector<ContactEvent> events = eventsOf(drop, recorder);
  if (events.size() < 2) return {};
  sample.features = rhythmFeatures(heardOf(events, recorder.mergeGap, random));
  return sample;
}

/// Sums over the gaps of a rhythm.
struct Gaps {
  double largest = 0, squares = 0, logs = 0, roughness = 0, sounding = 0;
  double flights = 0, loudStart = 0;  ///< lengths; log of amplitude before over length
  double onto = 0, from = 0;          ///< squares of the amplitudes at the ends and at the starts
  double after = 0, before = 0;       ///< products of each gap and the next, squares of the former
};

Gaps sumGaps(const std::vector<SignatureEvent>& events) {
  Gaps sum;
  double last = 0;
  for (std::size_t k = 1; k < events.size(); ++k) {
    const SignatureEvent &a = events[k - 1], &b = events[k];
    const double gap = std::max(b.time - a.time, kLeastGap);
    const double flight = std::max(b.time - a.time - a.duration, kLeastGap);
    sum.largest = std::max(sum.largest, gap);
    sum.squares += gap * gap;
    sum.logs += portableLog(gap);
    sum.flights += flight;
    sum.loudStart += logAmplitude(a.amplitude) - portableLog(flight);
    sum.onto += b.amplitude * b.amplitude;
    sum.from += a.amplitude * a.amplitude;
    sum.sounding += a.duration;
    if (k > 1) {
      sum.roughness += std::abs(portableLog(gap / last));
      sum.after += gap * last;
      sum.before += last * last;
    }
    last = gap;
  }
  sum.sounding += events.back().duration;
  return sum;
}

}  // namespace

RhythmFeatures rhythmFeatures(const ContactSignature& signature) {
  const auto& events = signature.events;
  const Gaps sum = sumGaps(events);
  const std::size_t n = events.size();
  const auto gaps = static_cast<double>(n - 1);
  const double whole = std::max(events.back().time, kLeastGap);
  double loudest = 0, loudness = 0;
  for (const SignatureEvent& event : events) {
    loudest = std::max(loudest, event.amplitude);
    loudness += logAmplitude(event.amplitude);
  }
  const double softest = logAmplitude(events.back().amplitude);
  RhythmFeatures f;
  f << 1, portableLog(static_cast<double>(n)), portableLog(whole),
      portableLog(std::max(events[1].time, kLeastGap)), portableLog(sum.largest),
      portableLog(std::max(whole - events[n - 2].time, kLeastGap)), sum.logs / gaps,
      portableLog(sum.squares), portableLog(sum.flights), sum.sounding / whole,
      n > 2 ? sum.roughness / (gaps - 1) : 0, n > 2 ? sum.after / sum.before : 0.5,
      loudness / static_cast<double>(n), logAmplitude(loudest), softest, softest / gaps,
      sum.loudStart / gaps,
      portableLog(std::max(sum.onto, kLeastAmplitude) / std::max(sum.from, kLeastAmplitude));
  return f;
}

std::vector<RhythmSample> rhythmsOfDrops(const Body& body, const SurfaceProperties& surface,
                                         const RecorderSettings& recorder,
                                         const RestitutionSpan& span, int drops,
                                         const Progress& progress) {
  std::vector<std::optional<RhythmSample>> all(static_cast<std::size_t>(drops));
  parallelFor(all.size(), "learn", progress,
              [&](std::size_t i) { all[i] = sampleOfDrop(body, surface, recorder, span, i); });
  std::vector<RhythmSample> heard;
  for (const auto& sample : all) {
    if (sample) heard.push_back(*sample);
  }
  return heard;
}

}  // namespace ifa
