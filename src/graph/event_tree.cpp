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

  /// Worse first, as std::priority_queue wants it.
  bool operator<(const Branch& other) const {
    return weight != other.weight ? weight < other.weight : child > other.child;
  }
};

/// The best so far, best first.
class Shortlist {
 public:
  explicit Shortlist(std::size_t count) : count_(count) { finds_.reserve(count + 1); }

  /// What a find has to be better than.
  [[nodiscard]] float least() const {
    return finds_.size() < count_ ? -std::numeric_limits<float>::infinity() : finds_.back().total;
  }
  void add(const TreeFind& find) {
    if (finds_.size() == count_ && !(find < finds_.back())) return;
    finds_.insert(std::upper_bound(finds_.begin(), finds_.end(), find), find);
    if (finds_.size() > count_) finds_.pop_back();
  }
  [[nodiscard]] std::vector<TreeFind> take() { return std::move(finds_); }

 private:
  std::size_t count_;
  std::vector<TreeFind> finds_;
};

}  // namespace

std::vector<TreeFind> EventTree::find(const TreeQuery& query, std::size_t count,
                                      std::size_t mostLeaves) const {
  Shortlist best(count);
  if (leaves_ == 0 || count == 0) return {};
  std::priority_queue<Branch> queue;
  queue.push({0, 0});
  alignas(64) std::array<float, kLeafEvents> weights{};
  for (std::size_t left = mostLeaves == 0 ? leaves_ : mostLeaves; !queue.empty();) {
    const Branch branch = queue.top();
    if (branch.weight < best.least()) break;
    queue.pop();
    if ((branch.child & TreeNode::kLeafBit) == 0) {
      const TreeNode& node = nodes_[branch.child];
      weighBoxes(node, query, weights.data());
      for (std::size_t i = 0; i < kFanOut; ++i) {
        const bool there = node.child[i] != TreeNode::kNoChild &&
                           weights[i] > -std::numeric_limits<float>::infinity();
        if (there && weights[i] >= best.least()) queue.push({weights[i], node.child[i]});
      }
      continue;
    }
    const std::size_t first = (branch.child & ~TreeNode::kLeafBit) * kLeafEvents;
    const auto* leaf = reinterpret_cast<const float*>(&events_[first]);
    const auto* siblings = reinterpret_cast<const std::uint32_t*>(leaf + kTreeColumns * kLeafEvents);
    weighLeaf(leaf, query, weights.data());
    for (std::size_t i = 0; i < kLeafEvents; ++i) {
      if (weights[i] > -std::numeric_limits<float>::infinity() && weights[i] >= best.least())
        best.add({weights[i], siblings[i]});
    }
    if (--left == 0) break;
  }
  return best.take();
}

std::size_t EventTree::bytes() const {
  return events_.size() * sizeof(TreeEvent) + nodes_.size() * sizeof(TreeNode);
}

}  // namespace ifa
