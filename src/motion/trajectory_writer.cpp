// SPDX-License-Identifier: Apache-2.0
#include "motion/trajectory_writer.h"

#include <cmath>

namespace ifa {

namespace {

constexpr double kFlightStep = 1.0 / 240;  // s
constexpr double kContactStep = 1e-3;      // s
/// Samples closer than this to a flight's ends are left out, s.
constexpr double kApart = 1e-6;

}  // namespace

TrajectoryWriter::TrajectoryWriter(const Body& body, const BodyModel& model, Motion& motion)
    : model_(model),
      motion_(motion),
      principalFromBody_(Eigen::Matrix3d(body.bodyFromPrincipal.transpose())) {}

void TrajectoryWriter::sample(const KernelState<double>& state, double time, double stretch) {
  const RigidState rigid = placement_.apply(rigidState(state));
  MotionSample sample;
  sample.time = time;
  sample.position = rigid.position;
  sample.orientation = (rigid.orientation * principalFromBody_).normalized();
  if (!motion_.trajectory.empty() &&
      motion_.trajectory.back().orientation.dot(sample.orientation) < 0) {
    sample.orientation.coeffs() = -sample.orientation.coeffs();
  }
  sample.velocity = rigid.velocity / stretch;
  sample.angularVelocity = rigid.angularVelocity / stretch;
  motion_.trajectory.push_back(sample);
}

void TrajectoryWriter::sampleAtRest(const KernelState<double>& state, double time) {
  KernelState<double> still = state;
  still.velocity = still.w = {0, 0, 0};
  sample(still, time);
}

/// Samples on the grid of multiples of `step` in the motion's time.
void TrajectoryWriter::inside(const KernelState<double>& departure, double time, double duration,
                              double step, double stretch) {
  KernelState<double> base = departure;
  base.time = 0;
  const double flown = duration / stretch;
  auto next = static_cast<long>(std::floor((time + kApart) / step)) + 1;
  while (base.time < flown) {
    const FlightSegment segment(model_, base, flown - base.time);
    const double end = base.time + segment.length();
    for (;; ++next) {
      const double at = static_cast<double>(next) * step - time;
      if (at / stretch > end || at > duration - kApart) break;
      sample(segment.at(at / stretch - base.time), time + at, stretch);
    }
    base = segment.at(segment.length());
  }
}

void TrajectoryWriter::flight(const KernelState<double>& departure, double time, double duration,
                              double stretch) {
  inside(departure, time, duration, kFlightStep, stretch);
}

void TrajectoryWriter::listSilent(double begin, double end) {
  auto& silent = motion_.silent;
  if (!silent.empty() && std::abs(silent.back()[1] - begin) < 1e-9) {
    silent.back()[1] = end;
  } else {
    silent.push_back({begin, end});
  }
}

bool TrajectoryWriter::run(Stepper& stepper, double time, double limit, bool silent,
                           const std::function<bool(const Stepper&, Advance)>& done,
                           double stretch) {
  while (stepper.state().time < limit) {
    const KernelState<double> from = stepper.state();
    const Advance did = stepper.advance(Stepper::kNoLimit);
    const KernelState<double>& to = stepper.state();
    const double begin = time + stretch * from.time, end = time + stretch * to.time;
    switch (did) {
      case Advance::kFlight:
      case Advance::kTouch:
        inside(from, begin, stretch * (to.time - from.time), kContactStep, stretch);
        sample(to, end, stretch);
        break;
      case Advance::kImpact:
      case Advance::kContact:
        sample(to, end, stretch);
        if (silent) listSilent(begin, end);
        break;
      case Advance::kLift:
        break;
      case Advance::kRest:
        return false;
    }
    if (done(stepper, did)) return true;
  }
  return false;
}

}  // namespace ifa
