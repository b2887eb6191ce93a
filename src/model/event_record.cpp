// SPDX-License-Identifier: Apache-2.0
// Not inline: where GCC 12 sees both it joins them, and forgets to round the last number.
#include "model/event_record.h"

#include <cmath>

namespace ifa {

PackedState pack(const RigidState& state) {
  const auto rounded = [](const Eigen::Vector3d& v) {
    return std::array{static_cast<float>(v.x()), static_cast<float>(v.y()),
                      static_cast<float>(v.z())};
  };
  const Eigen::Quaterniond& q = state.orientation;
  return {static_cast<float>(state.position.z()),
          {static_cast<float>(q.w()), static_cast<float>(q.x()), static_cast<float>(q.y()),
           static_cast<float>(q.z())},
          rounded(state.velocity),
          rounded(state.angularVelocity)};
}

RigidState unpack(const PackedState& packed) {
  const auto exact = [](const std::array<float, 3>& v) {
    return Eigen::Vector3d(v[0], v[1], v[2]);
  };
  const double w = packed.orientation[0], x = packed.orientation[1], y = packed.orientation[2],
               z = packed.orientation[3];
  const double length = std::sqrt((w * w + x * x) + (y * y + z * z));
  RigidState state;
  state.position.z() = packed.height;
  if (length > 0) state.orientation = {w / length, x / length, y / length, z / length};
  state.velocity = exact(packed.velocity);
  state.angularVelocity = exact(packed.angularVelocity);
  return state;
}

}  // namespace ifa
