// SPDX-License-Identifier: Apache-2.0
// What each part of the planner "hybrid" contributes: the first odd cases of each object of the
// evaluation set, planned with one part after the other left out. Every motion is audited.
//   planner_bench [CASES [OBJECT...]]
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <string>
#include <vector>

#include "audit/audit.h"
#include "base/paths.h"
#include "body/object_file.h"
#include "body/symmetry.h"
#include "evaluation_cases.h"
#include "motion/build_motion.h"
#include "pipeline/learned.h"
#include "pipeline/object_graph.h"
#include "planner/shooting_planner.h"

namespace {

using ifa::PlanRequest;
using ifa::ShootingPlannerSettings;

constexpr int kNoQuota = 1 << 24;

struct Variant {
  std::string name;
  ShootingPlannerSettings settings;
  bool symmetry = true;
};

std::vector<Variant> variants() {
  const auto all = ShootingPlannerSettings::hybrid();
  std::vector<Variant> list = {{"hybrid", all, true}};
  const auto without = [&](const char* name, const auto& change) {
    list.push_back({name, all, true});
    change(list.back().settings);
  };
  without("no changes drawn at random (shooting)", [](auto& set) { set.children = 0; });
  without("no look-ahead to the next contact", [](auto& set) { set.lookAheadWeight = 0; });
  without("no outlook on the energy", [](auto& set) { set.outlookWeight = 0; });
  without("rhythm not followed where it is hard", [](auto& set) { set.hardContacts = 0; });
  without("no silent passages", [](auto& set) { set.silentBeam = 0; });
  without("no terminal connections", [](auto& set) { set.aimedEndings = 0; });
  without("no other transitions", [](auto& set) { set.aimedEvents = 0; });
  without("no first contacts of the database", [](auto& set) { set.aimedRoots = 0; });
  list.push_back({"no symmetry", all, false});
  without("no variety in the beam",
          [](auto& set) { set.perParent = set.perRoot = set.perEnergyBin = kNoQuota; });
  list.push_back({"shoot (no database)", {}, true});
  return list;
}

/// What is planned, and for whom.
struct Object {
  ifa::Body body;
  ifa::SurfaceProperties surface;
  ifa::EnergyOutlook outlook;
  ifa::EventDatabase database;
  std::vector<Eigen::Matrix3d> symmetry;
  std::vector<ifa::ContactSignature> cases;
};

ifa::Result<Object> load(const std::string& name, int cases) {
  auto body = ifa::loadObject(name);
  if (!body) return tl::unexpected(body.error());
  const std::string surfaceName = body->definition.defaultSurface;
  ifa::SurfaceProperties surface = body->definition.surfaces.at(surfaceName);
  const ifa::Learned learned = ifa::learnObject(*body, surface, ifa::cacheFolder(), {});
  surface.referenceImpulse = learned.referenceImpulse;
  const ifa::GraphShelf shelf({}, 0);
  auto database = shelf.database(*body, surface, surfaceName, {});
  if (!database) return tl::unexpected(database.error());
  const ifa::SymmetryGroup group = ifa::findSymmetry(*body);
  return Object{std::move(*body),     surface,          learned.outlook,
                std::move(*database), group.elements(), ifa::bench::casesOf(name, cases)};
}

bool holdsAudit(const PlanRequest& request, const ifa::Plan& plan) {
  const auto motion = ifa::buildMotion(request, plan, 0);
  return motion && ifa::audit(*motion, *request.body).passed();
}

struct Tally {
  int cases = 0, solved = 0;
  double score = 0, seconds = 0, slowest = 0;
  std::vector<double> bends;
};

void run(const Object& object, const Variant& variant, Tally& tally) {
  for (const auto& signature : object.cases) {
    PlanRequest request;
    request.body = &object.body;
    request.surface = object.surface;
    request.surfaceName = object.body.definition.defaultSurface;
    request.signature = signature;
    request.outlook = object.outlook;
    request.database = &object.database;
    request.symmetry = object.symmetry;
    request.settings.symmetry = variant.symmetry;
    request.accepts = holdsAudit;
    const std::clock_t begin = std::clock();
    const auto plans = ifa::ShootingPlanner(variant.settings).plan(request, {});
    const double seconds = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
    ++tally.cases;
    tally.seconds += seconds;
    tally.slowest = std::max(tally.slowest, seconds);
    if (!plans || !plans->front().solved) continue;
    ++tally.solved;
    tally.score += plans->front().score;
    for (const auto& contact : plans->front().contacts) tally.bends.push_back(contact.bend);
  }
}

void print(const Variant& variant, Tally tally) {
  std::sort(tally.bends.begin(), tally.bends.end());
  const auto bends = static_cast<double>(std::max<std::size_t>(1, tally.bends.size()));
  const auto small = std::upper_bound(tally.bends.begin(), tally.bends.end(), 1.0);
  fmt::print("| {} | {} | {:.3f} | {:.2f} | {:.1f} % | {:.2f} | {:.1f} |\n", variant.name,
             tally.solved, tally.score / std::max(1, tally.solved),
             tally.bends.empty() ? 0 : tally.bends[tally.bends.size() / 2],
             100 * static_cast<double>(small - tally.bends.begin()) / bends,
             tally.seconds / std::max(1, tally.cases), tally.slowest);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  const int cases = argc > 1 ? std::atoi(argv[1]) : 5;
  std::vector<std::string> names(argv + std::min(argc, 2), argv + argc);
  if (names.empty()) {
    for (const auto& entry :
         std::filesystem::directory_iterator(fmt::format("{}/tests/evaluation", IFA_SOURCE_DIR))) {
      if (entry.is_directory()) names.push_back(entry.path().filename().string());
    }
    std::sort(names.begin(), names.end());
  }
  std::vector<Object> objects;
  for (const std::string& name : names) {
    auto object = load(name, cases);
    if (!object) {
      fmt::print(stderr, "{}\n", object.error().text());
      return EXIT_FAILURE;
    }
    objects.push_back(std::move(*object));
  }
  fmt::print(
      "| planner | solved | Score | bend, median | at most 1 | s of a processor a case | slowest "
      "|\n");
  fmt::print("|---|---|---|---|---|---|---|\n");
  for (const Variant& variant : variants()) {
    Tally tally;
    for (const Object& object : objects) run(object, variant, tally);
    print(variant, std::move(tally));
  }
  return EXIT_SUCCESS;
}
