// SPDX-License-Identifier: Apache-2.0
#include "planner/energy_outlook.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "base/portable_math.h"
#include "dynamics/energy.h"
#include "dynamics/simulator.h"
#include "sampler/drop_statistics.h"
#include "sampler/initial_state.h"

namespace ifa {

namespace {

/// Seed of the drops from which the outlook is learnt; fixed, so that plans do not depend on it.
constexpr std::uint64_t kSeed = 0x6f75746c6f6f6bULL;
constexpr double kLongestDrop = 10;   // s
constexpr double kLeastShare = 1e-4;  // of the energy at rest; keeps the logarithm finite

struct Sample {
  EnergyOutlook::Features features;
  double energy;  ///< after the contact, J
  double rest;    ///< of that drop, J
};

std::vector<Sample> samplesOfDrop(const Body& body, const BodyModel& model,
                                  const RecorderSettings& settings, std::uint64_t index) {
  const DropResult drop = simulateDrop(model, sampleInitialState(body, kSeed, index), kLongestDrop);
  const std::vector<ContactEvent> events = eventsOf(drop, settings);
  std::vector<double> starts, impulses;
  for (const ContactEvent& event : events) {
    starts.push_back(event.start);
    impulses.push_back(event.amplitude);
  }
  std::vector<Sample> samples;
  for (std::size_t k = 0; k + 1 < events.size(); ++k) {
    samples.push_back({EnergyOutlook::features(starts, impulses, k),
                       totalEnergy(model, events[k].after), totalEnergy(model, drop.rest)});
  }
  return samples;
}

double logAbove(double energy, double rest) {
  return portableLog(std::max(energy - rest, kLeastShare * rest));
}

}  // namespace

EnergyOutlook::EnergyOutlook(const Coefficients& known)
    : weights_(known.weights.data()), spread_(known.spread), restEnergy_(known.restEnergy) {}

EnergyOutlook::Coefficients EnergyOutlook::coefficients() const {
  Coefficients known{{}, spread_, restEnergy_};
  std::copy(weights_.begin(), weights_.end(), known.weights.begin());
  return known;
}

EnergyOutlook::Features EnergyOutlook::features(const std::vector<double>& starts,
                                                const std::vector<double>& impulses,
                                                std::size_t k) {
  double largest = 0, sum = 0;
  for (std::size_t i = k + 1; i < starts.size(); ++i) {
    largest = std::max(largest, starts[i] - starts[i - 1]);
    sum += impulses[i];
  }
  Features f;
  f << 1, portableLog(std::max(starts[k + 1] - starts[k], 1e-4)),
      portableLog(std::max(largest, 1e-4)), portableLog(std::max(starts.back() - starts[k], 1e-4)),
      portableLog(std::max(sum, 1e-12)), portableLog(static_cast<double>(starts.size() - k - 1));
  return f;
}

EnergyOutlook EnergyOutlook::learn(const Body& body, const BodyModel& model,
                                   const RecorderSettings& recorder, int drops,
                                   const Progress& progress) {
  std::vector<std::vector<Sample>> samples(static_cast<std::size_t>(drops));
  parallelFor(samples.size(), "learn", progress,
              [&](std::size_t i) { samples[i] = samplesOfDrop(body, model, recorder, i); });
  using Normal = Eigen::Matrix<double, kFeatures, kFeatures>;
  Normal normal = 1e-6 * Normal::Identity();
  Features right = Features::Zero();
  double squares = 0, rest = 0, count = 0;
  const auto each = [&](const auto& use) {
    for (const auto& drop : samples) {
      for (const Sample& s : drop) use(s);
    }
  };
  each([&](const Sample& s) {
    const double y = logAbove(s.energy, s.rest);
    normal += s.features * s.features.transpose();
    right += s.features * y;
    rest += s.rest;
    ++count;
  });
  EnergyOutlook outlook;
  if (count == 0) return outlook;
  outlook.weights_ = normal.ldlt().solve(right);
  each([&](const Sample& s) {
    const double miss = logAbove(s.energy, s.rest) - outlook.weights_.dot(s.features);
    squares += miss * miss;
  });
  outlook.spread_ = std::max(0.1, std::sqrt(squares / count));
  outlook.restEnergy_ = rest / count;
  return outlook;
}

double EnergyOutlook::deviation(double energy, const Features& features) const {
  if (restEnergy_ <= 0) return 0;
  return (logAbove(energy, restEnergy_) - weights_.dot(features)) / spread_;
}

}  // namespace ifa
