// SPDX-License-Identifier: Apache-2.0
#include "pipeline/choose_object.h"

#include <algorithm>
#include <cmath>

#include "base/portable_math.h"
#include "body/object_file.h"
#include "pipeline/batch.h"
#include "pipeline/synchronize_with.h"

namespace ifa {

namespace {

/// Twice as likely is no reason to prefer one object to another, seven times is: log units.
constexpr double kDoubt = 2;
/// Factors of a contact in eq. 12.
constexpr double kFactors = 6;

ObjectRank rankOf(const std::string& object, const Motion& motion) {
  ObjectRank rank{object, motion.success, 0, 0, motion.failure};
  if (!motion.success) return rank;
  rank.score = motion.score;
  rank.reason = describe(motion);
  return rank;
}

/// Objects may merge contacts at other gaps, so they may not have the same number of them: the
/// largest counts for all.
void compare(ObjectRanking& ranking, std::size_t contacts) {
  std::stable_sort(ranking.begin(), ranking.end(),
                   [](const ObjectRank& a, const ObjectRank& b) { return a.score > b.score; });
  const double best = ranking.front().score;
  for (ObjectRank& rank : ranking) {
    if (rank.score <= 0) continue;
    rank.behind = kFactors * static_cast<double>(contacts) * portableLog(best / rank.score);
  }
}

}  // namespace

std::vector<std::string> asGoodAsBest(const ObjectRanking& ranking) {
  std::vector<std::string> names;
  for (const ObjectRank& rank : ranking) {
    if (rank.solved && rank.behind < kDoubt) names.push_back(rank.object);
  }
  return names;
}

Result<std::vector<std::string>> candidateObjects(const std::string& object) {
  if (object == "auto") return listObjects();
  std::vector<std::string> names;
  std::error_code code;
  if (object.find(',') == std::string::npos || std::filesystem::exists(object, code)) return names;
  for (std::size_t begin = 0; begin <= object.size();) {
    const std::size_t end = std::min(object.find(',', begin), object.size());
    if (end > begin) names.push_back(object.substr(begin, end - begin));
    begin = end + 1;
  }
  return names;
}

Result<ObjectRanking> chooseObject(const SynchronizeSettings& settings,
                                   const std::vector<std::string>& objects,
                                   const Progress& progress) {
  ObjectRanking ranking;
  std::size_t contacts = 0;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    progress("objects", static_cast<double>(i) / static_cast<double>(objects.size()));
    SynchronizeSettings one = settings;
    one.object = objects[i];
    one.takes = 1;
    Progress silent;
    silent.stop = progress.stop;
    GraphShelf shelf(one.graph, one.energyGain);
    const auto found = synchronizeWith(one, shelf, silent);
    if (!found) return tl::unexpected(found.error());
    contacts = std::max(contacts, found->signature.events.size());
    ranking.push_back(rankOf(objects[i], found->takes.front()));
  }
  if (ranking.empty()) return badInput("names no object", settings.object);
  compare(ranking, contacts);
  return ranking;
}

}  // namespace ifa
