// SPDX-License-Identifier: Apache-2.0
// A rhythm in numbers, and the rhythms that a body makes (docs/fitting.md, docs/choosing.md).
#pragma once

#include <Eigen/Core>
#include <vector>

#include "base/progress.h"
#include "body/body.h"
#include "ifa/contact_signature.h"
#include "sampler/event_recorder.h"

namespace ifa {

inline constexpr int kRhythmFeatures = 18;
/// The first is 1.
using RhythmFeatures = Eigen::Matrix<double, kRhythmFeatures, 1>;

/// How many contacts, how far apart, how regular, how loud: of at least two events.
[[nodiscard]] RhythmFeatures rhythmFeatures(const ContactSignature& signature);

struct RestitutionSpan {
  double least = 0, most = 0;
};

struct RhythmSample {
  RhythmFeatures features;
  double restitution = 0;  ///< of the drop that sounded so
};

/// Simulates `drops` drops, each with a restitution of its own from `span`, and hears them with
/// wrong amplitudes, as people do; those of which one contact at most is heard are left out.
/// Reports as "learn"; when asked to stop, what comes back is of no use. The same for any number of
/// threads.
[[nodiscard]] std::vector<RhythmSample> rhythmsOfDrops(const Body& body,
                                                       const SurfaceProperties& surface,
                                                       const RecorderSettings& recorder,
                                                       const RestitutionSpan& span, int drops,
                                                       const Progress& progress = {});

}  // namespace ifa
