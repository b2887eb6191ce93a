// SPDX-License-Identifier: Apache-2.0
// The part of a picture that something covers.
#pragma once

#include <algorithm>
#include <limits>

#include "render/camera.h"
#include "render/floor_light.h"

namespace ifa::render {

/// A rectangle of pixels; `right` and `bottom` are one past the last. Empty at first.
struct PixelBox {
  int left = std::numeric_limits<int>::max(), top = std::numeric_limits<int>::max();
  int right = 0, bottom = 0;

  void include(float x, float y, float reach, const Camera& camera) {
    left = std::min(left, std::clamp(static_cast<int>(x - reach), 0, camera.width));
    top = std::min(top, std::clamp(static_cast<int>(y - reach), 0, camera.height));
    right = std::max(right, std::clamp(static_cast<int>(x + reach) + 1, 0, camera.width));
    bottom = std::max(bottom, std::clamp(static_cast<int>(y + reach) + 1, 0, camera.height));
  }
  void includeBall(const Vector& centre, float radius, const Camera& camera) {
    const Vector seen = camera.project(centre);
    // The outline of a ball off the axis is an ellipse; a tenth covers it at these angles.
    include(seen.x(), seen.y(),
            1.1f * radius / camera.pixelAt(std::max(seen.z() - radius, 1e-4f)) + 1, camera);
  }
  template <class T>
  void includeGrid(const FloorGrid<T>& grid, const Camera& camera) {
    if (grid.values.empty()) return;
    for (int corner = 0; corner < 4; ++corner) {
      const int column = corner % 2 * grid.columns, row = corner / 2 * grid.rows;
      const Vector place(grid.left + static_cast<float>(column) * grid.step,
                         grid.low + static_cast<float>(row) * grid.step, 0);
      const Vector seen = camera.project(place);
      include(seen.x(), seen.y(), 1, camera);
    }
  }
  void include(const PixelBox& other) {
    left = std::min(left, other.left), top = std::min(top, other.top);
    right = std::max(right, other.right), bottom = std::max(bottom, other.bottom);
  }
  [[nodiscard]] bool holds(int x, int y) const {
    return x >= left && x < right && y >= top && y < bottom;
  }
};

}  // namespace ifa::render
