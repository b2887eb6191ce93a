// SPDX-License-Identifier: Apache-2.0
#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <span>

#include "base/parallel.h"
#include "graph/event_tree.h"

namespace ifa {

namespace {

static_assert(sizeof(TreeEvent) == (kTreeColumns + 1) * sizeof(float));

constexpr std::size_t kSample = 512;          // events whose spread stands for a range's
constexpr std::size_t kOwnThread = 1U << 14;  // events worth a task of their own
constexpr std::uint32_t kNobody = 0xFFFFFFFFU;

std::size_t leavesOf(std::size_t events) { return (events + kLeafEvents - 1) / kLeafEvents; }

/// Leaves of each child of a node over so many, the last child's apart: a power of the fan-out, so
/// that nodes are full.
std::size_t childLeaves(std::size_t leaves) {
  std::size_t unit = 1;
  while (unit * kFanOut < leaves) unit *= kFanOut;
  return unit;
}

/// Means and standard deviations of a range, from some of it.
struct Spread {
  std::array<float, kTreeColumns> mean{}, deviation{};

  explicit Spread(std::span<const TreeEvent> events) {
    const std::size_t stride = std::max<std::size_t>(1, events.size() / kSample);
    std::array<double, kTreeColumns> sum{}, squares{};
    double count = 0;
    for (std::size_t i = 0; i < events.size(); i += stride, ++count) {
      for (std::size_t a = 0; a < kTreeColumns; ++a) {
        const double x = coordinate(events[i], a);
        sum[a] += x;
        squares[a] += x * x;
      }
    }
    for (std::size_t a = 0; a < kTreeColumns; ++a) {
      const double m = sum[a] / count;
      mean[a] = static_cast<float>(m);
      deviation[a] = static_cast<float>(std::sqrt(std::max(0.0, squares[a] / count - m * m)));
    }
  }

 private:
  static double coordinate(const TreeEvent& event, std::size_t axis) { return event.values[axis]; }
};

float lengthOf(const Spread& s, std::size_t axis) {
  float sum = 0;
  for (std::size_t a = axis; a < axis + 3; ++a)
    sum += s.mean[a] * s.mean[a] + s.deviation[a] * s.deviation[a];
  return std::sqrt(sum);
}

/// The axis along which a range is widest in units of what the factors tell apart.
std::size_t widestAxis(std::span<const TreeEvent> events, const TreeScales& scales) {
  const Spread spread(events);
  const float time = std::max(spread.mean[kTime], 1e-3F);
  const auto unit = [&](std::size_t axis) {
    if (axis <= kUpZ) return 0.7F * std::min(time, 0.2F);
    if (axis <= kFlightZ) return scales.velocity * lengthOf(spread, kFlightX);
    if (axis <= kSpinZ) return scales.spin * lengthOf(spread, kSpinX);
    if (axis == kTime) return 0.1F * time;
    return axis == kHeardLoud ? scales.amplitude : scales.sound;
  };
  std::size_t widest = 0;
  float most = -1;
  for (std::size_t axis = 0; axis < kHeight; ++axis) {
    const float width = spread.deviation[axis] / std::max(unit(axis), 1e-12F);
    if (width > most) {
      most = width;
      widest = axis;
    }
  }
  return widest;
}

/// Sorts so that the first `leaves` leaves hold what is lower along the widest axis.
void halve(std::span<TreeEvent> events, std::size_t leaves, const TreeScales& scales) {
  const std::size_t axis = widestAxis(events, scales);
  std::nth_element(events.begin(),
                   events.begin() + static_cast<std::ptrdiff_t>(leaves * kLeafEvents), events.end(),
                   [axis](const TreeEvent& a, const TreeEvent& b) {
                     const float x = a.values[axis], y = b.values[axis];
                     return x != y ? x < y : a.sibling < b.sibling;
                   });
}

/// Puts a range into the order of its leaves, by halving the children of its node, then theirs.
void sortRange(std::span<TreeEvent> events, const TreeScales& scales) {
  if (events.size() <= kLeafEvents) return;
  const std::size_t leaves = leavesOf(events.size()), unit = childLeaves(leaves);
  const std::size_t low = (leaves + unit - 1) / unit / 2 * unit;
  halve(events, low, scales);
  const auto left = [&] { sortRange(events.first(low * kLeafEvents), scales); };
  const auto right = [&] { sortRange(events.subspan(low * kLeafEvents), scales); };
  if (events.size() < kOwnThread) {
    left();
    right();
  } else {
    tbb::parallel_invoke(left, right);
  }
}

}  // namespace

/// Makes the nodes over sorted events. Ranges are parted as sortRange did it.
class TreeBuilder {
 public:
  explicit TreeBuilder(EventTree& tree) : tree_(tree) {}

  void makeNodes() {
    tree_.nodes_.emplace_back();
    fill(0, 0, tree_.leaves_);
  }
  /// Columns instead of rows within each leaf.
  void transposeLeaves() {
    constexpr std::size_t kBlock = 1024;
    parallelFor((tree_.leaves_ + kBlock - 1) / kBlock, [&](std::size_t block) {
      const std::size_t end = std::min(tree_.leaves_, (block + 1) * kBlock);
      for (std::size_t leaf = block * kBlock; leaf < end; ++leaf) transpose(leaf);
    });
  }

 private:
  struct Child {
    std::size_t first, leaves;
  };

  void transpose(std::size_t leaf) {
    constexpr std::size_t kWords = kTreeColumns + 1;
    TreeEvent* events = &tree_.events_[leaf * kLeafEvents];
    std::array<std::array<std::uint32_t, kLeafEvents>, kWords> columns;
    for (std::size_t i = 0; i < kLeafEvents; ++i) {
      std::array<std::uint32_t, kWords> row;
      std::memcpy(row.data(), &events[i], sizeof row);
      for (std::size_t c = 0; c < kWords; ++c) columns[c][i] = row[c];
    }
    std::memcpy(static_cast<void*>(events), columns.data(), sizeof columns);
  }

  /// Node `node` over leaves first to first + count - 1.
  void fill(std::size_t node, std::size_t first, std::size_t count) {
    tree_.nodes_[node].child.fill(TreeNode::kNoChild);
    for (auto& row : tree_.nodes_[node].low) row.fill(0);
    for (auto& row : tree_.nodes_[node].high) row.fill(0);
    const std::size_t unit = childLeaves(count);
    for (std::size_t i = 0; i * unit < count; ++i)
      addChild(node, i, {first + i * unit, std::min(unit, count - i * unit)});
  }

  void addChild(std::size_t node, std::size_t i, const Child& child) {
    std::array<float, kTreeColumns> low, high;
    if (child.leaves == 1) {
      boxOfLeaf(child.first, low, high);
      tree_.nodes_[node].child[i] = static_cast<std::uint32_t>(child.first) | TreeNode::kLeafBit;
    } else {
      const std::size_t below = tree_.nodes_.size();
      tree_.nodes_.emplace_back();
      fill(below, child.first, child.leaves);
      tree_.nodes_[node].child[i] = static_cast<std::uint32_t>(below);
      boxOfNode(tree_.nodes_[below], low, high);
    }
    for (std::size_t a = 0; a < kTreeColumns; ++a) {
      tree_.nodes_[node].low[a][i] = low[a];
      tree_.nodes_[node].high[a][i] = high[a];
    }
  }

  using Bounds = std::array<float, kTreeColumns>;

  void boxOfLeaf(std::size_t leaf, Bounds& low, Bounds& high) const {
    low.fill(std::numeric_limits<float>::max());
    high.fill(std::numeric_limits<float>::lowest());
    for (std::size_t i = 0; i < kLeafEvents; ++i) {
      const TreeEvent& event = tree_.events_[leaf * kLeafEvents + i];
      if (event.sibling == kNobody) break;
      for (std::size_t a = 0; a < kTreeColumns; ++a) {
        low[a] = std::min(low[a], event.values[a]);
        high[a] = std::max(high[a], event.values[a]);
      }
    }
  }

  static void boxOfNode(const TreeNode& node, Bounds& low, Bounds& high) {
    for (std::size_t a = 0; a < kTreeColumns; ++a) {
      low[a] = node.low[a][0];
      high[a] = node.high[a][0];
      for (std::size_t i = 1; i < kFanOut && node.child[i] != TreeNode::kNoChild; ++i) {
        low[a] = std::min(low[a], node.low[a][i]);
        high[a] = std::max(high[a], node.high[a][i]);
      }
    }
  }

  EventTree& tree_;
};

EventTree::EventTree(std::vector<TreeEvent> events, const TreeScales& scales)
    : leaves_(leavesOf(events.size())), events_(std::move(events)) {
  if (leaves_ == 0) return;
  sortRange(events_, scales);
  // The last leaf is filled up with events that no query takes: infinitely loud.
  TreeEvent nobody = events_.back();
  nobody.sibling = kNobody;
  nobody.values[kHeardLoud] = std::numeric_limits<float>::infinity();
  events_.resize(leaves_ * kLeafEvents, nobody);
  TreeBuilder builder(*this);
  builder.makeNodes();
  builder.transposeLeaves();
}

}  // namespace ifa
