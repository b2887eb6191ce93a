// SPDX-License-Identifier: Apache-2.0
// The sums of an evaluation.
#include <algorithm>
#include <cmath>
#include <utility>

#include "base/statistics.h"
#include "pipeline/evaluate.h"

namespace ifa {

EvaluationRow summarize(std::string name, const std::vector<CaseOutcome>& cases) {
  EvaluationRow row;
  row.name = std::move(name);
  std::vector<double> bends, arrivals, walls;
  double contacts = 0, heard = 0, solvedContacts = 0, logFv = 0;
  for (const CaseOutcome& outcome : cases) {
    ++row.cases;
    contacts += outcome.contacts;
    if (outcome.contacts > 0) ++heard;  // else it broke before its contacts were known
    walls.push_back(outcome.wallSeconds);
    row.events = std::max(row.events, outcome.events);
    if (!outcome.solved) continue;
    ++row.solved;
    if (outcome.goodSeconds >= 0) {
      ++row.good;
      row.meanGoodSeconds += outcome.goodSeconds;
    }
    row.meanScoreWithoutSound += outcome.scoreWithoutSound;
    arrivals.insert(arrivals.end(), outcome.arrivalBends.begin(), outcome.arrivalBends.end());
    row.meanSearchSeconds += outcome.searchSeconds;
    row.meanScore += outcome.score;
    logFv += outcome.contacts * std::log(std::max(1e-300, outcome.meanFv));
    solvedContacts += outcome.contacts;
    bends.insert(bends.end(), outcome.bends.begin(), outcome.bends.end());
  }
  if (heard > 0) row.meanContacts = contacts / heard;
  row.wallMedian = medianOf(walls);
  row.wallP95 = quantileOf(walls, 0.95);
  if (row.solved == 0) return row;
  row.meanSearchSeconds /= row.solved;
  row.meanScore /= row.solved;
  row.meanScoreWithoutSound /= row.solved;
  if (row.good > 0) row.meanGoodSeconds /= row.good;
  row.arrivalBendMedian = medianOf(arrivals);
  row.arrivalBendMax = quantileOf(arrivals, 1);
  row.meanFv = std::exp(logFv / std::max(1.0, solvedContacts));
  row.bendMedian = medianOf(bends);
  row.bendMax = quantileOf(bends, 1);
  const auto good = std::count_if(bends.begin(), bends.end(), [](double b) { return b <= 1; });
  row.bendShareUpToOne =
      static_cast<double>(good) / static_cast<double>(std::max<std::size_t>(1, bends.size()));
  return row;
}

}  // namespace ifa
