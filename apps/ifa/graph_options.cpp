// SPDX-License-Identifier: Apache-2.0
#include "graph_options.h"

#include "command.h"

namespace ifa::cli {

void addGraphOptions(CLI::App& command, GraphOptions& options) {
  const std::string both = "Planners \"hybrid\" and \"graph\"";
  command
      .add_option("--database", options.database,
                  "event database of this object (default: the cache's, made on first use)")
      ->group(both);
  command
      .add_flag_callback(
          "--no-symmetry", [&options] { options.symmetry = false; },
          "take events as they are, not also as their images under the body's symmetry group")
      ->group(both);
  const std::string group = "Planner \"graph\"";
  command.add_option("--simulations", options.simulations, "size of the cache's database")
      ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1000000000}))
      ->capture_default_str()
      ->group(group);
  command
      .add_option_function<std::string>(
          "--cut", [&options](const std::string& name) { options.cut = cutNamed(name); },
          "events of the database: audible ones, or the paper's, any impulse above zero (default: "
          "what --database has, else audible)")
      ->check(CLI::IsMember({"audible", "paper"}))
      ->group(group);
  command.add_option("--early-exit", options.earlyExit, "a motion of this Score ends the search")
      ->check(numberFrom(0, 1))
      ->capture_default_str()
      ->group(group);
  command
      .add_flag("--processor-time", options.processorTime,
                "--time-limit is of the processor time that the search takes")
      ->group(group);
  command
      .add_flag("--printed-velocity", options.printedVelocity,
                "weigh changes of velocity as the paper prints it")
      ->group(group);
  command
      .add_option_function<std::string>(
          "--connection",
          [&options](const std::string& kind) { options.timeWarp = kind == "blend"; },
          "exact: flights that take the sound's time; blend: the paper's, shown at another pace")
      ->check(CLI::IsMember({"exact", "blend"}))
      ->default_str("exact")
      ->group(group);
}

}  // namespace ifa::cli
