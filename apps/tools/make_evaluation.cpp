// SPDX-License-Identifier: Apache-2.0
// Makes the fixed evaluation set: signatures of drops that another engine simulated, heard with
// errors, of bodies a little unlike the ones that the planner uses (tests/evaluation/README.md).
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <nlohmann/json.hpp>
#include <numbers>
#include <numeric>
#include <string>
#include <vector>

#include "base/file.h"
#include "base/parallel.h"
#include "body/object_file.h"
#include "sampler/initial_state.h"
#include "sampler/listened_signature.h"
#include "sampler/paper_rows.h"
#include "sampler/simulator_comparison.h"
#include "signature/signature_json.h"

namespace {

using ifa::Body;

constexpr std::size_t kCases = 20;
constexpr std::size_t kFewestContacts = 2;
constexpr double kTimeLimit = 20;      // s
constexpr double kEnergyRise = 0.01;   // share of the initial energy
constexpr double kNearMean = 0.15;     // share of the paper's n
constexpr double kLabelNoise = 0.005;  // m, standard deviation on x and on y

struct Options {
  std::vector<std::string> objects;
  std::filesystem::path folder = std::filesystem::path(IFA_SOURCE_DIR) / "tests" / "evaluation";
  std::size_t drops = 1500;
  std::uint64_t seed = 2014;
  ifa::EventCut cut = ifa::EventCut::kAudible;
  bool positions = false;
  double leastSide = 0;  ///< m; drops whose places lie in a smaller box are left out
};

/// What a set is made of: an object on one of its surfaces.
struct Row {
  const Body& body;
  const std::string& surfaceName;
  double paperMean;  ///< the paper's mean n

  [[nodiscard]] const ifa::SurfaceProperties& surface() const {
    return body.definition.surfaces.at(surfaceName);
  }
};

/// One drop of a body that differs a little from the nominal one.
struct Drop {
  std::uint64_t index = 0;
  double restitution = 0, size = 1;
  ifa::ContactSignature signature;      ///< audible: cases are chosen by it, whatever the cut
  ifa::ContactSignature written;        ///< by the cut asked for
  std::vector<Eigen::Vector2d> places;  ///< of the centre of mass, where events of `written` begin
  bool rested = false, keptEnergy = false;
};

Drop simulate(const Row& row, const Options& options, std::uint64_t index) {
  ifa::SurfaceProperties surface = row.surface();
  // The initial state draws from the stream of this index too; this one must differ.
  ifa::RandomStream random(options.seed + 1, index);
  Drop drop;
  drop.index = index;
  drop.restitution = std::min(0.95, surface.restitution * random.uniform(0.9, 1.1));
  drop.size = random.uniform(0.98, 1.02);
  surface.restitution = drop.restitution;
  const Body body = ifa::scaledBody(row.body, drop.size);
  const ifa::RigidState start = ifa::sampleInitialState(body, options.seed, index);
  const ifa::DropResult result =
      ifa::simulateDropOde(body, surface, start, kTimeLimit, ifa::fineOde());
  const auto events = ifa::eventsOf(result, ifa::audibleCut(body, surface));
  const double speed = ifa::kineticSpeed(body, start);
  const double initial = body.mass * (speed * speed / 2 + ifa::kGravity * start.position.z());
  drop.rested = result.atRest;
  drop.keptEnergy = ifa::largestEnergyRise(body, events) <= kEnergyRise * initial;
  ifa::ListenerSettings listener;
  listener.mergeGap = row.body.definition.mergeGap;
  const ifa::RandomStream errors = random;  // each cut is heard with the same ones
  drop.signature = ifa::listenTo(events, listener, random);
  random = errors;
  const auto written = ifa::eventsOf(result, ifa::recorderFor(options.cut, body, surface));
  drop.written = ifa::listenTo(written, listener, random);
  for (const ifa::ContactEvent& event : written)
    drop.places.emplace_back(event.before.position.head<2>());
  return drop;
}

double longestSide(const std::vector<Eigen::Vector2d>& places) {
  Eigen::AlignedBox2d box;
  for (const Eigen::Vector2d& place : places) box.extend(place);
  return places.empty() ? 0 : box.sizes().maxCoeff();
}

/// The cases of one object, and how they came about.
struct ObjectSet {
  std::string name, folder;  // d6; d6, or d6@desk
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

ObjectSet makeObjectSet(const Row& row, const std::string& folder, const Options& options) {
  std::vector<Drop> drops(options.drops);
  ifa::parallelFor(drops.size(), [&](std::size_t i) { drops[i] = simulate(row, options, i); });
  const auto usable = [&](const Drop& drop) {
    return drop.rested && drop.keptEnergy && drop.signature.events.size() >= kFewestContacts &&
           longestSide(drop.places) >= options.leastSide;
  };
  std::vector<Drop> kept;
  std::copy_if(drops.begin(), drops.end(), std::back_inserter(kept), usable);
  ObjectSet set;
  set.name = row.body.definition.name;
  set.folder = folder;
  set.paperMean = row.paperMean;
  set.restitution = row.surface().restitution;
  set.referenceImpulse = row.surface().referenceImpulse;
  set.drops = drops.size();
  set.kept = kept.size();
  set.meanOfDrops = meanContacts(kept);
  if (kept.size() >= kCases) chooseCases(set, std::move(kept));
  for (Drop& drop : set.cases) drop.signature = drop.written;
  return set;
}

/// CASE.json: where the body is when contacts begin, and where a person would have marked it.
std::string placesJson(const Drop& drop, const Options& options) {
  ifa::RandomStream random(options.seed + 2, drop.index);
  // Box and Muller: two normal numbers at once, one for each axis.
  const auto error = [&] {
    const double radius = std::sqrt(-2 * std::log(1 - random.uniform()));
    const double angle = random.uniform(0, 2 * std::numbers::pi);
    return Eigen::Vector2d(kLabelNoise * radius *
                           Eigen::Vector2d(std::cos(angle), std::sin(angle)));
  };
  const auto rounded = [](double metres) { return std::round(metres * 1e6) / 1e6; };
  auto positions = nlohmann::ordered_json::array(), labelled = positions;
  for (const Eigen::Vector2d& place : drop.places) {
    const Eigen::Vector2d label = place + error();
    positions.push_back({rounded(place.x()), rounded(place.y())});
    labelled.push_back({rounded(label.x()), rounded(label.y())});
  }
  return nlohmann::ordered_json{{"positions", positions}, {"labelled", labelled}}.dump() + "\n";
}

ifa::Result<void> writeCases(const ObjectSet& set, const Options& options) {
  const std::filesystem::path folder = options.folder / set.folder;
  std::filesystem::create_directories(folder);
  for (std::size_t i = 0; i < set.cases.size(); ++i) {
    const std::string name = fmt::format("{}-{:02}", set.name, i);
    auto written = ifa::writeSignature(folder / (name + ".signature.json"), set.cases[i].signature);
    if (written && options.positions) {
      written =
          ifa::writeFileAtomically(folder / (name + ".json"), placesJson(set.cases[i], options));
    }
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
  more than 1 % of the initial across an event or from one event to the next{places}.
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

std::string placesText(const Options& options) {
  if (options.leastSide <= 0) return {};
  return fmt::format(", and whose places at contacts lie in a box with a side of {} m or more",
                     options.leastSide);
}

std::string readmeText(const std::vector<ObjectSet>& sets, const Options& options) {
  std::string text = fmt::format(
      kIntroduction, fmt::arg("seed", options.seed), fmt::arg("last", options.drops - 1),
      fmt::arg("fewest", kFewestContacts), fmt::arg("cases", kCases),
      fmt::arg("events", eventsText(options.cut)), fmt::arg("places", placesText(options)));
  text +=
      "| object | paper's n | mean n | even, odd | from | drops kept | their mean n | "
      "restitution | J_ref, N s |\n|---|---|---|---|---|---|---|---|---|\n";
  for (const ObjectSet& set : sets) {
    text += fmt::format(
        "| {} | {} | {:.2f} | {:.1f}, {:.1f} | {} | {} of {} | {:.2f} | {} | {} |\n", set.folder,
        set.paperMean, meanContacts(set.cases), meanContacts(set.cases, 0, 2),
        meanContacts(set.cases, 1, 2), set.longestTenth ? "longest tenth" : "all", set.kept,
        set.drops, set.meanOfDrops, set.restitution, set.referenceImpulse);
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

/// @param folder  NAME, on the default surface, or NAME@SURFACE
ifa::Result<ObjectSet> makeSet(const std::string& folder, const Options& options) {
  const std::size_t at = folder.find('@');
  const std::string surface = at == std::string::npos ? "" : folder.substr(at + 1);
  const auto body = ifa::loadObject(folder.substr(0, at));
  if (!body) return tl::unexpected(body.error());
  const ifa::PaperRow* paper = ifa::paperRow(body->definition.name, surface);
  if (paper == nullptr) return ifa::badInput("is no row of the paper", folder);
  const std::string surfaceName(paper->surface);
  ObjectSet set = makeObjectSet({*body, surfaceName, paper->meanContacts}, folder, options);
  if (set.cases.empty()) return ifa::badInput("too few drops kept their energy", folder);
  return set;
}

ifa::Result<void> run(const Options& options) {
  std::vector<ObjectSet> sets;
  for (const std::string& folder : options.objects) {
    auto made = makeSet(folder, options);
    if (!made) return tl::unexpected(made.error());
    const ObjectSet& set = sets.emplace_back(std::move(*made));
    if (const auto done = writeCases(set, options); !done) return done;
    fmt::print("{:<10} paper {:5.1f}  chosen {:5.2f}  kept {} of {}, mean {:.2f}{}\n", folder,
               set.paperMean, meanContacts(set.cases), set.kept, set.drops, set.meanOfDrops,
               set.longestTenth ? ", longest tenth" : "");
  }
  return ifa::writeFileAtomically(options.folder / "README.md", readmeText(sets, options));
}

void printRows() {
  for (const ifa::PaperRow& row : ifa::kPaperRows) fmt::print("{}@{}\n", row.object, row.surface);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Makes the fixed evaluation set"};
  Options options;
  app.add_option("OBJECT", options.objects, "NAME or NAME@SURFACE (default: the ten of the set)");
  app.add_option("-o", options.folder, "folder to write in");
  app.add_option("-n", options.drops, "drops per object");
  app.add_option("--seed", options.seed);
  app.add_option_function<std::string>(
         "--cut", [&options](const std::string& name) { options.cut = ifa::cutNamed(name); },
         "events: audible (default), or paper: the same drops, any impulse above zero")
      ->check(CLI::IsMember({"audible", "paper"}));
  app.add_flag("--positions", options.positions,
               "also CASE.json: places of the centre of mass, and as labelled 5 mm off");
  app.add_option("--least-side", options.leastSide,
                 "leaves out drops whose places lie in a box with no side so long, m");
  bool rows = false;
  app.add_flag("--rows", rows, "only print the rows of the paper's Table 1, as NAME@SURFACE");
  CLI11_PARSE(app, argc, argv);
  if (rows) {
    printRows();
    return 0;
  }
  if (options.objects.empty())
    options.objects.assign(ifa::evaluationObjects().begin(), ifa::evaluationObjects().end());
  if (const auto done = run(options); !done) {
    fmt::print(stderr, "{}\n", done.error().text());
    return 3;
  }
  return 0;
}
