// SPDX-License-Identifier: Apache-2.0
// Makes the fixed evaluation set: signatures of drops that another engine simulated, heard with
// errors, of bodies a little unlike the ones that the planner uses (tests/evaluation/README.md).
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <iterator>
#include <numeric>
#include <string>
#include <vector>

#include "base/file.h"
#include "base/parallel.h"
#include "body/object_file.h"
#include "sampler/initial_state.h"
#include "sampler/listened_signature.h"
#include "sampler/simulator_comparison.h"
#include "signature/signature_json.h"
#include "tools/paper_rows.h"

namespace {

using ifa::Body;

constexpr std::size_t kCases = 20;
constexpr std::size_t kFewestContacts = 2;
constexpr double kTimeLimit = 20;     // s
constexpr double kEnergyRise = 0.01;  // share of the initial energy
constexpr double kNearMean = 0.15;    // share of the paper's n

struct Options {
  std::vector<std::string> objects;
  std::filesystem::path folder = std::filesystem::path(IFA_SOURCE_DIR) / "tests" / "evaluation";
  std::size_t drops = 1500;
  std::uint64_t seed = 2014;
  ifa::EventCut cut = ifa::EventCut::kAudible;
};

/// One drop of a body that differs a little from the nominal one.
struct Drop {
  std::uint64_t index = 0;
  double restitution = 0, size = 1;
  ifa::ContactSignature signature;  ///< audible: cases are chosen by it, whatever the cut
  ifa::ContactSignature written;    ///< by the cut asked for
  bool rested = false, keptEnergy = false;
};

Drop simulate(const Body& nominal, const Options& options, std::uint64_t index) {
  const ifa::ObjectDefinition& definition = nominal.definition;
  ifa::SurfaceProperties surface = definition.surfaces.at(definition.defaultSurface);
  // The initial state draws from the stream of this index too; this one must differ.
  ifa::RandomStream random(options.seed + 1, index);
  Drop drop;
  drop.index = index;
  drop.restitution = std::min(0.95, surface.restitution * random.uniform(0.9, 1.1));
  drop.size = random.uniform(0.98, 1.02);
  surface.restitution = drop.restitution;
  const Body body = ifa::scaledBody(nominal, drop.size);
  const ifa::RigidState start = ifa::sampleInitialState(body, options.seed, index);
  const ifa::DropResult result =
      ifa::simulateDropOde(body, surface, start, kTimeLimit, ifa::fineOde());
  const auto events = ifa::eventsOf(result, ifa::audibleCut(body, surface));
  const double speed = ifa::kineticSpeed(body, start);
  const double initial = body.mass * (speed * speed / 2 + ifa::kGravity * start.position.z());
  drop.rested = result.atRest;
  drop.keptEnergy = ifa::largestEnergyRise(body, events) <= kEnergyRise * initial;
  ifa::ListenerSettings listener;
  listener.mergeGap = definition.mergeGap;
  const ifa::RandomStream errors = random;  // each cut is heard with the same ones
  drop.signature = ifa::listenTo(events, listener, random);
  random = errors;
  drop.written = ifa::listenTo(ifa::eventsOf(result, ifa::recorderFor(options.cut, body, surface)),
                               listener, random);
  return drop;
}

/// The cases of one object, and how they came about.
struct ObjectSet {
  std::string name;
  double paperMean = 0;
  double restitution = 0, referenceImpulse = 0;
  std::size_t drops = 0, kept = 0;
  double meanOfDrops = 0;  // mean n of the drops kept
  bool longestTenth = false;
  std::vector<Drop> cases;
};

double contacts(const Drop& drop) { return static_cast<double>(drop.signature.events.size()); }

double meanContacts(const std::vector<Drop>& drops, std::size_t first = 0, std::size_t step = 1) {
  double sum = 0, count = 0;
  for (std::size_t i = first; i < drops.size(); i += step, ++count) sum += contacts(drops[i]);
  return count > 0 ? sum / count : 0;
}

std::vector<Drop> longestTenth(std::vector<Drop> drops) {
  std::stable_sort(drops.begin(), drops.end(),
                   [](const Drop& a, const Drop& b) { return contacts(a) > contacts(b); });
  drops.resize(std::max(kCases, drops.size() / 10));
  return drops;
}

void chooseCases(ObjectSet& set, std::vector<Drop> kept) {
  const std::vector<Drop> longest = longestTenth(kept);
  set.longestTenth = meanContacts(longest) < set.paperMean * (1 - kNearMean);
  if (set.longestTenth) kept = longest;
  std::vector<double> counts;
  std::transform(kept.begin(), kept.end(), std::back_inserter(counts), contacts);
  for (const std::size_t i : ifa::chooseByMean(counts, kCases, set.paperMean))
    set.cases.push_back(kept[i]);
}

ObjectSet makeObjectSet(const Body& body, double paperMean, const Options& options) {
  std::vector<Drop> drops(options.drops);
  ifa::parallelFor(drops.size(), [&](std::size_t i) { drops[i] = simulate(body, options, i); });
  const auto usable = [](const Drop& drop) {
    return drop.rested && drop.keptEnergy && drop.signature.events.size() >= kFewestContacts;
  };
  std::vector<Drop> kept;
  std::copy_if(drops.begin(), drops.end(), std::back_inserter(kept), usable);
  const auto& surface = body.definition.surfaces.at(body.definition.defaultSurface);
  ObjectSet set;
  set.name = body.definition.name;
  set.paperMean = paperMean;
  set.restitution = surface.restitution;
  set.referenceImpulse = surface.referenceImpulse;
  set.drops = drops.size();
  set.kept = kept.size();
  set.meanOfDrops = meanContacts(kept);
  if (kept.size() >= kCases) chooseCases(set, std::move(kept));
  for (Drop& drop : set.cases) drop.signature = drop.written;
  return set;
}

ifa::Result<void> writeCases(const ObjectSet& set, const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder / set.name);
  for (std::size_t i = 0; i < set.cases.size(); ++i) {
    const std::string file = fmt::format("{}-{:02}.signature.json", set.name, i);
    const auto written = ifa::writeSignature(folder / set.name / file, set.cases[i].signature);
    if (!written) return written;
  }
  return {};
}

constexpr const char* kIntroduction = R"(# Evaluation set

Made by `make_evaluation` (apps/tools), seed {seed}; do not edit. Each case is the signature of one
drop simulated by the ODE backend (steps of 0.25 ms) and heard with errors; the planner is given the
nominal object.

- Drops: initial states {seed}/0 to {seed}/{last} of the object's own sampling; restitution times a
  uniform 0.9 to 1.1 (at most 0.95), size times a uniform 0.98 to 1.02 at the same density.
- Kept: those that come to rest, with at least {fewest} audible events, whose energy never rises by
  more than 1 % of the initial across an event or from one event to the next.
- Chosen: {cases} of the kept whose mean number of contacts is the paper's n for the object, by
  exponential weights; from the longest tenth of the kept alone where even its mean is over 15 %
  short of the paper's n.
- Heard: starts off by a uniform +-3 ms, ends by +-8 ms, amplitudes relative to the first by +-30 %;
  starts stay a merge gap apart, ends a merge gap before the next start; what is then shorter than
  the merge gap is discrete. Events are {events}; all are terminal.
- Even-numbered cases are for tuning, odd-numbered ones are only reported.

)";

const char* eventsText(ifa::EventCut cut) {
  return cut == ifa::EventCut::kPaper
             ? "those of the paper's cut, any impulse above zero until the body rests"
             : "audible events at the object's J_ref";
}

std::string readmeText(const std::vector<ObjectSet>& sets, const Options& options) {
  std::string text =
      fmt::format(kIntroduction, fmt::arg("seed", options.seed),
                  fmt::arg("last", options.drops - 1), fmt::arg("fewest", kFewestContacts),
                  fmt::arg("cases", kCases), fmt::arg("events", eventsText(options.cut)));
  text +=
      "| object | paper's n | mean n | even, odd | from | drops kept | their mean n | "
      "restitution | J_ref, N s |\n|---|---|---|---|---|---|---|---|---|\n";
  for (const ObjectSet& set : sets) {
    text +=
        fmt::format("| {} | {} | {:.2f} | {:.1f}, {:.1f} | {} | {} of {} | {:.2f} | {} | {} |\n",
                    set.name, set.paperMean, meanContacts(set.cases), meanContacts(set.cases, 0, 2),
                    meanContacts(set.cases, 1, 2), set.longestTenth ? "longest tenth" : "all",
                    set.kept, set.drops, set.meanOfDrops, set.restitution, set.referenceImpulse);
  }
  text +=
      "\n| case | drop | contacts | last start, s | restitution | size |\n"
      "|---|---|---|---|---|---|\n";
  for (const ObjectSet& set : sets) {
    for (std::size_t i = 0; i < set.cases.size(); ++i) {
      const Drop& drop = set.cases[i];
      text += fmt::format("| {}-{:02} | {} | {} | {:.3f} | {:.3f} | {:.4f} |\n", set.name, i,
                          drop.index, drop.signature.events.size(),
                          drop.signature.events.back().time, drop.restitution, drop.size);
    }
  }
  return text;
}

ifa::Result<void> run(const Options& options) {
  std::vector<ObjectSet> sets;
  for (const std::string& name : options.objects) {
    const auto body = ifa::loadObject(name);
    if (!body) return tl::unexpected(body.error());
    const auto row = std::find_if(ifa::paperRows().begin(), ifa::paperRows().end(),
                                  [&](const ifa::PaperRow& r) { return r.object == name; });
    if (row == ifa::paperRows().end()) return ifa::badInput("not an object of the paper", name);
    sets.push_back(makeObjectSet(*body, row->meanContacts, options));
    const ObjectSet& set = sets.back();
    if (set.cases.empty()) return ifa::badInput("too few drops kept their energy", name);
    if (const auto done = writeCases(set, options.folder); !done) return done;
    fmt::print("{:<10} paper {:5.1f}  chosen {:5.2f}  kept {} of {}, mean {:.2f}{}\n", name,
               set.paperMean, meanContacts(set.cases), set.kept, set.drops, set.meanOfDrops,
               set.longestTenth ? ", longest tenth" : "");
  }
  return ifa::writeFileAtomically(options.folder / "README.md", readmeText(sets, options));
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Makes the fixed evaluation set"};
  Options options;
  app.add_option("OBJECT", options.objects, "objects (default: the ten of the set)");
  app.add_option("-o", options.folder, "folder to write in");
  app.add_option("-n", options.drops, "drops per object");
  app.add_option("--seed", options.seed);
  app.add_option_function<std::string>(
         "--cut", [&options](const std::string& name) { options.cut = ifa::cutNamed(name); },
         "events: audible (default), or paper: the same drops, any impulse above zero")
      ->check(CLI::IsMember({"audible", "paper"}));
  CLI11_PARSE(app, argc, argv);
  if (options.objects.empty())
    options.objects.assign(ifa::evaluationObjects().begin(), ifa::evaluationObjects().end());
  if (const auto done = run(options); !done) {
    fmt::print(stderr, "{}\n", done.error().text());
    return 3;
  }
  return 0;
}
