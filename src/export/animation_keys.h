// SPDX-License-Identifier: Apache-2.0
// Which instants of a motion become keys of an animation that players interpolate linearly.
#pragma once

#include <vector>

#include "body/body.h"
#include "ifa/motion.h"
#include "model/pose_track.h"

namespace ifa {

/// How an animation file shows a body and its motion.
struct AnimationSettings {
  double keyRate = 120;        ///< keys per second, Hz
  double maxError = 0.9e-4;    ///< m; more keys are set where a surface point would be further off
  double creaseDegrees = 30;   ///< edges sharper than this are drawn sharp
  bool floorAndLight = false;  ///< in GLB: the floor below the motion and a directional light
};

struct AnimationKey {
  float time = 0;  ///< s from the sound's first sample
  Pose pose;       ///< neighbours' quaternions have a dot product >= 0
};

/// Keys at multiples of 1/`rate` s and exactly at the start and end of each contact, and more where
/// straight lines between keys would leave the motion by more than `maxError` anywhere within
/// `radius` of the centre of mass. Times start at 0 and increase strictly as floats; what lies
/// before the sound's first sample is cut, and the first pose is held until the motion begins.
/// @param motion  with samples
[[nodiscard]] std::vector<AnimationKey> animationKeys(const Motion& motion, double rate,
                                                      double radius, double maxError);
/// The same for a body that shows `mesh`.
[[nodiscard]] std::vector<AnimationKey> animationKeys(const Motion& motion, const Mesh& mesh,
                                                      const AnimationSettings& settings);

}  // namespace ifa
