// SPDX-License-Identifier: Apache-2.0
// Planning where the restitution, or the surface, is not known (docs/fitting.md).
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "base/progress.h"
#include "ifa/synchronize.h"
#include "planner/planner.h"

namespace ifa {

/// Where a restitution that was given is off, the right one is looked for between these.
struct RestitutionRange {
  double least = 0, most = 0;
};

/// Decision: a restitution may be off by 30 % whichever of the two that share is taken of, so 0.7
/// times the given one to it over 0.7; at most 0.95.
[[nodiscard]] RestitutionRange fitRange(double given);

/// Gives the object's surfaces the restitution that the settings name, or a share of theirs.
void changeRestitution(const SynchronizeSettings& settings, ObjectDefinition& object);

/// A surface on which a motion is looked for.
struct FitCandidate {
  std::string surface;
  double restitution = 0;
};

/// What is to be planned, and what may be changed for it.
struct FitRequest {
  const Planner* planner = nullptr;
  PlanRequest plan;  ///< surface and outlook of it are replaced
  /// By name, each with its J_ref, which stays: it is the threshold of hearing, not the impulse of
  /// a drop (docs/fitting.md).
  std::map<std::string, SurfaceProperties> surfaces;
  std::string first;            ///< of them; goes first
  std::filesystem::path cache;  ///< of what is learnt
};

/// What was found.
struct Fit {
  PlanRequest request;  ///< with the surface as fitted
  std::string surface;
  double given = 0;  ///< restitution that the surface came with
  std::vector<Plan> plans;
};

/// What is looked at first, likeliest first: what the rhythm sounds like on each surface; where
/// there is only one, also the given restitution if that is near, else a neighbour of the estimate,
/// beyond it as seen from the given one where the range allows.
[[nodiscard]] std::vector<FitCandidate> fitCandidates(const FitRequest& request,
                                                      const Progress& progress);

/// Plans at the restitution and on the surface that suit the signature best. Costs at most three
/// times the counted work that one plan may cost. Reports as "fit", then as the planner. Errors:
/// the planner's.
[[nodiscard]] Result<Fit> planWithFit(const FitRequest& request, const Progress& progress);

}  // namespace ifa
