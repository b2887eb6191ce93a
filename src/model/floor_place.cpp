// SPDX-License-Identifier: Apache-2.0
#include "model/floor_place.h"

namespace ifa {

using Eigen::Vector3d;

Pose FloorPlace::apply(const Pose& pose) const {
  const Eigen::Quaterniond turned(Eigen::AngleAxisd(turn, Vector3d::UnitZ()));
  return {turned * pose.position + Vector3d(shift.x(), shift.y(), 0), turned * pose.orientation};
}

Motion FloorPlace::apply(Motion motion) const {
  const Eigen::Quaterniond turned(Eigen::AngleAxisd(turn, Vector3d::UnitZ()));
  const Vector3d moved(shift.x(), shift.y(), 0);
  for (MotionSample& sample : motion.trajectory) {
    sample.position = turned * sample.position + moved;
    sample.orientation = turned * sample.orientation;
    sample.velocity = turned * sample.velocity;
    sample.angularVelocity = turned * sample.angularVelocity;
  }
  for (MotionContact& contact : motion.contacts) {
    contact.position = turned * contact.position + moved;
    for (Vector3d* change : {&contact.impulseChange, &contact.angularChange,
                             &contact.arrivalImpulseChange, &contact.arrivalAngularChange}) {
      *change = turned * *change;
    }
  }
  for (MotionOrientation& wish : motion.orientations) wish.world = turned * wish.world;
  for (MotionPosition& wish : motion.positions) {
    const Vector3d place = turned * Vector3d(wish.place.x(), wish.place.y(), 0) + moved;
    wish.place = place.head<2>();
  }
  return motion;
}

}  // namespace ifa
