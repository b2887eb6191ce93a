// SPDX-License-Identifier: Apache-2.0
#include "export/animation_keys.h"

#include <algorithm>
#include <cmath>

namespace ifa {
namespace {

// A regular key this close to a contact's own adds nothing.
constexpr double kCrowded = 2e-4;  // s
// No interval is split below this, whatever the samples say.
constexpr double kShortest = 1e-4;  // s

/// Keys as times after the first contact, in order.
std::vector<double> contactTimes(const Motion& motion, double from, double to) {
  std::vector<double> times = {from, motion.trajectory.front().time, to};
  for (const MotionContact& contact : motion.contacts) {
    times.push_back(contact.time);
    times.push_back(contact.end);
  }
  std::sort(times.begin(), times.end());
  const auto outside = [&](double time) { return time < from || time > to; };
  times.erase(std::remove_if(times.begin(), times.end(), outside), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
}

/// `times` and the regular keys between them, counted from the sound's first sample.
std::vector<double> withRegularKeys(const std::vector<double>& times, double origin, double rate) {
  std::vector<double> all;
  std::size_t next = 0;
  for (double count = 0;; ++count) {
    const double time = origin + count / rate;
    while (next < times.size() && times[next] <= time) all.push_back(times[next++]);
    if (next == times.size()) return all;
    const bool crowded = (!all.empty() && time - all.back() < kCrowded && all.back() != time) ||
                         times[next] - time < kCrowded;
    if (!crowded && (all.empty() || all.back() < time)) all.push_back(time);
  }
}

/// Splits intervals at the motion's samples until linear interpolation follows it.
class Refinement {
 public:
  Refinement(const Motion& motion, double radius, double maxError)
      : motion_(motion), track_(motion), radius_(radius), maxError_(maxError) {}

  /// Appends the keys after `from` up to `to`.
  void append(double from, double to, std::vector<double>& keys) const {
    const double split = to - from < kShortest ? from : worstSample(from, to);
    if (split > from) {
      append(from, split, keys);
      append(split, to, keys);
    } else {
      keys.push_back(to);
    }
  }

 private:
  /// The sample, or middle between two, that lies furthest off; `from` when all are near enough.
  [[nodiscard]] double worstSample(double from, double to) const {
    const Pose first = track_.at(from), last = track_.at(to);
    double worst = maxError_, where = from;
    const auto look = [&](double time) {
      if (time <= from || time >= to) return;
      const double error = distance(first, last, (time - from) / (to - from), track_.at(time));
      if (error > worst) worst = error, where = time;
    };
    auto sample = std::upper_bound(motion_.trajectory.begin(), motion_.trajectory.end(), from,
                                   [](double t, const MotionSample& s) { return t < s.time; });
    for (double before = from; before < to; ++sample) {
      const double time = sample == motion_.trajectory.end() ? to : std::min(to, sample->time);
      look(0.5 * (before + time));
      look(time);
      before = time;
      if (sample == motion_.trajectory.end()) break;
    }
    return where;
  }

  /// Players turn along the arc between two quaternions (glTF's rule, three.js) or along the chord
  /// (Blender); the worse of the two.
  [[nodiscard]] double distance(const Pose& a, const Pose& b, double share,
                                const Pose& truth) const {
    const Eigen::Vector3d position = a.position + share * (b.position - a.position);
    const Eigen::Quaterniond arc = a.orientation.slerp(share, b.orientation);
    const double sign = a.orientation.dot(b.orientation) < 0 ? -1 : 1;
    const Eigen::Quaterniond chord(
        ((1 - share) * a.orientation.coeffs() + sign * share * b.orientation.coeffs())
            .normalized());
    return (position - truth.position).norm() +
           radius_ * std::max(arc.angularDistance(truth.orientation),
                              chord.angularDistance(truth.orientation));
  }

  const Motion& motion_;
  PoseTrack track_;
  double radius_, maxError_;
};

void alignSigns(std::vector<AnimationKey>& keys) {
  for (std::size_t i = 1; i < keys.size(); ++i) {
    Eigen::Quaterniond& q = keys[i].pose.orientation;
    if (q.dot(keys[i - 1].pose.orientation) < 0) q.coeffs() = -q.coeffs();
  }
}

}  // namespace

std::vector<AnimationKey> animationKeys(const Motion& motion, double rate, double radius,
                                        double maxError) {
  const double origin = -motion.sound.firstContact;  // the sound's first sample
  const double end = std::max(origin, motion.trajectory.back().time);
  const auto coarse = withRegularKeys(contactTimes(motion, origin, end), origin, rate);
  std::vector<double> times = {coarse.front()};
  const Refinement refinement(motion, radius, maxError);
  for (std::size_t i = 1; i < coarse.size(); ++i) {
    refinement.append(coarse[i - 1], coarse[i], times);
  }
  const PoseTrack track(motion);
  std::vector<AnimationKey> keys;
  for (const double time : times) {
    const auto rounded = static_cast<float>(time - origin);
    if (keys.empty() || rounded > keys.back().time) keys.push_back({rounded, track.at(time)});
  }
  alignSigns(keys);
  return keys;
}

std::vector<AnimationKey> animationKeys(const Motion& motion, const Mesh& mesh,
                                        const AnimationSettings& settings) {
  double radius = 0;
  for (const Eigen::Vector3d& v : mesh.vertices) radius = std::max(radius, v.norm());
  return animationKeys(motion, settings.keyRate, radius, settings.maxError);
}

}  // namespace ifa
