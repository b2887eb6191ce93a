// SPDX-License-Identifier: Apache-2.0
// The report of evaluations in Markdown.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "audit/orientation_errors.h"
#include "base/statistics.h"
#include "pipeline/evaluation_report.h"
#include "sampler/paper_rows.h"

namespace ifa {
namespace {

/// A bar would end the cell, a line end the row.
std::string cell(std::string text) {
  for (char& c : text) {
    if (c == '|') c = '/';
    if (c == '\n' || c == '\r') c = ' ';
  }
  return text;
}

/// A line of a table, from the texts of its cells.
std::string line(const std::vector<std::string>& cells) {
  std::string text = "|";
  for (const std::string& one : cells) text += " " + one + " |";
  return text + "\n";
}

std::string head(const std::vector<std::string>& cells) {
  return line(cells) + line(std::vector<std::string>(cells.size(), "---"));
}

std::string solvedOf(int solved, int cases) {
  return fmt::format("{}/{} ({:.0f} %)", solved, cases, cases > 0 ? 100.0 * solved / cases : 0);
}

bool isGraph(const Evaluation& evaluation) { return evaluation.settings.planner == "graph"; }

const std::vector<std::string> kColumns = {"object",
                                           "by",
                                           "events in database",
                                           "cases",
                                           "mean n",
                                           "solved",
                                           "search, s",
                                           "Score",
                                           "without sound",
                                           "f_v",
                                           "bend, median",
                                           "at most 1",
                                           "largest",
                                           "wall, median s",
                                           "p95 s"};
const std::vector<std::string> kGraphColumns = {"Score 0.3", "s to 0.3", "arrival bend, median",
                                                "largest"};

std::vector<std::string> cellsOf(const std::string& name, const Evaluation& evaluation,
                                 const EvaluationRow& row) {
  // Of solved cases; nothing where there are none.
  const auto number = [&](double value, int digits) {
    return row.solved > 0 ? fmt::format("{:.{}f}", value, digits) : "";
  };
  return {name,
          settingsLabel(evaluation.settings),
          row.events < 0 ? "none" : std::to_string(row.events),
          std::to_string(row.cases),
          fmt::format("{:.1f}", row.meanContacts),
          solvedOf(row.solved, row.cases),
          number(row.meanSearchSeconds, 2),
          number(row.meanScore, 3),
          number(row.meanScoreWithoutSound, 3),
          number(row.meanFv, 3),
          number(row.bendMedian, 2),
          row.solved > 0 ? fmt::format("{:.1f} %", 100 * row.bendShareUpToOne) : "",
          number(row.bendMax, 2),
          fmt::format("{:.2f}", row.wallMedian),
          fmt::format("{:.2f}", row.wallP95)};
}

/// What only searches of a database have.
std::vector<std::string> graphCellsOf(const EvaluationRow& row) {
  return {fmt::format("{}/{}", row.good, row.cases),
          row.good > 0 ? fmt::format("{:.2f}", row.meanGoodSeconds) : "",
          row.solved > 0 ? fmt::format("{:.2f}", row.arrivalBendMedian) : "",
          row.solved > 0 ? fmt::format("{:.2f}", row.arrivalBendMax) : ""};
}

std::vector<std::string> paperCells(const PaperRow& row) {
  return {"",
          "paper",
          std::to_string(row.nodes),
          std::to_string(row.sounds),
          fmt::format("{:.1f}", row.meanContacts),
          solvedOf(row.solved, row.sounds),
          fmt::format("{:.0f}", 60 * row.searchMinutes),
          fmt::format("{:.2f}", row.score)};
}

/// The table's rows, by the name of each, in order of first appearance.
struct SideBySide {
  struct Part {
    const Evaluation* evaluation;
    const EvaluationRow* row;
  };
  std::vector<std::string> names;
  std::map<std::string, std::vector<Part>> parts;

  explicit SideBySide(const std::vector<Evaluation>& evaluations) {
    for (const Evaluation& evaluation : evaluations) {
      for (const EvaluationRow& row : evaluation.rows) {
        if (!parts.contains(row.name)) names.push_back(row.name);
        parts[row.name].push_back({&evaluation, &row});
      }
    }
    std::stable_sort(names.begin(), names.end(), [&](const auto& a, const auto& b) {
      return paperRowNamed(a) < paperRowNamed(b);  // in the paper's order; nullptr first
    });
  }
};

std::vector<std::string> totalOfPaper(const SideBySide& rows) {
  int solved = 0, sounds = 0;
  for (const std::string& name : rows.names) {
    const PaperRow* paper = paperRowNamed(name);
    if (paper == nullptr) continue;
    solved += paper->solved;
    sounds += paper->sounds;
  }
  if (sounds == 0) return {};
  return {"", "paper", "", std::to_string(sounds), "", solvedOf(solved, sounds)};
}

}  // namespace

std::string evaluationTable(const std::vector<Evaluation>& evaluations) {
  const bool graph = std::any_of(evaluations.begin(), evaluations.end(), isGraph);
  std::vector<std::string> columns = kColumns;
  if (graph) columns.insert(columns.end(), kGraphColumns.begin(), kGraphColumns.end());
  std::string text = head(columns);
  const auto add = [&](std::vector<std::string> cells, const std::vector<std::string>& more = {}) {
    cells.insert(cells.end(), more.begin(), more.end());
    cells.resize(columns.size());
    text += line(cells);
  };
  const auto addOurs = [&](const std::string& name, const Evaluation& evaluation,
                           const EvaluationRow& row) {
    add(cellsOf(name, evaluation, row),
        isGraph(evaluation) ? graphCellsOf(row) : std::vector<std::string>());
  };
  const SideBySide rows(evaluations);
  for (const std::string& name : rows.names) {
    std::string shown = name;
    for (const SideBySide::Part& part : rows.parts.at(name)) {
      addOurs(shown, *part.evaluation, *part.row);
      shown.clear();
    }
    if (const PaperRow* paper = paperRowNamed(name)) add(paperCells(*paper));
  }
  for (const Evaluation& evaluation : evaluations)
    addOurs(&evaluation == &evaluations.front() ? "all" : "", evaluation, evaluation.total);
  if (const auto paper = totalOfPaper(rows); !paper.empty()) add(paper);
  return text;
}

namespace {

// ---- Contacts that last (figures 3 and 12) ----

constexpr double kCentroidMet = 0.010;  // s, half-width of f_c

void addLasting(const std::string& name, const std::string& label,
                const std::vector<const CaseOutcome*>& cases, std::string& text) {
  std::vector<double> centroids, durations;
  for (const CaseOutcome* outcome : cases) {
    for (const ContinuousContact& contact : outcome->continuous) {
      centroids.push_back(1e3 * std::abs(contact.centroid - contact.targetCentroid));
      durations.push_back(1e3 * std::abs(contact.duration - contact.targetDuration));
    }
  }
  if (centroids.empty()) return;
  const auto met = std::count_if(centroids.begin(), centroids.end(),
                                 [](double off) { return off <= 1e3 * kCentroidMet; });
  const auto count = static_cast<double>(centroids.size());
  text += line({name, label, std::to_string(centroids.size()),
                fmt::format("{:.1f}", medianOf(centroids)),
                fmt::format("{:.1f}", quantileOf(centroids, 0.9)),
                fmt::format("{:.0f} %", 100 * static_cast<double>(met) / count),
                fmt::format("{:.1f}", medianOf(durations)),
                fmt::format("{:.1f}", quantileOf(durations, 0.9))});
}

std::vector<const CaseOutcome*> solvedOf(const Evaluation& evaluation, const std::string& object,
                                         const std::string& surface, bool all) {
  std::vector<const CaseOutcome*> cases;
  for (const CaseOutcome& outcome : evaluation.cases) {
    const bool same = outcome.what.object == object && outcome.what.surface == surface;
    if (outcome.solved && (all || same)) cases.push_back(&outcome);
  }
  return cases;
}

/// The first case of each row.
std::vector<const CaseOutcome*> rowsOf(const Evaluation& evaluation) {
  std::vector<const CaseOutcome*> firsts;
  for (const CaseOutcome& outcome : evaluation.cases) {
    const bool known = std::any_of(firsts.begin(), firsts.end(), [&](const CaseOutcome* first) {
      return first->what.object == outcome.what.object &&
             first->what.surface == outcome.what.surface;
    });
    if (!known) firsts.push_back(&outcome);
  }
  return firsts;
}

std::string nameOf(const EvaluationCase& what) {
  return what.surface.empty() ? what.object : what.object + " (" + what.surface + ")";
}

std::string lastingMarkdown(const std::vector<Evaluation>& evaluations) {
  std::string text;
  for (const Evaluation& evaluation : evaluations) {
    const std::string label = settingsLabel(evaluation.settings);
    for (const CaseOutcome* row : rowsOf(evaluation)) {
      addLasting(nameOf(row->what), label,
                 solvedOf(evaluation, row->what.object, row->what.surface, false), text);
    }
    addLasting("all", label, solvedOf(evaluation, "", "", true), text);
  }
  if (text.empty()) return text;
  return "\n### Contacts that last\n\nOf solved cases: how far the motion's centroid (equation 8) "
         "and duration are from the sound's, and how many centroids lie within 10 ms, where f_c "
         "is one half.\n\n" +
         head({"object", "by", "contacts", "centroid off, median ms", "90 %", "within 10 ms",
               "duration off, median ms", "90 %"}) +
         text;
}

// ---- Places (Table 2) ----

std::vector<std::string> placeCells(double largest, double relativeLargest, double mean,
                                    double relativeMean, double side) {
  return {fmt::format("{:.1f} / {:.3f}", 100 * largest, relativeLargest),
          fmt::format("{:.1f} / {:.3f}", 100 * mean, relativeMean),
          fmt::format("{:.1f}", 100 * side)};
}

std::string placesMarkdown(const std::vector<Evaluation>& evaluations) {
  std::string text;
  const auto add = [&](std::vector<std::string> cells, const std::vector<std::string>& numbers) {
    cells.insert(cells.end(), numbers.begin(), numbers.end());
    text += line(cells);
  };
  for (const Evaluation& evaluation : evaluations) {
    for (const CaseOutcome& outcome : evaluation.cases) {
      if (!outcome.places) continue;
      const PlaceErrors& off = *outcome.places;
      const double side = std::max(1e-9, off.longestSide);
      add({cell(outcome.what.name), settingsLabel(evaluation.settings),
           std::to_string(outcome.contacts), fmt::format("{:.3f}", outcome.score)},
          placeCells(off.largest, off.largest / side, off.mean, off.mean / side, side));
    }
  }
  if (text.empty()) return text;
  for (const PaperPlaces& paper : kPaperPlaces) {
    add({std::string(paper.motion), "paper", "", ""},
        placeCells(paper.largest, paper.relativeLargest, paper.mean, paper.relativeMean,
                   paper.longestSide));
  }
  return "\n### Places\n\nAs the paper's Table 2: how far contacts begin from where the true "
         "motion's do, absolute and relative to the longest side of the path's box.\n\n" +
         head({"motion", "by", "n", "Score", "largest, cm / relative", "mean, cm / relative",
               "longest side, cm"}) +
         text;
}

// ---- Orientations ----

const CaseOutcome* sameCase(const Evaluation& evaluation, const CaseOutcome& wanted) {
  const auto found = std::find_if(
      evaluation.cases.begin(), evaluation.cases.end(), [&](const CaseOutcome& outcome) {
        return outcome.what.object == wanted.what.object &&
               outcome.what.surface == wanted.what.surface && outcome.what.name == wanted.what.name;
      });
  return found == evaluation.cases.end() ? nullptr : &*found;
}

bool hasWishes(const CaseOutcome& outcome) { return !outcome.orientationErrors.empty(); }

/// Mean Score that the wishes cost, over cases that are solved with and without them.
std::string scoreGivenUp(const std::vector<Evaluation>& evaluations,
                         const std::vector<const CaseOutcome*>& cases) {
  double sum = 0, count = 0;
  for (const CaseOutcome* outcome : cases) {
    for (const Evaluation& plain : evaluations) {
      const CaseOutcome* other = sameCase(plain, *outcome);
      if (other == nullptr || hasWishes(*other) || !other->solved || !outcome->solved) continue;
      sum += other->score - outcome->score;
      ++count;
      break;
    }
  }
  return count > 0 ? fmt::format("{:.3f}", sum / count) : "";
}

std::string orientationsMarkdown(const std::vector<Evaluation>& evaluations) {
  std::string text;
  for (const Evaluation& evaluation : evaluations) {
    for (const CaseOutcome* row : rowsOf(evaluation)) {
      std::vector<const CaseOutcome*> cases;
      int solved = 0, met = 0;
      double largest = 0, score = 0;
      for (const CaseOutcome& outcome : evaluation.cases) {
        if (nameOf(outcome.what) != nameOf(row->what) || !hasWishes(outcome)) continue;
        cases.push_back(&outcome);
        if (!outcome.solved) continue;
        const double error =
            *std::max_element(outcome.orientationErrors.begin(), outcome.orientationErrors.end());
        ++solved;
        if (error <= kOrientationMet) ++met;
        largest = std::max(largest, error);
        score += outcome.score;
      }
      if (cases.empty()) continue;
      text += line({nameOf(row->what), settingsLabel(evaluation.settings),
                    solvedOf(solved, static_cast<int>(cases.size())),
                    fmt::format("{}/{}", met, cases.size()),
                    fmt::format("{:.2f}", largest * 180 / std::numbers::pi),
                    solved > 0 ? fmt::format("{:.3f}", score / solved) : "",
                    scoreGivenUp(evaluations, cases)});
    }
  }
  if (text.empty()) return text;
  return "\n### Orientations\n\nHow many lie as asked, within 4 degrees, and the mean Score given "
         "up against the same sounds without the wish.\n\n" +
         head({"object", "by", "solved", "as asked", "largest angle of the solved, degrees",
               "Score", "given up"}) +
         text;
}

// ---- Cases ----

/// "0.56", or "0.80 for 0.56" where it was fitted.
std::string restitutionOf(const CaseOutcome& outcome) {
  const std::string used = fmt::format("{:.2f}", outcome.restitution);
  if (outcome.restitution == outcome.givenRestitution) return used;
  return fmt::format("{} for {:.2f}", used, outcome.givenRestitution);
}

std::string casesMarkdown(const std::vector<Evaluation>& evaluations) {
  std::string text = head({"object", "case", "by", "n", "solved", "Score", "f_v", "bend, median",
                           "bend, largest", "search, s", "wall, s", "restitution", "why not"});
  for (const Evaluation& evaluation : evaluations) {
    for (const CaseOutcome& outcome : evaluation.cases) {
      text += line(
          {nameOf(outcome.what), cell(outcome.what.name), settingsLabel(evaluation.settings),
           std::to_string(outcome.contacts), outcome.solved ? "yes" : "no",
           fmt::format("{:.3f}", outcome.score), fmt::format("{:.3f}", outcome.meanFv),
           fmt::format("{:.2f}", medianOf(outcome.bends)),
           fmt::format("{:.2f}", quantileOf(outcome.bends, 1)),
           fmt::format("{:.2f}", outcome.searchSeconds), fmt::format("{:.2f}", outcome.wallSeconds),
           restitutionOf(outcome), cell(outcome.failure)});
    }
  }
  return text;
}

std::string textOf(const Eigen::Vector3d& direction) {
  return fmt::format("{},{},{}", direction.x(), direction.y(), direction.z());
}

/// As `--orient` has it.
std::string textOf(const OrientationWish& wish) {
  const bool up = wish.world == Eigen::Vector3d::UnitZ();
  const bool down = wish.world == -Eigen::Vector3d::UnitZ();
  return fmt::format("{}:{}={}", wish.contact == 0 ? "last" : std::to_string(wish.contact),
                     wish.face.empty() ? textOf(wish.body) : wish.face,
                     up     ? "up"
                     : down ? "down"
                            : textOf(wish.world));
}

}  // namespace

std::string settingsLabel(const EvaluateSettings& settings) {
  if (!settings.label.empty()) return settings.label;
  std::string label = settings.planner;
  const GraphOptions& graph = settings.graph;
  if (settings.planner == "graph") {
    label += fmt::format(", {} drops", graph.simulations);
    if (graph.cut == EventCut::kPaper) label += ", paper's cut";
    if (graph.printedVelocity) label += ", printed velocity";
    if (graph.timeWarp) label += ", blended";
  }
  if (!graph.symmetry) label += ", no images";
  if (settings.timeLimitSeconds > 0) label += fmt::format(", {} s", settings.timeLimitSeconds);
  if (settings.restitutionScale != 1)
    label += fmt::format(", restitution x {}", settings.restitutionScale);
  if (settings.fit) label += ", fitted";
  for (const OrientationWish& wish : settings.orientations) label += ", " + textOf(wish);
  return label;
}

std::string evaluationMarkdown(const std::vector<Evaluation>& evaluations,
                               const std::string& stem) {
  std::string text = "# " + stem + "\n\n" + evaluationTable(evaluations);
  if (std::any_of(evaluations.begin(), evaluations.end(),
                  [](const Evaluation& evaluation) { return evaluation.interrupted; })) {
    text += "\nInterrupted: only the cases that were done.\n";
  }
  text += lastingMarkdown(evaluations) + placesMarkdown(evaluations) +
          orientationsMarkdown(evaluations);
  text += "\n### Charts\n\n";
  for (const EvaluationChart& chart : evaluationCharts(evaluations))
    text += fmt::format("![{}]({}-{}.svg)\n\n", chart.title, stem, chart.name);
  return text + "## Cases\n\n" + casesMarkdown(evaluations);
}

}  // namespace ifa
