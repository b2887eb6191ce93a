// SPDX-License-Identifier: Apache-2.0
// What a mesh is like, and what is wrong with it, in words for its owner.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "body/body.h"

namespace ifa {

/// Most triangles that a mesh may have.
inline constexpr std::size_t kMaxTriangles = 2'000'000;

enum class ProblemSeverity {
  kNote,      ///< worth knowing
  kNotSolid,  ///< usable as a thin shell only
  kUnusable,  ///< no body can be made of it
};

/// One thing that is wrong, and what to do about it.
struct MeshProblem {
  ProblemSeverity severity = ProblemSeverity::kNote;
  std::string message, remedy;
};

/// Measures of a mesh and its problems, the worst first.
struct MeshReport {
  std::size_t vertices = 0, triangles = 0;
  std::size_t openEdges = 0;            ///< edges of an odd number of triangles
  std::size_t inconsistentEdges = 0;    ///< edges whose triangles do not run opposite ways
  std::size_t degenerateTriangles = 0;  ///< area under 1e-12 of the size squared
  double area = 0;                      ///< m^2
  double volume = 0;                    ///< m^3, negative when inside out; meaningless when open
  Eigen::Vector3d extent = Eigen::Vector3d::Zero();  ///< sides of the bounding box, m
  std::vector<MeshProblem> problems;

  /// Whether a solid body can be made of it (an inside-out mesh can be turned).
  [[nodiscard]] bool solid() const;
  /// Whether any body can be made of it.
  [[nodiscard]] bool usable() const;
};

/// Inspects a mesh whose vertices are welded.
[[nodiscard]] MeshReport inspectMesh(const Mesh& mesh);

}  // namespace ifa
