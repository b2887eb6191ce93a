// SPDX-License-Identifier: Apache-2.0
#include "planner/restitution_outlook.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <vector>

namespace ifa {

namespace {

/// Restitutions of the drops go beyond those that are looked for: a regression pulls towards the
/// middle of what it was taught.
constexpr double kWidest = 0.55;
constexpr double kRidge = 1e-3;

}  // namespace

RestitutionOutlook::RestitutionOutlook(const Coefficients& known)
    : weights_(known.weights.data()), spread_(known.spread) {}

RestitutionOutlook::Coefficients RestitutionOutlook::coefficients() const {
  Coefficients known{{}, spread_};
  std::copy(weights_.begin(), weights_.end(), known.weights.begin());
  return known;
}

RestitutionOutlook RestitutionOutlook::learn(const Body& body, const SurfaceProperties& surface,
                                             const RecorderSettings& recorder, int drops,
                                             const Progress& progress) {
  const RestitutionSpan span = {kWidest * surface.restitution,
                                std::min(kMostRestitution, surface.restitution / kWidest)};
  const std::vector<RhythmSample> samples =
      rhythmsOfDrops(body, surface, recorder, span, drops, progress);
  using Normal = Eigen::Matrix<double, kFeatures, kFeatures>;
  Normal normal = kRidge * Normal::Identity();
  RhythmFeatures right = RhythmFeatures::Zero();
  for (const RhythmSample& s : samples) {
    normal += s.features * s.features.transpose();
    right += s.features * s.restitution;
  }
  RestitutionOutlook outlook;
  outlook.weights_ = normal.ldlt().solve(right);
  double squares = 0;
  for (const RhythmSample& s : samples) {
    const double miss = s.restitution - outlook.weights_.dot(s.features);
    squares += miss * miss;
  }
  outlook.spread_ = std::sqrt(squares / std::max<double>(1, static_cast<double>(samples.size())));
  return outlook;
}

double RestitutionOutlook::estimate(const ContactSignature& signature) const {
  return weights_.dot(rhythmFeatures(signature));
}

}  // namespace ifa
