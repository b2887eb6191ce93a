// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>

#include "audit/checks.h"
#include "audit/flight.h"

namespace ifa::audit_detail {
namespace {

using Eigen::Vector2d;

// Decision: round bodies have facets for want of triangles, and stop on the edge between two of
// them as well as on one. A gap under the next vertex that nobody sees is taken for contact.
constexpr double kUnseenGap = 5e-3;  // share of the body's size

/// Where the lowest vertices stand, seen from above, relative to the centre of mass.
std::vector<Vector2d> supportPoints(const Evidence& all, const MotionSample& rest) {
  const double gap = std::max(all.depth, kUnseenGap * all.body.size);
  std::vector<Vector2d> points;
  for (const Eigen::Vector3d& vertex : all.body.hull) {
    const Eigen::Vector3d arm = rest.orientation * vertex;
    if (rest.position.z() + arm.z() <= gap) points.emplace_back(arm.head<2>());
  }
  return points;
}

/// Distance of the origin from the convex hull of `points`: the largest, over all directions, by
/// which the origin lies beyond every point. 0 inside.
double distanceOutside(const std::vector<Vector2d>& points) {
  constexpr int kDirections = 3600;
  double distance = points.empty() ? std::numeric_limits<double>::infinity() : 0;
  for (int i = 0; i < kDirections && !points.empty(); ++i) {
    const double angle = i * (2 * 3.14159265358979323846 / kDirections);
    const Vector2d direction(std::cos(angle), std::sin(angle));
    double reach = -std::numeric_limits<double>::infinity();
    for (const Vector2d& point : points) reach = std::max(reach, direction.dot(point));
    distance = std::max(distance, -reach);
  }
  return distance;
}

/// Speed of the fastest point of the body, m/s.
double speedOf(const Evidence& all, const MotionSample& sample) {
  return sample.velocity.norm() + all.body.radius * sample.angularVelocity.norm();
}

AuditCheck pose(const Evidence& all) {
  Worst worst;
  const MotionSample& last = all.motion.trajectory.back();
  for (const MotionSample& sample : all.motion.trajectory) {
    if (sample.time < all.restTime - kSameTime) continue;
    worst.see(std::max((sample.position - last.position).norm(),
                       sample.orientation.angularDistance(last.orientation)),
              sample.time);
    if (sample.time > all.restTime + kSameTime) worst.see(speedOf(all, sample), sample.time);
  }
  worst.see(speedOf(all, last), last.time, "the motion ends before it rests");
  return worst.check("rest pose", "m, rad or m/s", all.settings.restDrift);
}

/// Energy of motion that vanishes when settling is declared over: freezing too early.
AuditCheck freezing(const Evidence& all) {
  Worst worst;
  const double eventEnd = all.motion.contacts.back().end;
  for (std::size_t i = all.motion.trajectory.size(); i-- > 0;) {
    const MotionSample& sample = all.sample(i);
    if (sample.time < eventEnd - kSameTime) break;
    if (sample.time < eventEnd + kSameTime && !isLastAt(all.motion, i)) break;
    if (speedOf(all, sample) == 0) continue;
    const double kinetic = all.energy(i) - all.mass * kGravity * sample.position.z();
    worst.see(kinetic, sample.time);
    break;
  }
  return worst.check("rest speed", "J", all.mass * kGravity * all.depth);
}

}  // namespace

void checkRest(const Evidence& all, Checks& checks) {
  if (!std::isfinite(all.restTime)) return;
  checks.push_back(pose(all));
  checks.push_back(freezing(all));
  Worst support;
  const MotionSample& last = all.motion.trajectory.back();
  support.see(distanceOutside(supportPoints(all, last)), last.time,
              "the centre of mass is not above the vertices that touch");
  checks.push_back(support.check("rest support", "m outside", all.depth));
}

}  // namespace ifa::audit_detail
