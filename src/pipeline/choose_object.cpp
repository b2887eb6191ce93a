// SPDX-License-Identifier: Apache-2.0
#include "pipeline/choose_object.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "base/paths.h"
#include "body/object_file.h"
#include "pipeline/batch.h"
#include "pipeline/check_settings.h"
#include "pipeline/chosen_body.h"
#include "pipeline/hear.h"
#include "pipeline/learned.h"
#include "pipeline/synchronize_with.h"
#include "pipeline/wishes.h"

namespace ifa {

namespace {

/// Features of a rhythm are not as independent, nor drops as like real ones, as a density has it:
/// to this power its ratios are honest ones (docs/choosing.md).
constexpr double kTrust = 0.3;
/// So many times less likely than the best is not in doubt any more, ...
constexpr double kDoubt = 3;
/// ... and is planned only where nothing that is likelier has a motion.
constexpr double kUnlikely = 30;
constexpr std::size_t kPlanned = 5;  ///< at most, beside those

/// One of the objects, before anything is planned.
struct Candidate {
  std::string object;
  double log = 0;  ///< of the likelihood of the rhythm
  double probability = 0;
};

/// Objects may merge contacts at other gaps; the sound is heard once for each gap.
class Listener {
 public:
  explicit Listener(const SynchronizeSettings& settings) : settings_(settings) {}

  Result<const ContactSignature*> signature(double mergeGap) {
    const auto known = heard_.find(mergeGap);
    if (known != heard_.end()) return &known->second;
    auto heard = hear(settings_, mergeGap);
    if (!heard) return tl::unexpected(heard.error());
    return &heard_.emplace(mergeGap, std::move(heard->signature)).first->second;
  }

 private:
  const SynchronizeSettings& settings_;
  std::map<double, ContactSignature> heard_;
};

/// One object with the sound as it is heard for it.
struct Hearing {
  ChosenBody chosen;
  const ContactSignature* signature;
};

/// Errors: where the object lacks what the settings ask of it, too.
Result<Hearing> hearWith(const SynchronizeSettings& settings, Listener& listener) {
  auto chosen = loadChosenBody(settings);
  if (!chosen) return tl::unexpected(chosen.error());
  const auto signature = listener.signature(chosen->body.definition.mergeGap);
  if (!signature) return tl::unexpected(signature.error());
  const auto wishes = plannedOrientations(settings.orientations, chosen->body, **signature);
  if (!wishes) return tl::unexpected(wishes.error());
  return Hearing{std::move(*chosen), *signature};
}

/// Logarithm of how likely the object is to make the sound. A single contact tells nothing.
double likelihoodOf(const Hearing& heard, const Progress& progress) {
  if (heard.signature->events.size() < 2) return 0;
  const ChosenBody& chosen = heard.chosen;
  SurfaceProperties surface = chosen.body.definition.surfaces.at(chosen.surface);
  if (surface.referenceImpulse <= 0) {
    surface.referenceImpulse =
        learnObject(chosen.body, surface, cacheFolder(), progress).referenceImpulse;
  }
  return learnRhythm(chosen.body, surface, cacheFolder(), progress).log(*heard.signature);
}

/// Likeliest first.
void weigh(std::vector<Candidate>& candidates) {
  std::vector<double> logs;
  for (const Candidate& one : candidates) logs.push_back(one.log);
  const std::vector<double> probabilities = rhythmProbabilities(logs);
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    candidates[i].probability = probabilities[i];
  }
  std::stable_sort(
      candidates.begin(), candidates.end(),
      [](const Candidate& a, const Candidate& b) { return a.probability > b.probability; });
}

SynchronizeSettings settingsWith(const SynchronizeSettings& settings, const std::string& object) {
  SynchronizeSettings one = settings;
  one.object = object;
  one.takes = 1;
  return one;
}

/// Nothing that one object may have and another lacks: surface, faces.
SynchronizeSettings withoutDemands(SynchronizeSettings settings) {
  settings.surface.clear();
  settings.orientations.clear();
  return settings;
}

class Choice {
 public:
  Choice(const SynchronizeSettings& settings, const Progress& progress)
      : settings_(settings), progress_(progress) {
    silent_.stop = progress.stop;
  }

  Result<ObjectRanking> rank(const std::vector<std::string>& objects) {
    auto candidates = weighed(objects);
    if (!candidates) return tl::unexpected(candidates.error());
    bool solved = false;
    for (std::size_t i = 0; i < candidates->size(); ++i) {
      const Candidate& one = (*candidates)[i];
      if (solved &&
          (i >= kPlanned || kUnlikely * one.probability < candidates->front().probability)) {
        ranking_.push_back({one.object, false, false, 0, one.probability, "less likely"});
        continue;
      }
      progress_("objects", 0.5 + 0.5 * static_cast<double>(std::min(i, kPlanned)) / kPlanned);
      if (auto good = plan(one); !good) return tl::unexpected(good.error());
      solved = solved || ranking_.back().solved;
    }
    std::stable_partition(ranking_.begin(), ranking_.end(),
                          [](const ObjectRank& one) { return one.solved; });
    ranking_.insert(ranking_.end(), aside_.begin(), aside_.end());
    return ranking_;
  }

 private:
  Result<std::vector<Candidate>> weighed(const std::vector<std::string>& objects) {
    std::vector<Candidate> candidates;
    Listener listener(settings_);
    Error lacking;
    for (std::size_t i = 0; i < objects.size(); ++i) {
      if (progress_.stopRequested()) {
        return tl::unexpected<Error>({ErrorCode::kInterrupted, "interrupted", {}, {}});
      }
      progress_("objects", 0.5 * static_cast<double>(i) / static_cast<double>(objects.size()));
      const SynchronizeSettings one = settingsWith(settings_, objects[i]);
      const auto heard = hearWith(one, listener);
      if (heard) {
        candidates.push_back({objects[i], likelihoodOf(*heard, silent_), 0});
        continue;
      }
      if (!hearWith(withoutDemands(one), listener)) return tl::unexpected(heard.error());
      if (aside_.empty()) lacking = heard.error();
      aside_.push_back({objects[i], false, false, 0, 0, heard.error().text()});
    }
    if (candidates.empty()) return tl::unexpected(lacking);
    weigh(candidates);
    return candidates;
  }

  Result<void> plan(const Candidate& one) {
    const SynchronizeSettings settings = settingsWith(settings_, one.object);
    GraphShelf shelf(settings.graph, settings.energyGain);
    const auto found = synchronizeWith(settings, shelf, silent_);
    if (!found) return tl::unexpected(found.error());
    const Motion& motion = found->takes.front();
    ObjectRank rank{one.object, true, motion.success, 0, one.probability, motion.failure};
    if (motion.success) {
      rank.score = motion.score;
      rank.reason = describe(motion);
    }
    ranking_.push_back(std::move(rank));
    return {};
  }

  const SynchronizeSettings& settings_;
  const Progress& progress_;
  Progress silent_;
  ObjectRanking ranking_, aside_;
};

}  // namespace

std::vector<double> rhythmProbabilities(const std::vector<double>& logs) {
  const double best = *std::max_element(logs.begin(), logs.end());
  std::vector<double> all;
  double sum = 0;
  for (const double log : logs) {
    // Where none is possible all are the same.
    all.push_back(log == best ? 1 : std::exp(kTrust * (log - best)));
    sum += all.back();
  }
  for (double& one : all) one /= sum;
  return all;
}

std::vector<std::string> asGoodAsBest(const ObjectRanking& ranking) {
  std::vector<std::string> names;
  for (const ObjectRank& rank : ranking) {
    if (rank.solved && kDoubt * rank.probability > ranking.front().probability) {
      names.push_back(rank.object);
    }
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
  if (auto good = checkSettings(settings); !good) return tl::unexpected(good.error());
  if (objects.empty()) return badInput("names no object", settings.object);
  return Choice(settings, progress).rank(objects);
}

}  // namespace ifa
