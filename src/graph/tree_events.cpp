// SPDX-License-Identifier: Apache-2.0
#include "graph/tree_events.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "base/parallel.h"
#include "graph/edge_weight.h"

namespace ifa {

namespace {

using Eigen::Vector3d;

constexpr std::size_t kBlock = 1U << 14;   // events of one task
constexpr std::size_t kSample = 1U << 14;  // events that the scales are taken from

/// Where the body leaves `event`, without reading what is not needed.
RigidState leaving(const EventDatabase& database, std::size_t event) {
  const auto at = [&](std::size_t column) {
    return database.values(static_cast<Column>(column))[event];
  };
  PackedState packed;
  packed.height = at(kAfterHeight);
  for (std::size_t i = 0; i < 4; ++i) packed.orientation[i] = at(kAfterW + i);
  for (std::size_t i = 0; i < 3; ++i) packed.angularVelocity[i] = at(kAfterSpinX + i);
  return unpack(packed);
}

TreeEvent treeEvent(const EventDatabase& database, const SymmetryGroup& group,
                    const Folding& folding, std::size_t j) {
  const auto value = [&](Column column, std::size_t event) -> double {
    return database.values(column)[event];
  };
  const RigidState state = leaving(database, j);
  const double time = value(kGap, j);
  const Vector3d way(value(kNextX, j) - value(kShiftX, j), value(kNextY, j) - value(kShiftY, j),
                     value(kBeforeHeight, j + 1) - state.position.z());
  const Eigen::Quaterniond inverse = state.orientation.conjugate();
  const HeardEvent heard = heardEvent(database, j + 1, 1);
  TreeEvent event{};
  const auto set = [&](TreeColumn column, const Vector3d& v) {
    for (int i = 0; i < 3; ++i)
      event.values[column + static_cast<std::size_t>(i)] = static_cast<float>(v[i]);
  };
  const Vector3d up = inverse * Vector3d::UnitZ();
  const std::size_t element = folding.elementOf(up);
  const Eigen::Matrix3d fold = group.elements()[element].transpose();
  set(kUpX, fold * up);
  set(kFlightX, fold * (inverse * way) / time);
  set(kSpinX, (group.isRotation(element) ? 1 : -1) * (fold * (inverse * state.angularVelocity)));
  event.values[kTime] = static_cast<float>(time);
  event.values[kHeardLoud] = static_cast<float>(heard.amplitude);
  event.values[kHeardDuration] = static_cast<float>(heard.duration);
  event.values[kHeardCentroid] = heard.duration > 0 ? static_cast<float>(heard.centroid) : 0;
  event.values[kHeight] = static_cast<float>(state.position.z());
  event.sibling = static_cast<std::uint32_t>(j);
  return event;
}

/// Which tree the flight from `j` belongs to: 0 onward, 1 ending, -1 none.
int treeOf(std::span<const std::uint8_t> flags, std::span<const float> gaps, std::size_t j) {
  if (!isLeftByFlight(flags, j) || !(gaps[j] > 0)) return -1;
  return (flags[j + 1] & EventRecord::kTerminal) != 0 ? 1 : 0;
}

}  // namespace

Folding::Folding(const SymmetryGroup& group) {
  // Any direction will do that no element leaves alone.
  const Vector3d direction = Vector3d(0.37, 0.54, 0.755).normalized();
  for (const Eigen::Matrix3d& element : group.elements())
    directions_.emplace_back(element * direction);
}

std::size_t Folding::elementOf(const Vector3d& up) const {
  std::size_t best = 0;
  double nearest = -2;
  for (std::size_t i = 0; i < directions_.size(); ++i) {
    const double cosine = directions_[i].dot(up);
    if (cosine > nearest) std::tie(best, nearest) = std::pair(i, cosine);
  }
  return best;
}

std::size_t Folding::elementOf(const EventDatabase& database, std::size_t event) const {
  return elementOf(leaving(database, event).orientation.conjugate() * Vector3d::UnitZ());
}

Result<TreeEvents> treeEvents(const EventDatabase& database, const SymmetryGroup& group,
                              const Progress& progress) {
  const Folding folding(group);
  const auto flags = database.flags();
  const auto gaps = database.values(kGap);
  const std::size_t blocks = (flags.size() + kBlock - 1) / kBlock;
  const auto each = [&](std::size_t block, const auto& take) {
    const std::size_t end = std::min(flags.size(), (block + 1) * kBlock);
    for (std::size_t j = block * kBlock; j < end; ++j) {
      const int tree = treeOf(flags, gaps, j);
      if (tree >= 0) take(static_cast<std::size_t>(tree), j);
    }
  };
  // How many each block has gives each a place of its own.
  std::vector<std::array<std::size_t, 2>> places(blocks + 1);
  parallelFor(blocks, [&](std::size_t block) {
    each(block, [&](std::size_t tree, std::size_t) { ++places[block + 1][tree]; });
  });
  for (std::size_t block = 0; block < blocks; ++block)
    for (std::size_t tree = 0; tree < 2; ++tree) places[block + 1][tree] += places[block][tree];
  TreeEvents events;
  const std::array<std::vector<TreeEvent>*, 2> trees = {&events.onward, &events.ending};
  for (std::size_t tree = 0; tree < 2; ++tree) {
    trees[tree]->reserve(places[blocks][tree] + kLeafEvents);  // the tree fills up its last leaf
    trees[tree]->resize(places[blocks][tree]);
  }
  parallelFor(blocks, [&](std::size_t block) {
    if (progress.stopRequested()) return;
    auto place = places[block];
    each(block, [&](std::size_t tree, std::size_t j) {
      (*trees[tree])[place[tree]++] = treeEvent(database, group, folding, j);
    });
  });
  if (progress.stopRequested())
    return tl::unexpected<Error>({ErrorCode::kInterrupted, "interrupted", {}, {}});
  return events;
}

TreeScales treeScales(const EventDatabase& database, const AffinityParameters& p) {
  double change = 0, turn = 0, speed = 1e-9, spin = 1e-9, loud = 1e-12, count = 0;
  const std::size_t stride = std::max<std::size_t>(1, database.events() / kSample);
  for (std::size_t i = 0; i < database.events(); i += stride, ++count) {
    const EventRecord record = database.record(i);
    const RigidState before = unpack(record.before), after = unpack(record.after);
    change += (after.velocity - before.velocity).norm();
    turn += (after.angularVelocity - before.angularVelocity).norm();
    speed += after.velocity.norm();
    spin += after.angularVelocity.norm();
    loud += record.amplitude;
  }
  const double reference = database.header().identity.settings.referenceImpulse;
  const auto typical = [](double size, double tangent) {
    return size * std::cbrt(tangent * tangent);
  };
  TreeScales scales;
  scales.velocity = static_cast<float>(typical(p.maxRelativeLinear, p.tanLinear) * change / speed);
  // Fewer cuts across the spin serve better than its narrow region suggests: measured.
  scales.spin = static_cast<float>(4 * typical(p.maxRelativeAngular, p.tanAngular) * turn / spin);
  scales.amplitude =
      static_cast<float>((reference > 0 ? reference : loud / count) / std::sqrt(p.amplitude));
  scales.sound = static_cast<float>(1 / std::sqrt(p.duration));
  return scales;
}

}  // namespace ifa
