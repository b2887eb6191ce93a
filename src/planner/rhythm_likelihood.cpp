// SPDX-License-Identifier: Apache-2.0
#include "planner/rhythm_likelihood.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/portable_math.h"

namespace ifa {

namespace {

constexpr double kOff = 1.25;    ///< the right restitution over the given one, or inverse
constexpr double kRidge = 1e-3;  ///< of the covariance: features that never differ tell nothing
/// Degrees of freedom: rhythms far from the mean are not as unlikely as a normal distribution says.
constexpr double kFreedom = 10;

RhythmLikelihood::Features withoutConstant(const RhythmFeatures& features) {
  return features.tail<RhythmLikelihood::kFeatures>();
}

}  // namespace

RhythmLikelihood::RhythmLikelihood(const Coefficients& known)
    : mean_(known.mean.data()), whitening_(known.whitening.data()), heard_(known.heard) {}

RhythmLikelihood::Coefficients RhythmLikelihood::coefficients() const {
  Coefficients known;
  std::copy(mean_.begin(), mean_.end(), known.mean.begin());
  std::copy_n(whitening_.data(), kEntries, known.whitening.begin());
  known.heard = heard_;
  return known;
}

RhythmLikelihood RhythmLikelihood::learn(const Body& body, const SurfaceProperties& surface,
                                         const RecorderSettings& recorder, int drops,
                                         const Progress& progress) {
  const RestitutionSpan span = {surface.restitution / kOff,
                                std::min(kMostRestitution, surface.restitution * kOff)};
  const auto samples = rhythmsOfDrops(body, surface, recorder, span, drops, progress);
  RhythmLikelihood likelihood;
  if (samples.empty()) return likelihood;
  const auto count = static_cast<double>(samples.size());
  likelihood.heard_ = count / drops;
  for (const RhythmSample& sample : samples) {
    likelihood.mean_ += withoutConstant(sample.features) / count;
  }
  Whitening covariance = kRidge * Whitening::Identity();
  for (const RhythmSample& sample : samples) {
    const Features off = withoutConstant(sample.features) - likelihood.mean_;
    covariance += off * off.transpose() / count;
  }
  const Eigen::LLT<Whitening> factor(covariance);
  likelihood.whitening_ = factor.matrixL().solve(Whitening::Identity());
  return likelihood;
}

double RhythmLikelihood::log(const ContactSignature& signature) const {
  if (heard_ <= 0) return -std::numeric_limits<double>::infinity();
  const Features off = withoutConstant(rhythmFeatures(signature)) - mean_;
  const double distance = (whitening_ * off).squaredNorm();
  double density = portableLog(heard_);
  for (int k = 0; k < kFeatures; ++k) density += portableLog(whitening_(k, k));
  return density - 0.5 * (kFreedom + kFeatures) * portableLog(1 + distance / kFreedom);
}

}  // namespace ifa
