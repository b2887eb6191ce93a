// SPDX-License-Identifier: Apache-2.0
// Prints how far our kernel's drops are from ODE's: Kolmogorov-Smirnov distances of event counts,
// times to rest and times between contacts, object by object.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "body/object_file.h"
#include "sampler/paper_rows.h"
#include "sampler/simulator_comparison.h"

namespace {

struct Options {
  std::vector<std::string> objects;
  double restitution = 0.5;
  double friction = -1, rolling = -1;
  ifa::ComparisonSettings comparison;
};

void readOptions(CLI::App& app, Options& options) {
  app.add_option("OBJECT", options.objects, "objects (default: those of the evaluation set)");
  app.add_option("-n", options.comparison.drops, "drops per object");
  app.add_option("--seed", options.comparison.seed);
  app.add_option("--restitution", options.restitution);
  app.add_option("--friction", options.friction, "instead of the object's");
  app.add_option("--rolling", options.rolling, "rolling and spinning friction, m");
  app.add_option("--ode-step", options.comparison.ode.step, "s");
}

void printRow(const std::string& name, const ifa::SimulatorComparison& c) {
  using ifa::mean;
  fmt::print(
      "{:<12} {:5.3f} {:5.3f} {:5.3f}   {:6.2f} {:6.2f}   {:6.2f} {:6.2f}   {:6.3f} {:6.3f}"
      "   {:6.4f} {:6.4f}   {} {}\n",
      name, c.eventCounts, c.restTimes, c.gaps, mean(c.native.audibleEvents),
      mean(c.ode.audibleEvents), mean(c.native.paperEvents), mean(c.ode.paperEvents),
      mean(c.native.restTimes), mean(c.ode.restTimes), ifa::median(c.native.gaps),
      ifa::median(c.ode.gaps), c.native.unfinished, c.ode.unfinished);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Compares drops of our kernel with ODE's"};
  Options options;
  readOptions(app, options);
  CLI11_PARSE(app, argc, argv);
  if (options.objects.empty())
    options.objects.assign(ifa::evaluationObjects().begin(), ifa::evaluationObjects().end());
  fmt::print("             D: limit 0.15, 0.10, 0.10   means, ours and ODE's\n");
  fmt::print(
      "{:<12} events rest gaps      audible        paper's cut      rest time, s    "
      "median gap, s   unfinished\n",
      "object");
  for (const std::string& name : options.objects) {
    const auto body = ifa::loadObject(name);
    if (!body) {
      fmt::print(stderr, "{}\n", body.error().text());
      return 3;
    }
    ifa::SurfaceProperties surface = body->definition.surfaces.at(body->definition.defaultSurface);
    surface.restitution = options.restitution;
    if (options.friction >= 0) surface.friction = options.friction;
    if (options.rolling >= 0) surface.rollingFriction = surface.spinningFriction = options.rolling;
    printRow(name, ifa::compareWithOde(*body, surface, options.comparison));
  }
  return 0;
}
