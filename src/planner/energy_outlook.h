// SPDX-License-Identifier: Apache-2.0
// What energy a body needs after a contact for the contacts still to come, learnt from drops of
// that body.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "base/progress.h"
#include "body/body.h"
#include "dynamics/body_model.h"
#include "ifa/contact_signature.h"
#include "sampler/event_recorder.h"

namespace ifa {

/// Linear regression of log(energy after a contact - energy at rest) on the rhythm that follows
/// (docs/planner.md). Immutable; thread safe.
class EnergyOutlook {
 public:
  static constexpr int kFeatures = 6;
  using Features = Eigen::Matrix<double, kFeatures, 1>;

  /// All that is learnt.
  struct Coefficients {
    std::array<double, kFeatures> weights{};
    double spread = 1, restEnergy = 0;
  };

  EnergyOutlook() = default;
  explicit EnergyOutlook(const Coefficients& known);
  [[nodiscard]] Coefficients coefficients() const;

  /// Simulates `drops` drops from the body's own sampling. Reports as "learn"; when asked to stop,
  /// what comes back is of no use.
  [[nodiscard]] static EnergyOutlook learn(const Body& body, const BodyModel& model,
                                           const RecorderSettings& recorder, int drops,
                                           const Progress& progress = {});

  /// Features of the events after number `k` of a rhythm (starts in s, impulses in N s), k not the
  /// last.
  [[nodiscard]] static Features features(const std::vector<double>& starts,
                                         const std::vector<double>& impulses, std::size_t k);

  /// How many standard deviations `energy` (J, above the ground plane) lies off what those features
  /// ask for.
  [[nodiscard]] double deviation(double energy, const Features& features) const;
  /// Typical energy at rest, J.
  [[nodiscard]] double restEnergy() const { return restEnergy_; }

 private:
  Features weights_ = Features::Zero();
  double spread_ = 1;
  double restEnergy_ = 0;
};

}  // namespace ifa
