// SPDX-License-Identifier: Apache-2.0
// Heights of the hull's vertices over the ground for many lanes: what GroundWatch is for one.
#ifndef IFA_DYNAMICS_GROUND_LANES_H
#define IFA_DYNAMICS_GROUND_LANES_H

#include <algorithm>
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

/// Where few vertices are always looked at whole, all lanes share one list; else each has that of
/// its own GroundWatch. Not thread safe. The model must outlive it.
template <class R>
class GroundLanes {
 public:
  static constexpr std::size_t kLanes = LaneTraits<R>::kLanes;
  using Index = typename LaneTraits<R>::Index;

  explicit GroundLanes(const BodyModel& body)
      : body_(body),
        shared_(GroundWatch(body).all()),
        count_(shared_ ? static_cast<int>(body.x.size()) : 0),
        numbers_(body.x.size()),
        lists_(shared_ ? 0 : kFields * body.rows.size()),
        frames_{Frame(body.rows.size()), Frame(body.rows.size())} {
    std::iota(numbers_.begin(), numbers_.end(), 0.0);
  }

  /// Takes each lane's list, where they are not shared.
  void takeLists(const GroundWatch* const* watches);

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
  [[nodiscard]] R rate(int i) const { return frames_[now_].rate[i]; }
  [[nodiscard]] R nextGap(int i) const { return frames_[1 - now_].gap[i]; }
  [[nodiscard]] R nextRate(int i) const { return frames_[1 - now_].rate[i]; }
  [[nodiscard]] Vec<R> place(int i) const {
    const auto k = static_cast<std::size_t>(i);
    if (shared_) return {R(body_.rows.x[k]), R(body_.rows.y[k]), R(body_.rows.z[k])};
    return {list(0, i), list(1, i), list(2, i)};
  }

  [[nodiscard]] R gapAt(const Index& i) const { return frames_[now_].gap.at(i); }
  [[nodiscard]] R rateAt(const Index& i) const { return frames_[now_].rate.at(i); }
  [[nodiscard]] Vec<R> placeAt(const Index& i) const {
    if (!shared_) return {listAt(0, i), listAt(1, i), listAt(2, i)};
    return {fromTable<R>(body_.rows.x.data(), i), fromTable<R>(body_.rows.y.data(), i),
            fromTable<R>(body_.rows.z.data(), i)};
  }
  [[nodiscard]] R vertexAt(const Index& i) const {
    return shared_ ? fromTable<R>(numbers_.data(), i) : listAt(3, i);
  }

 private:
  struct Frame {
    explicit Frame(std::size_t rows) : gap(rows), rate(rows) {}
    LaneRows<R> gap, rate;
  };
  static constexpr int kFields = GroundWatch::kListed;

  [[nodiscard]] R list(int field, int i) const { return lists_[i * kFields + field]; }
  [[nodiscard]] R listAt(int field, const Index& i) const {
    return fromRows<R>(lists_.row(field), times<kFields>(i));
  }

  void measure(const KernelState<R>& state, const Rotation<R>& rotation, Frame& frame);

  const BodyModel& body_;
  bool shared_;
  int count_;
  std::vector<double> numbers_;  ///< 0, 1, 2 ...
  LaneRows<R> lists_;            ///< kFields rows for each, -1 where a lane has no more
  Frame frames_[2];
  int now_ = 0;
};

template <class R>
void GroundLanes<R>::takeLists(const GroundWatch* const* watches) {
  count_ = 0;
  const double* from[kLanes];
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    count_ = std::max(count_, watches[lane]->count());
    from[lane] = watches[lane]->listed();
  }
  constexpr int kPerBlock = static_cast<int>(kBlock) / kFields;
  for (int i = 0; i < count_; i += kPerBlock) {
    loadBlock(from, static_cast<std::size_t>(i * kFields), lists_.row(i * kFields));
  }
}

template <class R>
void GroundLanes<R>::measure(const KernelState<R>& state, const Rotation<R>& rotation,
                             Frame& frame) {
  const R height = state.position.z, rise = state.velocity.z, zero(0.0), far(1e9);
  const Vec<R> up = rotation.rows[2], turn = cross(up, state.w);
  double *gap = frame.gap.row(0), *rate = frame.rate.row(0);
  const double *x = body_.rows.x.data(), *y = body_.rows.y.data(), *z = body_.rows.z.data();
  const double* list = shared_ ? nullptr : lists_.row(0);
  for (std::size_t i = 0; i < static_cast<std::size_t>(count_); ++i) {
    const Vec<R> p = shared_ ? Vec<R>{R(x[i]), R(y[i]), R(z[i])}
                             : Vec<R>{loadLanes<R>(list), loadLanes<R>(list + kLanes),
                                      loadLanes<R>(list + 2 * kLanes)};
    R over = height + (p.x * up.x + p.y * up.y + p.z * up.z);
    if (!shared_) {
      setWhere(loadLanes<R>(list + 3 * kLanes) < zero, over, far);
      list += kFields * kLanes;
    }
    storeLanes(over, gap + i * kLanes);
    storeLanes(rise + (p.x * turn.x + p.y * turn.y + p.z * turn.z), rate + i * kLanes);
  }
}

}  // namespace ifa

#endif
