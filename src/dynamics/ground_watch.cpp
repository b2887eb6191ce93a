// SPDX-License-Identifier: Apache-2.0
#include "dynamics/ground_watch.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <numeric>

namespace ifa {

GroundWatch::GroundWatch(const BodyModel& body)
    : body_(body), rows_(body.rows), index_(body.rows.size()), all_(body.x.size() <= kFew) {
  std::iota(index_.begin(), index_.end(), 0);
  if (!all_) return;
  count_ = body.x.size();
  filled_ = body.rows.size();
}

bool GroundWatch::cover(double height, const Vec<double>& up, double kinetic) {
  if (all_ || cover_.holds(body_, height, up, kinetic)) return false;
  cover_.renew(body_, height, up, kinetic);
  list(height, up);
  return true;
}

void GroundWatch::list(double height, const Vec<double>& up) {
  const double *x = body_.rows.x.data(), *y = body_.rows.y.data(), *z = body_.rows.z.data();
  double *nearX = rows_.x.data(), *nearY = rows_.y.data(), *nearZ = rows_.z.data();
  count_ = 0;
  constexpr std::size_t kBits = 64;
  for (std::size_t begin = 0; begin < body_.x.size(); begin += kBits) {
    const std::size_t size = std::min(kBits, body_.x.size() - begin);
    std::uint64_t near = 0;
    for (std::size_t k = 0; k < size; ++k) {
      const std::size_t i = begin + k;
      const double gap = height + (x[i] * up.x + y[i] * up.y + z[i] * up.z);
      near |= static_cast<std::uint64_t>(gap <= cover_.margin) << k;
    }
    for (; near != 0; near &= near - 1, ++count_) {
      const std::size_t i = begin + static_cast<std::size_t>(std::countr_zero(near));
      nearX[count_] = x[i];
      nearY[count_] = y[i];
      nearZ[count_] = z[i];
      index_[count_] = static_cast<int>(i);
    }
  }
  constexpr std::size_t kChunk = VertexRows::kChunk;
  filled_ = (count_ + kChunk - 1) / kChunk * kChunk;
  for (std::size_t i = count_; i < filled_; ++i) {
    nearX[i] = nearX[count_ - 1];
    nearY[i] = nearY[count_ - 1];
    nearZ[i] = nearZ[count_ - 1];
  }
}

void GroundWatch::measure(const KernelState<double>& state, const Rotation<double>& rotation,
                          GroundFrame& frame) const {
  const double height = state.position.z, rise = state.velocity.z;
  const Vec<double>& up = rotation.rows[2];
  const Vec<double> turn = cross(up, state.w);
  const std::size_t size = filled_;
  if (frame.gap.size() < size) {
    frame.gap.resize(size);
    frame.rate.resize(size);
  }
  const double *x = rows_.x.data(), *y = rows_.y.data(), *z = rows_.z.data();
  double *gap = frame.gap.data(), *rate = frame.rate.data();
  for (std::size_t i = 0; i < size; i += VertexRows::kChunk) {
    double g[VertexRows::kChunk], r[VertexRows::kChunk];
    for (std::size_t k = 0; k < VertexRows::kChunk; ++k) {
      const double px = x[i + k], py = y[i + k], pz = z[i + k];
      g[k] = height + (px * up.x + py * up.y + pz * up.z);
      r[k] = rise + (px * turn.x + py * turn.y + pz * turn.z);
    }
    for (std::size_t k = 0; k < VertexRows::kChunk; ++k) {
      gap[i + k] = g[k];
      rate[i + k] = r[k];
    }
  }
}

}  // namespace ifa
