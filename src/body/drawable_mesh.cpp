// SPDX-License-Identifier: Apache-2.0
#include "body/drawable_mesh.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

namespace ifa {
namespace {

using Eigen::Vector3d;

constexpr double kPi = 3.14159265358979323846;
// Where more faces meet, as at the tip of a fan, each keeps its own normal: the work would be
// quadratic.
constexpr std::size_t kMaxFacesAtVertex = 256;

/// Vertices at the same place are one, whatever the file says.
std::vector<int> weld(const std::vector<Vector3d>& vertices) {
  std::map<std::tuple<double, double, double>, int> seen;
  std::vector<int> welded;
  welded.reserve(vertices.size());
  for (const Vector3d& v : vertices) {
    welded.push_back(
        seen.emplace(std::tuple(v.x(), v.y(), v.z()), static_cast<int>(seen.size())).first->second);
  }
  return welded;
}

class NormalBuilder {
 public:
  NormalBuilder(const Mesh& mesh, double creaseDegrees)
      : mesh_(mesh), cosine_(std::cos(creaseDegrees * kPi / 180)), welded_(weld(mesh.vertices)) {
    facesAt_.resize(mesh.vertices.size());
    for (std::size_t face = 0; face < mesh.triangles.size(); ++face) {
      faceNormals_.push_back(faceNormal(mesh.triangles[face]));
      for (const int vertex : mesh.triangles[face]) {
        facesAt_[static_cast<std::size_t>(weldedIndex(vertex))].push_back(face);
      }
    }
  }

  [[nodiscard]] const Vector3d& faceNormal(std::size_t face) const { return faceNormals_[face]; }

  /// Mean of the normals around the corner that are nearly the face's own, weighted by angle.
  [[nodiscard]] Vector3d cornerNormal(std::size_t face, int vertex) const {
    const auto& around = facesAt_[static_cast<std::size_t>(weldedIndex(vertex))];
    if (around.size() > kMaxFacesAtVertex) return faceNormals_[face];
    Vector3d sum = Vector3d::Zero();
    for (const std::size_t other : around) {
      if (faceNormals_[other].dot(faceNormals_[face]) >= cosine_) {
        sum += angleAt(other, weldedIndex(vertex)) * faceNormals_[other];
      }
    }
    return sum.norm() > 0 ? Vector3d(sum.normalized()) : faceNormals_[face];
  }

 private:
  [[nodiscard]] int weldedIndex(int vertex) const {
    return welded_[static_cast<std::size_t>(vertex)];
  }
  [[nodiscard]] const Vector3d& point(int vertex) const {
    return mesh_.vertices[static_cast<std::size_t>(vertex)];
  }
  [[nodiscard]] Vector3d faceNormal(const std::array<int, 3>& corners) const {
    const Vector3d normal =
        (point(corners[1]) - point(corners[0])).cross(point(corners[2]) - point(corners[0]));
    const double length = normal.norm();
    return length > 0 ? Vector3d(normal / length) : Vector3d(Vector3d::Zero());
  }
  [[nodiscard]] double angleAt(std::size_t face, int welded) const {
    const auto& corners = mesh_.triangles[face];
    for (std::size_t i = 0; i < 3; ++i) {
      if (weldedIndex(corners[i]) != welded) continue;
      const Vector3d a = point(corners[(i + 1) % 3]) - point(corners[i]);
      const Vector3d b = point(corners[(i + 2) % 3]) - point(corners[i]);
      return std::atan2(a.cross(b).norm(), a.dot(b));
    }
    return 0;
  }

  const Mesh& mesh_;
  double cosine_;
  std::vector<int> welded_;
  std::vector<Vector3d> faceNormals_;
  std::vector<std::vector<std::size_t>> facesAt_;
};

/// Gathers corners; equal ones become one vertex.
class CornerTable {
 public:
  explicit CornerTable(DrawableMesh& out) : out_(out) {}

  std::uint32_t add(const Vector3d& position, const Vector3d& normal) {
    const Vector3d rounded = (normal * 1e4).array().round();
    const Key key(position.x(), position.y(), position.z(), rounded.x(), rounded.y(), rounded.z());
    const auto [entry, isNew] =
        indices_.emplace(key, static_cast<std::uint32_t>(out_.positions.size()));
    if (isNew) {
      out_.positions.push_back(asFloats(position));
      out_.normals.push_back(asFloats(normal));
    }
    return entry->second;
  }

 private:
  using Key = std::tuple<double, double, double, double, double, double>;

  static std::array<float, 3> asFloats(const Vector3d& v) {
    return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
  }

  DrawableMesh& out_;
  std::map<Key, std::uint32_t> indices_;
};

}  // namespace

DrawableMesh drawableMesh(const Mesh& mesh, double creaseDegrees) {
  DrawableMesh out;
  out.triangles.resize(std::max<std::size_t>(1, mesh.materials.size()));
  const NormalBuilder normals(mesh, creaseDegrees);
  CornerTable corners(out);
  for (std::size_t face = 0; face < mesh.triangles.size(); ++face) {
    if (normals.faceNormal(face).squaredNorm() == 0) continue;
    const int material = mesh.triangleMaterial.empty() ? 0 : mesh.triangleMaterial[face];
    auto& list = out.triangles[static_cast<std::size_t>(material)];
    for (const int vertex : mesh.triangles[face]) {
      list.push_back(corners.add(mesh.vertices[static_cast<std::size_t>(vertex)],
                                 normals.cornerNormal(face, vertex)));
    }
  }
  return out;
}

}  // namespace ifa
