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
// Within these a step of no duration is the listed change and not an impact, m/s and rad/s.
constexpr double kSameVelocity = 1e-9, kSameSpin = 1e-6;

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

/// A change of velocity, m/s and rad/s, world frame.
struct Change {
  Vector3d linear, angular;
};

/// First and last sample of contact `index`'s event; null where there is no such event.
struct EventEnds {
  const MotionSample* first = nullptr;
  const MotionSample* last = nullptr;
};

/// The change may press the body down again in the same instant: the event's last sample is the one
/// right after the change, where that is seen.
EventEnds endsOf(const Evidence& all, std::size_t index, const Change& change) {
  const double leaving = all.retiming(index + 1);
  EventEnds ends;
  bool changed = false;
  for (const Step& step : all.steps) {
    if (step.kind != StepKind::kEvent || step.contact != index || changed) continue;
    const MotionSample &a = all.sample(step.from), &b = all.sample(step.from + 1);
    if (ends.first == nullptr) ends.first = &a;
    ends.last = &b;
    const Vector3d linear = leaving * b.velocity - a.velocity - change.linear;
    const Vector3d angular = leaving * b.angularVelocity - a.angularVelocity - change.angular;
    changed = step.duration <= 0 && linear.norm() < kSameVelocity && angular.norm() < kSameSpin;
  }
  return ends;
}

/// The body's orientation where contact `index` ends; it turns by nothing within an instant.
Eigen::Quaterniond orientationAtEnd(const Evidence& all, std::size_t index) {
  Eigen::Quaterniond q = Eigen::Quaterniond::Identity();
  for (const Step& step : all.steps) {
    if (step.kind == StepKind::kEvent && step.contact == index) {
      q = all.sample(step.from + 1).orientation;
    }
  }
  return q;
}

/// Bend of the change that the file says was made where contact `index` ends.
double bendAfter(const Evidence& all, std::size_t index) {
  const MotionContact& next = all.contact(index + 1);
  const Eigen::Matrix3d inverse = all.body.inertia.inverse();
  const Eigen::Quaterniond q = orientationAtEnd(all, index);
  const Change change{next.impulseChange / all.mass,
                      q * (inverse * (q.conjugate() * next.angularChange))};
  const EventEnds ends = endsOf(all, index, change);
  if (ends.first == nullptr) return 0;
  const auto& [linear, angular] = change;
  const double arriving = all.retiming(index), leaving = all.retiming(index + 1);
  const Vector3d linearByContact =
      leaving * ends.last->velocity - linear - arriving * ends.first->velocity;
  const Vector3d angularByContact =
      leaving * ends.last->angularVelocity - angular - arriving * ends.first->angularVelocity;
  return std::sqrt(
      bendSquared(linear, linearByContact, kLinearSize, 20, kSmallestChange) +
      bendSquared(angular, angularByContact, kAngularSize, 10, kSmallestChange / all.body.radius));
}

}  // namespace

void checkBend(const Evidence& all, Checks& checks) {
  Worst bend, understated;
  for (std::size_t i = 0; i < all.motion.contacts.size(); ++i) {
    const MotionContact& contact = all.contact(i);
    const double found = i > 0 ? bendAfter(all, i - 1) : 0;
    const std::string name = "contact " + std::to_string(i + 1);
    bend.see(std::max(contact.bend, found), contact.time, name);
    understated.see(found - contact.bend, contact.time, name);
  }
  checks.push_back(bend.check("bend", "", all.motion.bend.cap));
  checks.push_back(understated.check("bend understated", "", kRounding));
}

}  // namespace ifa::audit_detail
