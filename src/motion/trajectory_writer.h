// SPDX-License-Identifier: Apache-2.0
// Turns kernel states into a motion's samples: flights at 240 Hz, contact at every step and impact.
#pragma once

#include <functional>

#include "connection/placement.h"
#include "dynamics/stepper.h"
#include "ifa/motion.h"

namespace ifa {

/// Not thread safe. Times are those of the motion: s after the first contact.
class TrajectoryWriter {
 public:
  TrajectoryWriter(const Body& body, const BodyModel& model, Motion& motion);

  /// From now on states are seen from a frame that `placement` lays into the motion's world.
  void place(const Placement& placement) { placement_ = placement; }
  /// A state, with the velocities it has when it is shown `stretch` times slower.
  void sample(const KernelState<double>& state, double time, double stretch = 1);
  /// The same with no velocity: a body at rest.
  void sampleAtRest(const KernelState<double>& state, double time);
  /// Samples strictly inside a flight from `departure` that is shown in `duration` seconds,
  /// `stretch` times slower than it is, on the grid of 240 Hz.
  void flight(const KernelState<double>& departure, double time, double duration,
              double stretch = 1);
  /// Runs `stepper` (time 0 = `time`) until `done` says so after some advance, or it rests, or
  /// `limit` s; writes flights in between at 1 ms and contact at every step. Contact is listed as
  /// silent where `silent`. Shown `stretch` times slower. Returns whether `done` was met.
  bool run(Stepper& stepper, double time, double limit, bool silent,
           const std::function<bool(const Stepper&, Advance)>& done, double stretch = 1);

 private:
  void inside(const KernelState<double>& departure, double time, double duration, double step,
              double stretch = 1);
  void listSilent(double begin, double end);

  BodyModel const& model_;
  Motion& motion_;
  Placement placement_;
  Eigen::Quaterniond principalFromBody_;
};

}  // namespace ifa
