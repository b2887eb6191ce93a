// SPDX-License-Identifier: Apache-2.0
#include "dynamics/ode_backend.h"

#include <ode/ode.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdarg>
#include <limits>
#include <mutex>
#include <vector>

namespace ifa {
namespace {

/// Below these lengths ODE would be given a row without bounds, which it leaves unset.
constexpr double kSmallestFrictionLength = 1e-9;
/// Share of a unit of inverse mass that is added to the solver's diagonal. From 1e-6 to 1e-3 the
/// motions are statistically the same, but under 1e-4 the solver often meets singular rows.
constexpr double kSoftness = 3e-4;

/// A body on fewer contacts may only be balancing: it is given so many quiet windows to topple.
constexpr int kSupport = 3;
constexpr int kBalancedWindows = 10;

/// Dantzig's solver reports rows that it gives up on; it still leaves a usable solution.
void ignoreMessage(int /*number*/, const char* /*format*/, va_list /*arguments*/) {}

struct VertexContact {
  Eigen::Vector3d position;  // world frame, m
  double depth = 0;          // m, > 0
};

using ContactSet = std::array<VertexContact, kMaxOdeContacts>;

/// The hull's vertices as three rows, so that the test against the plane runs at memory speed.
struct VertexRows {
  std::vector<double> x, y, z;  // principal frame, m

  explicit VertexRows(const Body& body) {
    for (const Eigen::Vector3d& vertex : body.hull) {
      const Eigen::Vector3d p = body.bodyFromPrincipal.transpose() * vertex;
      x.push_back(p.x());
      y.push_back(p.y());
      z.push_back(p.z());
    }
  }
};

/// Keeps `keep` of `found`: the deepest first, then always the one farthest from those kept. Too
/// few or bunched contacts leave cups rocking for ever.
int chooseBySpread(std::vector<VertexContact>& found, int keep, ContactSet& chosen) {
  if (static_cast<int>(found.size()) <= keep) {
    std::copy(found.begin(), found.end(), chosen.begin());
    return static_cast<int>(found.size());
  }
  std::vector<double> distance(found.size(), std::numeric_limits<double>::max());
  auto next = std::max_element(found.begin(), found.end(),
                               [](const auto& a, const auto& b) { return a.depth < b.depth; });
  for (int count = 0; count < keep; ++count) {
    chosen[static_cast<std::size_t>(count)] = *next;
    for (std::size_t i = 0; i < found.size(); ++i)
      distance[i] = std::min(distance[i], (found[i].position - next->position).squaredNorm());
    next = found.begin() + (std::max_element(distance.begin(), distance.end()) - distance.begin());
  }
  return keep;
}

dSurfaceParameters contactSurface(const SurfaceProperties& surface, const OdeSettings& settings) {
  dSurfaceParameters parameters{};
  parameters.mode = dContactBounce | dContactApprox1;
  parameters.mu = surface.friction;
  parameters.bounce = surface.restitution;
  parameters.bounce_vel = settings.bounceThreshold;
  if (surface.rollingFriction > 0 || surface.spinningFriction > 0) {
    parameters.mode |= dContactRolling | dContactAxisDep;
    parameters.mu2 = surface.friction;
    parameters.rho = std::max(surface.rollingFriction, kSmallestFrictionLength);
    parameters.rho2 = parameters.rho;
    parameters.rhoN = std::max(surface.spinningFriction, kSmallestFrictionLength);
  }
  return parameters;
}

/// A world with one body, and a threading implementation of its own: ODE's default one is shared
/// by all worlds and not locked.
class OdeWorld {
 public:
  OdeWorld(const Body& body, const OdeSettings& settings) {
    static std::once_flag initialised;
    std::call_once(initialised, [] {
      dInitODE2(0);
      dSetMessageHandler(ignoreMessage);
    });
    world_ = dWorldCreate();
    threading_ = dThreadingAllocateSelfThreadedImplementation();
    dWorldSetStepThreadingImplementation(world_, dThreadingImplementationGetFunctions(threading_),
                                         threading_);
    dWorldSetGravity(world_, 0, 0, -kGravity);
    dWorldSetERP(world_, settings.errorReduction);
    // Just enough softness to tell apart the forces of more contacts than a body has freedoms.
    dWorldSetCFM(world_, kSoftness * settings.step / body.mass);
    dWorldSetContactMaxCorrectingVel(world_, settings.maxCorrectingVelocity);
    joints_ = dJointGroupCreate(0);
    body_ = dBodyCreate(world_);
    dBodySetAutoDisableFlag(body_, 0);
    dBodySetFiniteRotationMode(body_, 1);
    dMass mass;
    const Eigen::Vector3d& moments = body.principalMoments;
    dMassSetParameters(&mass, body.mass, 0, 0, 0, moments.x(), moments.y(), moments.z(), 0, 0, 0);
    dBodySetMass(body_, &mass);
  }
  OdeWorld(const OdeWorld&) = delete;
  OdeWorld& operator=(const OdeWorld&) = delete;
  ~OdeWorld() {
    dJointGroupDestroy(joints_);
    dWorldDestroy(world_);
    dThreadingFreeImplementation(threading_);
  }

  void setState(const RigidState& state) {
    const Eigen::Quaterniond& q = state.orientation;
    const dQuaternion orientation = {q.w(), q.x(), q.y(), q.z()};
    dBodySetPosition(body_, state.position.x(), state.position.y(), state.position.z());
    dBodySetQuaternion(body_, orientation);
    dBodySetLinearVel(body_, state.velocity.x(), state.velocity.y(), state.velocity.z());
    dBodySetAngularVel(body_, state.angularVelocity.x(), state.angularVelocity.y(),
                       state.angularVelocity.z());
  }

  RigidState state() const {
    const dReal* q = dBodyGetQuaternion(body_);
    return {Eigen::Vector3d(dBodyGetPosition(body_)), Eigen::Quaterniond(q[0], q[1], q[2], q[3]),
            Eigen::Vector3d(dBodyGetLinearVel(body_)), Eigen::Vector3d(dBodyGetAngularVel(body_))};
  }

  dWorldID world() const { return world_; }
  dBodyID body() const { return body_; }
  dJointGroupID joints() const { return joints_; }

 private:
  dWorldID world_;
  dThreadingImplementationID threading_;
  dJointGroupID joints_;
  dBodyID body_;
};

/// One drop in progress.
class OdeDrop {
 public:
  OdeDrop(const Body& body, const SurfaceProperties& surface, const OdeSettings& settings)
      : model_(body), settings_(settings), rows_(body), world_(body, settings) {
    contact_.surface = contactSurface(surface, settings);
    contact_.geom.normal[2] = 1;
  }

  DropResult run(const RigidState& start, double timeLimit) {
    world_.setState(start);
    const auto steps = static_cast<long>(std::ceil(timeLimit / settings_.step));
    const auto window = static_cast<long>(std::ceil(settings_.restWindow / settings_.step));
    long quiet = 0;
    DropResult result;
    for (long i = 0; i < steps && !result.atRest; ++i) {
      advance(static_cast<double>(i) * settings_.step, result);
      quiet = isQuiet() ? quiet + 1 : 0;
      if (quiet == 0) widest_ = 0;
      result.atRest = quiet >= (widest_ >= kSupport ? window : kBalancedWindows * window);
      result.restTime = static_cast<double>(i + 1 - quiet) * settings_.step;
    }
    if (!result.atRest) result.restTime = timeLimit;
    result.rest = world_.state();
    return result;
  }

 private:
  void advance(double time, DropResult& result) {
    const int count = findContacts();
    widest_ = std::max(widest_, count);
    if (count == 0) {
      dWorldStep(world_.world(), settings_.step);
      wasTouching_ = false;
      return;
    }
    if (wasTouching_ && settings_.recordSteps) result.steps.back().touching = true;
    wasTouching_ = true;
    for (int i = 0; i < count; ++i) addJoint(static_cast<std::size_t>(i));
    if (settings_.recordSteps) {
      ContactStep& step = result.steps.emplace_back();
      step.time = time;
      step.duration = settings_.step;
      step.before = world_.state();
      dWorldStep(world_.world(), settings_.step);
      step.after = world_.state();
      for (int i = 0; i < count; ++i)
        step.impulse += settings_.step * Eigen::Vector3d(feedback_[static_cast<std::size_t>(i)].f1);
    } else {
      dWorldStep(world_.world(), settings_.step);
    }
    dJointGroupEmpty(world_.joints());
  }

  int findContacts() {
    const dReal* position = dBodyGetPosition(world_.body());
    if (position[2] > model_.radius) return 0;
    const dReal* r = dBodyGetRotation(world_.body());
    found_.clear();
    for (std::size_t i = 0; i < rows_.x.size(); ++i) {
      const double x = rows_.x[i], y = rows_.y[i], z = rows_.z[i];
      const double height = position[2] + r[8] * x + r[9] * y + r[10] * z;
      if (height >= 0) continue;
      found_.push_back({{position[0] + r[0] * x + r[1] * y + r[2] * z,
                         position[1] + r[4] * x + r[5] * y + r[6] * z, height},
                        -height});
    }
    return chooseBySpread(found_, std::min(settings_.maxContacts, kMaxOdeContacts), contacts_);
  }

  void addJoint(std::size_t i) {
    for (int axis = 0; axis < 3; ++axis) contact_.geom.pos[axis] = contacts_[i].position[axis];
    contact_.geom.depth = contacts_[i].depth;
    const dJointID joint = dJointCreateContact(world_.world(), world_.joints(), &contact_);
    dJointAttach(joint, world_.body(), nullptr);
    if (settings_.recordSteps) dJointSetFeedback(joint, &feedback_[i]);
  }

  bool isQuiet() const {
    const double limit = settings_.restSpeed * settings_.restSpeed;
    const double linear = Eigen::Vector3d(dBodyGetLinearVel(world_.body())).squaredNorm();
    if (linear > limit) return false;
    const dReal* q = dBodyGetQuaternion(world_.body());
    const Eigen::Vector3d spin = Eigen::Quaterniond(q[0], q[1], q[2], q[3]).conjugate() *
                                 Eigen::Vector3d(dBodyGetAngularVel(world_.body()));
    return linear + model_.principalMoments.dot(spin.cwiseAbs2()) / model_.mass < limit;
  }

  const Body& model_;
  const OdeSettings& settings_;
  VertexRows rows_;
  OdeWorld world_;
  dContact contact_{};
  std::vector<VertexContact> found_;
  ContactSet contacts_{};
  std::array<dJointFeedback, kMaxOdeContacts> feedback_{};
  bool wasTouching_ = false;
  int widest_ = 0;  // most contacts in a step since the body is quiet
};

}  // namespace

DropResult simulateDropOde(const Body& body, const SurfaceProperties& surface,
                           const RigidState& start, double timeLimit, const OdeSettings& settings) {
  return OdeDrop(body, surface, settings).run(start, timeLimit);
}

}  // namespace ifa
