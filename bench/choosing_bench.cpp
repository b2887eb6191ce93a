// SPDX-License-Identifier: Apache-2.0
// How well `--object auto` tells by the rhythm alone what made a sound: every case of the
// evaluation set, weighed with the objects named, or with those of the set.
//   choosing_bench [OBJECT...]
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "base/paths.h"
#include "body/object_file.h"
#include "evaluation_cases.h"
#include "pipeline/choose_object.h"
#include "pipeline/learned.h"

namespace {

namespace fs = std::filesystem;

struct Known {
  std::string name;
  ifa::RhythmLikelihood rhythm;
};

std::vector<std::string> objectsOfSet() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(IFA_SOURCE_DIR "/tests/evaluation")) {
    if (entry.is_directory()) names.push_back(entry.path().filename().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

ifa::Result<Known> learn(const std::string& name) {
  const auto body = ifa::loadObject(name);
  if (!body) return tl::unexpected(body.error());
  const auto& surface = body->definition.surfaces.at(body->definition.defaultSurface);
  return Known{name, ifa::learnRhythm(*body, surface, ifa::cacheFolder(), {})};
}

/// Over some cases.
struct Tally {
  int cases = 0;
  std::array<int, 4> among{};  ///< truth among the first 1, 2, 3, 4
  double stated = 0;           ///< sum of the probabilities of the first

  void add(const std::vector<double>& probabilities, std::size_t truth) {
    const auto rank = static_cast<std::size_t>(
        std::count_if(probabilities.begin(), probabilities.end(),
                      [&](double one) { return one > probabilities[truth]; }));
    for (std::size_t k = rank; k < among.size(); ++k) ++among[k];
    stated += *std::max_element(probabilities.begin(), probabilities.end());
    ++cases;
  }
  void print(const std::string& name) const {
    const auto share = [&](int count) { return 100.0 * count / std::max(1, cases); };
    fmt::print("| {} | {} | {:.0f} % | {:.0f} % | {:.0f} % | {:.0f} % |\n", name, cases,
               share(among[0]), share(among[1]), share(among[3]),
               100 * stated / std::max(1, cases));
  }
};

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::string> names(argv + 1, argv + argc);
  if (names.empty()) names = objectsOfSet();
  std::vector<Known> objects;
  for (const std::string& name : names) {
    auto known = learn(name);
    if (!known) {
      fmt::print(stderr, "{}\n", known.error().text());
      return 1;
    }
    objects.push_back(std::move(*known));
  }
  fmt::print(
      "| made by | cases | first | of the first two | of the first four | said of the first |\n");
  fmt::print("|---|---|---|---|---|---|\n");
  Tally odd, even;
  std::array<Tally, 5> sure;  // by what is said of the first, in fifths
  for (std::size_t truth = 0; truth < objects.size(); ++truth) {
    const std::string& name = objects[truth].name;
    Tally own;
    for (int i = 0; i < 20; ++i) {
      const auto signature = ifa::bench::caseOf(name, i);
      if (!signature || signature->events.size() < 2) continue;
      std::vector<double> logs;
      for (const Known& one : objects) logs.push_back(one.rhythm.log(*signature));
      const std::vector<double> probabilities = ifa::rhythmProbabilities(logs);
      own.add(probabilities, truth);
      (i % 2 == 1 ? odd : even).add(probabilities, truth);
      const double most = *std::max_element(probabilities.begin(), probabilities.end());
      sure[std::min<std::size_t>(4, static_cast<std::size_t>(5 * most))].add(probabilities, truth);
    }
    if (own.cases > 0) own.print(name);
  }
  even.print("even cases");
  odd.print("odd cases");
  for (std::size_t k = 0; k < sure.size(); ++k) {
    sure[k].print(fmt::format("first at {} to {} %", 20 * k, 20 * k + 20));
  }
  return 0;
}
