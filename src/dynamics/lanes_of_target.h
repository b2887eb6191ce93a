// SPDX-License-Identifier: Apache-2.0
// The kernel's templates over Highway's lanes, for the instruction set that HWY_TARGET names. A
// file that is compiled once for each of them (foreach_target.h) includes this each time: no guard.
//
// Code for an instruction set must be compiled for it, and none of it may be taken for code of
// another. So everything over lanes is included anew, in a namespace of the instruction set; what
// is not over lanes (models, lists of vertices) was included before and stays what it is.
#include <hwy/highway.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <type_traits>
#include <utility>
#include <vector>

#include "body/simple_hull.h"
#include "dynamics/body_model.h"
#include "dynamics/ground_watch.h"
#include "dynamics/support.h"

#undef IFA_DYNAMICS_LANE_H
#undef IFA_DYNAMICS_LANE_TRIGONOMETRY_H
#undef IFA_DYNAMICS_LANE_STATE_H
#undef IFA_DYNAMICS_LANE_ENERGY_H
#undef IFA_DYNAMICS_FREE_ROTATION_H
#undef IFA_DYNAMICS_FLIGHT_PATH_H
#undef IFA_DYNAMICS_HEIGHT_CUBIC_H
#undef IFA_DYNAMICS_CHOSEN_VERTICES_H
#undef IFA_DYNAMICS_CONTACT_SOLVER_H
#undef IFA_DYNAMICS_IMPACT_LAW_H
#undef IFA_DYNAMICS_MIDPOINT_STEP_H
#undef IFA_DYNAMICS_SIMULATION_H
#undef IFA_DYNAMICS_CONTACT_PHASE_H
#undef IFA_DYNAMICS_TOUCH_SEARCH_H
#undef IFA_DYNAMICS_FLIGHT_H
#undef IFA_DYNAMICS_GROUND_COVER_H
#undef IFA_DYNAMICS_GROUND_LANES_H
#undef IFA_DYNAMICS_WIDE_LANE_H

HWY_BEFORE_NAMESPACE();
namespace ifa {
namespace HWY_NAMESPACE {
// What needs a lane type comes after it.
// clang-format off
#include "dynamics/lane.h"
#include "dynamics/wide_lane.h"
#include "dynamics/lane_state.h"
#include "dynamics/contact_phase.h"
#include "dynamics/flight.h"
#include "dynamics/ground_cover.h"
#include "dynamics/ground_lanes.h"
// clang-format on
}  // namespace HWY_NAMESPACE
}  // namespace ifa
HWY_AFTER_NAMESPACE();
