// SPDX-License-Identifier: Apache-2.0
// The charts of an evaluation.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "pipeline/evaluation_report.h"
#include "render/chart.h"
#include "sampler/paper_rows.h"

namespace ifa {
namespace {

constexpr std::size_t kMostSideBySide = 6;

using Evaluations = std::vector<Evaluation>;

std::string labelOf(const Evaluation& evaluation) { return settingsLabel(evaluation.settings); }

EvaluationChart draw(std::string name, const Chart& chart) {
  return {std::move(name), chart.title, chartSvg(chart)};
}

/// Whether any series has a point.
bool hasPoints(const Chart& chart) {
  return std::any_of(chart.series.begin(), chart.series.end(),
                     [](const ChartSeries& series) { return !series.points.empty(); });
}

std::string solvedNote(const Evaluations& evaluations) {
  std::string note;
  for (const Evaluation& evaluation : evaluations) {
    note += fmt::format("{}{} of {}", note.empty() ? "solved cases: " : ", ",
                        evaluation.total.solved, evaluation.total.cases);
  }
  return note;
}

/// Mean Score of each row, with the paper's.
Chart scoreChart(const Evaluations& evaluations) {
  Chart chart{"Score by object", "means of the solved cases", {"Score", false, 0, 1}, {""}};
  std::vector<std::string>& names = chart.y.names;
  ChartSeries paper{"the paper"};
  for (const PaperRow& row : kPaperRows) {
    const std::string surface = fmt::format("{} ({})", row.object, row.surface);
    const auto isThis = [&](const EvaluationRow& ours) {
      return ours.name == surface || (ours.name == row.object && paperRow(row.object, "") == &row);
    };
    const bool any =
        std::any_of(evaluations.begin(), evaluations.end(), [&](const Evaluation& evaluation) {
          return std::any_of(evaluation.rows.begin(), evaluation.rows.end(), isThis);
        });
    if (!any) continue;
    const auto place = static_cast<double>(names.size());
    names.push_back(surface);
    paper.points.emplace_back(row.score, place);
    chart.series.resize(evaluations.size());
    for (std::size_t i = 0; i < evaluations.size(); ++i) {
      const auto& rows = evaluations[i].rows;
      const auto ours = std::find_if(rows.begin(), rows.end(), isThis);
      if (ours != rows.end() && ours->solved > 0)
        chart.series[i].points.emplace_back(ours->meanScore, place);
    }
  }
  for (std::size_t i = 0; i < chart.series.size(); ++i)
    chart.series[i].name = labelOf(evaluations[i]);
  chart.series.push_back(std::move(paper));
  return chart;
}

/// How many contacts have at most so large a factor.
Chart factorChart(const Evaluation& evaluation) {
  Chart chart{"Factors of contacts, " + labelOf(evaluation),
              solvedNote({evaluation}) + "; a line that runs along the right edge is good",
              {"factor", false, 0, 1},
              {"share of contacts with at most this factor", false, 0, 1}};
  struct Kind {
    const char* name;
    double ContactFactors::*value;
    bool always;  ///< else only where some contact has one
  };
  for (const Kind& kind : {Kind{"f_v, velocity", &ContactFactors::v, true},
                           Kind{"f_q, orientation", &ContactFactors::q, true},
                           Kind{"f_t, time warp", &ContactFactors::t, true},
                           Kind{"f_a, amplitude", &ContactFactors::a, true},
                           Kind{"f_l, duration", &ContactFactors::l, true},
                           Kind{"f_c, centroid", &ContactFactors::c, true},
                           Kind{"f_o, as asked", &ContactFactors::o, false},
                           Kind{"f_p, place", &ContactFactors::p, false}}) {
    std::vector<double> values;
    for (const CaseOutcome& outcome : evaluation.cases) {
      if (!outcome.solved) continue;
      for (const ContactFactors& factors : outcome.factors) values.push_back(factors.*kind.value);
    }
    const bool any = std::any_of(values.begin(), values.end(), [](double v) { return v != 1; });
    if (kind.always || any) chart.series.push_back(cumulativeShare(kind.name, std::move(values)));
  }
  return chart;
}

Chart bendChart(const Evaluations& evaluations) {
  Chart chart{"Bend of contacts",
              solvedNote(evaluations),
              {"bend (1: the edge of what is plausible)", false, 0},
              {"share of contacts with at most this bend", false, 0, 1}};
  for (const Evaluation& evaluation : evaluations) {
    std::vector<double> bends;
    for (const CaseOutcome& outcome : evaluation.cases) {
      if (outcome.solved) bends.insert(bends.end(), outcome.bends.begin(), outcome.bends.end());
    }
    chart.series.push_back(cumulativeShare(labelOf(evaluation), std::move(bends)));
  }
  chart.guides = {{ChartGuide::Kind::kUp, 1, "plausible up to here"}};
  return chart;
}

Chart timeChart(const Evaluations& evaluations) {
  Chart chart{"Search time against contacts",
              solvedNote(evaluations),
              {"contacts of the sound, n", false, 0},
              {"search, s", true}};
  for (const Evaluation& evaluation : evaluations) {
    ChartSeries series{labelOf(evaluation)};
    for (const CaseOutcome& outcome : evaluation.cases) {
      if (outcome.solved) series.points.emplace_back(outcome.contacts, outcome.searchSeconds);
    }
    chart.series.push_back(std::move(series));
  }
  return chart;
}

/// As figures 3 and 12: where within a contact that lasts its loudness lies.
Chart centroidChart(const Evaluations& evaluations) {
  Chart chart{"Contacts that last: centroids",
              solvedNote(evaluations),
              {"centroid of the sound's contact, ms after its start", false, 0},
              {"centroid of the motion's contact, ms", false, 0}};
  for (const Evaluation& evaluation : evaluations) {
    ChartSeries series{labelOf(evaluation)};
    for (const CaseOutcome& outcome : evaluation.cases) {
      if (!outcome.solved) continue;
      for (const ContinuousContact& contact : outcome.continuous)
        series.points.emplace_back(1e3 * contact.targetCentroid, 1e3 * contact.centroid);
    }
    chart.series.push_back(std::move(series));
  }
  chart.guides = {{ChartGuide::Kind::kDiagonal, 0, "the same"}};
  return chart;
}

/// As figure 16, where databases of several sizes were searched.
Chart sizeChart(const Evaluations& evaluations) {
  Chart chart{"Score against the size of the database",
              "0: no motion was found",
              {"simulations", true},
              {"Score", false, 0, 1}};
  std::map<std::string, std::vector<std::pair<double, double>>> lines;
  std::set<std::uint64_t> sizes;
  for (const Evaluation& evaluation : evaluations) {
    if (evaluation.settings.planner != "graph") continue;
    sizes.insert(evaluation.settings.graph.simulations);
    for (const EvaluationRow& row : evaluation.rows) {
      lines[row.name].emplace_back(static_cast<double>(evaluation.settings.graph.simulations),
                                   row.meanScore);
    }
  }
  if (sizes.size() < 2) return chart;
  for (auto& [name, points] : lines) {
    std::sort(points.begin(), points.end());
    chart.series.push_back({name, ChartStyle::kMarkedLine, std::move(points)});
  }
  return chart;
}

}  // namespace

std::vector<EvaluationChart> evaluationCharts(const std::vector<Evaluation>& evaluations) {
  std::vector<EvaluationChart> charts;
  const auto add = [&](std::string name, const Chart& chart) {
    if (hasPoints(chart)) charts.push_back(draw(std::move(name), chart));
  };
  const Chart size = sizeChart(evaluations);
  add("size", size);
  if (hasPoints(size) || evaluations.size() > kMostSideBySide) return charts;
  add("score", scoreChart(evaluations));
  add("time", timeChart(evaluations));
  add("bend", bendChart(evaluations));
  for (std::size_t i = 0; i < evaluations.size(); ++i)
    add(i == 0 ? "factors" : fmt::format("factors-{}", i + 1), factorChart(evaluations[i]));
  add("centroids", centroidChart(evaluations));
  return charts;
}

}  // namespace ifa
