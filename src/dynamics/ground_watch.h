// SPDX-License-Identifier: Apache-2.0
// Heights of the hull's vertices over the ground while the body is close to it. Only those that can
// come near are looked at; the list of them is made anew when the body has moved too far for it
// (as Verlet lists do), so what is found does not depend on when the list was made.
#pragma once

#include <cstddef>
#include <vector>

#include "dynamics/body_model.h"
#include "dynamics/kernel_state.h"

namespace ifa {

/// Gaps and their rates of the listed vertices in one state.
struct GroundFrame {
  std::vector<double> gap, rate;  ///< m, m/s; filled up as the list's rows are
};

/// Not thread safe. The model must outlive it.
class GroundWatch {
 public:
  explicit GroundWatch(const BodyModel& body);

  /// Makes sure that every vertex under `reach` (m) is listed while the body is as in `height`
  /// (of its centre, m) and `up` (the world's z axis, body frame). True when the list was remade.
  bool cover(double height, const Vec<double>& up, double reach);
  /// Gaps and rates of the listed vertices. `turn` is cross(up, w).
  void measure(double height, double rise, const Vec<double>& up, const Vec<double>& turn,
               GroundFrame& frame) const;

  [[nodiscard]] std::size_t count() const { return index_.size(); }
  /// Hull vertex number `i` of the list; they are in the hull's order.
  [[nodiscard]] int vertex(std::size_t i) const { return index_[i]; }
  [[nodiscard]] Vec<double> place(std::size_t i) const {
    return {rows_.x[i], rows_.y[i], rows_.z[i]};
  }

 private:
  void list(double height, const Vec<double>& up);

  const BodyModel& body_;
  VertexRows rows_;
  std::vector<int> index_;
  double listedHeight_ = 0;
  Vec<double> listedUp_{};
  double margin_ = -1;  ///< what is not listed was higher than this, m
  bool all_;
};

}  // namespace ifa
