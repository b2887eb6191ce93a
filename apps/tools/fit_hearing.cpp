// SPDX-License-Identifier: Apache-2.0
// Where the threshold of hearing lies (docs/method.md, 2): compares the contacts that people marked
// in recordings with those that drops of the same objects have when everything under a share of
// J_ref is left out.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "body/object_file.h"
#include "dynamics/simulator.h"
#include "sampler/drop_statistics.h"
#include "sampler/initial_state.h"
#include "signature/labels.h"
#include "signature/signature.h"

namespace {

namespace fs = std::filesystem;

constexpr double kTimeLimit = 20;  // s
constexpr std::size_t kLastGaps = 4;
constexpr double kQuantiles[] = {0.1, 0.25, 0.5, 0.75, 0.9, 0.95};

/// Contacts per drop, and the last gaps of each: where what is soft matters most.
struct Rhythm {
  std::vector<double> counts, gaps;

  /// @param starts, ends  of one drop's contacts, s
  void add(const std::vector<double>& starts, const std::vector<double>& ends) {
    counts.push_back(static_cast<double>(starts.size()));
    const std::size_t first = starts.size() > kLastGaps ? starts.size() - kLastGaps : 1;
    for (std::size_t k = first; k < starts.size(); ++k) gaps.push_back(starts[k] - ends[k - 1]);
  }
};

void print(const std::string& what, Rhythm rhythm, const Rhythm& marked) {
  const double distance = ifa::distributionDistance(rhythm.gaps, marked.gaps);
  std::sort(rhythm.gaps.begin(), rhythm.gaps.end());
  fmt::print("{:<8} {:8.1f}  ", what, ifa::mean(rhythm.counts));
  for (const double quantile : kQuantiles) {
    const auto at =
        static_cast<std::size_t>(quantile * static_cast<double>(rhythm.gaps.size() - 1));
    fmt::print(" {:5.1f}", rhythm.gaps[at] * 1e3);
  }
  fmt::print("   {:5.3f}\n", distance);
}

ifa::Result<void> addMarked(const fs::path& file, const ifa::Body& body, Rhythm& rhythm) {
  auto sound = ifa::readSound(file);
  if (!sound) return tl::unexpected(sound.error());
  const auto labels = ifa::readLabels(fs::path(file).replace_extension(".txt"));
  if (!labels) return tl::unexpected(labels.error());
  const auto signature =
      ifa::signatureFromLabels(*sound, *labels, {body.definition.mergeGap, {}}, file.string());
  if (!signature) return tl::unexpected(signature.error());
  std::vector<double> starts, ends;
  for (const ifa::SignatureEvent& event : signature->events) {
    starts.push_back(event.time);
    ends.push_back(event.time + event.duration);
  }
  rhythm.add(starts, ends);
  return {};
}

void addDrops(const ifa::Body& body, double share, std::size_t drops, Rhythm& rhythm) {
  const auto& surface = body.definition.surfaces.at(body.definition.defaultSurface);
  ifa::RecorderSettings cut = ifa::audibleCut(body, surface);
  cut.threshold = share * surface.referenceImpulse;
  const ifa::BodyModel model(body, surface);
  for (std::size_t i = 0; i < drops; ++i) {
    const auto drop = ifa::simulateDrop(model, ifa::sampleInitialState(body, 7, i), kTimeLimit);
    std::vector<double> starts, ends;
    for (const ifa::ContactEvent& event : ifa::eventsOf(drop, cut)) {
      starts.push_back(event.start);
      ends.push_back(event.end);
    }
    rhythm.add(starts, ends);
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Compares marked contacts with those of drops, for several thresholds of hearing"};
  std::string folder;
  std::vector<double> shares = {0.01, 0.02, 0.03, 0.04, 0.05};
  std::size_t drops = 300;
  app.add_option("FOLDER", folder, "recordings: OBJECT/NAME.wav with NAME.txt")->required();
  app.add_option("--shares", shares, "thresholds, as shares of J_ref");
  app.add_option("-n", drops, "drops per recording");
  CLI11_PARSE(app, argc, argv);

  Rhythm marked;
  std::map<std::string, std::size_t> recordings;
  std::map<std::string, ifa::Body> bodies;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.path().extension() != ".wav") continue;
    const std::string name = entry.path().parent_path().filename().string();
    auto body = ifa::loadObject(name);
    const auto added = body ? addMarked(entry.path(), *body, marked)
                            : ifa::Result<void>(tl::unexpected(body.error()));
    if (!added) {
      fmt::print(stderr, "{}\n", added.error().text());
      return 3;
    }
    ++recordings[name];
    bodies.emplace(name, std::move(*body));
  }
  if (marked.gaps.empty()) {
    fmt::print(stderr, "{}: holds no marked recording\n", folder);
    return 3;
  }
  fmt::print("         contacts  quantiles of the last {} gaps, ms        KS distance\n",
             kLastGaps);
  fmt::print("                   ");
  for (const double quantile : kQuantiles) fmt::print(" {:5.2f}", quantile);
  fmt::print("\n");
  print("marked", marked, marked);
  for (const double share : shares) {
    Rhythm rhythm;
    for (const auto& [name, count] : recordings) {
      addDrops(bodies.at(name), share, drops * count, rhythm);
    }
    print(fmt::format("{:.1f} %", 100 * share), rhythm, marked);
  }
  return 0;
}
