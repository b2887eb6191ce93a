// SPDX-License-Identifier: Apache-2.0
#include "planner/shooting_plan.h"

#include <fmt/format.h>

#include <cmath>

namespace ifa {

namespace {

PlannedContact contactOf(const ShootingNode& node) {
  PlannedContact contact;
  contact.event = node.event;
  contact.time = node.start;
  contact.moved = node.moved;
  contact.restitution = node.restitution;
  contact.relativeAmplitude = node.heard.amplitude;
  contact.bend = node.bend;
  contact.retiming = node.retiming;
  contact.arrival = node.arrival;
  contact.arrivalChange = node.arrivalChange;
  contact.arrivalAngularChange = node.arrivalAngular;
  contact.arrivalBend = node.arrivalBend;
  contact.source = node.source;
  if (node.level == 0 && node.source.kind == SourceKind::kShot) {
    contact.source.kind = SourceKind::kSampled;
  }
  return contact;
}

/// The factors of a contact, from its own numbers.
ContactFactors factorsOf(const ShootingNode& node, const HeardEvent& target) {
  ContactFactors factors;
  factors.v = std::exp(logVelocity(node.bend) + logVelocity(node.arrivalBend));
  factors.t = std::exp(logTimeWarp(node.retiming, 1));
  factors.a = std::exp(logAmplitude(target, node.heard));
  factors.l = std::exp(logDuration(target, node.heard));
  factors.c = std::exp(logCentroid(target, node.heard));
  return factors;
}

/// The commonest reason for which no motion reached the next contact, and what would help.
std::string reasonOf(const ShootingDeaths& d, double gap, bool terminal) {
  const long flight = d.noFlight + d.bent + d.energy + d.earlier;
  const long sum = flight + d.unheard + d.restless + d.noTime;
  if (sum == 0) return "the search ended before it was tried";
  if (d.noTime * 2 > sum) {
    return fmt::format("{:.0f} ms leave no time after the contact before; merge the two labels",
                       gap * 1e3);
  }
  if (terminal && d.restless > flight) {
    return "no motion comes to rest there; a longer last label, or --no-terminal, would help";
  }
  if (d.unheard * 2 > sum)
    return "the contact would be too soft to be heard; another object or surface?";
  if (d.energy > d.earlier && d.energy * 3 > sum) {
    return fmt::format(
        "the gap of {:.0f} ms before it needs more energy than is left; a higher restitution or a "
        "mark that was missed in the gap?",
        gap * 1e3);
  }
  if (d.bent > d.earlier) {
    return fmt::format(
        "a gap of {:.0f} ms asks for an implausible bounce; another restitution, or a missed or "
        "false mark near it?",
        gap * 1e3);
  }
  return fmt::format(
      "in the {:.0f} ms before it something always touches too early; a mark that was "
      "missed there?",
      gap * 1e3);
}

}  // namespace

Plan planOf(const ShootingProblem& problem, const std::vector<ShootingNode>& path) {
  Plan plan;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const ShootingNode& node = path[i];
    PlannedContact contact = contactOf(node);
    contact.factors = factorsOf(node, problem.targets[static_cast<std::size_t>(node.level)]);
    contact.target = node.level;
    if (i > 0) {
      plan.contacts.back().velocityChange = node.velocityChange;
      plan.contacts.back().angularVelocityChange = node.angularChange;
    }
    plan.contacts.push_back(contact);
  }
  plan.worth = path.back().worth();
  sumUp(plan, path.back().log);
  problem.wishes.settle(plan);
  problem.places.settle(plan);
  return plan;
}

std::string failureOf(const ShootingProblem& problem, const ShootingSearch& search,
                      const ShootingNode* farthest, double leastScore) {
  const auto& events = problem.request.signature.events;
  if (farthest == nullptr) {
    return events.size() == 1 && problem.request.signature.terminal
               ? "contact 1 at 0.000 s: no motion comes to rest in one contact like this"
               : "contact 1 at 0.000 s: no initial state gives an audible contact";
  }
  const auto level = static_cast<std::size_t>(farthest->level);
  if (level + 1 >= events.size()) {
    if (!problem.request.orientations.empty()) {
      return "no motion that was found lies as --orient asks";
    }
    const double score = farthest->log.score(static_cast<int>(events.size()));
    if (score >= leastScore) return "the search ended before its motions were looked at";
    return fmt::format(
        "the best motion's Score is {:.2f}, under {:.1f}: marks or object do not fit", score,
        leastScore);
  }
  const bool terminal = level + 2 == events.size() && problem.request.signature.terminal;
  return fmt::format("contact {} at {:.3f} s cannot be met: {}", level + 2, events[level + 1].time,
                     reasonOf(search.deathsAfter(farthest->level),
                              events[level + 1].time - events[level].time, terminal));
}

}  // namespace ifa
