// SPDX-License-Identifier: Apache-2.0
// Motions that are right by construction, made without any of the code under test: a tumbling box
// that bounces on frictionless ground, and a box that lands flat, slides and stops.
#pragma once

#include <algorithm>
#include <cmath>

#include "ifa/motion.h"
#include "support/box_body.h"

namespace ifa::test {

inline constexpr double kGravity = 9.80665;
inline constexpr double kSample = 1.0 / 240;

/// Box of three different sides with a drawable mesh and a reference impulse.
inline Body makeDrawableBox() {
  Body body = makeBoxBody({0.024, 0.018, 0.012}, 0.006);
  body.mesh.materials = {{"red", {0.6, 0.05, 0.05, 1}, 0.4, 0},
                         {"glass", {0.9, 0.9, 1, 0.5}, 0, 0}};
  const int quads[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                           {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  for (int side = 0; side < 6; ++side) {
    const int* q = quads[side];
    body.mesh.triangles.push_back({q[0], q[1], q[2]});
    body.mesh.triangles.push_back({q[0], q[2], q[3]});
    body.mesh.triangleMaterial.insert(body.mesh.triangleMaterial.end(), 2, side == 5 ? 1 : 0);
  }
  SurfaceProperties desk;
  desk.restitution = 0.7;
  desk.friction = 0.35;
  desk.referenceImpulse = body.mass * 2;
  body.definition.surfaces["desk"] = desk;
  body.definition.defaultSurface = "desk";
  return body;
}

/// Appends samples to a motion while it moves one body about.
class MotionMaker {
 public:
  explicit MotionMaker(const Body& body) : body_(body) {
    motion.program = "0.1.0";
    motion.planner = "shoot";
    motion.seed = 18446744073709551615ULL;
    motion.object = {body.definition.name, "box.obj", "desk", body.mass, 0.7, 0.35};
    motion.sound = {"sound.wav", 44100, 2.5, 0.25};
    motion.success = true;
  }

  void begin(const MotionSample& state) {
    now = state;
    record();
  }
  /// Free flight for `duration` s.
  void fly(double duration) {
    const double end = now.time + duration;
    while (end - now.time > kSample) {
      drift(kSample);
      record();
    }
    if (end > now.time) drift(end - now.time);
    now.time = end;
    record();
  }
  /// Free flight until the lowest vertex touches.
  void flyToGround() {
    const MotionSample start = now;
    MotionSample above = now;
    do {
      above = now;
      drift(1e-4);
    } while (lowest() > 0);
    double low = 0, high = 1e-4;
    for (int i = 0; i < 50; ++i) {
      const double middle = 0.5 * (low + high);
      now = above;
      drift(middle);
      (lowest() > 0 ? low : high) = middle;
    }
    low += above.time - start.time;
    now = start;
    fly(low);
  }
  /// Impulse (N s) at `arm` from the centre of mass (m, world); a new sample at the same time.
  void hit(const Eigen::Vector3d& impulse, const Eigen::Vector3d& arm) {
    now.velocity += impulse / body_.mass;
    now.angularVelocity += worldInverse() * arm.cross(impulse);
    record();
  }
  /// Frictionless impact of the lowest vertex.
  void bounce(double restitution) {
    const Eigen::Vector3d arm = lowestArm(), up = Eigen::Vector3d::UnitZ();
    const double approach = (now.velocity + now.angularVelocity.cross(arm)).z();
    const double inverseMass = 1 / body_.mass + up.dot((worldInverse() * arm.cross(up)).cross(arm));
    hit(-(1 + restitution) * approach / inverseMass * up, arm);
  }
  /// Lists a discrete contact now; call it after the impact.
  void listContact(bool terminal = false) {
    MotionContact contact;
    contact.targetTime = contact.time = contact.end = now.time;
    contact.terminal = terminal;
    contact.position = now.position;
    contact.restitution = 0.7;
    contact.bend = 0.1 * static_cast<double>(motion.contacts.size());
    motion.contacts.push_back(contact);
  }
  /// Times count from the first contact.
  Motion finish() {
    const double origin = motion.contacts.front().time;
    for (MotionSample& sample : motion.trajectory) sample.time -= origin;
    for (auto& interval : motion.silent) interval = {interval[0] - origin, interval[1] - origin};
    for (MotionContact& contact : motion.contacts) {
      contact.targetTime = contact.time = contact.time - origin;
      contact.end -= origin;
    }
    motion.bend = {0.2, motion.contacts.back().bend, 2};
    return motion;
  }
  void record() { motion.trajectory.push_back(now); }
  [[nodiscard]] double lowest() const { return now.position.z() + lowestArm().z(); }

  Motion motion;
  MotionSample now;

 private:
  [[nodiscard]] Eigen::Vector3d lowestArm() const {
    Eigen::Vector3d lowest = now.orientation * body_.hull.front();
    for (const auto& vertex : body_.hull) {
      const Eigen::Vector3d arm = now.orientation * vertex;
      if (arm.z() < lowest.z()) lowest = arm;
    }
    return lowest;
  }
  [[nodiscard]] Eigen::Matrix3d worldInverse() const {
    const Eigen::Matrix3d r = now.orientation.toRotationMatrix();
    return r * body_.inertia.inverse() * r.transpose();
  }
  /// Euler's equations in the body frame, small Runge-Kutta steps.
  void drift(double duration) {
    const int steps = std::max(1, static_cast<int>(std::ceil(duration / 1e-4)));
    const double dt = duration / steps;
    Eigen::Vector3d w = now.orientation.conjugate() * now.angularVelocity;
    for (int i = 0; i < steps; ++i) step(now.orientation, w, dt);
    now.angularVelocity = now.orientation * w;
    now.position += duration * now.velocity;
    now.position.z() -= 0.5 * kGravity * duration * duration;
    now.velocity.z() -= kGravity * duration;
    now.time += duration;
  }
  void step(Eigen::Quaterniond& q, Eigen::Vector3d& w, double dt) const {
    using Eigen::Quaterniond, Eigen::Vector3d, Eigen::Vector4d;
    const auto spin = [](const Vector4d& c, const Vector3d& v) -> Vector4d {
      return 0.5 * (Quaterniond(c) * Quaterniond(0, v.x(), v.y(), v.z())).coeffs();
    };
    const auto euler = [&](const Vector3d& v) -> Vector3d {
      return -body_.inertia.inverse() * v.cross(body_.inertia * v);
    };
    const Vector4d q1 = spin(q.coeffs(), w);
    const Vector3d w1 = euler(w);
    const Vector4d q2 = spin(q.coeffs() + dt / 2 * q1, w + dt / 2 * w1);
    const Vector3d w2 = euler(w + dt / 2 * w1);
    const Vector4d q3 = spin(q.coeffs() + dt / 2 * q2, w + dt / 2 * w2);
    const Vector3d w3 = euler(w + dt / 2 * w2);
    const Vector4d q4 = spin(q.coeffs() + dt * q3, w + dt * w3);
    const Vector3d w4 = euler(w + dt * w3);
    q.coeffs() += dt / 6 * (q1 + 2 * q2 + 2 * q3 + q4);
    q.normalize();
    w += dt / 6 * (w1 + 2 * w2 + 2 * w3 + w4);
  }

  const Body& body_;
};

/// Tumbles, bounces five times, and is still in the air at the end.
inline Motion makeTumblingMotion(const Body& body) {
  MotionMaker maker(body);
  MotionSample start;
  start.position = {0.1, -0.2, 0.25};
  start.orientation = Eigen::Quaterniond(0.8, 0.3, -0.4, 0.33).normalized();
  start.velocity = {0.3, 0.2, -0.5};
  start.angularVelocity = {9, -14, 5};
  maker.begin(start);
  for (int contact = 0; contact < 5; ++contact) {
    maker.flyToGround();
    maker.bounce(0.8);
    maker.listContact();
  }
  maker.flyToGround();
  return maker.finish();
}

/// Falls flat, bounces twice, lands, slides until friction stops it, and rests for half a second.
inline Motion makeSlidingMotion(const Body& body) {
  const double friction = 0.35, mass = body.mass;
  MotionMaker maker(body);
  MotionSample start;
  start.position = {0, 0, 0.15};
  start.velocity = {2.4, 0.8, 0};
  maker.begin(start);
  for (const double restitution : {0.6, 0.5, 0.0}) {
    maker.flyToGround();
    const double normal = -(1 + restitution) * mass * maker.now.velocity.z();
    const Eigen::Vector3d along = maker.now.velocity.cwiseProduct(Eigen::Vector3d(1, 1, 0));
    maker.hit(normal * Eigen::Vector3d::UnitZ() - friction * normal * along.normalized(),
              Eigen::Vector3d::Zero());
    maker.listContact(restitution == 0);
  }
  const double slideStart = maker.now.time;
  maker.now.velocity.z() = 0;
  while (maker.now.velocity.norm() > 0) {
    const double speed = maker.now.velocity.norm();
    const double dt = std::min(1e-3, speed / (friction * kGravity));
    maker.now.velocity *= dt < 1e-3 ? 0 : 1 - friction * kGravity * dt / speed;
    maker.now.position += dt * maker.now.velocity;
    maker.now.time += dt;
    maker.record();
  }
  maker.motion.silent.push_back({slideStart, maker.now.time});
  for (int i = 0; i < 120; ++i) {
    maker.now.time += kSample;
    maker.record();
  }
  return maker.finish();
}

}  // namespace ifa::test
