// SPDX-License-Identifier: Apache-2.0
#include "audit/separation.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace ifa {

namespace {

using Eigen::Vector3d;
using Corners = Eigen::Matrix3Xd;

constexpr double kFinestTurn = 1e-5;  // rad of the search for a direction

double beginOf(const LaidMotion& laid) {
  return laid.motion->trajectory.front().time + laid.motion->sound.firstContact;
}
double endOf(const LaidMotion& laid) {
  return laid.motion->trajectory.back().time + laid.motion->sound.firstContact;
}

struct Where {
  Vector3d centre;
  Eigen::Quaterniond turned;
};

Where whereAt(const LaidMotion& laid, double time) {
  const auto& samples = laid.motion->trajectory;
  const double own = time - laid.motion->sound.firstContact;
  const auto after = std::upper_bound(samples.begin(), samples.end(), own,
                                      [](double t, const MotionSample& s) { return t < s.time; });
  const MotionSample& b = after == samples.end() ? samples.back() : *after;
  const MotionSample& a = after == samples.begin() ? samples.front() : *(after - 1);
  const double share =
      b.time > a.time ? std::clamp((own - a.time) / (b.time - a.time), 0.0, 1.0) : 0;
  const Eigen::Quaterniond laidDown(Eigen::AngleAxisd(laid.turn, Vector3d::UnitZ()));
  const Vector3d centre = a.position + share * (b.position - a.position);
  return {laidDown * centre + Vector3d(laid.shift.x(), laid.shift.y(), 0),
          laidDown * a.orientation.slerp(share, b.orientation)};
}

Corners cornersAt(const LaidMotion& laid, const Where& where) {
  const auto& hull = laid.body->hull;
  Corners corners(3, static_cast<Eigen::Index>(hull.size()));
  for (std::size_t i = 0; i < hull.size(); ++i) {
    corners.col(static_cast<Eigen::Index>(i)) = where.centre + where.turned * hull[i];
  }
  return corners;
}

/// Room between two bodies along a unit direction that points from `one` to `other`, m.
double room(const Corners& one, const Corners& other, const Vector3d& direction) {
  return (direction.transpose() * other).minCoeff() - (direction.transpose() * one).maxCoeff();
}

/// The most room that any direction gives, which is the distance of bodies that do not meet. As a
/// function of direction it has one summit only where it is positive, so that climbing finds it; it
/// has ridges too, so every ring of directions that is tried is turned against the one before, and
/// several must fail before a smaller one is tried.
/// @param enough  m; more need not be found
double mostRoom(const Corners& one, const Corners& other, Vector3d direction, double enough) {
  constexpr int kOnRing = 8, kRings = 6;
  constexpr double kGolden = 2.399963229728653;  // rad: no two rings are alike
  double best = room(one, other, direction), turn = 0;
  int failed = 0;
  for (double step = 0.5; step > kFinestTurn && best < enough;) {
    const Vector3d sideways = direction.unitOrthogonal(), upwards = direction.cross(sideways);
    const Vector3d from = direction;
    turn += kGolden;
    for (int k = 0; k < kOnRing; ++k) {
      const double angle = turn + k * 2 * std::numbers::pi / kOnRing;
      const Vector3d tried =
          (from + step * (std::cos(angle) * sideways + std::sin(angle) * upwards)).normalized();
      if (const double found = room(one, other, tried); found > best) {
        best = found;
        direction = tried;
      }
    }
    failed = direction == from ? failed + 1 : 0;
    if (failed < kRings) continue;
    step *= 0.5;
    failed = 0;
  }
  return best;
}

}  // namespace

Separation leastSeparation(const std::vector<LaidMotion>& motions, double rate) {
  Separation found;
  found.least = std::numeric_limits<double>::infinity();
  double begin = std::numeric_limits<double>::infinity(), end = -begin;
  for (const LaidMotion& laid : motions) {
    begin = std::min(begin, beginOf(laid));
    end = std::max(end, endOf(laid));
  }
  const auto last = static_cast<long>(std::ceil((end - begin) * rate));
  for (long k = 0; k <= last && motions.size() > 1; ++k) {
    const double time = begin + static_cast<double>(k) / rate;
    std::vector<Where> where;
    for (const LaidMotion& laid : motions) where.push_back(whereAt(laid, time));
    for (std::size_t i = 0; i < motions.size(); ++i) {
      for (std::size_t j = i + 1; j < motions.size(); ++j) {
        if (time < beginOf(motions[i]) || time < beginOf(motions[j])) continue;
        const Vector3d between = where[j].centre - where[i].centre;
        // Balls that are further apart than what was found already need no closer look.
        const double balls = between.norm() - motions[i].body->radius - motions[j].body->radius;
        if (balls >= found.least) continue;
        const Vector3d start =
            between.norm() > 0 ? Vector3d(between.normalized()) : Vector3d::UnitX();
        const double least = mostRoom(cornersAt(motions[i], where[i]),
                                      cornersAt(motions[j], where[j]), start, found.least);
        if (least < found.least) found = {least, i, j, time, true};
      }
    }
  }
  if (!found.known) found.least = 0;
  return found;
}

}  // namespace ifa
