// SPDX-License-Identifier: Apache-2.0
// State of one rigid body: the noun that dynamics, planners and motion exchange.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace ifa {

/// Position and velocity of a body (IFA section 4). World frame: z up, ground at z = 0.
/// The orientation is world from *principal* frame (axes of inertia, origin at the centre of mass),
/// the frame in which dynamics and planners work; files use the mesh's axes
/// (Body::bodyFromPrincipal).
struct RigidState {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();               ///< centre of mass, m
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();  ///< world from principal
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();               ///< m/s
  Eigen::Vector3d angularVelocity = Eigen::Vector3d::Zero();        ///< rad/s, world frame
};

/// Standard gravity, m/s^2, along -z.
inline constexpr double kGravity = 9.80665;

}  // namespace ifa
