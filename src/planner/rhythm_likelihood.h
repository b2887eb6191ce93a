// SPDX-License-Identifier: Apache-2.0
// How likely a body is to make a rhythm, learnt from drops of the body (docs/choosing.md).
#pragma once

#include <Eigen/Core>
#include <array>

#include "planner/rhythm_features.h"

namespace ifa {

/// Density of what is heard of a body's drops, as a multivariate t distribution with their mean
/// and covariance. Immutable; thread safe.
class RhythmLikelihood {
 public:
  static constexpr int kFeatures = kRhythmFeatures - 1;  ///< without the constant one
  static constexpr int kEntries = kFeatures * kFeatures;
  using Features = Eigen::Matrix<double, kFeatures, 1>;
  using Whitening = Eigen::Matrix<double, kFeatures, kFeatures>;

  /// All that is learnt.
  struct Coefficients {
    std::array<double, kFeatures> mean{};
    std::array<double, kEntries> whitening{};  ///< lower triangle W with W cov W' = 1; columns
    double heard = 0;  ///< share of drops of which two contacts or more are heard
  };

  explicit RhythmLikelihood(const Coefficients& known);
  [[nodiscard]] Coefficients coefficients() const;

  /// From drops whose restitution differs by up to a quarter from the surface's.
  [[nodiscard]] static RhythmLikelihood learn(const Body& body, const SurfaceProperties& surface,
                                              const RecorderSettings& recorder, int drops,
                                              const Progress& progress = {});

  /// Logarithm of the density, comparable between bodies; -infinity for a body that is never heard
  /// twice.
  /// @param signature  of at least two events: one tells nothing
  [[nodiscard]] double log(const ContactSignature& signature) const;

 private:
  RhythmLikelihood() = default;

  Features mean_ = Features::Zero();
  Whitening whitening_ = Whitening::Identity();
  double heard_ = 0;
};

}  // namespace ifa
