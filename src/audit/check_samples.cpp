// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <string>

#include "audit/checks.h"

namespace ifa::audit_detail {
namespace {

constexpr double kUnit = 1e-9;            // of a quaternion's norm
constexpr double kSamePose = 1e-9;        // m and rad, of samples that share their time
constexpr double kSlack = 1e-6;           // s, on the sampling intervals
constexpr double kFlightStep = 1. / 240;  // s
constexpr double kContactStep = 1e-3;     // s
// Beyond these a file is broken, and predicting it would take for ever.
constexpr double kLongestGap = 0.1;   // s
constexpr double kFastest = 1e3;      // m/s
constexpr double kFastestSpin = 5e3;  // rad/s
constexpr double kAlmostUnit = 1e-2;  // of a quaternion's norm

/// Counts flaws and keeps the first one's description.
struct Flaws {
  double count = 0, time = 0;
  std::string first;

  void add(double when, const std::string& what) {
    if (count++ > 0) return;
    time = when;
    first = what;
  }
  [[nodiscard]] AuditCheck check(std::string name) const {
    return {std::move(name), count == 0, count, 0, "flaws", time, first};
  }
};

bool isFinite(const MotionSample& s) {
  return std::isfinite(s.time) && s.position.allFinite() && s.orientation.coeffs().allFinite() &&
         s.velocity.allFinite() && s.angularVelocity.allFinite();
}

bool isAbsurd(const MotionSample& s) {
  return s.velocity.norm() > kFastest || s.angularVelocity.norm() > kFastestSpin ||
         std::abs(s.orientation.norm() - 1) > kAlmostUnit;
}

/// How far samples may be apart there, s. Steps of a silent passage are as long as they are shown.
double longestStep(const Motion& motion, const MotionSample& a, const MotionSample& b) {
  const auto inside = [&](double from, double to) {
    return a.time >= from - kSameTime && b.time <= to + kSameTime;
  };
  double retiming = 1;
  for (const MotionContact& contact : motion.contacts) {
    if (inside(contact.time, contact.end)) return kContactStep;
    if (contact.time < b.time - kSameTime) continue;
    retiming = contact.retiming;
    break;
  }
  const bool silent = std::any_of(motion.silent.begin(), motion.silent.end(),
                                  [&](const auto& s) { return inside(s[0], s[1]); });
  return silent ? kContactStep * std::max(1.0, retiming) : kFlightStep;
}

void lookAtStep(const Motion& motion, const MotionSample& a, const MotionSample& b, Flaws& flaws) {
  const double step = b.time - a.time;
  if (step < 0) flaws.add(b.time, "goes back in time");
  // Times so close are one; the body may still have moved on by what it does in that time.
  const double moved = kSamePose + kSameTime * std::max(a.velocity.norm(), b.velocity.norm());
  const double turned =
      kSamePose + kSameTime * std::max(a.angularVelocity.norm(), b.angularVelocity.norm());
  if (step < kSameTime && ((b.position - a.position).norm() > moved ||
                           a.orientation.angularDistance(b.orientation) > turned)) {
    flaws.add(b.time, "two poses at one time");
  }
  if (step > kFlightStep + kSlack) flaws.add(a.time, "a gap between samples");
  if (step > kContactStep + kSlack && step > longestStep(motion, a, b) + kSlack) {
    flaws.add(a.time, "samples in contact are more than 1 ms apart");
  }
}

void lookForSample(const Motion& motion, double time, const char* what, Flaws& flaws) {
  const auto next =
      std::lower_bound(motion.trajectory.begin(), motion.trajectory.end(), time - kSameTime,
                       [](const MotionSample& sample, double t) { return sample.time < t; });
  if (next == motion.trajectory.end() || next->time > time + kSameTime) flaws.add(time, what);
}

AuditCheck signs(const Motion& motion) {
  Flaws flaws;
  for (std::size_t i = 1; i < motion.trajectory.size(); ++i) {
    const MotionSample &a = motion.trajectory[i - 1], &b = motion.trajectory[i];
    if (a.orientation.dot(b.orientation) < 0) flaws.add(b.time, "the quaternion changes its sign");
  }
  return flaws.check("orientation signs");
}

}  // namespace

bool canBeJudged(const Motion& motion) {
  const auto& samples = motion.trajectory;
  const auto apart = [](const MotionSample& a, const MotionSample& b) {
    return b.time < a.time || b.time - a.time > kLongestGap;
  };
  return samples.size() > 1 && !motion.contacts.empty() &&
         std::all_of(samples.begin(), samples.end(), isFinite) &&
         std::none_of(samples.begin(), samples.end(), isAbsurd) &&
         std::adjacent_find(samples.begin(), samples.end(), apart) == samples.end();
}

void checkSamples(const Motion& motion, Checks& checks) {
  Flaws flaws;
  const auto& samples = motion.trajectory;
  if (samples.size() < 2) flaws.add(0, "no samples");
  if (motion.contacts.empty()) flaws.add(0, "no contacts");
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (!isFinite(samples[i])) flaws.add(samples[i].time, "a number that is not finite");
    if (isAbsurd(samples[i])) flaws.add(samples[i].time, "an absurd speed or orientation");
    if (std::abs(samples[i].orientation.norm() - 1) > kUnit) {
      flaws.add(samples[i].time, "an orientation that is no unit quaternion");
    }
    if (i > 0) lookAtStep(motion, samples[i - 1], samples[i], flaws);
  }
  for (const MotionContact& contact : motion.contacts) {
    lookForSample(motion, contact.time, "no sample at a contact's start", flaws);
    lookForSample(motion, contact.end, "no sample at a contact's end", flaws);
  }
  checks.push_back(flaws.check("samples"));
  checks.push_back(signs(motion));
}

}  // namespace ifa::audit_detail
