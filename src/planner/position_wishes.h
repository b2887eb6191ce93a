// SPDX-License-Identifier: Apache-2.0
// Places in the plane that the user asks for at contacts (IFA section 6, docs/controls.md).
#pragma once

#include <Eigen/Core>
#include <optional>

#include "planner/planner.h"

namespace ifa {

/// How a motion's own frame lies in the plane of the wishes, as far as it is known: registered by
/// the first two places that are asked for, as printed.
struct Registered {
  int places = 0;                                   ///< of the wishes so far, at most 2
  Eigen::Vector2d first = Eigen::Vector2d::Zero();  ///< where the first is met, own frame, m
  PlanarTransform plane;                            ///< own frame to that of the wishes
};

class PositionWishes {
 public:
  explicit PositionWishes(const PlanRequest& request) : request_(request) {}

  [[nodiscard]] bool any() const { return !request_.positions.empty(); }
  [[nodiscard]] bool any(std::size_t level) const { return wishFor(level) != nullptr; }
  /// Where contact `level` should begin, own frame; nothing where that does not matter.
  /// @param unsteered  where it would begin as things go
  [[nodiscard]] std::optional<Eigen::Vector2d> place(std::size_t level, const Registered& before,
                                                     const Eigen::Vector2d& unsteered) const;
  /// A contact at `position` (own frame) that meets target `level`: logarithm of f_p, and what is
  /// known of the registration then.
  [[nodiscard]] double meet(std::size_t level, const Eigen::Vector2d& position,
                            Registered& registered) const;
  /// Lays the plan where the wishes are, and sets f_p of its contacts.
  void settle(Plan& plan) const;

 private:
  [[nodiscard]] const PlannedPosition* wishFor(std::size_t level) const;

  const PlanRequest& request_;
};

}  // namespace ifa
