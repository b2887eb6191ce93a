// SPDX-License-Identifier: Apache-2.0
// Rays per second of a draft film, everything included but the encoder, against a bare Embree loop
// over the same frames on the same threads: body and floor as triangles of one scene, the same
// pixels and samples, for each hit a shadow ray to the key light, and nothing done with what is
// found. On our side a ray is what is asked about a body, whether its bounding ball or Embree
// answers; what the floor shows without a body is known and no ray. The hits of both are compared
// first.
#include <embree3/rtcore.h>
#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "base/parallel.h"
#include "body/object_file.h"
#include "ifa/synchronize.h"
#include "render/frame_renderer.h"

namespace {

using namespace ifa::render;

constexpr int kWidth = 640, kHeight = 360, kSamples = 16, kRounds = 5;
constexpr std::size_t kFrames = 24, kBareFrames = kFrames / 4;
constexpr double kGoal = 0.6;
constexpr float kInfinity = std::numeric_limits<float>::infinity();

double seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Body at one pose and floor in one Embree scene, world frame.
class BareScene {
 public:
  BareScene(const ifa::Body& body, const ifa::Pose& pose)
      : device_(rtcNewDevice(nullptr)), scene_(rtcNewScene(device_)) {
    rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
    std::vector<Vector> vertices;
    const Eigen::Matrix3d turn = pose.orientation.toRotationMatrix();
    for (const auto& v : body.mesh.vertices) {
      vertices.emplace_back((turn * v + pose.position).cast<float>());
    }
    std::vector<std::array<unsigned, 3>> triangles;
    for (const auto& t : body.mesh.triangles) {
      triangles.push_back(
          {static_cast<unsigned>(t[0]), static_cast<unsigned>(t[1]), static_cast<unsigned>(t[2])});
    }
    body_ = attach(vertices, triangles);
    const float far = 50;
    attach({{-far, -far, 0}, {far, -far, 0}, {far, far, 0}, {-far, far, 0}},
           {{0, 1, 2}, {0, 2, 3}});
    rtcCommitScene(scene_);
  }
  ~BareScene() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }
  BareScene(const BareScene&) = delete;
  BareScene& operator=(const BareScene&) = delete;

  /// Distance of the hit, with `isBody` set; infinity when there is none.
  float trace(const Ray& ray, bool& isBody) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRayHit query;
    query.ray = asRay(ray);
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(scene_, &context, &query);
    isBody = query.hit.geomID == body_;
    return query.ray.tfar;
  }
  bool occluded(const Ray& ray) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRay query = asRay(ray);
    rtcOccluded1(scene_, &context, &query);
    return query.tfar < 0;
  }

 private:
  static RTCRay asRay(const Ray& ray) {
    return {ray.origin.x(),
            ray.origin.y(),
            ray.origin.z(),
            1e-4f,
            ray.direction.x(),
            ray.direction.y(),
            ray.direction.z(),
            0,
            kInfinity,
            ~0u,
            0,
            0};
  }
  unsigned attach(const std::vector<Vector>& vertices,
                  const std::vector<std::array<unsigned, 3>>& triangles) {
    RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* to = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0,
                                                           RTC_FORMAT_FLOAT3, 12, vertices.size()));
    for (const Vector& v : vertices) *to++ = v.x(), *to++ = v.y(), *to++ = v.z();
    auto* index = static_cast<unsigned*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, triangles.size()));
    for (const auto& t : triangles) *index++ = t[0], *index++ = t[1], *index++ = t[2];
    rtcCommitGeometry(geometry);
    const unsigned id = rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
    return id;
  }

  RTCDevice device_;
  RTCScene scene_;
  unsigned body_ = 0;
};

struct Case {
  ifa::Body body;
  ifa::Motion motion;
  std::vector<Actor> actors;
  RenderSettings settings;
};

Case makeCase(const std::string& object) {
  ifa::SynchronizeSettings wanted;
  wanted.sound =
      fmt::format("{}/tests/evaluation/{}/{}-01.signature.json", IFA_SOURCE_DIR, object, object);
  wanted.object = object;
  auto result = ifa::synchronize(wanted);
  auto body = ifa::loadObject(object);
  if (!result || !body) {
    fmt::print(stderr, "{}: {}\n", object, (result ? body.error() : result.error()).text());
    std::exit(3);
  }
  Case made{std::move(*body), std::move(result->takes.front()), {}, {}};
  Actor actor;
  actor.geometry = std::make_shared<BodyGeometry>(made.body);
  actor.motion = std::make_shared<ifa::Motion>(made.motion);
  made.actors = {actor};
  made.settings.width = kWidth;
  made.settings.height = kHeight;
  made.settings.samplesPerPixel = kSamples;
  made.settings.camera = ifa::CameraKind::kFixed;
  return made;
}

double timeOf(const Case& scene, std::size_t frame) {
  const double from = scene.motion.contacts.front().time, to = scene.motion.contacts.back().end;
  return from + (to - from) * static_cast<double>(frame) / static_cast<double>(kFrames - 1);
}

/// The bare loop over one frame. Returns its rays.
long bareFrame(const BareScene& scene, const Camera& camera, const Vector& key,
               const SampleTable& samples) {
  long rays = 0, found = 0;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      for (int i = 0; i < kSamples; ++i) {
        const Sample& s = samples.at(x, y)[i];
        const Ray ray = camera.through(static_cast<float>(x) + s.x, static_cast<float>(y) + s.y);
        bool isBody = false;
        const float distance = scene.trace(ray, isBody);
        ++rays;
        if (distance == kInfinity) continue;
        ++rays;
        found += scene.occluded({ray.origin + distance * ray.direction, key}) ? 1 : 0;
      }
    }
  }
  static std::atomic<long> kept{0};  // so that nothing is optimised away
  kept += found;
  return rays;
}

/// Largest difference of the distances that both ways find, m; rays past an outline may differ.
double disagreement(const Case& scene, const Camera& camera, double time) {
  const BareScene bare(scene.body, scene.actors[0].poseAt(time));
  const Moment moment(scene.actors, time, 0);
  double worst = 0;
  long differing = 0, hits = 0;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const Ray ray = camera.through(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
      bool isBody = false;
      const float distance = bare.trace(ray, isBody);
      SurfaceHit hit;
      const bool ours = moment.intersect(ray, 0, 0, hit) != Moment::kNobody;
      hits += isBody ? 1 : 0;
      differing += ours != isBody ? 1 : 0;
      if (ours && isBody)
        worst = std::max(worst, std::abs(double{hit.distance} - double{distance}));
    }
  }
  return hits > 0 && differing <= 2 ? worst : 1;
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

bool run(const std::string& object) {
  const Case scene = makeCase(object);
  const FrameRenderer renderer(scene.actors, scene.settings);
  const Camera camera = renderer.cameraPath().at(0);
  const SampleTable samples(kSamples);
  const Studio studio(renderer.cameraPath().azimuth(), Colour(0.2f, 0.2f, 0.2f));
  for (const std::size_t frame : {std::size_t{0}, kFrames / 2, kFrames - 1}) {
    const double off = disagreement(scene, camera, timeOf(scene, frame));
    if (off > 1e-4) {
      fmt::print(stderr, "{}: our hits differ from Embree's by {:g} m\n", object, off);
      return false;
    }
  }
  std::vector<std::unique_ptr<BareScene>> bare;
  for (std::size_t frame = 0; frame < kFrames; ++frame) {
    bare.push_back(
        std::make_unique<BareScene>(scene.body, scene.actors[0].poseAt(timeOf(scene, frame))));
  }
  std::vector<double> ours, bares, times, bareTimes;  // million rays/s; ms a frame

  for (int round = 0; round < kRounds; ++round) {
    const long before = renderer.rays();
    double start = seconds();
    ifa::parallelFor(kFrames, [&](std::size_t i) { (void)renderer.render(timeOf(scene, i)); });
    const double time = seconds() - start;
    ours.push_back(static_cast<double>(renderer.rays() - before) / time / 1e6);
    times.push_back(1e3 * time / kFrames);
    std::atomic<long> rays{0};
    start = seconds();
    ifa::parallelFor(kBareFrames, [&](std::size_t i) {
      rays += bareFrame(*bare[4 * i], camera, studio.keyDirection(), samples);
    });
    const double bareTime = seconds() - start;
    bares.push_back(static_cast<double>(rays.load()) / bareTime / 1e6);
    bareTimes.push_back(1e3 * bareTime / kBareFrames);
  }
  const double ratio = median(ours) / median(bares);
  fmt::print(
      "{:10} draft {:5.1f} million rays/s, bare Embree loop {:5.1f}, ratio {:.2f} (goal 0.60 {}); "
      "a frame {:4.0f} ms and {:4.0f} ms\n",
      object, median(ours), median(bares), ratio, ratio >= kGoal ? "met" : "missed", median(times),
      median(bareTimes));
  return ratio >= kGoal;
}

}  // namespace

int main() {
  bool met = true;
  for (const char* object : {"d6", "d20", "Nut", "CoffeeCup"}) met = run(object) && met;
  return met ? 0 : 1;
}
