// SPDX-License-Identifier: Apache-2.0
// Several reports as one.
#include <algorithm>

#include "pipeline/evaluation_report.h"

namespace ifa {
namespace {

bool sameRow(const CaseOutcome& a, const CaseOutcome& b) {
  return a.what.object == b.what.object && a.what.surface == b.what.surface;
}

}  // namespace

std::vector<Evaluation> mergeByLabel(const std::vector<Evaluation>& evaluations) {
  std::vector<Evaluation> merged;
  for (const Evaluation& evaluation : evaluations) {
    const std::string label = settingsLabel(evaluation.settings);
    auto same = std::find_if(merged.begin(), merged.end(), [&](const Evaluation& other) {
      return settingsLabel(other.settings) == label;
    });
    if (same == merged.end()) {
      merged.push_back(evaluation);
      continue;
    }
    std::vector<CaseOutcome> cases = std::move(same->cases);
    for (const CaseOutcome& outcome : evaluation.cases) {
      std::erase_if(cases, [&](const CaseOutcome& other) {
        return sameRow(other, outcome) && other.what.name == outcome.what.name;
      });
      cases.push_back(outcome);
    }
    const bool interrupted = same->interrupted || evaluation.interrupted;
    *same = sumUp(same->settings, std::move(cases));
    same->interrupted = interrupted;
  }
  return merged;
}

Evaluation firstCases(const Evaluation& evaluation, std::size_t limit) {
  std::vector<CaseOutcome> cases;
  for (const CaseOutcome& outcome : evaluation.cases) {
    const auto before = std::count_if(cases.begin(), cases.end(), [&](const CaseOutcome& other) {
      return sameRow(other, outcome);
    });
    if (static_cast<std::size_t>(before) < limit) cases.push_back(outcome);
  }
  Evaluation first = sumUp(evaluation.settings, std::move(cases));
  first.interrupted = evaluation.interrupted;
  return first;
}

}  // namespace ifa
