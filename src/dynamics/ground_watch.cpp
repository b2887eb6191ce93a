// SPDX-License-Identifier: Apache-2.0
#include "dynamics/ground_watch.h"

namespace ifa {

namespace {

/// Bodies of fewer vertices are always looked at whole.
constexpr std::size_t kFew = 24;
/// How far beyond what must be seen a new list reaches, in that distance and in radii of the body.
constexpr double kFarther = 4, kFartherRadii = 0.03;

/// base + x a.x + y a.y + z a.z for each of a row of vertices.
void project(const VertexRows& rows, double base, const Vec<double>& a, double* out) {
  const double *x = rows.x.data(), *y = rows.y.data(), *z = rows.z.data();
  const std::size_t size = rows.size();
  for (std::size_t i = 0; i < size; i += VertexRows::kChunk) {
    for (std::size_t k = 0; k < VertexRows::kChunk; ++k) {
      out[i + k] = base + (x[i + k] * a.x + y[i + k] * a.y + z[i + k] * a.z);
    }
  }
}

}  // namespace

GroundWatch::GroundWatch(const BodyModel& body) : body_(body), all_(body.x.size() <= kFew) {
  if (!all_) return;
  rows_ = body.rows;
  for (std::size_t i = 0; i < body.x.size(); ++i) index_.push_back(static_cast<int>(i));
}

bool GroundWatch::cover(double height, const Vec<double>& up, double reach) {
  if (all_) return false;
  const Vec<double> turned = up - listedUp_;
  const double sunk = body_.radius * laneSqrt(dot(turned, turned)) - (height - listedHeight_);
  if (margin_ - sunk > reach) return false;
  margin_ = kFarther * reach + kFartherRadii * body_.radius;
  list(height, up);
  return true;
}

void GroundWatch::list(double height, const Vec<double>& up) {
  listedHeight_ = height;
  listedUp_ = up;
  rows_.clear();
  index_.clear();
  const VertexRows& all = body_.rows;
  for (std::size_t i = 0; i < body_.x.size(); ++i) {
    const double gap = height + (all.x[i] * up.x + all.y[i] * up.y + all.z[i] * up.z);
    if (gap > margin_) continue;
    rows_.add(all.x[i], all.y[i], all.z[i]);
    index_.push_back(static_cast<int>(i));
  }
  if (!index_.empty()) rows_.fillUp();
}

void GroundWatch::measure(double height, double rise, const Vec<double>& up,
                          const Vec<double>& turn, GroundFrame& frame) const {
  frame.gap.resize(rows_.size());
  frame.rate.resize(rows_.size());
  project(rows_, height, up, frame.gap.data());
  project(rows_, rise, turn, frame.rate.data());
}

}  // namespace ifa
