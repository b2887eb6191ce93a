// SPDX-License-Identifier: Apache-2.0
#include "dynamics/ground_watch.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numeric>

namespace ifa {

namespace {

/// Bodies of fewer vertices are always looked at whole.
constexpr std::size_t kFew = 24;
/// How far beyond what must be seen a new list reaches, in that distance and in radii of the body,
/// and what kinetic energy it is good for, in that of the moment.
constexpr double kFarther = 3, kFartherRadii = 0.01, kFaster = 1.5;
/// A list made for so many times the kinetic energy is too long to keep; slower bodies than kSlow
/// (m/s) are not told apart.
constexpr double kSlower = 8, kSlow = 0.05;

}  // namespace

GroundWatch::GroundWatch(const BodyModel& body)
    : body_(body), rows_(body.rows), index_(body.rows.size()), all_(body.x.size() <= kFew) {
  std::iota(index_.begin(), index_.end(), 0);
  if (!all_) {
    listed_.resize(body.rows.size() / 2);
    for (Pair& pair : listed_) pair.numbers[3] = pair.numbers[7] = -1;
    return;
  }
  count_ = body.x.size();
  filled_ = body.rows.size();
}

bool GroundWatch::cover(double height, const Vec<double>& up, double kinetic) {
  if (all_) return false;
  kinetic = laneMax(kinetic, 0.5 * body_.mass * kSlow * kSlow);
  const Vec<double> turned = up - listedUp_;
  const double left = margin_ - reach_ + (height - listedHeight_);
  if (kinetic <= mostKinetic_ && kinetic * kSlower >= mostKinetic_ && left > 0 &&
      body_.radius * body_.radius * dot(turned, turned) < left * left) {
    return false;
  }
  list(height, up, kinetic);
  return true;
}

void GroundWatch::list(double height, const Vec<double>& up, double kinetic) {
  const double step = body_.step + kTogether;
  listedHeight_ = height;
  listedUp_ = up;
  mostKinetic_ = kFaster * kinetic;
  const double speed = body_.speedRoot * std::sqrt(2 * mostKinetic_) + kGravity * step;
  reach_ = speed * step + body_.slop;
  margin_ = kFarther * reach_ + kFartherRadii * body_.radius;
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
      near |= static_cast<std::uint64_t>(gap <= margin_) << k;
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

void GroundWatch::tellList() {
  double* to = listed_[0].numbers;
  for (std::size_t i = 0; i < count_; ++i, to += kListed) {
    to[0] = rows_.x[i];
    to[1] = rows_.y[i];
    to[2] = rows_.z[i];
    to[3] = index_[i];
  }
  for (std::size_t i = count_; i < told_; ++i, to += kListed) to[3] = -1;
  told_ = count_;
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
