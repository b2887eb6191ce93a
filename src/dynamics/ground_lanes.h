// SPDX-License-Identifier: Apache-2.0
// Heights of the hull's vertices over the ground for many lanes: what GroundWatch is for one.
#ifndef IFA_DYNAMICS_GROUND_LANES_H
#define IFA_DYNAMICS_GROUND_LANES_H

#include <algorithm>
#include <bit>
#include <numeric>
#include <vector>

#include "dynamics/ground_watch.h"
#include "dynamics/lane_state.h"

namespace ifa {

/// Numbers for each lane, row by row.
template <class R>
class LaneRows {
 public:
  static constexpr std::size_t kLanes = LaneTraits<R>::kLanes;

  explicit LaneRows(std::size_t rows) : rows_(rows) {}

  [[nodiscard]] const double* row(int i) const { return rows_[static_cast<std::size_t>(i)].lanes; }
  [[nodiscard]] double* row(int i) { return rows_[static_cast<std::size_t>(i)].lanes; }
  [[nodiscard]] R operator[](int i) const { return loadLanes<R>(row(i)); }
  /// Each lane's own row.
  [[nodiscard]] R at(const typename LaneTraits<R>::Index& i) const {
    return fromRows<R>(rows_[0].lanes, i);
  }

 private:
  struct alignas(kLanes * sizeof(double)) Row {
    double lanes[kLanes];
  };

  std::vector<Row> rows_;
};

/// Where few vertices are always looked at whole, all lanes share one list; else each has its own,
/// and rates are worked out when they are asked for: few are. Not thread safe. The model must
/// outlive it.
template <class R>
class GroundLanes {
 public:
  static constexpr std::size_t kLanes = LaneTraits<R>::kLanes;
  using Index = typename LaneTraits<R>::Index;
  /// Numbers of a listed vertex: x, y, z and its own.
  static constexpr int kListed = 4;

  explicit GroundLanes(const BodyModel& body);

  /// All lanes share one list: list() and takeLists() are not to be called.
  [[nodiscard]] bool shared() const { return shared_; }
  /// Writes a list, kListed numbers for each vertex that is no higher than `margin` while the body
  /// is as in `height` and `up`, in the hull's order. Returns its length.
  int list(double height, const Vec<double>& up, double margin, double* to) const;
  /// Takes the list of each lane.
  void takeLists(const double* const* lists, const R& counts);

  void measure(const KernelState<R>& state, const Rotation<R>& rotation) {
    measure(state, rotation, frames_[now_]);
  }
  void measureNext(const KernelState<R>& state, const Rotation<R>& rotation) {
    measure(state, rotation, frames_[1 - now_]);
  }
  void goOn() { now_ = 1 - now_; }

  /// Of the lane that lists most; what another has not is far above the ground.
  [[nodiscard]] int count() const { return count_; }
  [[nodiscard]] R gap(int i) const { return frames_[now_].gap[i]; }
  [[nodiscard]] R rate(int i) const { return rate(frames_[now_], i); }
  [[nodiscard]] R nextGap(int i) const { return frames_[1 - now_].gap[i]; }
  [[nodiscard]] R nextRate(int i) const { return rate(frames_[1 - now_], i); }
  /// No rate is larger, m/s.
  [[nodiscard]] R mostRate() const {
    const Frame& now = frames_[now_];
    const R turn = laneAbs(now.turn.x) + laneAbs(now.turn.y) + laneAbs(now.turn.z);
    return R(1.001) * (laneAbs(now.rise) + R(body_.radius) * turn);
  }
  [[nodiscard]] Vec<R> place(int i) const {
    const auto k = static_cast<std::size_t>(i);
    if (shared_) return {R(body_.rows.x[k]), R(body_.rows.y[k]), R(body_.rows.z[k])};
    return {listed(0, i), listed(1, i), listed(2, i)};
  }

  [[nodiscard]] R gapAt(const Index& i) const { return frames_[now_].gap.at(i); }
  [[nodiscard]] R rateAt(const Index& i) const {
    const Frame& now = frames_[now_];
    return shared_ ? now.rates.at(i) : now.rate(placeAt(i));
  }
  [[nodiscard]] Vec<R> placeAt(const Index& i) const {
    if (!shared_) return {listedAt(0, i), listedAt(1, i), listedAt(2, i)};
    return {fromTable<R>(body_.rows.x.data(), i), fromTable<R>(body_.rows.y.data(), i),
            fromTable<R>(body_.rows.z.data(), i)};
  }
  [[nodiscard]] R vertexAt(const Index& i) const {
    return shared_ ? fromTable<R>(numbers_.data(), i) : listedAt(3, i);
  }

 private:
  struct Frame {
    explicit Frame(std::size_t rows) : gap(rows), rates(rows) {}
    [[nodiscard]] R rate(const Vec<R>& p) const {
      return rise + (p.x * turn.x + p.y * turn.y + p.z * turn.z);
    }
    LaneRows<R> gap, rates;  ///< rates where the list is shared
    R rise{};                ///< and where it is not what they are made of
    Vec<R> turn{};
  };

  [[nodiscard]] R rate(const Frame& frame, int i) const {
    return shared_ ? frame.rates[i] : frame.rate(place(i));
  }
  [[nodiscard]] R listed(int field, int i) const { return lists_[i * kListed + field]; }
  [[nodiscard]] R listedAt(int field, const Index& i) const {
    return fromRows<R>(lists_.row(field), times<kListed>(i));
  }

  void measure(const KernelState<R>& state, const Rotation<R>& rotation, Frame& frame);

  const BodyModel& body_;
  bool shared_;
  int count_;
  std::vector<double> numbers_;   ///< 0, 1, 2 ...
  std::vector<double> vertices_;  ///< kListed numbers for each
  LaneRows<R> rows_;              ///< x, y and z of as many vertices as there are lanes, and so on
  LaneRows<R> lists_;             ///< kListed rows for each place in the lists
  R counts_{};
  Frame frames_[2];
  int now_ = 0;
};

template <class R>
GroundLanes<R>::GroundLanes(const BodyModel& body)
    : body_(body),
      shared_(body.x.size() <= GroundWatch::kFew),
      count_(shared_ ? static_cast<int>(body.x.size()) : 0),
      numbers_(body.x.size()),
      rows_(3 * (body.x.size() + kLanes - 1) / kLanes + 3),
      lists_(shared_ ? 0 : kListed * body.rows.size()),
      frames_{Frame(body.rows.size()), Frame(body.rows.size())} {
  std::iota(numbers_.begin(), numbers_.end(), 0.0);
  for (std::size_t i = 0; i < body.x.size(); ++i) {
    const double place[3] = {body.x[i], body.y[i], body.z[i]};
    for (std::size_t k = 0; k < 3; ++k) {
      rows_.row(static_cast<int>(3 * (i / kLanes) + k))[i % kLanes] = place[k];
      vertices_.push_back(place[k]);
    }
    vertices_.push_back(static_cast<double>(i));
  }
}

template <class R>
int GroundLanes<R>::list(double height, const Vec<double>& up, double margin, double* to) const {
  const R base(height), x(up.x), y(up.y), z(up.z), most(margin);
  double* next = to;
  for (std::size_t begin = 0; begin < body_.x.size(); begin += kLanes) {
    const int row = static_cast<int>(3 * (begin / kLanes));
    const R gap = base + (rows_[row] * x + rows_[row + 1] * y + rows_[row + 2] * z);
    const std::size_t size = std::min(kLanes, body_.x.size() - begin);
    unsigned bits = laneBits(gap <= most) & ((1U << size) - 1);
    for (; bits != 0; bits &= bits - 1, next += kListed) {
      const std::size_t i = begin + static_cast<std::size_t>(std::countr_zero(bits));
      std::copy_n(vertices_.data() + i * kListed, kListed, next);
    }
  }
  return static_cast<int>(next - to) / kListed;
}

template <class R>
void GroundLanes<R>::takeLists(const double* const* lists, const R& counts) {
  alignas(kLanes * sizeof(double)) double each[kLanes];
  storeLanes(counts, each);
  counts_ = counts;
  count_ = static_cast<int>(*std::max_element(each, each + kLanes));
  constexpr int kPerBlock = static_cast<int>(kBlock) / kListed;
  for (int i = 0; i < count_; i += kPerBlock) {
    loadBlock(lists, static_cast<std::size_t>(i * kListed), lists_.row(i * kListed));
  }
}

template <class R>
void GroundLanes<R>::measure(const KernelState<R>& state, const Rotation<R>& rotation,
                             Frame& frame) {
  const R height = state.position.z, rise = state.velocity.z, far(1e9);
  const Vec<R> up = rotation.rows[2], turn = cross(up, state.w);
  double* gap = frame.gap.row(0);
  const auto count = static_cast<std::size_t>(count_);
  if (shared_) {
    const double *x = body_.rows.x.data(), *y = body_.rows.y.data(), *z = body_.rows.z.data();
    double* rates = frame.rates.row(0);
    for (std::size_t i = 0; i < count; ++i) {
      const Vec<R> p = {R(x[i]), R(y[i]), R(z[i])};
      storeLanes(height + (p.x * up.x + p.y * up.y + p.z * up.z), gap + i * kLanes);
      storeLanes(rise + (p.x * turn.x + p.y * turn.y + p.z * turn.z), rates + i * kLanes);
    }
    return;
  }
  frame.rise = rise;
  frame.turn = turn;
  const double* at = lists_.row(0);
  for (std::size_t i = 0; i < count; ++i, at += kListed * kLanes) {
    const R x = loadLanes<R>(at), y = loadLanes<R>(at + kLanes), z = loadLanes<R>(at + 2 * kLanes);
    const R over = height + (x * up.x + y * up.y + z * up.z);
    storeLanes(select(R(static_cast<double>(i)) < counts_, over, far), gap + i * kLanes);
  }
}

}  // namespace ifa

#endif
