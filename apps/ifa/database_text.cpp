// SPDX-License-Identifier: Apache-2.0
#include "database_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace ifa::cli {

namespace {

std::string row(const char* label, const std::string& text) {
  return fmt::format("  {:<16}{}\n", label, text);
}

/// Smallest, tenth, half, nine tenths, largest, each times `unit`.
std::string quantilesOf(std::vector<float> values, double unit, const char* name) {
  if (values.empty()) return "none";
  std::sort(values.begin(), values.end());
  std::string text;
  for (const double share : {0.0, 0.1, 0.5, 0.9, 1.0}) {
    const auto i = static_cast<std::size_t>(share * static_cast<double>(values.size() - 1));
    text += fmt::format("{}{:.4g}", text.empty() ? "" : ", ", unit * values[i]);
  }
  return fmt::format("{} {} (least, 10 %, median, 90 %, most)", text, name);
}

std::string eventsText(const EventDatabase& database) {
  std::vector<float> counts;
  for (std::size_t k = 0; k < database.simulations(); ++k) {
    counts.push_back(static_cast<float>(database.firstEvent(k + 1) - database.firstEvent(k)));
  }
  return quantilesOf(std::move(counts), 1, "a simulation");
}

std::string settingsText(const DatabaseSettings& s) {
  std::string text = fmt::format(
      "restitution {:.4g}, friction {:.4g}, J_ref {:.4g} N s, cone {:g} degrees, "
      "{:g} to {:g} m/s, {:g} to {:g} rad/s",
      s.restitution, s.friction, s.referenceImpulse, s.coneDegrees, s.speed[0], s.speed[1],
      s.spin[0], s.spin[1]);
  return s.odeStep > 0 ? text + fmt::format(", ODE at {:g} ms", 1e3 * s.odeStep) : text;
}

std::string headerText(const EventDatabase& database) {
  const DatabaseHeader& header = database.header();
  const DatabaseIdentity& id = header.identity;
  std::string text = fmt::format("{}: {} on {}\n", database.path().string(), nameIn(id.object),
                                 nameIn(id.surface));
  text += row("simulations",
              fmt::format("{} to {} of {}, seed {}, {} kernel, version {}", header.firstSimulation,
                          header.firstSimulation + header.simulations - 1, id.allSimulations,
                          id.seed, backendName(id.backend), id.simulationVersion));
  const auto events = static_cast<double>(std::max<std::uint64_t>(header.events, 1));
  text += row("events", fmt::format("{}, {:.4g} a simulation", header.events,
                                    events / static_cast<double>(header.simulations)));
  text += row("size", fmt::format("{:.4g} MB, {:.1f} bytes an event",
                                  1e-6 * static_cast<double>(header.fileBytes),
                                  static_cast<double>(header.fileBytes) / events));
  text += row("cut", std::string(cutName(cutOf(id.settings))));
  text += row("settings", settingsText(id.settings));
  return text + row("hashes", fmt::format("file {:016x}, body {:016x}, settings {:016x}",
                                          database.hash(), id.bodyHash, id.settingsHash));
}

std::string columnsText(const EventDatabase& database) {
  std::size_t terminal = 0, followed = 0, silent = 0;
  std::vector<float> gaps;
  const auto flags = database.flags();
  for (std::size_t i = 0; i < flags.size(); ++i) {
    terminal += (flags[i] & EventRecord::kTerminal) != 0 ? 1 : 0;
    silent += (flags[i] & EventRecord::kSilentPassage) != 0 ? 1 : 0;
    if ((flags[i] & EventRecord::kFollowed) == 0) continue;
    ++followed;
    gaps.push_back(database.values(kGap)[i]);
  }
  const auto all = [&](Column column) {
    const auto values = database.values(column);
    return std::vector<float>(values.begin(), values.end());
  };
  std::string text = row("terminal", fmt::format("{} events", terminal));
  text +=
      row("passages", fmt::format("{} flights, {} with silent contact", followed - silent, silent));
  text += row("per simulation", eventsText(database));
  text += row("duration", quantilesOf(all(kDuration), 1e3, "ms"));
  text += row("to the next", quantilesOf(std::move(gaps), 1e3, "ms"));
  return text + row("amplitude", quantilesOf(all(kAmplitude), 1e3, "mN s"));
}

}  // namespace

std::string databaseText(const EventDatabase& database, bool checked) {
  std::string text = headerText(database) + columnsText(database);
  if (checked) text += row("check", "every checksum holds");
  text.pop_back();
  return text;
}

}  // namespace ifa::cli
