// SPDX-License-Identifier: Apache-2.0
// Best transitions of an event database: are those that the search trees find those of a full scan,
// and how much sooner are they found. Queries are contacts of drops that are not in the database.
//   graph_bench OBJECT FILE|SIMULATIONS [QUERIES [audible|paper]]
// With a number of simulations the database is made in the cache, where it is not there yet, by the
// cut named last.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "base/parallel.h"
#include "base/random.h"
#include "body/object_file.h"
#include "dynamics/simulator.h"
#include "graph/contact_graph.h"
#include "graph/tree_events.h"
#include "pipeline/build_database.h"
#include "sampler/drop_statistics.h"
#include "sampler/initial_state.h"

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define IFA_WIDEST __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define IFA_WIDEST
#endif

namespace {

using ifa::Body;
using ifa::ContactEvent;
using ifa::ContactGraph;
using ifa::EventDatabase;
using ifa::GraphSettings;
using ifa::Transition;

constexpr std::uint64_t kSeed = 4711;  // the databases have others
constexpr std::size_t kBest = 5, kChecked = 40, kTimed = 100, kImages = 2000;
constexpr double kTimeLimit = 20;  // s
constexpr double kMissing = -20;   // log weight that an edge not found counts as, or the worst's
constexpr float kNone = -std::numeric_limits<float>::infinity();

struct Query {
  ifa::TransitionSource source;
  ifa::TransitionTarget target;
};

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Of this process, those of mapped files included.
double residentMegabytes() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.rfind("VmRSS:", 0) == 0) return std::strtod(line.c_str() + 6, nullptr) / 1024;
  return 0;
}

/// What some contact of a drop was followed by, changed: time by up to 10 %, loudness by 30 %.
Query makeQuery(const Body& body, const ifa::BodyModel& model, const ifa::RecorderSettings& cut,
                std::size_t q) {
  ifa::RandomStream random(kSeed, q);
  for (std::size_t attempt = 0;; ++attempt) {
    const auto start = ifa::sampleInitialState(body, kSeed + 1, q + (attempt << 32));
    const auto events = ifa::eventsOf(ifa::simulateDrop(model, start, kTimeLimit), cut);
    if (events.size() < 2) continue;
    const std::size_t i = random.below(events.size() - 1);
    const ContactEvent &from = events[i], &to = events[i + 1];
    const double time = to.start - from.end, first = events[0].amplitude;
    if (from.touchingAfter || !(time > 0)) continue;
    return {{from.before, from.after},
            {time * random.uniform(0.9, 1.1),
             {to.amplitude / first * random.uniform(0.7, 1.3), to.filteredDuration(cut.mergeGap),
              to.centroid},
             to.terminal,
             first}};
  }
}

std::vector<Query> makeQueries(const Body& body, const EventDatabase& database, std::size_t count) {
  auto surface = body.definition.surfaces.at(body.definition.defaultSurface);
  const ifa::DatabaseSettings& made = database.header().identity.settings;
  surface.referenceImpulse = made.referenceImpulse;
  const ifa::BodyModel model(body, surface);
  const ifa::RecorderSettings cut = ifa::recorderFor(ifa::cutOf(made), body, surface);
  std::vector<Query> queries(count);
  ifa::parallelFor(count, [&](std::size_t q) { queries[q] = makeQuery(body, model, cut, q); });
  return queries;
}

/// The best of all, by looking at every event, as each of its images, in single precision and at
/// the best of them again.
std::vector<Transition> exhaustive(const ContactGraph& graph, const Body& body,
                                   const Query& query) {
  const ifa::SymmetryGroup& group = graph.symmetry();
  const ifa::Folding folding(group);
  std::map<std::uint32_t, Transition> bySibling;
  for (std::size_t i = 0; i < group.order(); ++i) {
    const ifa::SymmetryImage& image = graph.image(group.inverse(i));
    const ifa::TreeQuery asked(body, graph.settings(),
                               {image.apply(query.source.before), image.apply(query.source.after)},
                               query.target);
    for (const auto& find : graph.tree(query.target.terminal).scan(asked, kBest)) {
      const auto element = static_cast<std::uint32_t>(
          group.product(folding.elementOf(graph.database(), find.sibling), i));
      const auto weight = graph.edgeWeight(query.source, query.target, find.sibling, element);
      if (!weight.exists()) continue;
      const Transition edge{find.sibling, weight, weight.total(), element};
      const auto [at, isNew] = bySibling.emplace(find.sibling, edge);
      if (!isNew && edge.total > at->second.total) at->second = edge;
    }
  }
  std::vector<Transition> best;
  for (const auto& entry : bySibling) best.push_back(entry.second);
  std::sort(best.begin(), best.end(), [](const Transition& a, const Transition& b) {
    return a.total != b.total ? a.total > b.total : a.sibling < b.sibling;
  });
  best.resize(std::min(best.size(), kBest));
  return best;
}

/// The same edges, or others of the same weight.
bool same(const std::vector<Transition>& found, const std::vector<Transition>& truth) {
  return std::equal(found.begin(), found.end(), truth.begin(), truth.end(),
                    [](const Transition& a, const Transition& b) {
                      return std::abs(a.total - b.total) <= 1e-12;
                    });
}

using Answers = std::vector<std::vector<Transition>>;

template <class Answer>
Answers answersTo(const std::vector<Query>& queries, const Answer& answer) {
  Answers answers(queries.size());
  ifa::parallelFor(queries.size(), [&](std::size_t q) { answers[q] = answer(queries[q]); });
  return answers;
}

struct Recall {
  double queries = 0, complete = 0, best = 0, lost = 0, first = 0;
};

Recall recallOf(const Answers& found, const Answers& truths) {
  Recall recall;
  for (std::size_t q = 0; q < truths.size(); ++q) {
    const auto& truth = truths[q];
    if (truth.empty()) continue;
    ++recall.queries;
    recall.complete += same(found[q], truth) ? 1 : 0;
    recall.best += !found[q].empty() && found[q][0].total == truth[0].total ? 1 : 0;
    recall.first += truth[0].total;
    for (std::size_t i = 0; i < truth.size(); ++i) {
      const double missing = std::min(kMissing, truth.back().total);
      const double got = i < found[q].size() ? found[q][i].total : missing;
      recall.lost += (truth[i].total - got) / static_cast<double>(truth.size());
    }
  }
  return recall;
}

/// A scan in two steps over plain columns in the order of the events: what needs no turn first, the
/// rest of those few that may still be among the best.
class ColumnScan {
 public:
  ColumnScan(const std::vector<ifa::TreeEvent>& events, ifa::TreeQuery query)
      : query_(query), columns_(ifa::kTreeColumns) {
    for (auto& column : columns_) column.resize(events.size() / kBlock * kBlock);
    for (std::size_t c = 0; c < columns_.size(); ++c)
      for (std::size_t i = 0; i < columns_[c].size(); ++i) columns_[c][i] = events[i].values[c];
  }
  void ask(const ifa::TreeQuery& query) { query_ = query; }

  /// The best weights, best first.
  [[nodiscard]] std::vector<float> find() {
    best_.assign(kBest, kNone);
    waiting_ = 0;
    for (std::size_t first = 0; first < columns_[0].size(); first += kBlock) {
      bound(first, bounds_.data());
      for (std::size_t i = 0; i < kBlock; ++i)
        if (bounds_[i] > kNone && bounds_[i] >= best_.back()) wait(first + i);
    }
    flush();
    return best_;
  }
  /// Bytes of what every event is asked for.
  [[nodiscard]] double bytesRead() const {
    return 7.0 * sizeof(float) * static_cast<double>(columns_[0].size());
  }

 private:
  static constexpr std::size_t kBlock = 1024;

  static void boundAll(const float* x, const float* y, const float* z, const float* t,
                       const float* a, const float* d, const float* c, const ifa::TreeQuery& q,
                       float* out);
  void bound(std::size_t first, float* out) const {
    const auto at = [&](ifa::TreeColumn c) { return columns_[c].data() + first; };
    boundAll(at(ifa::kUpX), at(ifa::kUpY), at(ifa::kUpZ), at(ifa::kTime), at(ifa::kHeardLoud),
             at(ifa::kHeardDuration), at(ifa::kHeardCentroid), query_, out);
  }
  void wait(std::size_t event) {
    for (std::size_t c = 0; c < columns_.size(); ++c)
      leaf_[c * ifa::kLeafEvents + waiting_] = columns_[c][event];
    if (++waiting_ == ifa::kLeafEvents) flush();
  }
  void flush() {
    std::array<float, ifa::kLeafEvents> weights{};
    ifa::weighLeaf(leaf_.data(), query_, weights.data());
    for (std::size_t i = 0; i < waiting_; ++i) {
      if (!(weights[i] > best_.back())) continue;
      best_.insert(std::upper_bound(best_.begin(), best_.end(), weights[i], std::greater<>()),
                   weights[i]);
      best_.pop_back();
    }
    waiting_ = 0;
  }

  ifa::TreeQuery query_;
  std::vector<std::vector<float>> columns_;
  std::array<float, kBlock> bounds_{};
  std::array<float, ifa::kTreeColumns * ifa::kLeafEvents> leaf_{};
  std::vector<float> best_;
  std::size_t waiting_ = 0;
};

IFA_WIDEST void ColumnScan::boundAll(const float* x, const float* y, const float* z, const float* t,
                                     const float* a, const float* d, const float* c,
                                     const ifa::TreeQuery& q, float* out) {
  const auto squared = [](float s) { return s * s; };
  for (std::size_t i = 0; i < kBlock; ++i) {
    const float time = q.fixedTime + q.ownTime * t[i], ratio = t[i] / q.time;
    const float chord2 =
        squared(x[i] - q.up[0]) + squared(y[i] - q.up[1]) + squared(z[i] - q.up[2]);
    const float turn = q.orientation * chord2 / squared(std::min(time, q.longTime));
    const float sum = turn + q.timeWarp * squared(std::max(ratio, 1 / ratio) - 1) +
                      q.loudness * squared(a[i] - q.loud) +
                      q.sound * (squared(d[i] - q.duration) + squared(c[i] - q.centroid));
    out[i] = turn <= q.leastOrientation ? -sum : kNone;
  }
}

struct Times {
  double scan = 0, columns = 0, tree = 0, slowest = 0, count = 0;
};

Times timesOf(const ContactGraph& graph, const Body& body, const std::vector<Query>& queries,
              const std::vector<ifa::TreeEvent>& events) {
  Times times;
  double kept = 0;
  ColumnScan columns(events, {body, graph.settings(), queries[0].source, queries[0].target});
  for (const Query& query : queries) {
    if (query.target.terminal || times.count == static_cast<double>(kTimed)) continue;
    const ifa::TreeQuery asked(body, graph.settings(), query.source, query.target);
    ++times.count;
    columns.ask(asked);
    const double t0 = now();
    kept += static_cast<double>(graph.tree(false).scan(asked, kBest).size());
    const double t1 = now();
    kept += columns.find()[0] > kNone ? 1 : 0;
    const double t2 = now();
    kept += static_cast<double>(graph.best(query.source, query.target, kBest).size());
    const double t3 = now();
    times.scan += t1 - t0;
    times.columns += t2 - t1;
    times.tree += t3 - t2;
    times.slowest = std::max(times.slowest, t3 - t2);
  }
  fmt::print("  one thread, {} queries ({} edges), not terminal: ", times.count, kept);
  const double full =
      static_cast<double>(graph.tree(false).leaves()) * ifa::kLeafEvents * sizeof(ifa::TreeEvent);
  fmt::print(
      "tree {:.0f} us (slowest {:.0f}); scan of all weights {:.1f} ms ({:.1f} GB/s), {:.0f} "
      "times; in two steps {:.1f} ms ({:.1f} GB/s), {:.0f} times\n",
      times.tree / times.count * 1e6, times.slowest * 1e6, times.scan / times.count * 1e3,
      full * times.count / times.scan * 1e-9, times.scan / times.tree,
      times.columns / times.count * 1e3, columns.bytesRead() * times.count / times.columns * 1e-9,
      times.columns / times.tree);
  return times;
}

bool report(const char* name, const EventDatabase& database, const Body& body,
            const std::vector<Query>& queries, const GraphSettings& settings, bool timed) {
  const double begin = now();
  const auto graph = ContactGraph::make(database, body, settings);
  const double built = now() - begin;
  if (!graph) return false;
  const auto tree = [&](const Query& q) { return graph->best(q.source, q.target, kBest); };
  const auto scan = [&](const Query& q) { return exhaustive(*graph, body, q); };
  const double asking = now();
  const Answers found = answersTo(queries, tree);
  const double answered = now();
  const double resident = residentMegabytes();
  const Answers truths = answersTo(queries, scan);
  const std::size_t checked = std::max<std::size_t>(2, kChecked / graph->symmetry().order());
  const std::vector<Query> some(queries.begin(),
                                queries.begin() + std::min(queries.size(), checked));
  const Answers doubly =
      answersTo(some, [&](const Query& q) { return graph->bestByScan(q.source, q.target, kBest); });
  const auto right = std::count_if(some.begin(), some.end(), [&](const Query& q) {
    const auto i = static_cast<std::size_t>(&q - some.data());
    return same(truths[i], doubly[i]);
  });
  const Recall r = recallOf(found, truths);
  fmt::print(
      "  {}: {} of {} queries have an edge; all {} best found {:.2f} %, the best {:.2f} %, "
      "lost {:.4f} of a mean {:.1f}; scans agree {}/{}; {:.2f} ms a query, all threads\n",
      name, r.queries, queries.size(), kBest, 100 * r.complete / r.queries,
      100 * r.best / r.queries, r.lost / r.queries, r.first / r.queries, right, some.size(),
      (answered - asking) / static_cast<double>(queries.size()) * 1e3);
  double ends = 0, met = 0;
  for (std::size_t q = 0; q < queries.size(); ++q) {
    ends += queries[q].target.terminal ? 1 : 0;
    met += queries[q].target.terminal && !truths[q].empty() ? 1 : 0;
  }
  if (timed) {
    fmt::print("  {} of {} terminal ones have an edge; flights: {} to terminal events, {} others\n",
               met, ends, graph->tree(true).leaves() * ifa::kLeafEvents,
               graph->tree(false).leaves() * ifa::kLeafEvents);
    fmt::print("  trees made in {:.2f} s, {:.0f} MB ({:.1f} bytes a flight); resident {:.0f} MB\n",
               built, static_cast<double>(graph->indexBytes()) * 1e-6,
               static_cast<double>(graph->indexBytes()) /
                   static_cast<double>((graph->tree(false).leaves() + graph->tree(true).leaves()) *
                                       ifa::kLeafEvents),
               resident);
    timesOf(*graph, body, queries, ifa::treeEvents(database, {}, {})->onward);
    const double start = now();
    const auto starts = graph->bestStarts(0.2, {1, 0, 0}, {0, {0.6, 0, 0}, false, 1}, 100);
    fmt::print("  best {} starts in {:.0f} ms\n", starts.size(), (now() - start) * 1e3);
  }
  std::fflush(stdout);
  return static_cast<std::size_t>(right) == some.size() && r.complete >= 0.95 * r.queries;
}

/// Where the database is; made where it was asked for by a number of simulations.
std::string databaseOf(const Body& body, const std::string& asked, ifa::EventCut cut) {
  if (asked.find_first_not_of("0123456789") != std::string::npos) return asked;
  ifa::DatabaseRequest request;
  request.body = &body;
  request.surfaceName = body.definition.defaultSurface;
  request.surface =
      ifa::withReferenceImpulse(body, body.definition.surfaces.at(request.surfaceName), {});
  request.simulations = std::strtoull(asked.c_str(), nullptr, 10);
  request.resume = true;
  request.cut = cut;
  const auto path = ifa::cachedDatabasePath(ifa::identityOf(request));
  const auto built = ifa::buildDatabase(request, path, {});
  if (!built) fmt::print(stderr, "{}\n", built.error().text());
  return path.string();
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    fmt::print(stderr, "graph_bench OBJECT FILE|SIMULATIONS [QUERIES [audible|paper]]\n");
    return EXIT_FAILURE;
  }
  const auto body = ifa::loadObject(argv[1]);
  if (!body) {
    fmt::print(stderr, "{}\n", body.error().text());
    return EXIT_FAILURE;
  }
  const auto database =
      EventDatabase::open(databaseOf(*body, argv[2], ifa::cutNamed(argc > 4 ? argv[4] : "")));
  if (!database) {
    fmt::print(stderr, "{}\n", database.error().text());
    return EXIT_FAILURE;
  }
  fmt::print("{}: {} events, cut {}\n", argv[1], database->events(),
             ifa::cutName(ifa::cutOf(database->header().identity.settings)));
  const auto queries =
      makeQueries(*body, *database, argc > 3 ? std::strtoul(argv[3], nullptr, 10) : 2000);
  GraphSettings plain, printed, warped;
  plain.symmetry = printed.symmetry = warped.symmetry = false;
  printed.velocityReference = ifa::VelocityReference::kPrinted;
  warped.connection = ifa::ConnectionKind::kBlend;
  bool good = report("as it is", *database, *body, queries, plain, true);
  good = report("warped", *database, *body, queries, warped, false) && good;
  good = report("printed reference", *database, *body, queries, printed, false) && good;
  // Every image is scanned for.
  const std::size_t few = std::max<std::size_t>(20, kImages / ifa::findSymmetry(*body).order());
  const std::vector<Query> fewer(queries.begin(), queries.begin() + std::min(queries.size(), few));
  good = report("images", *database, *body, fewer, {}, false) && good;
  return good ? EXIT_SUCCESS : EXIT_FAILURE;
}
