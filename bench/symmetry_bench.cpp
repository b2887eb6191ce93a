// SPDX-License-Identifier: Apache-2.0
// What symmetry does for the planner "graph": the first odd cases of the evaluation set, planned
// with and without it from one database and with the same number of expanded nodes. Every motion is
// audited.
//   symmetry_bench OBJECT FILE [CASES] [NODES]
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "audit/audit.h"
#include "body/object_file.h"
#include "evaluation_cases.h"
#include "graph/contact_graph.h"
#include "motion/build_motion.h"
#include "planner/graph_planner.h"

namespace {

using ifa::Body;
using ifa::ContactGraph;
using ifa::EventDatabase;
using ifa::PlanRequest;

constexpr double kPreRoll = 0.3;  // s

double processSeconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

struct Tally {
  int solved = 0, failedAudits = 0, images = 0, contacts = 0;
  double score = 0, fv = 0, seconds = 0;
  std::vector<double> scores;  ///< of every case; 0: not solved

  void add(const PlanRequest& request, const ifa::Plan& plan) {
    scores.push_back(plan.solved ? plan.score : 0);
    if (!plan.solved) return;
    ++solved;
    score += plan.score;
    fv += plan.meanFv;
    for (const auto& contact : plan.contacts) {
      ++contacts;
      images += contact.source.symmetry != 0 ? 1 : 0;
    }
    auto motion = ifa::buildMotion(request, plan, kPreRoll);
    if (motion) motion->object.surface = request.body->definition.defaultSurface;
    if (!motion || !ifa::audit(*motion, *request.body).passed()) ++failedAudits;
  }
};

/// Nothing where there is no graph.
std::optional<Tally> report(const Body& body, const EventDatabase& database,
                            const std::vector<ifa::ContactSignature>& cases, long nodes,
                            bool symmetry) {
  ifa::GraphSettings settings;
  settings.symmetry = symmetry;
  const auto graph = ContactGraph::make(database, body, settings);
  if (!graph) return {};
  ifa::GraphPlannerSettings budget;
  budget.mostQueries = nodes;
  Tally tally;
  for (const auto& signature : cases) {
    PlanRequest request;
    request.body = &body;
    request.surface = body.definition.surfaces.at(body.definition.defaultSurface);
    request.graph = &*graph;
    request.signature = signature;
    request.settings.earlyExit = 1;  // or the budget would not be the same
    const double begin = processSeconds();
    const auto plans = ifa::GraphPlanner(budget).plan(request, {});
    tally.seconds += processSeconds() - begin;
    if (!plans) return {};
    tally.add(request, plans->at(0));
  }
  const double solved = std::max(1, tally.solved);
  fmt::print(
      "{} {}: solved {} of {}, Score {:.3f}, f_v {:.3f}, {} of {} contacts are images, "
      "{:.2f} s of a processor a case, {} audits failed\n",
      body.definition.name, graph->symmetry().name(), tally.solved, cases.size(),
      tally.score / solved, tally.fv / solved, tally.images, tally.contacts,
      tally.seconds / static_cast<double>(cases.size()), tally.failedAudits);
  std::fflush(stdout);
  return tally;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    fmt::print(stderr, "symmetry_bench OBJECT FILE [CASES] [NODES]\n");
    return EXIT_FAILURE;
  }
  const auto body = ifa::loadObject(argv[1]);
  const auto database = EventDatabase::open(argv[2]);
  if (!body || !database) {
    fmt::print(stderr, "{}\n", body ? database.error().text() : body.error().text());
    return EXIT_FAILURE;
  }
  const auto cases = ifa::bench::casesOf(argv[1], argc > 3 ? std::atoi(argv[3]) : 4);
  const long nodes = argc > 4 ? std::atol(argv[4]) : 2500;
  const auto plain = report(*body, *database, cases, nodes, false);
  const auto images = report(*body, *database, cases, nodes, true);
  if (!plain || !images) return EXIT_FAILURE;
  double both = 0, before = 0, after = 0;
  for (std::size_t i = 0; i < std::min(plain->scores.size(), images->scores.size()); ++i) {
    if (plain->scores[i] <= 0 || images->scores[i] <= 0) continue;
    ++both;
    before += plain->scores[i];
    after += images->scores[i];
  }
  if (both > 0)
    fmt::print("  {} solved either way: Score {:.3f}, {:.3f}\n", both, before / both, after / both);
  return plain->failedAudits + images->failedAudits == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
