// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <string>

#include "audit/checks.h"
#include "audit/flight.h"

namespace ifa::audit_detail {
namespace {

using Eigen::Vector3d;

// IFA equation 2: the plausible region's half-axes as shares of the change that the contact made.
constexpr double kDegree = 3.14159265358979323846 / 180;
constexpr double kLinearSize = 0.4, kAngularSize = 0.2;
// Method, 5: a smaller change than this (m/s at the body's radius) is taken for this.
constexpr double kSmallestChange = 0.05;
// Digits by which a stated bend may be smaller than the one found here.
constexpr double kRounding = 1e-6;

/// Squared length of `change` in units of the region around `reference`.
double bendSquared(const Vector3d& change, const Vector3d& reference, double size, double degrees,
                   double smallest) {
  const double length = reference.norm();
  const Vector3d axis = length > 0 ? Vector3d(reference / length) : Vector3d(Vector3d::UnitZ());
  const double semiAxis = size * std::max(length, smallest);
  const double along = change.dot(axis), across = (change - along * axis).norm();
  return std::pow(along / semiAxis, 2) +
         std::pow(across / (semiAxis * std::tan(degrees * kDegree)), 2);
}

/// First and last sample of an event.
struct EventEnds {
  const MotionSample* first = nullptr;
  const MotionSample* last = nullptr;
};

/// Whether a step only cuts what little motion is left where the body comes to rest ("rest speed"):
/// no contact made that change.
bool isFreezing(const Evidence& all, const Step& step) {
  const MotionSample &a = all.sample(step.from), &b = all.sample(step.from + 1);
  const double weight = all.mass * kGravity;
  return step.duration <= 0 && a.time >= all.restTime - kSameTime && b.velocity.norm() == 0 &&
         b.angularVelocity.norm() == 0 &&
         all.energy(step.from) - weight * a.position.z() <= weight * all.depth;
}

/// Ends of contact `index`'s event, up to the change that leads out of it; null where there is
/// none.
EventEnds endsOf(const Evidence& all, std::size_t index) {
  EventEnds ends;
  for (const Step& step : all.steps) {
    if (step.kind != StepKind::kEvent || step.contact != index) continue;
    if (ends.first != nullptr && isFreezing(all, step)) break;
    if (ends.first == nullptr) ends.first = &all.sample(step.from);
    ends.last = &all.sample(step.from + 1);
    if (step.from + 1 == all.departures[index]) break;
  }
  return ends;
}

/// Bends of the changes that the file says were made where contact `index` begins and ends.
struct Bends {
  double arriving = 0, leaving = 0;
};

Bends bendsOf(const Evidence& all, std::size_t index) {
  const EventEnds ends = endsOf(all, index);
  if (ends.first == nullptr) return {};
  const MotionContact& contact = all.contact(index);
  const Change came = all.changeBy(contact.arrivalImpulseChange, contact.arrivalAngularChange,
                                   ends.first->orientation);
  Change left;
  if (index + 1 < all.motion.contacts.size()) {
    const MotionContact& next = all.contact(index + 1);
    left = all.changeBy(next.impulseChange, next.angularChange, ends.last->orientation);
  }
  // The contact as it was simulated: neither change has a part in it.
  const double before = all.retiming(index), after = all.retiming(index + 1);
  const Vector3d linear =
      after * ends.last->velocity - left.linear - (before * ends.first->velocity + came.linear);
  const Vector3d angular = after * ends.last->angularVelocity - left.angular -
                           (before * ends.first->angularVelocity + came.angular);
  const auto bend = [&](const Change& change) {
    return std::sqrt(
        bendSquared(change.linear, linear, kLinearSize, 20, kSmallestChange) +
        bendSquared(change.angular, angular, kAngularSize, 10, kSmallestChange / all.body.radius));
  };
  return {bend(came), bend(left)};
}

}  // namespace

void checkBend(const Evidence& all, Checks& checks) {
  Worst bend, understated;
  double found = 0;  // of the change that leads to this contact
  for (std::size_t i = 0; i < all.motion.contacts.size(); ++i) {
    const MotionContact& contact = all.contact(i);
    const std::string name = "contact " + std::to_string(i + 1);
    const Bends bends = bendsOf(all, i);
    bend.see(std::max({contact.bend, found, contact.arrivalBend, bends.arriving}), contact.time,
             name);
    understated.see(std::max(found - contact.bend, bends.arriving - contact.arrivalBend),
                    contact.time, name);
    found = bends.leaving;
  }
  checks.push_back(bend.check("bend", "", all.motion.bend.cap));
  checks.push_back(understated.check("bend understated", "", kRounding));
}

}  // namespace ifa::audit_detail
