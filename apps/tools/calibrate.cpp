// SPDX-License-Identifier: Apache-2.0
// Tunes restitution (and friction) of the objects' surfaces to the paper's events per simulation,
// measures J_ref, and writes both into the object files.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <string>
#include <vector>

#include "base/file.h"
#include "body/object_file.h"
#include "sampler/calibration.h"
#include "sampler/paper_rows.h"

namespace {

using ifa::Body;

struct Options {
  std::vector<std::string> objects;
  std::string surface;
  bool measureOnly = false, dryRun = false;
  ifa::CalibrationSettings settings;
};

void readOptions(CLI::App& app, Options& options) {
  app.add_option("OBJECT", options.objects, "objects (default: all that there are)");
  app.add_option("--surface", options.surface, "this one only");
  app.add_option("-n", options.settings.simulations, "simulations per measurement");
  app.add_option("--seed", options.settings.seed);
  app.add_option("--tolerance", options.settings.tolerance, "share of the target");
  app.add_option("--lowest-restitution", options.settings.lowestRestitution, "of the search");
  app.add_option("--highest-restitution", options.settings.highestRestitution, "of the search");
  app.add_flag("--measure", options.measureOnly, "keep restitution and friction, measure J_ref");
  app.add_flag("--dry-run", options.dryRun, "print only");
}

ifa::Calibration calibrate(const Body& body, const ifa::SurfaceProperties& surface,
                           const ifa::PaperRow* row, const Options& options) {
  if (row != nullptr && !options.measureOnly) {
    return ifa::calibrateSurface(body, surface, row->eventsPerSimulation, options.settings);
  }
  ifa::Calibration result{surface, ifa::measureSurface(body, surface, options.settings), true};
  result.surface.referenceImpulse = result.measured.referenceImpulse;
  return result;
}

void printRow(const std::string& name, const std::string& surface, const ifa::PaperRow* row,
              const ifa::Calibration& c) {
  const double target = row == nullptr ? 0 : row->eventsPerSimulation;
  const double error = row == nullptr ? 0 : c.measured.eventsPerSimulation / target - 1;
  fmt::print(
      "{:<17} {:<7} {:6.3f} {:6.3f}  {:6.2f} {:6.2f} {:+5.1f} %  {:6.2f} {:6.2f} {:11.4g} {:3}{}\n",
      name, surface, c.surface.restitution, c.surface.friction, target,
      c.measured.eventsPerSimulation, 100 * error, c.measured.audibleEvents, c.measured.restTime,
      c.surface.referenceImpulse, c.measured.unfinished, c.reached ? "" : "  out of reach");
  std::fflush(stdout);
}

ifa::Result<void> calibrateObject(const std::string& name, const Options& options) {
  const auto path = ifa::findObjectFile(name);
  if (!path) return tl::unexpected(path.error());
  const auto body = ifa::loadObject(name);
  if (!body) return tl::unexpected(body.error());
  auto definition = ifa::readObjectFile(*path);
  if (!definition) return tl::unexpected(definition.error());
  for (auto& [surface, properties] : definition->surfaces) {
    if (!options.surface.empty() && surface != options.surface) continue;
    const ifa::PaperRow* row = ifa::paperRow(definition->name, surface);
    const ifa::Calibration c = calibrate(*body, properties, row, options);
    printRow(definition->name, surface, row, c);
    properties = c.surface;
  }
  if (options.dryRun) return {};
  return ifa::writeFileAtomically(*path, ifa::objectFileText(*definition));
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Calibrates the objects' surfaces to the paper's events per simulation"};
  Options options;
  readOptions(app, options);
  CLI11_PARSE(app, argc, argv);
  if (options.objects.empty()) options.objects = ifa::listObjects().value_or(options.objects);
  fmt::print(
      "object            surface      e friction  paper   ours  error  audible rest,s   J_ref, "
      "N s unfinished\n");
  for (const std::string& name : options.objects) {
    if (const auto done = calibrateObject(name, options); !done) {
      fmt::print(stderr, "{}\n", done.error().text());
      return 3;
    }
  }
  return 0;
}
