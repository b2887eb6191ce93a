// SPDX-License-Identifier: Apache-2.0
// From a definition and its meshes to a body.
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <utility>

#include "body/mass_properties.h"
#include "body/mesh_import.h"
#include "body/mesh_report.h"
#include "body/object_file.h"
#include "body/simple_hull.h"

namespace ifa {

using Eigen::Vector3d;

namespace {

constexpr double kSmallestSize = 2e-4;  // m
constexpr double kLargestSize = 5.0;    // m

/// A mesh that may have been turned, and its mass properties.
struct WeighedMesh {
  Mesh mesh;
  MassProperties properties;
};

tl::unexpected<Error> meshError(const MeshReport& report, BodyKind kind, const std::string& place) {
  const auto bad =
      std::find_if(report.problems.begin(), report.problems.end(), [&](const MeshProblem& problem) {
        return problem.severity == ProblemSeverity::kUnusable ||
               (kind == BodyKind::kSolid && problem.severity == ProblemSeverity::kNotSolid);
      });
  return badInput("cannot be made a body: " + bad->message, place, bad->remedy);
}

void turnInsideOut(Mesh& mesh) {
  for (auto& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
}

Result<WeighedMesh> weigh(Mesh mesh, BodyKind kind, double mass, double density,
                          const std::string& place) {
  const MeshReport report = inspectMesh(mesh);
  if (kind == BodyKind::kSolid ? !report.solid() : !report.usable()) {
    return meshError(report, kind, place);
  }
  const bool closed = report.openEdges == 0 && report.inconsistentEdges == 0;
  if (closed && report.volume < 0) turnInsideOut(mesh);
  MassProperties unit = kind == BodyKind::kSolid ? solidProperties(mesh) : shellProperties(mesh);
  if (!(unit.mass > 0)) return badInput("has no surface to give mass to", place);
  const double factor = mass > 0 ? mass / unit.mass : density;
  return WeighedMesh{std::move(mesh), scaledMass(std::move(unit), factor)};
}

Result<void> checkSize(double size, const std::string& place) {
  if (size >= kSmallestSize && size <= kLargestSize) return {};
  return badInput(fmt::format("is {:.3g} m long, which no thrown object is", size), place,
                  "check the units (most modelling programs export millimetres)");
}

// Mass, centre of mass and everything that follows from them; moves the mesh to the body frame.
void setMassProperties(Body& body, const MassProperties& properties) {
  body.mass = properties.mass;
  body.definition.mass = properties.mass;
  body.centreOfMass = properties.centre;
  const PrincipalFrame frame = principalFrame(properties.inertia());
  body.principalMoments = frame.moments;
  body.bodyFromPrincipal = frame.bodyFromPrincipal;
  body.inertia =
      frame.bodyFromPrincipal * frame.moments.asDiagonal() * frame.bodyFromPrincipal.transpose();
  for (Vector3d& vertex : body.mesh.vertices) vertex -= properties.centre;
}

Result<void> setHull(Body& body, const std::vector<Vector3d>& points, const std::string& place) {
  auto hull = hullForPhysics(points);
  if (!hull) {
    Error error = hull.error();
    error.place = place;
    return tl::unexpected(error);
  }
  body.hull = std::move(hull->corners);
  body.exactHullVertices = hull->exactCorners;
  body.hullDeviation = hull->deviation;
  for (Vector3d& corner : body.hull) {
    corner -= body.centreOfMass;
    body.radius = std::max(body.radius, corner.norm());
  }
  return {};
}

Result<Body> assemble(ObjectDefinition definition, Mesh mesh, const MassProperties& properties,
                      const std::vector<Vector3d>& hullPoints) {
  Eigen::AlignedBox3d box;
  for (const Vector3d& vertex : mesh.vertices) box.extend(vertex);
  Body body;
  body.size = box.sizes().maxCoeff();
  const std::string place = definition.meshPath.empty() ? definition.name : definition.meshPath;
  if (const auto good = checkSize(body.size, place); !good) return tl::unexpected(good.error());
  const std::vector<Vector3d> points = hullPoints.empty() ? mesh.vertices : hullPoints;
  body.mesh = std::move(mesh);
  body.definition = std::move(definition);
  setMassProperties(body, properties);
  if (auto good = setHull(body, points, place); !good) return tl::unexpected(good.error());
  return body;
}

// The parts of a composite as one thing.
Result<MassProperties> weighParts(const ObjectDefinition& definition, double scale) {
  MassProperties all;
  for (const ObjectPart& part : definition.parts) {
    auto mesh = importMesh(part.meshPath, scale);
    if (!mesh) return tl::unexpected(mesh.error());
    const auto weighed = weigh(std::move(*mesh), part.kind, part.mass, part.density, part.meshPath);
    if (!weighed) return tl::unexpected(weighed.error());
    all = combined(all, weighed->properties);
  }
  return all;
}

}  // namespace

Result<Body> makeBodyFromMesh(ObjectDefinition definition, Mesh mesh,
                              const std::vector<Vector3d>& hullPoints) {
  const std::string place = definition.meshPath.empty() ? definition.name : definition.meshPath;
  if (!(definition.mass > 0) && !(definition.density > 0)) {
    return badInput("has neither mass nor density", place);
  }
  auto weighed =
      weigh(std::move(mesh), definition.kind, definition.mass, definition.density, place);
  if (!weighed) return tl::unexpected(weighed.error());
  return assemble(std::move(definition), std::move(weighed->mesh), weighed->properties, hullPoints);
}

Result<Body> makeBody(ObjectDefinition definition) {
  const double scale = metresPerUnit(definition.units);
  if (scale == 0) return badInput("unknown units \"" + definition.units + "\"", definition.path);
  auto mesh = importMesh(definition.meshPath, scale);
  if (!mesh) return tl::unexpected(mesh.error());
  std::vector<Vector3d> hullPoints;
  if (!definition.hullPath.empty()) {
    auto hull = importMesh(definition.hullPath, scale);
    if (!hull) return tl::unexpected(hull.error());
    hullPoints = std::move(hull->vertices);
  }
  if (definition.parts.empty()) {
    return makeBodyFromMesh(std::move(definition), std::move(*mesh), hullPoints);
  }
  const auto properties = weighParts(definition, scale);
  if (!properties) return tl::unexpected(properties.error());
  return assemble(std::move(definition), std::move(*mesh), *properties, hullPoints);
}

}  // namespace ifa
