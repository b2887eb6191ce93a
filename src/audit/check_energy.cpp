// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <limits>
#include <string>

#include "audit/checks.h"

namespace ifa::audit_detail {
namespace {

/// Energies at the two ends of a contact event, and the largest rise on the way, J.
struct EventEnergy {
  double before = 0, after = 0, rise = 0;
  bool seen = false;
};

EventEnergy energyOf(const Evidence& all, std::size_t index) {
  EventEnergy energy;
  double lowest = std::numeric_limits<double>::infinity();
  for (const Step& step : all.steps) {
    if (step.kind != StepKind::kEvent || step.contact != index) continue;
    if (!energy.seen) {
      energy.before = lowest = all.energy(step.from);
      energy.seen = true;
    }
    // What was added when the event was over is the plan's change, judged with the whole event.
    const bool ends = step.from + 2 >= all.motion.trajectory.size() ||
                      all.sample(step.from + 1).time >= all.contact(index).end - kSameTime;
    const double now = all.energy(step.from + 1);
    if (!ends) energy.rise = std::max(energy.rise, now - lowest);
    lowest = std::min(lowest, now);
    energy.after = now;
  }
  return energy;
}

AuditCheck silentEnergy(const Evidence& all) {
  Worst worst;
  double lowest = std::numeric_limits<double>::infinity();
  for (const Step& step : all.steps) {
    if (step.kind != StepKind::kSilent && step.kind != StepKind::kAfter) {
      lowest = std::numeric_limits<double>::infinity();
      continue;
    }
    lowest = std::min(lowest, all.energy(step.from));
    worst.see(all.energy(step.from + 1) - lowest, all.sample(step.from + 1).time);
  }
  return worst.check("silent energy", "J gained", all.mass * kGravity * all.depth);
}

}  // namespace

void checkEnergy(const Evidence& all, Checks& checks) {
  Worst gain, transient;
  for (std::size_t i = 0; i < all.motion.contacts.size(); ++i) {
    const EventEnergy energy = energyOf(all, i);
    if (!energy.seen) continue;  // "contacts found" tells
    const double time = all.contact(i).time;
    const std::string name = "contact " + std::to_string(i + 1);
    const double allowed = energy.before * (1 + all.motion.energyGain);
    gain.see((energy.after - allowed) / std::max(energy.before, 1e-12), time, name);
    transient.see(energy.rise, time, name);
  }
  checks.push_back(gain.check("event energy", "share gained", all.settings.energyRounding));
  checks.push_back(
      transient.check("transient energy", "J gained", all.mass * kGravity * all.depth));
  checks.push_back(silentEnergy(all));
}

}  // namespace ifa::audit_detail
