// SPDX-License-Identifier: Apache-2.0
// How well detected contacts agree with labels.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace ifa::test {

struct DetectionScore {
  std::size_t found = 0, missed = 0, invented = 0;
  std::vector<double> errors;  ///< s, detected minus labelled

  [[nodiscard]] double fMeasure() const {
    const auto both = static_cast<double>(2 * found);
    return both > 0 ? both / (both + static_cast<double>(missed + invented)) : 0;
  }
  [[nodiscard]] double medianError() const {
    std::vector<double> sorted;
    for (const double error : errors) sorted.push_back(std::abs(error));
    std::sort(sorted.begin(), sorted.end());
    return sorted.empty() ? 0 : sorted[sorted.size() / 2];
  }
  void add(const DetectionScore& other) {
    found += other.found;
    missed += other.missed;
    invented += other.invented;
    errors.insert(errors.end(), other.errors.begin(), other.errors.end());
  }
};

/// Pairs times one to one, nearest pairs first, no pair further apart than `tolerance` s.
inline DetectionScore scoreDetection(const std::vector<double>& labelled,
                                     const std::vector<double>& detected, double tolerance) {
  struct Pair {
    double distance;
    std::size_t i, j;
  };
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < labelled.size(); ++i) {
    for (std::size_t j = 0; j < detected.size(); ++j) {
      const double distance = std::abs(labelled[i] - detected[j]);
      if (distance <= tolerance) pairs.push_back({distance, i, j});
    }
  }
  std::sort(pairs.begin(), pairs.end(),
            [](const Pair& a, const Pair& b) { return a.distance < b.distance; });
  std::vector<bool> labelUsed(labelled.size()), detectedUsed(detected.size());
  DetectionScore score;
  for (const Pair& pair : pairs) {
    if (labelUsed[pair.i] || detectedUsed[pair.j]) continue;
    labelUsed[pair.i] = detectedUsed[pair.j] = true;
    score.errors.push_back(detected[pair.j] - labelled[pair.i]);
  }
  score.found = score.errors.size();
  score.missed = labelled.size() - score.found;
  score.invented = detected.size() - score.found;
  return score;
}

}  // namespace ifa::test
