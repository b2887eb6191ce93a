// SPDX-License-Identifier: Apache-2.0
// Orientations that the user asks for at contacts (IFA section 6, docs/controls.md).
#pragma once

#include <Eigen/Core>
#include <vector>

#include "model/contact_event.h"
#include "planner/planner.h"

namespace ifa {

/// What the wishes of a request cost, whatever element of the body's rotation group and whatever
/// turn about the vertical suits each best: both are chosen when a plan is complete.
class OrientationWishes {
 public:
  explicit OrientationWishes(const PlanRequest& request);

  /// Logarithm of f_o of all wishes for target `level`, that `event` meets; 0 where there are none.
  [[nodiscard]] double log(std::size_t level, const ContactEvent& event) const;
  /// The same of an event that begins with the body turned so; 0 for a last event that comes to
  /// rest, which is judged where it does.
  [[nodiscard]] double logAtStart(std::size_t level, const Eigen::Quaterniond& orientation) const;

  /// Whether anything is asked for at target `level`, and whether `event` lies there as asked.
  [[nodiscard]] bool any(std::size_t level) const;
  [[nodiscard]] bool met(std::size_t level, const ContactEvent& event) const;

  /// Shows the whole plan as that image and turned so that the wishes are met best, and sets f_o of
  /// its contacts.
  void settle(Plan& plan) const;
  /// Whether each is met as well as half an f_o says: within 4 degrees.
  [[nodiscard]] static bool met(const Plan& settled);

 private:
  [[nodiscard]] bool judgedAtRest(const PlannedOrientation& wish) const;
  [[nodiscard]] double logOf(const PlannedOrientation& wish,
                             const Eigen::Quaterniond& orientation) const;

  const PlanRequest& request_;
  std::vector<Eigen::Matrix3d> turns_;  ///< the group's proper elements
};

}  // namespace ifa
