// SPDX-License-Identifier: Apache-2.0
#include "render/body_geometry.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <stdexcept>

#include "body/drawable_mesh.h"

namespace ifa::render {
namespace {

constexpr double kCreaseDegrees = 30;  // as in the animation files
constexpr std::size_t kMostFinishes = 256;
// Wider instructions round otherwise (FMA), so that a film would depend on the processor; for
// single rays they are not faster.
#ifdef __x86_64__
constexpr const char* kSameEverywhere = "isa=sse2";
#else
constexpr const char* kSameEverywhere = nullptr;
#endif
constexpr float kInfinity = std::numeric_limits<float>::infinity();
// What stands out of a triangle's plane by less than this times the radius does not shade it.
constexpr double kFlat = 1e-4;
// The work is triangles times corners of the hull.
constexpr std::size_t kMostTested = 100000;

Finish finishOf(const MeshMaterial& material) {
  Finish finish;
  for (int i = 0; i < 3; ++i) {
    finish.colour[i] = static_cast<float>(material.colour[static_cast<std::size_t>(i)]);
  }
  const auto roughness = static_cast<float>(material.roughness);
  finish.alpha = std::max(roughness * roughness, 0.004f);
  finish.metallic = static_cast<float>(material.metallic);
  return finish;
}

/// Whether all corners of the hull lie behind the triangle's plane.
bool open(const std::array<Vector, 3>& triangle, const std::vector<Eigen::Vector3d>& hull,
          double radius) {
  const Eigen::Vector3d a = triangle[0].cast<double>();
  const Eigen::Vector3d normal =
      (triangle[1].cast<double>() - a).cross(triangle[2].cast<double>() - a);
  const double limit = kFlat * radius * normal.norm();
  return std::all_of(hull.begin(), hull.end(), [&](const Eigen::Vector3d& corner) {
    return (corner - a).dot(normal) <= limit;
  });
}

RTCRay rtcRay(const Ray& ray, float limit) {
  return {ray.origin.x(),
          ray.origin.y(),
          ray.origin.z(),
          0,
          ray.direction.x(),
          ray.direction.y(),
          ray.direction.z(),
          0,
          limit,
          ~0u,
          0,
          0};
}

/// The nearest hit closer than `limit`; without one, no geometry, and `limit` stays.
RTCRayHit trace(RTCScene scene, const Ray& ray, float limit) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRayHit query;
  query.ray = rtcRay(ray, limit);
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(scene, &context, &query);
  return query;
}

template <class T>
T* newBuffer(RTCGeometry geometry, RTCBufferType type, RTCFormat format, std::size_t count) {
  return static_cast<T*>(rtcSetNewGeometryBuffer(geometry, type, 0, format, sizeof(T), count));
}

}  // namespace

struct BodyGeometry::Device {
  Device() : device(rtcNewDevice(kSameEverywhere)), scene(nullptr) {
    if (device == nullptr) throw std::runtime_error("Embree does not start");
    scene = rtcNewScene(device);
    // Rays along an edge must not slip between its triangles.
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
  }
  ~Device() {
    rtcReleaseScene(scene);
    rtcReleaseDevice(device);
  }
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;

  RTCDevice device;
  RTCScene scene;
};

BodyGeometry::BodyGeometry(const Body& body) : device_(std::make_unique<Device>()) {
  const DrawableMesh mesh = drawableMesh(body.mesh, kCreaseDegrees);
  normals_ = mesh.normals;
  for (std::size_t m = 0; m < mesh.triangles.size(); ++m) {
    const auto& list = mesh.triangles[m];
    for (std::size_t i = 0; i + 2 < list.size(); i += 3) {
      corners_.push_back({list[i], list[i + 1], list[i + 2]});
      finishOf_.push_back(static_cast<std::uint8_t>(std::min(m, kMostFinishes - 1)));
    }
  }
  for (const MeshMaterial& material : body.mesh.materials) finishes_.push_back(finishOf(material));
  if (finishes_.empty()) finishes_.push_back(finishOf(MeshMaterial{}));
  for (const auto& p : mesh.positions) {
    radius_ = std::max(radius_, std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]));
  }
  const auto point = [&](std::uint32_t corner) {
    const auto& p = mesh.positions[corner];
    return Vector(p[0], p[1], p[2]);
  };
  const bool tested = corners_.size() <= kMostTested;
  for (const auto& c : corners_) {
    isOpen_.push_back(
        tested && open({point(c[0]), point(c[1]), point(c[2])}, body.hull, body.radius) ? 1 : 0);
  }
  RTCGeometry geometry = rtcNewGeometry(device_->device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* positions = newBuffer<std::array<float, 3>>(geometry, RTC_BUFFER_TYPE_VERTEX,
                                                    RTC_FORMAT_FLOAT3, mesh.positions.size());
  auto* indices = newBuffer<std::array<std::uint32_t, 3>>(geometry, RTC_BUFFER_TYPE_INDEX,
                                                          RTC_FORMAT_UINT3, corners_.size());
  std::copy(mesh.positions.begin(), mesh.positions.end(), positions);
  std::copy(corners_.begin(), corners_.end(), indices);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(device_->scene, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(device_->scene);
}

BodyGeometry::~BodyGeometry() = default;
BodyGeometry::BodyGeometry(BodyGeometry&&) noexcept = default;

bool BodyGeometry::intersect(const Ray& ray, float limit, SurfaceHit& hit) const {
  const RTCRayHit query = trace(device_->scene, ray, limit);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return false;
  const std::size_t triangle = query.hit.primID;
  const auto normalAt = [&](std::size_t k) {
    const auto& n = normals_[corners_[triangle][k]];
    return Vector(n[0], n[1], n[2]);
  };
  const float u = query.hit.u, v = query.hit.v;
  hit.distance = query.ray.tfar;
  hit.geometric = Vector(query.hit.Ng_x, query.hit.Ng_y, query.hit.Ng_z).normalized();
  hit.open = isOpen_[triangle] != 0 && hit.geometric.dot(ray.direction) < 0;
  hit.normal = ((1 - u - v) * normalAt(0) + u * normalAt(1) + v * normalAt(2)).normalized();
  if (hit.geometric.dot(ray.direction) > 0) hit.geometric = -hit.geometric;
  if (hit.normal.dot(hit.geometric) < 0) hit.normal = -hit.normal;
  hit.finish = &finishes_[finishOf_[triangle]];
  return true;
}

float BodyGeometry::distance(const Ray& ray) const {
  return trace(device_->scene, ray, kInfinity).ray.tfar;
}

bool BodyGeometry::occludes(const Ray& ray) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRay query = rtcRay(ray, kInfinity);
  rtcOccluded1(device_->scene, &context, &query);
  return query.tfar < 0;
}

}  // namespace ifa::render
