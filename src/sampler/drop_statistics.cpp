// SPDX-License-Identifier: Apache-2.0
#include "sampler/drop_statistics.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/parallel.h"
#include "sampler/initial_state.h"

namespace ifa {
namespace {

/// One drop's share of DropStatistics.
struct DropFigures {
  double paperEvents = 0, largestImpulse = 0, restTime = 0;
  std::vector<double> audibleStarts;
  bool finished = false;
};

DropFigures figuresOf(const DropResult& drop, const Body& body, const SurfaceProperties& surface) {
  EventRecorder paper(paperCut(body)), audible(audibleCut(body, surface));
  for (const ContactStep& step : drop.steps) {
    paper.add(step);
    audible.add(step);
  }
  DropFigures figures;
  figures.paperEvents = static_cast<double>(paper.finish(drop.atRest).size());
  for (const ContactEvent& event : audible.finish(drop.atRest))
    figures.audibleStarts.push_back(event.start);
  figures.largestImpulse = paper.largestImpulse();
  figures.restTime = timeToRest(body, drop.steps);
  figures.finished = drop.atRest;
  return figures;
}

}  // namespace

RecorderSettings audibleCut(const Body& body, const SurfaceProperties& surface) {
  return {body.definition.mergeGap, body.mass * kGravity, kAudibleShare * surface.referenceImpulse,
          true};
}

std::vector<ContactEvent> eventsOf(const DropResult& drop, const RecorderSettings& settings) {
  EventRecorder recorder(settings);
  for (const ContactStep& step : drop.steps) {
    // A simulator that waits to see whether the body rests has steps of that, too.
    if (!settings.audible && drop.atRest && step.time >= drop.restTime) break;
    recorder.add(step);
  }
  return recorder.finish(drop.atRest);
}

RecorderSettings paperCut(const Body& body) {
  return {body.definition.mergeGap, body.mass * kGravity, 0, false};
}

RecorderSettings recorderFor(EventCut cut, const Body& body, const SurfaceProperties& surface) {
  return cut == EventCut::kPaper ? paperCut(body) : audibleCut(body, surface);
}

double kineticSpeed(const Body& body, const RigidState& state) {
  const Eigen::Vector3d spin = state.orientation.conjugate() * state.angularVelocity;
  return std::sqrt(state.velocity.squaredNorm() +
                   body.principalMoments.dot(spin.cwiseAbs2()) / body.mass);
}

double timeToRest(const Body& body, const std::vector<ContactStep>& steps, double speed) {
  const auto last = std::find_if(steps.rbegin(), steps.rend(), [&](const ContactStep& step) {
    return kineticSpeed(body, step.before) > speed;
  });
  return last == steps.rend() ? 0 : last->time + last->duration;
}

DropStatistics gatherStatistics(const Body& body, const SurfaceProperties& surface,
                                const Simulate& simulate, std::uint64_t seed, std::size_t count) {
  std::vector<DropFigures> drops(count);
  parallelFor(count, [&](std::size_t i) {
    drops[i] = figuresOf(simulate(sampleInitialState(body, seed, i)), body, surface);
  });
  DropStatistics all;
  for (const DropFigures& drop : drops) {
    all.paperEvents.push_back(drop.paperEvents);
    all.audibleEvents.push_back(static_cast<double>(drop.audibleStarts.size()));
    all.largestImpulse.push_back(drop.largestImpulse);
    all.restTimes.push_back(drop.restTime);
    for (std::size_t k = 1; k < drop.audibleStarts.size(); ++k)
      all.gaps.push_back(drop.audibleStarts[k] - drop.audibleStarts[k - 1]);
    if (!drop.finished) ++all.unfinished;
  }
  return all;
}

double mean(const std::vector<double>& values) {
  if (values.empty()) return 0;
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double median(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

double distributionDistance(std::vector<double> a, std::vector<double> b) {
  if (a.empty() || b.empty()) return a.empty() == b.empty() ? 0 : 1;
  std::sort(a.begin(), a.end());
  std::sort(b.begin(), b.end());
  double distance = 0;
  std::size_t i = 0, j = 0;
  while (i < a.size() && j < b.size()) {
    const double value = std::min(a[i], b[j]);
    while (i < a.size() && a[i] <= value) ++i;
    while (j < b.size() && b[j] <= value) ++j;
    distance = std::max(distance, std::abs(static_cast<double>(i) / static_cast<double>(a.size()) -
                                           static_cast<double>(j) / static_cast<double>(b.size())));
  }
  return distance;
}

}  // namespace ifa
