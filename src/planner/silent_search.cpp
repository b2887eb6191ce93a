// SPDX-License-Identifier: Apache-2.0
#include "planner/silent_search.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <vector>

namespace ifa {

namespace {

/// Changes farther out than this are not tried, in units of the plausible region.
constexpr double kFarthest = 2.5;

/// What still differs by half between two changes that are so much closer than the first two jumps
/// there, because another vertex comes first: nothing in between comes on time.
constexpr double kJump = 0.5, kCloser = 1.0 / 512;

/// Illinois' false position with a bisection now and then, from too early to too late. Ends with a
/// call of `miss` within the precision, or false.
template <class Miss>
bool closeIn(const Miss& miss, double low, double high, double atLow, double atHigh,
             double precision) {
  const double narrow = kCloser * (high - low), jump = kJump * (atHigh - atLow);
  double trueLow = atLow, trueHigh = atHigh;
  for (int step = 0; step < 50; ++step) {
    if (high - low < narrow && trueHigh - trueLow > jump) return false;
    const double share = step % 3 == 2 ? 0.5 : atLow / (atLow - atHigh);
    const double middle = low + (high - low) * std::clamp(share, 0.01, 0.99);
    const double off = miss(middle);
    if (off >= kNever) return false;
    if (std::abs(off) < precision) return true;
    if ((off < 0) == (atLow < 0)) {
      low = middle;
      atLow = trueLow = off;
      atHigh *= 0.5;
    } else {
      high = middle;
      atHigh = trueHigh = off;
      atLow *= 0.5;
    }
  }
  return false;
}

/// Two of them, one too early and one too late.
struct SilentPair {
  double cost;
  SilentProbe early, late;
};

/// All such pairs, first those near each other, so that the way between them is smooth, and near to
/// no change.
std::vector<SilentPair> bracketing(const std::vector<SilentProbe>& probes) {
  std::vector<SilentPair> pairs;
  for (const SilentProbe& e : probes) {
    for (const SilentProbe& l : probes) {
      if (e.off >= 0 || l.off < 0) continue;
      pairs.push_back({(e.y - l.y).norm() + 0.5 * (e.y + l.y).norm() + 30 * (l.off - e.off), e, l});
    }
  }
  std::stable_sort(pairs.begin(), pairs.end(),
                   [](const SilentPair& a, const SilentPair& b) { return a.cost < b.cost; });
  return pairs;
}

/// Pairs that both come too early, but with the body fallen to different sides. Between them lies a
/// motion that stays balanced for ever, so there are others next to it that take any time.
std::vector<SilentPair> tipping(const std::vector<SilentProbe>& probes) {
  constexpr double kOtherSide = 0.9;  // cosine
  std::vector<SilentPair> pairs;
  for (std::size_t i = 0; i < probes.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const SilentProbe &a = probes[i], &b = probes[j];
      if (a.off >= 0 || b.off >= 0 || a.up.dot(b.up) > kOtherSide) continue;
      pairs.push_back({(a.y - b.y).norm() + 0.5 * (a.y + b.y).norm(), a, b});
    }
  }
  std::stable_sort(pairs.begin(), pairs.end(),
                   [](const SilentPair& a, const SilentPair& b) { return a.cost < b.cost; });
  return pairs;
}

/// Closes in on the balance between such a pair until a motion comes too late; that and its early
/// neighbour.
template <class Probe>
std::optional<SilentPair> balance(const Probe& probe, SilentPair pair) {
  for (int step = 0; step < 24; ++step) {
    const SilentProbe middle = probe(0.5 * (pair.early.y + pair.late.y));
    if (middle.off >= kNever) return std::nullopt;
    if (middle.off >= 0) return SilentPair{0, pair.early, middle};
    const bool likeFirst = middle.up.dot(pair.early.up) > middle.up.dot(pair.late.up);
    (likeFirst ? pair.early : pair.late) = middle;
  }
  return std::nullopt;
}

SilentProbe nearestProbe(const std::vector<SilentProbe>& probes) {
  return *std::min_element(probes.begin(), probes.end(), [](const auto& a, const auto& b) {
    return std::abs(a.off) < std::abs(b.off);
  });
}

/// Where a plane through the probes that end at the same contact as the nearest one is a little
/// past zero.
std::optional<Coordinates> extrapolated(const std::vector<SilentProbe>& probes) {
  if (probes.empty()) return std::nullopt;
  const SilentProbe nearest = nearestProbe(probes);
  Eigen::Matrix<double, 6, 6> normal = 1e-3 * Eigen::Matrix<double, 6, 6>::Identity();
  Coordinates right = Coordinates::Zero();
  int count = 0;
  for (const SilentProbe& probe : probes) {
    const double apart = probe.off - nearest.off;
    if (std::abs(apart) > 0.5 * std::abs(nearest.off) + 0.002) continue;
    const Coordinates way = probe.y - nearest.y;
    normal += way * way.transpose();
    right += way * apart;
    ++count;
  }
  if (count < 5) return std::nullopt;
  const Coordinates slope = normal.ldlt().solve(right);
  if (slope.squaredNorm() < 1e-12) return std::nullopt;
  return Coordinates(nearest.y - slope * (1.2 * nearest.off / slope.squaredNorm()));
}

std::vector<SilentPair> atMost(std::vector<SilentPair> pairs, int most) {
  if (pairs.size() > static_cast<std::size_t>(most)) pairs.resize(static_cast<std::size_t>(most));
  return pairs;
}

}  // namespace

SilentProbe silentProbe(const Coordinates& y, const std::optional<NextContact>& next,
                        double horizon, double duration) {
  SilentProbe probe{y, horizon - duration, Eigen::Vector3d::Zero()};
  if (next) {
    probe.off = std::min(next->delay, horizon) - duration;
    probe.up = next->state.orientation.conjugate() * Eigen::Vector3d::UnitZ();
  }
  return probe;
}

void findOnTime(const std::function<SilentProbe(const Coordinates&)>& probe,
                const std::function<void()>& found, const SilentSearchSettings& settings,
                RandomStream& random) {
  std::vector<SilentProbe> all;
  int hits = 0;  // where there is much slack
  for (int i = 0; i < settings.probes; ++i) {
    Coordinates y;
    const double spread = i == 0 ? 0 : settings.spread * (0.3 + 0.9 * i / settings.probes);
    for (int axis = 0; axis < 6; ++axis) y[axis] = spread * bellShaped(random);
    const SilentProbe tried = probe(y);
    if (tried.off < kNever) all.push_back(tried);
    if (std::abs(tried.off) >= settings.precision) continue;
    found();
    if (++hits > settings.tries) return;
  }
  if (all.empty()) return;
  std::vector<SilentPair> pairs = atMost(bracketing(all), settings.tries);
  if (pairs.empty()) {
    for (const SilentPair& edge : atMost(tipping(all), settings.tries)) {
      if (const auto balanced = balance(probe, edge)) pairs.push_back(*balanced);
    }
  }
  if (const auto aimed = extrapolated(all); aimed && aimed->norm() < kFarthest) {
    const SilentProbe end = probe(*aimed), nearest = nearestProbe(all);
    if (end.off < kNever && (end.off < 0) != (nearest.off < 0)) {
      pairs.insert(pairs.begin(),
                   end.off < 0 ? SilentPair{0, end, nearest} : SilentPair{0, nearest, end});
    }
  }
  for (const SilentPair& pair : pairs) {
    const auto along = [&](double s) {
      return probe(pair.early.y + s * (pair.late.y - pair.early.y)).off;
    };
    if (closeIn(along, 0, 1, pair.early.off, pair.late.off, settings.precision)) found();
  }
}

/// Nearly normal, without transcendental functions: four uniform numbers added up.
double bellShaped(RandomStream& random) {
  const double sum = random.uniform() + random.uniform() + random.uniform() + random.uniform();
  return (sum - 2) * 1.7320508075688772;
}

}  // namespace ifa
