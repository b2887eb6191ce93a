// SPDX-License-Identifier: Apache-2.0
// Welding of vertices, by a grid of cells much larger than the tolerance.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>

#include "body/mesh_import.h"

namespace ifa {

using Eigen::Vector3d;

namespace {

using Cell = std::array<std::int64_t, 3>;

struct CellHash {
  std::size_t operator()(const Cell& cell) const {
    std::uint64_t hash = 0x9e3779b97f4a7c15u;
    for (const std::int64_t c : cell) {
      hash = (hash ^ static_cast<std::uint64_t>(c)) * 0xbf58476d1ce4e5b9u;
      hash ^= hash >> 31;
    }
    return static_cast<std::size_t>(hash);
  }
};

/// Vertices kept so far, found by place.
class VertexGrid {
 public:
  VertexGrid(double tolerance, std::vector<Vector3d>& kept)
      : tolerance_(tolerance), cell_(16 * tolerance), kept_(kept) {}

  /// Index of the kept vertex that `p` joins; keeps it when there is none.
  int indexOf(const Vector3d& p) {
    const Cell low = cellOf(p, -tolerance_), high = cellOf(p, tolerance_);
    Cell cell = low;
    for (cell[0] = low[0]; cell[0] <= high[0]; ++cell[0]) {
      for (cell[1] = low[1]; cell[1] <= high[1]; ++cell[1]) {
        for (cell[2] = low[2]; cell[2] <= high[2]; ++cell[2]) {
          if (const int found = search(cell, p); found >= 0) return found;
        }
      }
    }
    const auto index = static_cast<int>(kept_.size());
    kept_.push_back(p);
    const auto [place, fresh] = heads_.try_emplace(cellOf(p, 0), index);
    next_.push_back(fresh ? -1 : place->second);
    place->second = index;
    return index;
  }

 private:
  [[nodiscard]] Cell cellOf(const Vector3d& p, double shift) const {
    Cell cell = {};
    for (std::size_t i = 0; i < 3; ++i) {
      const double coordinate = p[static_cast<Eigen::Index>(i)] + shift;
      // What is too far away to count its cells shares the last one.
      constexpr double kLast = 4e18;
      cell[i] =
          static_cast<std::int64_t>(std::clamp(std::floor(coordinate / cell_), -kLast, kLast));
    }
    return cell;
  }

  [[nodiscard]] int search(const Cell& cell, const Vector3d& p) const {
    const auto head = heads_.find(cell);
    if (head == heads_.end()) return -1;
    for (int i = head->second; i >= 0; i = next_[static_cast<std::size_t>(i)]) {
      if ((kept_[static_cast<std::size_t>(i)] - p).norm() <= tolerance_) return i;
    }
    return -1;
  }

  double tolerance_, cell_;
  std::vector<Vector3d>& kept_;
  std::unordered_map<Cell, int, CellHash> heads_;  ///< newest vertex of each cell
  std::vector<int> next_;                          ///< older one of the same cell, or -1
};

}  // namespace

Mesh weldVertices(const Mesh& mesh, double tolerance) {
  Mesh welded;
  welded.materials = mesh.materials;
  if (mesh.vertices.empty()) return welded;
  // Cells are counted from the first vertex, so that their numbers fit however far the mesh lies
  // from its file's origin.
  const Vector3d origin = mesh.vertices.front();
  VertexGrid grid(tolerance > 0 ? tolerance : 1e-12, welded.vertices);
  std::vector<int> newIndex(mesh.vertices.size(), -1);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    std::array<int, 3> triangle = {};
    for (std::size_t k = 0; k < 3; ++k) {
      const auto old = static_cast<std::size_t>(mesh.triangles[t][k]);
      if (newIndex[old] < 0) newIndex[old] = grid.indexOf(mesh.vertices[old] - origin);
      triangle[k] = newIndex[old];
    }
    if (triangle[0] == triangle[1] || triangle[1] == triangle[2] || triangle[2] == triangle[0]) {
      continue;
    }
    welded.triangles.push_back(triangle);
    if (!mesh.triangleMaterial.empty()) {
      welded.triangleMaterial.push_back(mesh.triangleMaterial[t]);
    }
  }
  for (Vector3d& vertex : welded.vertices) vertex += origin;
  return welded;
}

}  // namespace ifa
