// SPDX-License-Identifier: Apache-2.0
// More takes out of one motion: the same contacts, but the body flies farther, or elsewhere,
// between some of them (docs/planner.md).
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "planner/contact_beginning.h"
#include "planner/plan_difference.h"
#include "planner/shooting_search.h"

namespace ifa {

/// By how much each flight of a motion goes farther (the one after contact k first), world frame,
/// m; and what the motion is then worth (Plan::worth).
struct MovedLanding {
  std::vector<Eigen::Vector2d> farther;
  double worth = 0;
};

/// What can be had of one plan. A horizontal velocity that the contact before a flight adds and the
/// one after it takes away again moves all that follows, and changes nothing else: heights, spins,
/// times and every contact stay what they were. It costs what changes of velocity cost.
class MovedLandings {
 public:
  /// The problem must outlive it.
  MovedLandings(const ShootingProblem& problem, Plan plan);

  /// The cheapest ways to move some contact by more than makes a take different.
  [[nodiscard]] std::vector<MovedLanding> proposals() const;
  /// The plan so changed, not yet audited; nothing where a contact cannot do what that asks of it.
  [[nodiscard]] std::optional<Plan> moved(const MovedLanding& landing) const;

 private:
  /// Squared bend of a contact by the horizontal velocity that is added to its change.
  struct SquaredBend {
    SquaredBend() = default;
    SquaredBend(const PlannedContact& contact, const PlausibleRegion& region,
                const Eigen::Vector3d& linear, const Eigen::Vector3d& angular);
    [[nodiscard]] double at(const Eigen::Vector2d& added) const {
      return bend + 2 * slope.dot(added) + added.dot(curvature * added);
    }
    double bend = 0;
    Eigen::Vector2d slope = Eigen::Vector2d::Zero();
    Eigen::Matrix2d curvature = Eigen::Matrix2d::Zero();
  };
  struct Flight {
    bool free = false;
    double time = 0;
    Eigen::Vector2d velocity = Eigen::Vector2d::Zero();  ///< m/s
    SquaredBend leaving, reaching;
    double rebound = 0;  ///< squared bend of the contact's restitution, which counts with `leaving`
    /// Metres for a pull, and the same where the body must not get slower or faster.
    Eigen::Matrix2d ease = Eigen::Matrix2d::Zero(), sideways = Eigen::Matrix2d::Zero();
  };
  /// How much of a flight's ease may be used, and which.
  struct Freedom {
    double share = 1;
    bool sideways = false;
  };
  /// What a motion is worth, its largest bend among those that changed, and at which flight's ends.
  struct Bent {
    double worth = 0, most = 0;
    std::size_t flight = 0;
  };
  /// What a contact takes from the body, J.
  struct Loss {
    double simulated = 0;  ///< in the event alone
    double whole = 0;      ///< with the change that leads out of it
  };

  void addFlight(std::size_t k);
  [[nodiscard]] PlausibleRegion regionOf(const PlannedContact& contact) const;
  [[nodiscard]] std::vector<Eigen::Vector2d> pullsOn(std::size_t point,
                                                     const Eigen::Vector2d& way) const;
  void propose(const std::vector<Eigen::Vector2d>& pulls, double distance,
               std::vector<MovedLanding>& out) const;
  [[nodiscard]] std::vector<Eigen::Vector2d> cheapest(const std::vector<Eigen::Vector2d>& pulls,
                                                      const std::vector<Freedom>& freedoms,
                                                      double distance) const;
  [[nodiscard]] std::optional<std::size_t> overdrawn(
      const std::vector<Eigen::Vector2d>& farther) const;
  [[nodiscard]] Bent bendsOf(const std::vector<Eigen::Vector2d>& farther) const;
  [[nodiscard]] double costOf(double squaredBend) const;
  void apply(std::size_t k, const Eigen::Vector2d& farther, Plan& plan) const;
  [[nodiscard]] static RigidState arrivalOf(const PlannedContact& contact);
  [[nodiscard]] static RigidState departureOf(const PlannedContact& contact);
  [[nodiscard]] Loss lossOf(const PlannedContact& contact) const;
  [[nodiscard]] bool holds(const PlannedContact& contact) const;

  const ShootingProblem& problem_;
  Plan plan_;
  std::vector<Flight> flights_;
  std::vector<Loss> losses_;
  std::vector<Eigen::Vector2d> path_;  ///< centred
  double length_ = 0, spread_ = 0;     ///< of the path: m, m^2
};

}  // namespace ifa
