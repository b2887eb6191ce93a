// SPDX-License-Identifier: Apache-2.0
// What one thread does in a pass of guided shooting: makes the children of one partial motion.
#pragma once

#include <vector>

#include "connection/time_warp.h"
#include "planner/shooting_search.h"
#include "planner/silent_search.h"

namespace ifa {

/// A touch that comes within this of the time asked for is that touch, s.
inline constexpr double kTouchPrecision = 1e-7;

/// Not thread safe; make one per item of work.
class ShootingWorker {
 public:
  explicit ShootingWorker(const ShootingProblem& problem)
      : problem_(problem), simulation_(problem.model, problem.recorder) {}

  /// Motions of one contact, from sampled initial state number `root`.
  void plant(unsigned root, std::uint64_t seed);
  /// The same from a contact late in the drop that begins there.
  void plantLate(unsigned root, std::uint64_t seed);
  /// Motions of one contact, an event of the database.
  void plantEvent(unsigned root, std::uint32_t event);
  /// Motions from `node` to target `level` (later than the node's own).
  /// @param effort  scales the number of children
  /// @param bound  children whose log score cannot get above are not simulated
  void expand(const ShootingNode& node, int index, int level, double effort, RandomStream random,
              double bound);

  [[nodiscard]] ShootingWork work() const { return {simulation_.pieces(), flights_}; }

  std::vector<ShootingNode> children;
  ShootingDeaths deaths;

 private:
  struct Edge {
    Eigen::Vector3d velocityChange, angularChange;
    double bend = 0;
    Arrival arrival = Arrival::kFlight;
    TimeWarp time;
  };
  /// Velocities that a contact makes up for at once, so that it goes as it did in the database.
  struct Jump {
    ContactSource source;
    Eigen::Vector3d linear = Eigen::Vector3d::Zero(), angular = Eigen::Vector3d::Zero();
  };

  /// How a motion gets from its last contact to another one.
  struct Way {
    double flightCost = 0,
           silentOff = ShootingNode::kNotSilent;  ///< the node's for its next target
    double cost = 0;                              ///< log units
  };
  void expandTo(const ShootingNode& node, ShootingNode child, const Way& way, double effort,
                RandomStream& random, double bound);
  [[nodiscard]] Way wayTo(const ShootingNode& node, int level, double time) const;
  void shoot(const ShootingNode& node, ShootingNode child, const PlausibleRegion& region,
             const Coordinates& wish, const TimeWarp& time, double eager, double restitution,
             double bound);
  void shootSilently(const ShootingNode& node, const ShootingNode& child,
                     const PlausibleRegion& region, double duration, int probes,
                     RandomStream& random, double bound);
  void shootAhead(const ShootingNode& node, const ShootingNode& child,
                  const PlausibleRegion& region, double duration, RandomStream& random,
                  double bound);
  [[nodiscard]] bool stuckAfter(int level) const;
  void arrive(const ShootingNode& node, ShootingNode child, const Edge& edge,
              const RigidState& arrival, double restitution, double bound, const Jump& jump);
  void arrive(const ShootingNode& node, const ShootingNode& child, const Edge& edge,
              const RigidState& arrival, double restitution, double bound) {
    arrive(node, child, edge, arrival, restitution, bound, {});
  }
  void shootAimed(const ShootingNode& node, const ShootingNode& child,
                  const PlausibleRegion& region, double duration, double bound);
  [[nodiscard]] bool makesUpFor(const Jump& jump, const RigidState& arrival,
                                ShootingNode& ending) const;
  void judge(ShootingNode& child) const;
  [[nodiscard]] double lookAhead(ShootingNode& node) const;
  [[nodiscard]] std::optional<Eigen::Vector2d> steeredTo(const ShootingNode& node, int level,
                                                         const PlausibleRegion& region,
                                                         double duration, double eager) const;
  [[nodiscard]] double flightCost(const ShootingNode& node, int level, double duration) const;
  [[nodiscard]] const PlannerSettings& settings() const { return problem_.request.settings; }
  [[nodiscard]] double shortestPassage() const;
  [[nodiscard]] static double silentHorizon(double duration);
  [[nodiscard]] double slack(double duration) const;
  [[nodiscard]] SilentSearchSettings silentSettings(int probes, double duration) const;
  [[nodiscard]] double endingCost(const ShootingNode& node, const RigidState& arrival) const;
  [[nodiscard]] HeardEvent heardOf(const ContactEvent& event, double firstAmplitude) const;
  [[nodiscard]] double mergeGapOf(std::size_t level) const;
  [[nodiscard]] double droppedBetween(int from, int to) const;
  [[nodiscard]] bool closes(int level) const;
  [[nodiscard]] double variedRestitution(int level, int attempt, RandomStream& random) const;
  [[nodiscard]] PlausibleRegion regionOf(const ContactEvent& event) const;

  const ShootingProblem& problem_;
  mutable EventSimulation simulation_;
  mutable long flights_ = 0;
  std::vector<ContactEvent> outcomes_;
};

}  // namespace ifa
