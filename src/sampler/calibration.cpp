// SPDX-License-Identifier: Apache-2.0
#include "sampler/calibration.h"

#include <fmt/format.h>

#include <cmath>
#include <string>

#include "dynamics/simulator.h"
#include "sampler/drop_statistics.h"

namespace ifa {
namespace {

constexpr int kBisections = 9;  // the range of 0.6 down to 0.001

/// What the sample supports, and what a person can read in an object file.
double fourDigits(double value) { return std::stod(fmt::format("{:.4g}", value)); }

/// Bisects one property of the surface, of which the number of events is a rising function.
class Bisection {
 public:
  Bisection(const Body& body, double target, const CalibrationSettings& settings)
      : body_(body), target_(target), settings_(settings) {}

  Calibration run(SurfaceProperties surface, double SurfaceProperties::*property, double low,
                  double high) const {
    const Calibration least = measure(surface, property, low);
    if (least.reached || least.measured.eventsPerSimulation > target_) return least;
    Calibration best = measure(surface, property, high);
    if (best.reached || best.measured.eventsPerSimulation < target_) return best;
    if (error(least) < error(best)) best = least;
    for (int i = 0; i < kBisections && !best.reached; ++i) {
      const Calibration middle = measure(surface, property, (low + high) / 2);
      (middle.measured.eventsPerSimulation < target_ ? low : high) = (low + high) / 2;
      if (error(middle) < error(best)) best = middle;
    }
    return best;
  }

  double error(const Calibration& c) const {
    return std::abs(c.measured.eventsPerSimulation / target_ - 1);
  }

 private:
  Calibration measure(SurfaceProperties surface, double SurfaceProperties::*property,
                      double value) const {
    surface.*property = std::round(value * 1e3) / 1e3;
    Calibration result;
    result.measured = measureSurface(body_, surface, settings_);
    surface.referenceImpulse = result.measured.referenceImpulse;
    result.surface = surface;
    result.reached = error(result) <= settings_.tolerance;
    return result;
  }

  const Body& body_;
  double target_;
  const CalibrationSettings& settings_;
};

}  // namespace

SurfaceMeasurement measureSurface(const Body& body, const SurfaceProperties& surface,
                                  const CalibrationSettings& settings) {
  const BodyModel model(body, surface);
  const auto simulate = [&](const RigidState& start) {
    return simulateDrop(model, start, settings.timeLimit);
  };
  SurfaceProperties judged = surface;
  const auto gather = [&](std::size_t count) {
    return gatherStatistics(body, judged, simulate, settings.seed, count);
  };
  const DropStatistics all = gather(settings.simulations);
  SurfaceMeasurement measured;
  measured.eventsPerSimulation = mean(all.paperEvents);
  measured.referenceImpulse = fourDigits(median(all.largestImpulse));
  measured.restTime = mean(all.restTimes);
  measured.unfinished = all.unfinished;
  // Audible events need J_ref, known only now; a part of the drops is enough for a figure to print.
  judged.referenceImpulse = measured.referenceImpulse;
  measured.audibleEvents = mean(gather(settings.simulations / 8 + 1).audibleEvents);
  return measured;
}

Calibration calibrateSurface(const Body& body, const SurfaceProperties& start, double target,
                             const CalibrationSettings& settings) {
  const Bisection bisection(body, target, settings);
  const Calibration first = bisection.run(start, &SurfaceProperties::restitution,
                                          settings.lowestRestitution, settings.highestRestitution);
  if (first.reached) return first;
  const Calibration second = bisection.run(first.surface, &SurfaceProperties::friction,
                                           settings.lowestFriction, settings.highestFriction);
  return bisection.error(second) < bisection.error(first) ? second : first;
}

}  // namespace ifa
