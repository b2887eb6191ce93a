// SPDX-License-Identifier: Apache-2.0
#include "planner/event_rhythms.h"

#include <algorithm>
#include <array>
#include <span>

#include "affinity/factors.h"
#include "base/portable_math.h"
#include "graph/edge_weight.h"
#include "planner/planner.h"

namespace ifa {

namespace {

/// Contacts looked ahead, and how much each counts: what lies farther off can still be changed.
constexpr std::array kWeights = {1.0, 0.5, 0.25};
/// A gap that is off by this, s, and this share of itself costs one log unit.
constexpr double kGapPrecision = 0.003, kGapShare = 0.06;
/// Log units that one contact can cost at most: one that does not fit is no reason to forget how
/// well the others do.
constexpr double kMostOfContact = 9;
/// Of a squared difference of the logarithms of two successive amplitudes' ratios.
constexpr double kAmplitudeWeight = 0.25;
constexpr double kOtherEnd = 4;  ///< rests where the sound goes on, or goes on where it ends

class RhythmCost {
 public:
  RhythmCost(const EventDatabase& database, const ContactSignature& signature, std::size_t level)
      : database_(database),
        signature_(signature),
        level_(level),
        flags_(database.flags()),
        durations_(database.values(kDuration)),
        gaps_(database.values(kGap)),
        amplitudes_(database.values(kAmplitude)) {}

  [[nodiscard]] bool serves(std::size_t event) const {
    const bool wanted = isLast(level_) && signature_.terminal;
    return terminal(event) == wanted && (wanted || isLast(level_) || followed(event));
  }

  /// @param most  what costs more need not be exact
  [[nodiscard]] double of(std::size_t event, double most) const {
    double cost = 0;
    for (std::size_t m = 0; m < kWeights.size() && !isLast(level_ + m) && cost < most; ++m) {
      if (!followed(event + m)) return cost + kWeights[m] * kMostOfContact;
      cost += kWeights[m] * step(event + m, level_ + m);
    }
    return cost < most ? cost + sound(event) : cost;
  }

 private:
  [[nodiscard]] bool isLast(std::size_t level) const {
    return level + 1 >= signature_.events.size();
  }
  [[nodiscard]] bool terminal(std::size_t event) const {
    return (flags_[event] & EventRecord::kTerminal) != 0;
  }
  [[nodiscard]] bool followed(std::size_t event) const {
    return event + 1 < flags_.size() && (flags_[event] & EventRecord::kFollowed) != 0;
  }

  /// From `event`, which meets `level`, to the next one of each.
  [[nodiscard]] double step(std::size_t event, std::size_t level) const {
    const SignatureEvent &from = signature_.events[level], &to = signature_.events[level + 1];
    const double wanted = to.time - from.time;
    const double off = durations_[event] + gaps_[event] - wanted;
    const double share = off / (kGapPrecision + kGapShare * wanted);
    double cost = share * share;
    if (terminal(event + 1) != (isLast(level + 1) && signature_.terminal)) cost += kOtherEnd;
    if (!(cost < kMostOfContact)) return kMostOfContact;
    const double ratio = static_cast<double>(amplitudes_[event + 1]) * from.amplitude /
                         (static_cast<double>(amplitudes_[event]) * to.amplitude);
    if (!(ratio > 0)) return kMostOfContact;
    const double apart = portableLog(ratio);
    return std::min(cost + kAmplitudeWeight * apart * apart, kMostOfContact);
  }

  /// Eq. 7 and 8 of the event itself; how loud it is depends on the motion's first.
  [[nodiscard]] double sound(std::size_t event) const {
    const HeardEvent target = heardOf(signature_.events[level_]);
    const HeardEvent heard = heardEvent(database_, event, 1);
    return -(logDuration(target, heard) + logCentroid(target, heard));
  }

  const EventDatabase& database_;
  const ContactSignature& signature_;
  std::size_t level_;
  std::span<const std::uint8_t> flags_;
  std::span<const float> durations_, gaps_, amplitudes_;
};

bool better(const RhythmMatch& a, const RhythmMatch& b) {
  return a.cost != b.cost ? a.cost < b.cost : a.event < b.event;
}

}  // namespace

std::vector<RhythmMatch> eventsInRhythm(const EventDatabase& database,
                                        const ContactSignature& signature, std::size_t level,
                                        std::size_t count) {
  std::vector<RhythmMatch> best;
  if (count == 0) return best;
  const RhythmCost cost(database, signature, level);
  double most = 1e300;
  for (std::size_t event = 0; event < database.events(); ++event) {
    if (!cost.serves(event)) continue;
    const double here = cost.of(event, most);
    if (here >= most) continue;
    best.push_back({static_cast<std::uint32_t>(event), here});
    if (best.size() < 2 * count) continue;
    std::nth_element(best.begin(), best.begin() + static_cast<std::ptrdiff_t>(count), best.end(),
                     better);
    best.resize(count);
    most = std::max_element(best.begin(), best.end(), better)->cost;
  }
  std::sort(best.begin(), best.end(), better);
  if (best.size() > count) best.resize(count);
  return best;
}

}  // namespace ifa
