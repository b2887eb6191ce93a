// SPDX-License-Identifier: Apache-2.0
#include "render/overlay.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "render/canvas.h"

namespace ifa::render {
namespace {

constexpr Paint kGround{0.05, 0.05, 0.06, 0.62};
constexpr Paint kWave{0.86, 0.88, 0.9, 0.75};
constexpr Paint kToCome{1, 1, 1, 0.45};
constexpr Paint kPast{1.0, 0.74, 0.3, 0.95};
constexpr Paint kPlayhead{1, 1, 1, 0.95};
constexpr double kFlash = 0.12;  // s of the film in which a flash dies away

}  // namespace

Overlay::Overlay(const Motion& motion, const Sound& sound, double seconds, double speed,
                 double step, int width, int height)
    : width_(width),
      stripHeight_(std::min(height, std::max(24, static_cast<int>(std::lround(kShare * height))))),
      seconds_(std::max(seconds, 1e-3)),
      speed_(speed),
      step_(step) {
  top_ = height - stripHeight_;
  for (const MotionContact& contact : motion.contacts) {
    const double origin = motion.sound.firstContact;
    marks_.push_back({contact.time + origin, contact.end + origin,
                      std::clamp(std::sqrt(contact.targetAmplitude), 0.25, 1.0)});
  }
  if (sound.samples.empty()) return;
  float peak = 1e-6f;
  for (const float s : sound.samples) peak = std::max(peak, std::abs(s));
  const double middle = top_ + 0.56 * stripHeight_,
               scale = 0.4 * stripHeight_ / static_cast<double>(peak);
  for (int x = 0; x < width; ++x) {
    const auto index = [&](int column) {
      const double sample = seconds_ * column / width * sound.rate;
      return std::min(static_cast<std::size_t>(sample), sound.samples.size());
    };
    float low = 0, high = 0;
    for (std::size_t i = index(x); i < index(x + 1); ++i) {
      low = std::min(low, sound.samples[i]);
      high = std::max(high, sound.samples[i]);
    }
    low_.push_back(static_cast<float>(middle - scale * static_cast<double>(high) - 0.5));
    high_.push_back(static_cast<float>(middle - scale * static_cast<double>(low) + 0.5));
  }
}

void Overlay::draw(Image& frame, double time) const {
  Canvas canvas(frame, top_, stripHeight_);
  const double thick = std::max(1.0, width_ / 640.0);
  canvas.rectangle(0, top_, width_, stripHeight_, kGround);
  canvas.bars(0, low_, high_, kWave);
  for (const Mark& mark : marks_) {
    const double now = time + 0.5 * step_;
    const bool past = now >= mark.start;
    const double x = place(mark.start), length = 0.2 + 0.22 * mark.level;
    canvas.rectangle(x - 0.5 * thick, top_, thick, length * stripHeight_, past ? kPast : kToCome);
    canvas.rectangle(x, top_, std::max(0.0, place(mark.end) - x), 1.5 * thick,
                     past ? kPast : kToCome);
    // While it sounds, and a moment longer, it glows.
    const double after = (now - std::max(mark.start, std::min(now, mark.end))) / (kFlash * speed_);
    if (past && after < 1) {
      Paint glow = kPast;
      glow.alpha = 0.85 * (1 - after) * (1 - after);
      canvas.disc(x, top_ + 0.2 * stripHeight_, (0.1 + 0.1 * mark.level) * stripHeight_, glow);
    }
  }
  canvas.rectangle(place(time) - 0.5 * thick, top_, thick, stripHeight_, kPlayhead);
  std::string told = fmt::format("{:.3f} s", time);
  if (speed_ != 1) told += fmt::format("  ×{:g}", speed_);
  const double size = std::max(9.0, 0.24 * stripHeight_);
  canvas.text(width_ - 0.4 * size, top_ + stripHeight_ - 0.4 * size, size, Align::kRight, told,
              kPlayhead);
}

}  // namespace ifa::render
