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

/// A flight seen from above, as things go, own frame.
struct LevelFlight {
  Eigen::Vector2d from = Eigen::Vector2d::Zero();  ///< m
  Eigen::Vector2d to = Eigen::Vector2d::Zero();    ///< m
  double duration = 0;                             ///< s
};

class PositionWishes {
 public:
  explicit PositionWishes(const PlanRequest& request) : request_(request) {}

  [[nodiscard]] bool any() const { return !request_.positions.empty(); }
  [[nodiscard]] bool any(std::size_t level) const { return wishFor(level) != nullptr; }
  /// Where contact `level` should begin, own frame; nothing where that does not matter. On the way
  /// to a wish of a later contact, as far along as a body comes that slows down evenly.
  [[nodiscard]] std::optional<Eigen::Vector2d> place(std::size_t level, const Registered& before,
                                                     const LevelFlight& flight) const;
  /// A contact at `position` (own frame) that meets target `level`: logarithm of f_p, and what is
  /// known of the registration then.
  [[nodiscard]] double meet(std::size_t level, const Eigen::Vector2d& position,
                            Registered& registered) const;
  /// Lays the plan where the wishes are, and sets f_p of its contacts.
  void settle(Plan& plan) const;
  /// Whether each is met to 2 cm.
  [[nodiscard]] static bool met(const Plan& settled);

 private:
  /// Of that contact.
  [[nodiscard]] const PlannedPosition* wishFor(std::size_t level) const;
  /// How much of the way that is left to the wish the flight to `level` should go.
  [[nodiscard]] double share(const PlannedPosition& wish, std::size_t level, double duration) const;

  const PlanRequest& request_;
};

}  // namespace ifa
