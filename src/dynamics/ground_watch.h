// SPDX-License-Identifier: Apache-2.0
// Heights of the hull's vertices over the ground while the body is close to it. Only those that can
// come near are looked at; the list of them is made anew when the body has moved too far for it
// (as Verlet lists do), so what is found does not depend on when the list was made.
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "dynamics/body_model.h"
#include "dynamics/ground_cover.h"
#include "dynamics/kernel_state.h"

namespace ifa {

/// Gaps and their rates of the listed vertices in one state.
struct GroundFrame {
  std::vector<double> gap, rate;  ///< m, m/s; of at least the list's length
};

/// Not thread safe. The model must outlive it.
class GroundWatch {
 public:
  /// Bodies of so many vertices at most are always looked at whole.
  static constexpr std::size_t kFew = 24;

  explicit GroundWatch(const BodyModel& body);

  /// Makes sure that every vertex that can be at the ground by the end of a step is listed, while
  /// the body is as in `height` (of its centre, m) and `up` (the world's z axis, body frame) and
  /// has kinetic energy `kinetic` (J). True when the list was remade.
  bool cover(double height, const Vec<double>& up, double kinetic);
  /// Gaps and rates of the listed vertices, now and at the end of a step.
  void measure(const KernelState<double>& state, const Rotation<double>& rotation) {
    measure(state, rotation, now_);
  }
  void measureNext(const KernelState<double>& state, const Rotation<double>& rotation) {
    measure(state, rotation, next_);
  }
  /// The end of the step is now.
  void goOn() { std::swap(now_, next_); }

  /// Every vertex is listed, always.
  [[nodiscard]] bool all() const { return all_; }
  /// Length of the list. Its vertices are in the hull's order.
  [[nodiscard]] int count() const { return static_cast<int>(count_); }
  [[nodiscard]] double gap(int i) const { return now_.gap[at(i)]; }
  [[nodiscard]] double rate(int i) const { return now_.rate[at(i)]; }
  [[nodiscard]] double nextGap(int i) const { return next_.gap[at(i)]; }
  [[nodiscard]] double nextRate(int i) const { return next_.rate[at(i)]; }
  /// Body frame, m.
  [[nodiscard]] Vec<double> place(int i) const {
    return {rows_.x[at(i)], rows_.y[at(i)], rows_.z[at(i)]};
  }
  /// Hull vertex number `i` of the list.
  [[nodiscard]] int vertex(int i) const { return index_[at(i)]; }

  /// The same for a number that each lane has for itself.
  [[nodiscard]] double gapAt(std::int64_t i) const { return gap(static_cast<int>(i)); }
  [[nodiscard]] double rateAt(std::int64_t i) const { return rate(static_cast<int>(i)); }
  [[nodiscard]] Vec<double> placeAt(std::int64_t i) const { return place(static_cast<int>(i)); }
  [[nodiscard]] double vertexAt(std::int64_t i) const { return vertex(static_cast<int>(i)); }

 private:
  static std::size_t at(int i) { return static_cast<std::size_t>(i); }
  void measure(const KernelState<double>& state, const Rotation<double>& rotation,
               GroundFrame& frame) const;
  void list(double height, const Vec<double>& up);

  const BodyModel& body_;
  VertexRows rows_;         ///< room for all vertices; the list is what comes first
  std::vector<int> index_;  ///< likewise
  std::size_t count_ = 0;   ///< length of the list ...
  std::size_t filled_ = 0;  ///< ... and filled up to a multiple of VertexRows::kChunk
  GroundCover<double> cover_;
  bool all_;
  GroundFrame now_, next_;
};

}  // namespace ifa
