// SPDX-License-Identifier: Apache-2.0
// What a symmetry group is called.
#pragma once

#include <cstddef>
#include <string>

namespace ifa {

class SymmetryGroup;

/// Order of the axis of the highest order; 1 where there is none.
[[nodiscard]] std::size_t highestAxis(const SymmetryGroup& group);

/// Schoenflies' symbol.
[[nodiscard]] std::string schoenflies(const SymmetryGroup& group);

}  // namespace ifa
