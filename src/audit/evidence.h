// SPDX-License-Identifier: Apache-2.0
// What the audit reads out of a motion's samples before it judges: steps, impulses, heights.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "audit/audit.h"

namespace ifa::audit_detail {

/// Standard gravity, m/s^2, along -z (the audit's own copy).
inline constexpr double kGravity = 9.80665;
/// Times that differ by less are the same, s.
inline constexpr double kSameTime = 1e-9;
/// Width of the bins in which impulses are heard (method, 2), s.
inline constexpr double kBin = 1e-3;

/// What a step between two samples has to be.
enum class StepKind {
  kFlight,  ///< free flight
  kEvent,   ///< inside a listed contact event
  kSilent,  ///< inside a marked interval of silent contact
  kAfter,   ///< after a last event that is not terminal: bounces on, flying or touching
  kRest     ///< after the body has settled
};

/// A change of velocity, m/s and rad/s, world frame.
struct Change {
  Eigen::Vector3d linear = Eigen::Vector3d::Zero(), angular = Eigen::Vector3d::Zero();
};

/// From sample `from` to the next.
struct Step {
  std::size_t from = 0;
  StepKind kind = StepKind::kFlight;
  std::size_t contact = 0;  ///< of an event: which; otherwise the next one (may be past the last)
  double duration = 0;      ///< s
  double simulated = 0;     ///< the same with retiming undone, s
  /// Change of linear momentum beyond gravity's, velocities as simulated (retiming undone), N s.
  Eigen::Vector3d impulse = Eigen::Vector3d::Zero();
};

/// Motion and body with what follows from them. Holds references.
struct Evidence {
  const Motion& motion;
  const Body& body;
  const AuditSettings& settings;
  double depth = 0;            ///< h: what counts as touching, m
  double mass = 0;             ///< kg
  double threshold = 0;        ///< of an event, N s of excess impulse in a bin
  double restTime = 0;         ///< from here on the body rests; infinite when it never does
  std::vector<double> lowest;  ///< height of the lowest vertex at each sample, m
  std::vector<Step> steps;     ///< one less than samples
  /// Of each contact: the sample from which on the body has the velocity with which it leaves.
  std::vector<std::size_t> departures;
  std::vector<double> pace;  ///< of each sample: times its velocities are what was simulated

  [[nodiscard]] const MotionSample& sample(std::size_t index) const {
    return motion.trajectory[index];
  }
  [[nodiscard]] const MotionContact& contact(std::size_t index) const {
    return motion.contacts[index];
  }
  /// Retiming of the edge that arrives at contact `index`; 1 past the last.
  [[nodiscard]] double retiming(std::size_t index) const {
    return index < motion.contacts.size() ? motion.contacts[index].retiming : 1;
  }
  /// Impulse above the share that quietly carries the weight, or all of it by the paper's cut
  /// (method, 2), N s; >= 0.
  [[nodiscard]] double excess(const Eigen::Vector3d& impulse, double duration) const;
  /// Mechanical energy at a sample with the velocities that were simulated, J.
  [[nodiscard]] double energy(std::size_t index) const;
  /// The changes of velocity that impulses (N s, N m s) make of a body in the orientation `q`.
  [[nodiscard]] Change changeBy(const Eigen::Vector3d& impulse, const Eigen::Vector3d& angular,
                                const Eigen::Quaterniond& q) const;
};

/// Whether a sample is the last of those that share its time.
[[nodiscard]] bool isLastAt(const Motion& motion, std::size_t index);

/// Needs finite samples in order of time.
[[nodiscard]] Evidence gatherEvidence(const Motion& motion, const Body& body,
                                      const AuditSettings& settings);

/// Keeps the worst value of a check and where it lies; a value that is no number is worst of all.
class Worst {
 public:
  void see(double value, double time, std::string detail = {});
  [[nodiscard]] AuditCheck check(std::string name, std::string unit, double limit) const;

 private:
  double value_ = 0, time_ = 0;
  std::string detail_;
};

}  // namespace ifa::audit_detail
