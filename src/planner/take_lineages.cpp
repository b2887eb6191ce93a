// SPDX-License-Identifier: Apache-2.0
#include "planner/take_lineages.h"

#include <algorithm>
#include <utility>

#include "planner/plan_difference.h"

namespace ifa {

namespace {

using Path = std::vector<Eigen::Vector2d>;

/// The path of a plan as far as a level.
Path pathUpTo(const Plan& plan, std::size_t level) {
  Plan part;
  for (const PlannedContact& contact : plan.contacts) {
    if (contact.target <= static_cast<int>(level)) part.contacts.push_back(contact);
  }
  return pathOf(part);
}

TakeLineages lineagesAt(std::size_t level, const std::vector<Plan>& found,
                        const ShootingSearch& search) {
  std::vector<Path> ways;
  for (const Plan& plan : found) ways.push_back(pathUpTo(plan, level));
  ShootingSearch::Beginning beginning{level, {}, true};
  for (const ShootingNode& node : search.kept(level)) {
    Path path = search.pathTo(node);
    const auto way = std::find_if(ways.begin(), ways.end(),
                                  [&](const Path& other) { return !differentPaths(path, other); });
    const auto number = static_cast<std::size_t>(way - ways.begin());
    if (way == ways.end()) ways.push_back(std::move(path));
    if (number < found.size()) continue;
    beginning.beam.push_back(node);
    beginning.beam.back().root = static_cast<unsigned>(number);
  }
  return {ways.size() - found.size(), std::move(beginning)};
}

}  // namespace

TakeLineages lineagesBeside(const std::vector<Plan>& found, const ShootingSearch& search,
                            std::size_t wanted, std::size_t before) {
  TakeLineages best;
  for (std::size_t level = before; level-- > 1 && best.ways < wanted;) {
    TakeLineages here = lineagesAt(level, found, search);
    if (here.ways > best.ways) best = std::move(here);
  }
  return best;
}

}  // namespace ifa
