// SPDX-License-Identifier: Apache-2.0
// One pass of guided shooting: beam search over live simulation (docs/planner.md).
#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "affinity/factors.h"
#include "base/random.h"
#include "planner/aimed_events.h"
#include "planner/energy_outlook.h"
#include "planner/event_simulation.h"
#include "planner/flight_timing.h"
#include "planner/orientation_wishes.h"
#include "planner/planner.h"
#include "planner/position_wishes.h"
#include "planner/shooting_planner_settings.h"

namespace ifa {

/// Everything that is the same for all passes of one plan.
struct ShootingProblem {
  ShootingProblem(const PlanRequest& planned, const ShootingPlannerSettings& tuning);
  /// The same, planned by a request that differs in its settings alone.
  ShootingProblem(const ShootingProblem& other, const PlanRequest& planned);

  const PlanRequest& request;
  ShootingPlannerSettings settings;
  BodyModel model;
  RecorderSettings recorder;
  OrientationWishes wishes;
  PositionWishes places;
  EnergyOutlook outlook;
  std::vector<HeardEvent> targets;
  std::vector<EnergyOutlook::Features> features;  ///< of what follows each target but the last
  std::vector<Eigen::Matrix3d> group;             ///< symmetries of the body, principal frame
  std::vector<AimedEvents> aims;                  ///< for each target; empty without a database
  std::vector<std::uint32_t> starts;              ///< events of the database to begin with

 private:
  void aim();
};

/// A motion up to one contact.
struct ShootingNode {
  static constexpr double kNotSilent = 1e9;

  int parent = -1, parentLevel = -1, level = 0;
  unsigned root = 0;
  ContactEvent event;      ///< in its own time, from 0
  double start = 0;        ///< s after the first contact
  double moved = 0;        ///< s from the target's mark to the alternative that is met
  double restitution = 0;  ///< inside this event
  double retiming = 1;     ///< time of the way here, as shown, over that of its simulation
  Eigen::Vector3d velocityChange = Eigen::Vector3d::Zero();  ///< that leads here from the parent
  Eigen::Vector3d angularChange = Eigen::Vector3d::Zero();
  /// By how much the event's own velocities differ from those with which the body arrives.
  Eigen::Vector3d arrivalChange = Eigen::Vector3d::Zero(), arrivalAngular = Eigen::Vector3d::Zero();
  double bend = 0, arrivalBend = 0;
  Registered registered;  ///< with the contacts up to this one
  Arrival arrival = Arrival::kFlight;
  ContactSource source;
  HeardEvent heard;
  double firstAmplitude = 1;  ///< N s
  LogScore log;
  double ugly = 0;  ///< log units that its large bends cost beside their factors
  double rank = 0;
  double flightCost = 0;  ///< log units of the least change that flies to the next target
  /// How far the unchanged motion misses the next target after silent contact.
  double silentOff = kNotSilent;
  double energyBefore = 0, energyAfter = 0;  ///< J

  /// Log score as far as known, large bends counted twice.
  [[nodiscard]] double worth() const { return log.total() - ugly; }
};

/// Why children died, to tell the user which contact fails and why.
struct ShootingDeaths {
  long noTime = 0, noFlight = 0, bent = 0, energy = 0, earlier = 0, unheard = 0, restless = 0;
  void operator+=(const ShootingDeaths& other);
};

/// Counted work: the same whatever else the machine does.
struct ShootingWork {
  long pieces = 0;   ///< of motion that were simulated: flights, impacts, steps in contact
  long flights = 0;  ///< timed
  void operator+=(const ShootingWork& other);
  /// In pieces; a timed flight takes as many instructions as ten.
  [[nodiscard]] double cost() const;
};

class ShootingSearch {
 public:
  /// @param hard  for each target, whether earlier passes found no way on a little later
  ShootingSearch(const ShootingProblem& problem, std::uint64_t pass, double width,
                 std::vector<bool> hard = {});

  /// Where a search goes on from.
  struct Beginning {
    std::size_t level = 0;
    /// Motions that were kept there, `root` telling which of them are of one kind. Each kind has
    /// the same share of the work.
    std::vector<ShootingNode> beam;
    /// What costs most is tried on the best of each kind, not on the best of all.
    bool inTurns = false;
  };
  /// Goes on from what `other` kept.
  /// @param problem  that of `other`, or the same with other settings
  ShootingSearch(const ShootingProblem& problem, const ShootingSearch& other, std::uint64_t pass,
                 double width, Beginning beginning);

  /// Searches; `stop` is asked between batches and ends the search early.
  void run(const std::function<bool()>& stop, const std::function<void(double)>& progress);

  /// Complete motions, best first (at most a few dozen).
  [[nodiscard]] const std::vector<ShootingNode>& complete() const { return complete_; }
  [[nodiscard]] std::size_t levels() const { return levels_.size(); }
  /// What was kept of a level.
  [[nodiscard]] const std::vector<ShootingNode>& kept(std::size_t level) const {
    return levels_[level];
  }
  /// As pathOf() a plan.
  [[nodiscard]] std::vector<Eigen::Vector2d> pathTo(const ShootingNode& node) const;
  /// The best of the motions that got farthest; nothing when not even a first contact was found.
  [[nodiscard]] const ShootingNode* farthest() const;
  /// From the first contact to `node`.
  [[nodiscard]] std::vector<ShootingNode> path(const ShootingNode& node) const;
  [[nodiscard]] const ShootingWork& work() const { return work_; }
  /// What was spent from a level on.
  [[nodiscard]] double costFrom(std::size_t level) const {
    return work_.cost() - costBefore_[level];
  }
  [[nodiscard]] const ShootingDeaths& deathsAfter(int level) const {
    return deaths_[static_cast<std::size_t>(level)];
  }

 private:
  void plantRoots(const std::function<bool()>& stop);
  void expandLevel(std::size_t level, const std::function<bool()>& stop);
  [[nodiscard]] double widthAt(std::size_t level) const;
  /// @param wider  how many times the beam of this width
  void keepBest(std::vector<ShootingNode>& candidates, double width, double wider) const;
  [[nodiscard]] static std::vector<ShootingNode> inTurns(const std::vector<ShootingNode>& nodes);
  void followOn(std::vector<ShootingNode>& nodes, std::size_t level);

  const ShootingProblem& problem_;
  std::uint64_t pass_;
  double width_;
  std::vector<bool> hard_;
  std::size_t begin_ = 0;  ///< level that is begun with
  bool inTurns_ = false;
  std::size_t firstHard_;                          ///< 0 when none is
  std::vector<std::vector<ShootingNode>> levels_;  ///< kept, by target
  std::vector<ShootingDeaths> deaths_;             ///< on the way out of each level
  std::vector<ShootingNode> complete_;
  ShootingWork work_;
  std::vector<double> costBefore_;  ///< each level
};

}  // namespace ifa
