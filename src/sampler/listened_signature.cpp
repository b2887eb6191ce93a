// SPDX-License-Identifier: Apache-2.0
#include "sampler/listened_signature.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "sampler/drop_statistics.h"

namespace ifa {
namespace {

double rounded(double value, double perUnit) { return std::round(value * perUnit) / perUnit; }

double energyOf(const Body& body, const RigidState& state) {
  const double speed = kineticSpeed(body, state);
  return body.mass * (speed * speed / 2 + kGravity * state.position.z());
}

/// Weights exp(strength * (value - centre)).
std::vector<double> tiltedWeights(const std::vector<double>& values, double strength) {
  const double largest = *std::max_element(values.begin(), values.end());
  const double smallest = *std::min_element(values.begin(), values.end());
  std::vector<double> weights;
  for (const double value : values)
    weights.push_back(std::exp(strength * (value - (strength > 0 ? largest : smallest))));
  return weights;
}

double weightedMean(const std::vector<double>& values, const std::vector<double>& weights) {
  return std::inner_product(values.begin(), values.end(), weights.begin(), 0.0) /
         std::accumulate(weights.begin(), weights.end(), 0.0);
}

}  // namespace

ContactSignature listenTo(const std::vector<ContactEvent>& events, const ListenerSettings& settings,
                          RandomStream& random) {
  const double gap = settings.mergeGap;
  std::vector<double> starts, ends;
  for (const ContactEvent& event : events) {
    const double heard = event.start + random.uniform(-1, 1) * settings.startJitter;
    starts.push_back(starts.empty() ? heard : std::max(heard, starts.back() + gap));
  }
  ContactSignature signature;
  for (std::size_t k = 0; k < events.size(); ++k) {
    const double latest =
        k + 1 < events.size() ? starts[k + 1] - gap : std::numeric_limits<double>::max();
    const double heardEnd = events[k].end + random.uniform(-1, 1) * settings.endJitter;
    const double end = std::clamp(heardEnd, starts[k], std::max(starts[k], latest));
    SignatureEvent& event = signature.events.emplace_back();
    event.time = rounded(starts[k] - starts[0], 1e6);
    const double louder = 1 + (k == 0 ? 0 : random.uniform(-1, 1) * settings.amplitudeJitter);
    event.amplitude =
        std::max(1e-4, rounded(louder * events[k].amplitude / events[0].amplitude, 1e4));
    if (end - starts[k] < gap) continue;
    event.duration = rounded(end - starts[k], 1e6);
    const double centroid = events[k].start + events[k].centroid - starts[k];
    event.centroid = rounded(std::clamp(centroid, 0.0, event.duration), 1e6);
  }
  signature.terminal = !events.empty() && events.back().terminal;
  return signature;
}

Body scaledBody(Body body, double factor) {
  const double volume = factor * factor * factor;
  for (Eigen::Vector3d& vertex : body.mesh.vertices) vertex *= factor;
  for (Eigen::Vector3d& vertex : body.hull) vertex *= factor;
  body.hullDeviation *= factor;
  body.mass *= volume;
  body.definition.mass *= volume;
  body.centreOfMass *= factor;
  body.inertia *= volume * factor * factor;
  body.principalMoments *= volume * factor * factor;
  body.radius *= factor;
  body.size *= factor;
  return body;
}

double largestEnergyRise(const Body& body, const std::vector<ContactEvent>& events) {
  double rise = 0, last = std::numeric_limits<double>::max();
  for (const ContactEvent& event : events) {
    for (const RigidState& state : {event.before, event.after}) {
      const double energy = energyOf(body, state);
      rise = std::max(rise, energy - last);
      last = energy;
    }
  }
  return rise;
}

std::vector<std::size_t> chooseByMean(const std::vector<double>& values, std::size_t count,
                                      double target) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
  double low = -3, high = 3;
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    (weightedMean(values, tiltedWeights(values, middle)) < target ? low : high) = middle;
  }
  const std::vector<double> weights = tiltedWeights(values, low);
  const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
  std::vector<std::size_t> chosen;
  double passed = 0;
  for (std::size_t i = 0; i < order.size() && chosen.size() < count; ++i) {
    passed += weights[order[i]] / total;
    const bool due = passed * static_cast<double>(count) > static_cast<double>(chosen.size()) + 0.5;
    const bool last = order.size() - i == count - chosen.size();
    if (due || last) chosen.push_back(order[i]);
  }
  std::sort(chosen.begin(), chosen.end());
  return chosen;
}

}  // namespace ifa
