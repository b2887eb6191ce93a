// SPDX-License-Identifier: Apache-2.0
// Best transitions of an event database: are those of the search trees those of a full scan, and
// how much sooner are they found. Queries are contacts of drops that are not in the database.
#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <string>
#include <vector>

#include "base/parallel.h"
#include "base/random.h"
#include "body/object_file.h"
#include "dynamics/simulator.h"
#include "graph/contact_graph.h"
#include "graph/tree_events.h"
#include "graph/tree_query.h"
#include "sampler/drop_statistics.h"
#include "sampler/initial_state.h"

namespace {

using ifa::Body;
using ifa::ContactEvent;
using ifa::ContactGraph;
using ifa::Transition;

constexpr std::uint64_t kSeed = 4711;  // the database has another
constexpr std::size_t kBest = 5;
constexpr double kTimeLimit = 20;  // s

struct Query {
  ifa::TransitionSource source;
  ifa::TransitionTarget target;
};

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Megabytes of this process that are in memory, those of mapped files included.
double residentMegabytes() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.rfind("VmRSS:", 0) == 0) return std::strtod(line.c_str() + 6, nullptr) / 1024;
  return 0;
}

/// What some contact of a drop was followed by, changed: time by up to 10 %, loudness by 30 %.
std::vector<Query> makeQueries(const Body& body, const ifa::EventDatabase& database,
                               std::size_t count) {
  auto surface = body.definition.surfaces.at(body.definition.defaultSurface);
  surface.referenceImpulse = database.header().identity.settings.referenceImpulse;
  const ifa::BodyModel model(body, surface);
  const double gap = database.header().identity.settings.mergeGap;
  std::vector<Query> queries(count);
  ifa::parallelFor(count, [&](std::size_t q) {
    ifa::RandomStream random(kSeed, q);
    for (std::size_t attempt = 0;; ++attempt) {
      const auto start = ifa::sampleInitialState(body, kSeed + 1, q + (attempt << 32));
      const auto events = ifa::eventsOf(ifa::simulateDrop(model, start, kTimeLimit),
                                        ifa::audibleCut(body, model.surface));
      if (events.size() < 2) continue;
      const std::size_t i = random.below(events.size() - 1);
      const ContactEvent &from = events[i], &to = events[i + 1];
      const double time = to.start - from.end;
      if (from.touchingAfter || !(time > 0)) continue;
      const double first = events[0].amplitude;
      queries[q] = {{from.before, from.after},
                    {time * random.uniform(0.9, 1.1),
                     {to.amplitude / first * random.uniform(0.7, 1.3), to.filteredDuration(gap),
                      to.centroid},
                     to.terminal,
                     first}};
      return;
    }
  });
  return queries;
}

struct Recall {
  std::size_t queries = 0, complete = 0, first = 0, none = 0;
  double lost = 0, fifth = 0, bestTotal = 0;
};

/// The same edges, or others of the same weight.
bool asGood(const std::vector<Transition>& found, const std::vector<Transition>& truth) {
  if (found.size() != truth.size()) return false;
  for (std::size_t i = 0; i < truth.size(); ++i)
    if (std::abs(found[i].total - truth[i].total) > 1e-12) return false;
  return true;
}

Recall recallOf(const ContactGraph& graph, const std::vector<Query>& queries,
                const std::vector<std::vector<Transition>>& truths) {
  std::vector<std::vector<Transition>> found(queries.size());
  ifa::parallelFor(queries.size(), [&](std::size_t q) {
    found[q] = graph.best(queries[q].source, queries[q].target, kBest);
  });
  Recall recall;
  for (std::size_t q = 0; q < queries.size(); ++q) {
    const auto& truth = truths[q];
    if (truth.empty()) {
      ++recall.none;
      continue;
    }
    ++recall.queries;
    recall.complete += asGood(found[q], truth) ? 1 : 0;
    recall.first += !found[q].empty() && found[q][0].sibling == truth[0].sibling ? 1 : 0;
    double lost = 0;
    // What is missing counts as an edge at the cut.
    for (std::size_t i = 0; i < truth.size(); ++i)
      lost += std::max(0.0, truth[i].total - (i < found[q].size() ? found[q][i].total : -20.0));
    recall.lost += lost / static_cast<double>(truth.size());
    recall.bestTotal += truth[0].total;
    recall.fifth += truth.back().total;
  }
  return recall;
}

}  // namespace

int main(int argc, char** argv) {
  const std::string object = argv[1], path = argv[2];
  const std::size_t count = argc > 3 ? std::strtoul(argv[3], nullptr, 10) : 500;
  const auto body = ifa::loadObject(object);
  auto database = ifa::EventDatabase::open(path);
  if (!body || !database) return EXIT_FAILURE;
  const auto queries = makeQueries(*body, *database, count);
  std::vector<std::vector<Transition>> truths(queries.size());
  const std::string cache = "/tmp/w_graph_truth_" + object + "_" + std::to_string(count);
  bool cached = false;
  for (const char* l = argc > 4 ? argv[4] : "500,1000,2000,4000,0"; l != nullptr;) {
    ifa::GraphSettings settings;
    settings.mostLeaves = std::strtoul(l, nullptr, 10);
    l = std::strchr(l, ',');
    if (l) ++l;
    double t = now();
    const auto graph = ContactGraph::make(*database, *body, settings);
    const double build = now() - t;
    if (!cached) {
      cached = true;
      if (FILE* f = std::fopen(cache.c_str(), "rb")) {
        for (auto& x : truths) {
          std::size_t n = 0;
          if (std::fread(&n, sizeof n, 1, f) != 1) return 1;
          x.resize(n);
          if (n && std::fread(static_cast<void*>(x.data()), sizeof(Transition), n, f) != n) return 1;
        }
        std::fclose(f);
      } else {
        t = now();
        ifa::parallelFor(queries.size(), [&](std::size_t q) {
          truths[q] = graph->bestByScan(queries[q].source, queries[q].target, kBest);
        });
        fmt::print("scan {:.1f} ms/query wall\n", (now() - t) / double(count) * 1e3);
        f = std::fopen(cache.c_str(), "wb");
        for (auto& x : truths) {
          std::size_t n = x.size();
          std::fwrite(&n, sizeof n, 1, f);
          std::fwrite(x.data(), sizeof(Transition), n, f);
        }
        std::fclose(f);
      }
    }
    const Recall r = recallOf(*graph, queries, truths);
    t = now();
    std::size_t n = 0;
    for (const auto& q : queries) n += graph->best(q.source, q.target, kBest).size();
    const double each = (now() - t) / double(count);
    const double all = double(r.queries);
    for (const bool terminal : {false, true}) {
      double scan = 0, find = 0, c = 0;
      for (const auto& q : queries) {
        if (q.target.terminal != terminal || (c >= 40)) continue;
        const ifa::TreeQuery query(*body, settings, q.source, q.target);
        const auto& tree = graph->tree(terminal);
        double t0 = now(); n += tree.scan(query, kBest).size(); double t1 = now(); 
        scan += t1 - t0; ++c;
        t1 = now();
        n += graph->best(q.source, q.target, kBest).size(); find += now() - t1;
      }
      fmt::print("  terminal {}: {} events, scan {:.2f} ms {:.1f} GB/s, find {:.0f} us, ratio {:.0f}\n", terminal, graph->tree(terminal).leaves()*32, scan/c*1e3, double(graph->tree(terminal).leaves()*32*60)/(scan/c)*1e-9, find/c*1e6, scan/find);
    }
    fmt::print(
        "{} leaves {:5}: build {:.2f} s, complete {:.2f} %, best {:.2f} %, lost {:.4f}, best {:.2f} fifth {:.2f}, "
        "none {}; {:.1f} us/query; index {:.0f} MB, resident {:.0f} MB\n",
        object, settings.mostLeaves, build, 100 * double(r.complete) / all, 100 * double(r.first) / all, r.lost / all,
        r.bestTotal / all, r.fifth / all, r.none, each * 1e6, double(graph->indexBytes()) / 1e6,
        residentMegabytes());
    std::fflush(stdout);
  }
}
