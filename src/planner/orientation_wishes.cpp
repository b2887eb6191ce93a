// SPDX-License-Identifier: Apache-2.0
#include "planner/orientation_wishes.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "affinity/factors.h"

namespace ifa {

namespace {

constexpr double kLeastMet = 0.5;  ///< f_o at 4 degrees

double angleBetween(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

/// Angle that is left between two directions after the best turn about the vertical.
double tiltBetween(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::abs(std::atan2(a.head<2>().norm(), a.z()) - std::atan2(b.head<2>().norm(), b.z()));
}

}  // namespace

OrientationWishes::OrientationWishes(const PlanRequest& request) : request_(request) {
  for (const Eigen::Matrix3d& element : request.symmetry) {
    if (element.determinant() > 0) turns_.push_back(element);
  }
  if (turns_.empty()) turns_.push_back(Eigen::Matrix3d::Identity());
}

bool OrientationWishes::judgedAtRest(const PlannedOrientation& wish) const {
  return request_.signature.terminal && wish.target + 1 == request_.signature.events.size();
}

double OrientationWishes::logOf(const PlannedOrientation& wish,
                                const Eigen::Quaterniond& orientation) const {
  double least = std::numeric_limits<double>::infinity();
  for (const Eigen::Matrix3d& turn : turns_) {
    least = std::min(least, tiltBetween(orientation * (turn * wish.body), wish.world));
  }
  return logOrientationWish(least);
}

double OrientationWishes::log(std::size_t level, const ContactEvent& event) const {
  double sum = 0;
  for (const PlannedOrientation& wish : request_.orientations) {
    if (wish.target != level) continue;
    const RigidState& seen = judgedAtRest(wish) ? event.after : event.before;
    sum += logOf(wish, seen.orientation);
  }
  return sum;
}

double OrientationWishes::logAtStart(std::size_t level,
                                     const Eigen::Quaterniond& orientation) const {
  double sum = 0;
  for (const PlannedOrientation& wish : request_.orientations) {
    if (wish.target == level && !judgedAtRest(wish)) sum += logOf(wish, orientation);
  }
  return sum;
}

bool OrientationWishes::any(std::size_t level) const {
  return std::any_of(request_.orientations.begin(), request_.orientations.end(),
                     [&](const PlannedOrientation& wish) { return wish.target == level; });
}

bool OrientationWishes::met(std::size_t level, const ContactEvent& event) const {
  return log(level, event) >= std::log(kLeastMet);
}

bool OrientationWishes::met(const Plan& settled) {
  return std::all_of(settled.contacts.begin(), settled.contacts.end(),
                     [](const PlannedContact& contact) { return contact.factors.o >= kLeastMet; });
}

void OrientationWishes::settle(Plan& plan) const {
  struct Met {
    PlannedContact* contact;
    const PlannedOrientation* wish;
    Eigen::Quaterniond orientation;  ///< as the plan shows it
  };
  std::vector<Met> all;
  for (const PlannedOrientation& wish : request_.orientations) {
    for (PlannedContact& contact : plan.contacts) {
      if (static_cast<std::size_t>(contact.target) != wish.target) continue;
      const RigidState& seen = judgedAtRest(wish) ? contact.event.after : contact.event.before;
      all.push_back({&contact, &wish, contact.placement.apply(seen).orientation});
    }
  }
  if (all.empty()) return;
  double least = std::numeric_limits<double>::infinity();
  Placement best;
  for (const Eigen::Matrix3d& element : turns_) {
    // The turn about the vertical that brings the horizontal parts together, least squares.
    double along = 0, across = 0;
    for (const Met& met : all) {
      const Eigen::Vector3d shown = met.orientation * (element * met.wish->body);
      along += shown.head<2>().dot(met.wish->world.head<2>());
      across += shown.x() * met.wish->world.y() - shown.y() * met.wish->world.x();
    }
    const double turn = along == 0 && across == 0 ? 0 : std::atan2(across, along);
    Placement placement;
    placement.plane = {std::cos(turn / 2), std::sin(turn / 2), 0, 0};
    placement.image = SymmetryImage::of(element);
    double sum = 0;
    for (const Met& met : all) {
      const Eigen::Vector3d shown =
          placement.plane.turn() * (met.orientation * (element * met.wish->body));
      const double angle = angleBetween(shown, met.wish->world);
      sum += angle * angle;
    }
    // The identity comes first, and stays where another is no better than by rounding.
    if (sum < least - 1e-12) {
      least = sum;
      best = placement;
    }
  }
  for (PlannedContact& contact : plan.contacts) contact.placement = best.after(contact.placement);
  for (const Met& met : all) {
    const Eigen::Quaterniond orientation =
        best.plane.turn() * met.orientation * best.image.relabelling;
    const double angle = angleBetween(orientation * met.wish->body, met.wish->world);
    met.contact->factors.o *= std::exp(logOrientationWish(angle));
  }
}

}  // namespace ifa
