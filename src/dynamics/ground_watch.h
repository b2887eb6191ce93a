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

/// Vertices that would hit within this time hit together, s: an impact of a hard body lasts as
/// long.
inline constexpr double kTogether = 1.5e-4;

/// Gaps and their rates of the listed vertices in one state.
struct GroundFrame {
  std::vector<double> gap, rate;  ///< m, m/s; of at least the list's length
};

/// Not thread safe. The model must outlive it.
class GroundWatch {
 public:
  explicit GroundWatch(const BodyModel& body);

  /// Makes sure that every vertex that can be at the ground by the end of a step is listed, while
  /// the body is as in `height` (of its centre, m) and `up` (the world's z axis, body frame) and
  /// has kinetic energy `kinetic` (J). True when the list was remade.
  bool cover(double height, const Vec<double>& up, double kinetic);
  /// Gaps and rates of the listed vertices. `turn` is cross(up, w).
  void measure(double height, double rise, const Vec<double>& up, const Vec<double>& turn,
               GroundFrame& frame) const;

  [[nodiscard]] std::size_t count() const { return count_; }
  /// Hull vertex number `i` of the list; they are in the hull's order.
  [[nodiscard]] int vertex(std::size_t i) const { return index_[i]; }
  [[nodiscard]] Vec<double> place(std::size_t i) const {
    return {rows_.x[i], rows_.y[i], rows_.z[i]};
  }

 private:
  void list(double height, const Vec<double>& up, double kinetic);

  const BodyModel& body_;
  VertexRows rows_;         ///< room for all vertices; the list is what comes first
  std::vector<int> index_;  ///< likewise
  std::size_t count_ = 0;   ///< length of the list ...
  std::size_t filled_ = 0;  ///< ... and filled up to a multiple of VertexRows::kChunk
  double listedHeight_ = 0;
  Vec<double> listedUp_{};
  double mostKinetic_ = -1;  ///< J, for which reach_ is enough
  double reach_ = 0;         ///< m, how far a step can bring a vertex down
  double margin_ = 0;        ///< what is not listed was higher than this, m
  bool all_;
};

}  // namespace ifa
