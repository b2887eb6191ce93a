// SPDX-License-Identifier: Apache-2.0
#include "planner/aimed_events.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "graph/edge_weight.h"

namespace ifa {

namespace {

using Eigen::Vector3d;

/// Verticals are kept in a grid over the cube around the unit sphere.
constexpr int kCells = 8;
constexpr double kCellWidth = 2.0 / kCells;
/// A flight is not tilted by more: sine of 25 degrees, and the farthest that unit vectors are apart
/// then.
constexpr double kMostSine = 0.42, kFarthest = 0.433;

int cellOf(double x) { return std::clamp(static_cast<int>((x + 1) / kCellWidth), 0, kCells - 1); }

std::size_t cellOf(const Vector3d& up) {
  return static_cast<std::size_t>((cellOf(up.x()) * kCells + cellOf(up.y())) * kCells +
                                  cellOf(up.z()));
}

double signOf(const Eigen::Matrix3d& element) { return element.determinant() < 0 ? -1 : 1; }

/// A state as a relabelled body sees it; the spin is an axial vector.
PlanarKey relabelled(const Eigen::Matrix3d& element, const PlanarKey& key) {
  return {element * key.up, element * key.velocity,
          signOf(element) * (element * key.angularVelocity)};
}

/// Smallest rotation that takes the unit vector `from` to `to`, applied to `v`.
Vector3d tilted(const Vector3d& from, const Vector3d& to, const Vector3d& v) {
  const Vector3d axis = from.cross(to), once = axis.cross(v);
  return v + once + axis.cross(once) / (1 + from.dot(to));
}

PlausibleRegion regionOf(const RigidState& before, const RigidState& after, double radius) {
  const Eigen::Quaterniond back = before.orientation.conjugate();
  return {back * (after.velocity - before.velocity),
          back * (after.angularVelocity - before.angularVelocity), radius};
}

}  // namespace

AimedEvents::AimedEvents(const EventDatabase& database, const std::vector<RhythmMatch>& matches,
                         std::span<const Eigen::Matrix3d> group, double radius)
    : group_(group) {
  std::vector<Guise> guises;
  for (const RhythmMatch& match : matches) {
    const EventRecord record = database.record(match.event);
    const RigidState before = unpack(record.before), after = unpack(record.after);
    const HeardEvent heard = heardEvent(database, match.event, 1);
    const auto number = static_cast<std::uint32_t>(candidates_.size());
    candidates_.push_back({match.event, match.cost, before.position.z(), heard.amplitude,
                           heard.duration, heard.centroid, planarKey(before),
                           regionOf(before, after, radius)});
    for (std::uint32_t element = 0; element < group.size(); ++element) {
      guises.push_back({group[element] * candidates_.back().key.up, number, element});
    }
  }
  begins_.assign(kCells * kCells * kCells + 1, 0);
  for (const Guise& guise : guises) ++begins_[cellOf(guise.up) + 1];
  for (std::size_t cell = 1; cell < begins_.size(); ++cell) begins_[cell] += begins_[cell - 1];
  guises_.resize(guises.size());
  std::vector<std::uint32_t> next(begins_.begin(), begins_.end() - 1);
  for (const Guise& guise : guises) guises_[next[cellOf(guise.up)]++] = guise;
}

/// A source, and how it flies when its spin is left alone.
struct AimedEvents::Query {
  Query(const BodyModel& model, const AimSource& aimed)
      : source(aimed),
        flight(aimingFlight(model, aimed.after, *aimed.region, aimed.duration)),
        up(flight.arrival.orientation.conjugate() * Vector3d::UnitZ()),
        perRise(aimed.region->coordinates(Vector3d::UnitZ(), Vector3d::Zero()).norm()),
        normal((flight.tilting * flight.tilting.transpose()).inverse()) {}

  const AimSource& source;
  AimingFlight flight;
  Vector3d up;
  double perRise;  ///< bend by a vertical change of 1 m/s
  Eigen::Matrix2d normal;
};

void AimedEvents::weigh(const Query& query, const Guise& guise, std::vector<Aim>& found,
                        double most) const {
  const AimSource& source = query.source;
  const Candidate& candidate = candidates_[guise.candidate];
  const double time = source.duration;
  const Vector3d& velocity = source.after.velocity;
  const double rise = (candidate.height - source.after.position.z()) / time + 0.5 * kGravity * time;
  const double lift = query.perRise * (rise - velocity.z());
  double cost = candidate.rhythm + lift * lift;
  if (cost >= most) return;
  const Vector3d tilt = tiltTo(query.flight.arrival.orientation, guise.up);
  const Eigen::Vector2d across = tilt.head<2>();
  const Eigen::Vector2d force = query.normal * across;
  cost += across.dot(force);
  if (!(cost < most)) return;
  const HeardEvent heard = {candidate.amplitude / source.firstAmplitude, candidate.duration,
                            candidate.centroid};
  cost -= logAmplitude(source.target, heard);
  if (cost >= most) return;
  // The jump on arrival, in the axes of the event's own body.
  const Eigen::Quaterniond back = query.flight.arrival.orientation.conjugate();
  const Vector3d spin = query.flight.arrival.angularVelocity +
                        source.region->angularAxes() * (query.flight.tilting.transpose() * force);
  const Vector3d arriving(velocity.x(), velocity.y(), rise - kGravity * time);
  const Eigen::Matrix3d& element = group_[guise.element];
  const PlanarKey seen =
      relabelled(element.transpose(), {guise.up, tilted(query.up, guise.up, back * arriving),
                                       tilted(query.up, guise.up, back * spin)});
  cost += candidate.region
              .coordinates(candidate.key.velocity - seen.velocity,
                           candidate.key.angularVelocity - seen.angularVelocity)
              .squaredNorm();
  if (cost < most) {
    found.push_back({candidate.event, static_cast<int>(guise.element),
                     relabelled(element, candidate.key), cost});
  }
}

std::vector<Aim> AimedEvents::best(const BodyModel& model, const AimSource& source,
                                   std::size_t count, double most) const {
  const Query query(model, source);
  std::vector<Aim> found;
  if (!query.normal.allFinite()) return found;
  const auto range = [](double x) {
    return std::pair(cellOf(x - kFarthest), cellOf(x + kFarthest));
  };
  const auto [x0, x1] = range(query.up.x());
  const auto [y0, y1] = range(query.up.y());
  const auto [z0, z1] = range(query.up.z());
  for (int x = x0; x <= x1; ++x) {
    for (int y = y0; y <= y1; ++y) {
      const auto row = static_cast<std::size_t>((x * kCells + y) * kCells);
      const std::size_t first = begins_[row + static_cast<std::size_t>(z0)];
      const std::size_t last = begins_[row + static_cast<std::size_t>(z1) + 1];
      for (std::size_t i = first; i < last; ++i) {
        const Guise& guise = guises_[i];
        if (guise.up.dot(query.up) < 0 || guise.up.cross(query.up).norm() > kMostSine) continue;
        weigh(query, guise, found, most);
      }
    }
  }
  // Equal costs keep the order of their events: cells do not.
  std::sort(found.begin(), found.end(), [](const Aim& a, const Aim& b) {
    if (a.cost != b.cost) return a.cost < b.cost;
    return a.event != b.event ? a.event < b.event : a.symmetry < b.symmetry;
  });
  std::vector<Aim> best;
  for (const Aim& aim : found) {
    if (best.size() == count) break;
    const bool isNew = std::none_of(best.begin(), best.end(),
                                    [&](const Aim& other) { return other.event == aim.event; });
    if (isNew) best.push_back(aim);
  }
  return best;
}

}  // namespace ifa
