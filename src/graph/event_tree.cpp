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

constexpr float kNone = -std::numeric_limits<float>::infinity();
/// Finds kept beyond those asked for, where rounding may have put them in the wrong order.
constexpr std::size_t kSpare = 8;

/// The best so far, best first.
class Shortlist {
 public:
  explicit Shortlist(std::size_t count) : count_(count) { finds_.reserve(count + kSpare + 1); }

  /// A find with less is not taken: the worst of those asked for, less what rounding does.
  [[nodiscard]] float least() const { return least_; }
  void add(const TreeFind& find) {
    finds_.insert(std::upper_bound(finds_.begin(), finds_.end(), find), find);
    if (finds_.size() > count_ + kSpare) finds_.pop_back();
    if (finds_.size() >= count_) least_ = finds_[count_ - 1].total * 1.0001F - 0.001F;
  }
  /// Takes what is worth it of a leaf.
  void addLeaf(const float* leaf, const TreeQuery& query) {
    alignas(64) std::array<float, kLeafEvents> weights{};
    weighLeaf(leaf, query, weights.data());
    const auto* siblings =
        reinterpret_cast<const std::uint32_t*>(leaf + kTreeColumns * kLeafEvents);
    for (std::size_t i = 0; i < kLeafEvents; ++i)
      if (weights[i] > kNone && weights[i] >= least_) add({weights[i], siblings[i]});
  }
  [[nodiscard]] std::vector<TreeFind> take() {
    while (!finds_.empty() && finds_.back().total < least_) finds_.pop_back();
    return std::move(finds_);
  }

 private:
  std::size_t count_;
  float least_ = kNone;
  std::vector<TreeFind> finds_;
};

}  // namespace

std::vector<TreeFind> EventTree::find(const TreeQuery& query, std::size_t count,
                                      std::size_t mostLeaves) const {
  if (leaves_ == 0 || count == 0) return {};
  Shortlist best(std::min(count, leaves_ * kLeafEvents));
  std::priority_queue<Branch> queue;
  queue.push({0, 0});
  alignas(64) std::array<float, kFanOut> weights{};
  for (std::size_t left = mostLeaves == 0 ? leaves_ : mostLeaves; !queue.empty();) {
    const Branch branch = queue.top();
    if (branch.weight < best.least()) break;
    queue.pop();
    if ((branch.child & TreeNode::kLeafBit) == 0) {
      const TreeNode& node = nodes_[branch.child];
      weighBoxes(node, query, weights.data());
      for (std::size_t i = 0; i < kFanOut; ++i) {
        const bool there = node.child[i] != TreeNode::kNoChild && weights[i] > kNone;
        if (there && weights[i] >= best.least()) queue.push({weights[i], node.child[i]});
      }
      continue;
    }
    best.addLeaf(leaf(branch.child & ~TreeNode::kLeafBit), query);
    if (--left == 0) break;
  }
  return best.take();
}

std::vector<TreeFind> EventTree::scan(const TreeQuery& query, std::size_t count) const {
  if (leaves_ == 0 || count == 0) return {};
  Shortlist best(std::min(count, leaves_ * kLeafEvents));
  for (std::size_t i = 0; i < leaves_; ++i) best.addLeaf(leaf(i), query);
  return best.take();
}

const float* EventTree::leaf(std::size_t number) const {
  return reinterpret_cast<const float*>(&events_[number * kLeafEvents]);
}

std::size_t EventTree::bytes() const {
  return events_.size() * sizeof(TreeEvent) + nodes_.size() * sizeof(TreeNode);
}

}  // namespace ifa
