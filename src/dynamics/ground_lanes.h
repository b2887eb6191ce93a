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

  [[nodiscard]] R operator[](int i) const { return loadLanes<R>(row(i)); }
  void set(int i, const R& value) { storeLanes(value, rows_[static_cast<std::size_t>(i)].lanes); }
  [[nodiscard]] double& lane(std::size_t i, std::size_t lane) { return rows_[i].lanes[lane]; }
  /// Each lane's own row.
  [[nodiscard]] R at(const typename LaneTraits<R>::Index& i) const {
    return fromRows<R>(rows_[0].lanes, i);
  }

 private:
  struct alignas(kLanes * sizeof(double)) Row {
    double lanes[kLanes];
  };
  [[nodiscard]] const double* row(int i) const { return rows_[static_cast<std::size_t>(i)].lanes; }

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
        x_(body.rows.size()),
        y_(x_),
        z_(x_),
        vertex_(x_),
        frames_{{x_, x_}, {x_, x_}} {
    std::iota(numbers_.begin(), numbers_.end(), 0.0);
  }

  /// Takes each lane's list, of `lanes` of them; the others have no vertices.
  void takeLists(const GroundWatch* const* watches, std::size_t lanes);

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
    return {x_[i], y_[i], z_[i]};
  }

  [[nodiscard]] R gapAt(const Index& i) const { return frames_[now_].gap.at(i); }
  [[nodiscard]] R rateAt(const Index& i) const { return frames_[now_].rate.at(i); }
  [[nodiscard]] Vec<R> placeAt(const Index& i) const {
    if (!shared_) return {x_.at(i), y_.at(i), z_.at(i)};
    return {fromTable<R>(body_.rows.x.data(), i), fromTable<R>(body_.rows.y.data(), i),
            fromTable<R>(body_.rows.z.data(), i)};
  }
  [[nodiscard]] R vertexAt(const Index& i) const {
    return shared_ ? fromTable<R>(numbers_.data(), i) : vertex_.at(i);
  }

 private:
  struct Frame {
    LaneRows<R> gap, rate;
  };

  void measure(const KernelState<R>& state, const Rotation<R>& rotation, Frame& frame);

  const BodyModel& body_;
  bool shared_;
  int count_;
  std::vector<double> numbers_;  ///< 0, 1, 2 ...
  LaneRows<R> x_, y_, z_;        ///< of the lists, m
  LaneRows<R> vertex_;           ///< likewise, -1 where a lane has no more
  Frame frames_[2];
  int now_ = 0;
};

template <class R>
void GroundLanes<R>::takeLists(const GroundWatch* const* watches, std::size_t lanes) {
  if (shared_) return;
  count_ = 0;
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    count_ = std::max(count_, watches[lane]->count());
    for (int i = 0; i < watches[lane]->count(); ++i) {
      const auto k = static_cast<std::size_t>(i);
      const auto& place = watches[lane]->place(i);
      x_.lane(k, lane) = place.x;
      y_.lane(k, lane) = place.y;
      z_.lane(k, lane) = place.z;
      vertex_.lane(k, lane) = watches[lane]->vertex(i);
    }
  }
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    for (int i = lane < lanes ? watches[lane]->count() : 0; i < count_; ++i) {
      vertex_.lane(static_cast<std::size_t>(i), lane) = -1;
    }
  }
}

template <class R>
void GroundLanes<R>::measure(const KernelState<R>& state, const Rotation<R>& rotation,
                             Frame& frame) {
  const R height = state.position.z, rise = state.velocity.z, zero(0.0), far(1e9);
  const Vec<R> up = rotation.rows[2], turn = cross(up, state.w);
  for (int i = 0; i < count_; ++i) {
    const Vec<R> p = place(i);
    const R gap = height + (p.x * up.x + p.y * up.y + p.z * up.z);
    frame.gap.set(i, shared_ ? gap : select(vertex_[i] < zero, far, gap));
    frame.rate.set(i, rise + (p.x * turn.x + p.y * turn.y + p.z * turn.z));
  }
}

}  // namespace ifa

#endif
