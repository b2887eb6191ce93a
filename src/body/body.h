// SPDX-License-Identifier: Apache-2.0
// A rigid body ready for simulation, and the object file that it comes from (docs/file-formats.md).
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace ifa {

/// What is under this share of J_ref is not heard. Decision: 3 %, the share at which the gaps and
/// numbers of simulated contacts are those that people mark in recordings (docs/method.md, 2).
inline constexpr double kAudibleShare = 0.03;

/// Largest restitution that a surface may have.
inline constexpr double kMostRestitution = 0.95;

/// Contact behaviour of an object on one kind of ground.
struct SurfaceProperties {
  double restitution = 0.5;     ///< Newton coefficient, 0 to 0.95
  double friction = 0.35;       ///< Coulomb coefficient, 0 to 2
  double rollingFriction = 0;   ///< m
  double spinningFriction = 0;  ///< m
  double referenceImpulse =
      0;  ///< J_ref, N s: median over sampled drops of the largest impulse in 1 ms
};

/// How initial states are sampled (IFA 5.1).
struct SamplingSettings {
  double coneDegrees = 30;                   ///< largest angle of the velocity from straight down
  std::array<double, 2> speed = {0.5, 4.0};  ///< m/s
  std::array<double, 2> spin = {0.0, 20.0};  ///< rad/s
};

/// Colour and name of a group of triangles.
struct MeshMaterial {
  std::string name;
  std::array<double, 4> colour = {0.8, 0.8, 0.8, 1.0};  ///< linear RGBA
  double roughness = 0.6;                               ///< 0 to 1
  double metallic = 0;                                  ///< 0 to 1
};

/// Triangle mesh, counter-clockwise seen from outside.
struct Mesh {
  std::vector<Eigen::Vector3d> vertices;      ///< m
  std::vector<std::array<int, 3>> triangles;  ///< indices into vertices
  std::vector<int> triangleMaterial;  ///< one index into materials per triangle; may be empty
  std::vector<MeshMaterial> materials;
};

enum class BodyKind { kSolid, kShell };

/// One piece of a body that is made of several materials: its own mesh and its own mass.
struct ObjectPart {
  std::string meshFile;  ///< as the object file names it, same units as the object's mesh
  std::string meshPath;  ///< resolved path
  BodyKind kind = BodyKind::kSolid;
  double mass = 0;     ///< kg; 0: given by the density
  double density = 0;  ///< kg/m^3 (solid) or kg/m^2 (shell); 0: given by the mass
};

/// Everything that an object file says (objects/NAME.json).
struct ObjectDefinition {
  std::string name, title, material, notes;
  std::string path;                ///< the object file; empty when made in memory
  std::string meshPath;            ///< resolved path of the mesh
  std::string meshFile;            ///< the mesh as the object file names it, relative to that file
  std::string hullFile, hullPath;  ///< mesh whose hull physics uses; empty: the visible mesh's
  std::string units = "m";         ///< of the meshes: m, cm, mm or in
  BodyKind kind = BodyKind::kSolid;
  double mass = 0;                ///< kg; 0: given by the density or the parts
  double density = 0;             ///< kg/m^3 (solid) or kg/m^2 (shell); 0: given by the mass
  std::vector<ObjectPart> parts;  ///< composite bodies only
  std::map<std::string, SurfaceProperties> surfaces;
  std::string defaultSurface;
  SamplingSettings sampling;
  double mergeGap = 0.010;                       ///< delta t of IFA section 4, s
  std::map<std::string, Eigen::Vector3d> faces;  ///< unit directions in the body frame
};

/// A body: mesh and mass properties. Body frame: the mesh's axes, origin at the centre of mass.
struct Body {
  ObjectDefinition definition;
  Mesh mesh;                          ///< body frame
  std::vector<Eigen::Vector3d> hull;  ///< vertices of the convex hull, body frame
  std::size_t exactHullVertices = 0;  ///< more than `hull` has where that was simplified
  double hullDeviation = 0;  ///< how far the exact hull reaches beyond a simplified one at most, m
  double mass = 0;           ///< kg
  Eigen::Vector3d centreOfMass = Eigen::Vector3d::Zero();           ///< in the mesh file's frame, m
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Identity();            ///< body frame, kg m^2
  Eigen::Vector3d principalMoments = Eigen::Vector3d::Ones();       ///< kg m^2, ascending
  Eigen::Matrix3d bodyFromPrincipal = Eigen::Matrix3d::Identity();  ///< a rotation
  double radius = 0;  ///< largest distance of a hull vertex from the centre of mass, m
  double size = 0;    ///< longest side of the mesh's bounding box, m

  /// Depth that counts as touching and not as sunk: max(0.1 mm, 0.1 % of the size), m.
  [[nodiscard]] double tolerance() const { return size * 1e-3 > 1e-4 ? size * 1e-3 : 1e-4; }
};

}  // namespace ifa
