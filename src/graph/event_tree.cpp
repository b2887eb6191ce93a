// SPDX-License-Identifier: Apache-2.0
#include "graph/event_tree.h"

#include <algorithm>
#include <limits>
#include <queue>

namespace ifa {

namespace {

/// What is still to be looked into: a node, or a leaf.
struct Branch {
  float weight;
  std::uint32_t child;
  std::uint32_t query;

  /// Worse first, as std::priority_queue wants it.
  bool operator<(const Branch& other) const {
    if (weight != other.weight) return weight < other.weight;
    return child != other.child ? child > other.child : query > other.query;
  }
};

constexpr float kNone = -std::numeric_limits<float>::infinity();
/// Finds kept beyond those asked for, where rounding may have put them in the wrong order.
constexpr std::size_t kSpare = 8;

/// The best so far, best first.
class Shortlist {
 public:
  /// @param several  a sibling may come more than once: its best find is kept
  Shortlist(std::size_t count, bool several) : count_(count), several_(several) {
    finds_.reserve(count + kSpare + 1);
  }

  /// A find with less is not taken: the worst of those asked for, less what rounding does.
  [[nodiscard]] float least() const { return least_; }
  void add(const TreeFind& find) {
    if (several_ && !replaces(find)) return;
    finds_.insert(std::upper_bound(finds_.begin(), finds_.end(), find), find);
    if (finds_.size() > count_ + kSpare) finds_.pop_back();
    if (finds_.size() >= count_) least_ = finds_[count_ - 1].total * 1.0001F - 0.001F;
  }
  /// Takes what is worth it of a leaf.
  void addLeaf(const float* leaf, const TreeQuery& query, std::uint32_t number) {
    alignas(64) std::array<float, kLeafEvents> weights{};
    weighLeaf(leaf, query, weights.data());
    const auto* siblings =
        reinterpret_cast<const std::uint32_t*>(leaf + kTreeColumns * kLeafEvents);
    for (std::size_t i = 0; i < kLeafEvents; ++i)
      if (weights[i] > kNone && weights[i] >= least_) add({weights[i], siblings[i], number});
  }
  [[nodiscard]] std::vector<TreeFind> take() {
    while (!finds_.empty() && finds_.back().total < least_) finds_.pop_back();
    return std::move(finds_);
  }

 private:
  /// Makes room for a find that is better than what its sibling has; false where it is not.
  bool replaces(const TreeFind& find) {
    const auto same = std::find_if(finds_.begin(), finds_.end(), [&](const TreeFind& other) {
      return other.sibling == find.sibling;
    });
    if (same == finds_.end()) return true;
    if (*same < find) return false;
    finds_.erase(same);
    return true;
  }

  std::size_t count_;
  bool several_;
  float least_ = kNone;
  std::vector<TreeFind> finds_;
};

}  // namespace

std::vector<TreeFind> EventTree::find(std::span<const TreeQuery> queries, std::size_t count,
                                      std::size_t mostLeaves) const {
  if (leaves_ == 0 || count == 0) return {};
  Shortlist best(std::min(count, leaves_ * kLeafEvents), queries.size() > 1);
  std::priority_queue<Branch> queue;
  for (std::uint32_t i = 0; i < queries.size(); ++i) queue.push({0, 0, i});
  alignas(64) std::array<float, kFanOut> weights{};
  std::size_t left = mostLeaves == 0 ? leaves_ * queries.size() : mostLeaves;
  while (!queue.empty()) {
    const Branch branch = queue.top();
    if (branch.weight < best.least()) break;
    queue.pop();
    const TreeQuery& query = queries[branch.query];
    if ((branch.child & TreeNode::kLeafBit) == 0) {
      const TreeNode& node = nodes_[branch.child];
      weighBoxes(node, query, weights.data());
      for (std::size_t i = 0; i < kFanOut; ++i) {
        const bool there = node.child[i] != TreeNode::kNoChild && weights[i] > kNone;
        if (there && weights[i] >= best.least())
          queue.push({weights[i], node.child[i], branch.query});
      }
      continue;
    }
    best.addLeaf(leaf(branch.child & ~TreeNode::kLeafBit), query, branch.query);
    if (--left == 0) break;
  }
  return best.take();
}

std::vector<TreeFind> EventTree::scan(const TreeQuery& query, std::size_t count) const {
  if (leaves_ == 0 || count == 0) return {};
  Shortlist best(std::min(count, leaves_ * kLeafEvents), false);
  for (std::size_t i = 0; i < leaves_; ++i) best.addLeaf(leaf(i), query, 0);
  return best.take();
}

const float* EventTree::leaf(std::size_t number) const {
  return reinterpret_cast<const float*>(&events_[number * kLeafEvents]);
}

std::size_t EventTree::bytes() const {
  return events_.size() * sizeof(TreeEvent) + nodes_.size() * sizeof(TreeNode);
}

}  // namespace ifa
