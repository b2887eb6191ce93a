// SPDX-License-Identifier: Apache-2.0
#include "planner/plan_difference.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

namespace ifa {

namespace {

using Eigen::Vector2d;
using Points = std::vector<Vector2d>;

constexpr double kShare = 0.1;  ///< of the path's length

Points pathOf(const Plan& plan) {
  Points points;
  for (const PlannedContact& contact : plan.contacts) {
    points.push_back(contact.placement.apply(contact.event.before).position.head<2>());
  }
  if (!plan.contacts.empty()) {
    const PlannedContact& last = plan.contacts.back();
    points.push_back(last.placement.apply(last.event.after).position.head<2>());
  }
  return points;
}

double lengthOf(const Points& points) {
  double length = 0;
  for (std::size_t i = 1; i < points.size(); ++i) length += (points[i] - points[i - 1]).norm();
  return length;
}

Points centred(Points points) {
  Vector2d mean = Vector2d::Zero();
  for (const Vector2d& p : points) mean += p;
  mean /= static_cast<double>(points.size());
  for (Vector2d& p : points) p -= mean;
  return points;
}

/// Largest distance between two centred paths once `b` is turned onto `a` by least squares.
double farthestApart(const Points& a, const Points& b) {
  double along = 0, across = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    along += a[i].dot(b[i]);
    across += b[i].x() * a[i].y() - b[i].y() * a[i].x();
  }
  const double size = std::hypot(along, across);
  const double c = size > 0 ? along / size : 1, s = size > 0 ? across / size : 0;
  double apart = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Vector2d turned(c * b[i].x() - s * b[i].y(), s * b[i].x() + c * b[i].y());
    apart = std::max(apart, (a[i] - turned).norm());
  }
  return apart;
}

}  // namespace

bool differentPaths(const Plan& a, const Plan& b) {
  if (a.contacts.size() != b.contacts.size()) return true;
  const Points pa = pathOf(a), pb = pathOf(b);
  if (pa.empty()) return false;
  const Points ca = centred(pa), cb = centred(pb);
  Points mirrored = cb;
  for (Vector2d& p : mirrored) p.y() = -p.y();
  const double apart = std::min(farthestApart(ca, cb), farthestApart(ca, mirrored));
  return apart > kShare * std::max(lengthOf(pa), lengthOf(pb));
}

}  // namespace ifa
