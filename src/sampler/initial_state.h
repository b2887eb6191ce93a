// SPDX-License-Identifier: Apache-2.0
// Random pre-contact states from which simulations start. IFA 5.1.
#pragma once

#include <cstdint>

#include "body/body.h"
#include "model/rigid_state.h"

namespace ifa {

/// State number `index` of the family `seed`: uniform random orientation, lowest hull vertex at
/// z = 0, centre of mass at x = y = 0; velocity downwards within the sampling cone, its direction
/// cosine-weighted about straight down and its magnitude uniform; spin in a uniform direction with
/// uniform magnitude. Uses arithmetic and square roots only, so that the bits are the same
/// everywhere. Thread safe.
[[nodiscard]] RigidState sampleInitialState(const Body& body, std::uint64_t seed,
                                            std::uint64_t index);

}  // namespace ifa
