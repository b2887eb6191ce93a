// SPDX-License-Identifier: Apache-2.0
#include "sound/rattle.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace ifa {

Rattles::Rattles(std::vector<double> smallRises, const DetectorSettings& settings)
    : smallRises_(std::move(smallRises)), settings_(settings) {}

double Rattles::lastOf(double start, double next) const {
  double end = start;
  for (const double time : smallRises_) {
    if (time > end && time < next && time - end <= settings_.rattleGap) end = time;
  }
  return end;
}

int Rattles::countIn(double from, double to) const {
  return static_cast<int>(std::upper_bound(smallRises_.begin(), smallRises_.end(), to) -
                          std::upper_bound(smallRises_.begin(), smallRises_.end(), from));
}

double Rattles::endOf(double start, double next) const {
  const double end = lastOf(start, next);
  return countIn(start, end) >= settings_.rattleFill ? end : start;
}

bool Rattles::join(double first, double second) const {
  int between = 0;
  double before = first, longest = 0;
  for (const double time : smallRises_) {
    if (time <= first || time >= second) continue;
    longest = std::max(longest, time - before);
    before = time;
    ++between;
  }
  longest = std::max(longest, second - before);
  return second - first <= settings_.denseGap * (between + 1) ||
         (between >= settings_.rattleFill && longest <= settings_.rattlePause);
}

void Rattles::joinLast(std::vector<DetectedContact>& contacts) const {
  auto joined = contacts;
  joined.back().end = lastOf(joined.back().start, std::numeric_limits<double>::infinity());
  int swallowed = 0;
  while (joined.size() > 1 && join(joined[joined.size() - 2].start, joined.back().start)) {
    joined[joined.size() - 2].end = joined.back().end;
    joined.pop_back();
    ++swallowed;
  }
  const int rises = countIn(joined.back().start, joined.back().end);
  // Contacts are small rises as well.
  if (rises - swallowed >= settings_.rattleFill) contacts = std::move(joined);
}

}  // namespace ifa
