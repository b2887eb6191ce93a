// SPDX-License-Identifier: Apache-2.0
// Meshes whose mass properties are known in closed form.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <vector>

#include "body/body.h"

namespace ifa::shapes {

using Eigen::Vector3d;

/// Box with sides `size` about `centre`, facing outwards.
inline Mesh box(const Vector3d& size, const Vector3d& centre = Vector3d::Zero()) {
  Mesh mesh;
  for (int i = 0; i < 8; ++i) {
    const Vector3d sign(i & 1 ? 0.5 : -0.5, i & 2 ? 0.5 : -0.5, i & 4 ? 0.5 : -0.5);
    mesh.vertices.push_back(centre + sign.cwiseProduct(size));
  }
  const int quads[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                           {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  for (const auto& q : quads) {
    mesh.triangles.push_back({q[0], q[1], q[2]});
    mesh.triangles.push_back({q[0], q[2], q[3]});
  }
  return mesh;
}

/// Tetrahedron of the origin and the three points on the axes at 1.
inline Mesh cornerTetrahedron() {
  Mesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  return mesh;
}

/// Sphere of `bands` by 2 `bands` facets, its vertices on the radius; 4 bands^2 - 4 bands
/// triangles.
inline Mesh sphere(double radius, int bands) {
  constexpr double kPi = 3.14159265358979323846;
  Mesh mesh;
  const int around = 2 * bands;
  for (int i = 1; i < bands; ++i) {
    for (int j = 0; j < around; ++j) {
      const double polar = kPi * i / bands, angle = kPi * j / bands;
      mesh.vertices.push_back(radius * Vector3d(std::sin(polar) * std::cos(angle),
                                                std::sin(polar) * std::sin(angle),
                                                std::cos(polar)));
    }
  }
  const int top = static_cast<int>(mesh.vertices.size()), bottom = top + 1;
  mesh.vertices.emplace_back(0, 0, radius);
  mesh.vertices.emplace_back(0, 0, -radius);
  for (int j = 0; j < around; ++j) {
    const int next = (j + 1) % around, last = (bands - 2) * around;
    mesh.triangles.push_back({top, j, next});
    mesh.triangles.push_back({bottom, last + next, last + j});
    for (int i = 0; i + 2 < bands; ++i) {
      const int a = i * around + j, b = i * around + next;
      mesh.triangles.push_back({a, a + around, b + around});
      mesh.triangles.push_back({a, b + around, b});
    }
  }
  return mesh;
}

/// Cube of side `side`, each face in `cells` by `cells` squares with vertices of its own.
inline Mesh griddedCube(double side, int cells) {
  Mesh mesh;
  for (int face = 0; face < 6; ++face) {
    const int axis = face / 2, base = static_cast<int>(mesh.vertices.size());
    const double out = face % 2 == 0 ? 0.5 : -0.5;
    for (int i = 0; i <= cells; ++i) {
      for (int j = 0; j <= cells; ++j) {
        Vector3d p;
        p[axis] = out;
        p[(axis + 1) % 3] = (static_cast<double>(i) / cells - 0.5) * (out > 0 ? 1 : -1);
        p[(axis + 2) % 3] = static_cast<double>(j) / cells - 0.5;
        mesh.vertices.push_back(side * p);
      }
    }
    for (int i = 0; i < cells; ++i) {
      for (int j = 0; j < cells; ++j) {
        const int a = base + i * (cells + 1) + j, b = a + cells + 1;
        mesh.triangles.push_back({a, b, b + 1});
        mesh.triangles.push_back({a, b + 1, a + 1});
      }
    }
  }
  return mesh;
}

inline Mesh moved(Mesh mesh, const Eigen::Matrix3d& rotation, const Vector3d& shift) {
  for (Vector3d& vertex : mesh.vertices) vertex = rotation * vertex + shift;
  return mesh;
}

inline Eigen::Matrix3d someRotation() {
  return Eigen::AngleAxisd(0.7, Vector3d(1, -2, 0.5).normalized()).toRotationMatrix();
}

}  // namespace ifa::shapes
