// SPDX-License-Identifier: Apache-2.0
// Which restitution a rhythm sounds like, learnt from drops of the body (docs/fitting.md).
#pragma once

#include <array>

#include "base/progress.h"
#include "body/body.h"
#include "ifa/contact_signature.h"
#include "planner/rhythm_features.h"
#include "sampler/event_recorder.h"

namespace ifa {

/// Linear regression of the restitution of a drop on the rhythm that is heard of it. Immutable;
/// thread safe.
class RestitutionOutlook {
 public:
  static constexpr int kFeatures = kRhythmFeatures;

  /// All that is learnt.
  struct Coefficients {
    std::array<double, kFeatures> weights{};
    double spread = 1;
  };

  RestitutionOutlook() = default;
  explicit RestitutionOutlook(const Coefficients& known);
  [[nodiscard]] Coefficients coefficients() const;

  /// Simulates `drops` drops, each with a restitution of its own about the surface's, and hears
  /// them with wrong amplitudes, as people do. Reports as "learn"; when asked to stop, what comes
  /// back is of no use.
  [[nodiscard]] static RestitutionOutlook learn(const Body& body, const SurfaceProperties& surface,
                                                const RecorderSettings& recorder, int drops,
                                                const Progress& progress = {});

  /// The restitution that `signature` sounds like, not clamped to any range.
  /// @param signature  of at least two events: one tells nothing
  [[nodiscard]] double estimate(const ContactSignature& signature) const;

  /// Standard deviation of what the regression misses.
  [[nodiscard]] double spread() const { return spread_; }

 private:
  RhythmFeatures weights_ = RhythmFeatures::Zero();
  double spread_ = 1;
};

}  // namespace ifa
