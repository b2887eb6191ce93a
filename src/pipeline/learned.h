// SPDX-License-Identifier: Apache-2.0
// What is learnt of an object from drops of it, once, before anything is planned with it.
#pragma once

#include <filesystem>

#include "base/progress.h"
#include "body/body.h"
#include "planner/energy_outlook.h"
#include "planner/restitution_outlook.h"
#include "planner/rhythm_likelihood.h"

namespace ifa {

struct Learned {
  double referenceImpulse = 0;  ///< J_ref, N s: the surface's own, or measured where it has none
  EnergyOutlook outlook;
};

/// Takes it from `cache` where a file of this very body, surface and version of the simulation is
/// there; else drops the body (some tenths of a second) and puts it there, if it can. What comes
/// back has the same bits either way. An unreadable or foreign file counts as none; an empty
/// `cache` is never used.
[[nodiscard]] Learned learnObject(const Body& body, const SurfaceProperties& surface,
                                  const std::filesystem::path& cache, const Progress& progress);

/// The same of the restitution that a rhythm sounds like, about the surface's own.
/// @param surface  with its J_ref
[[nodiscard]] RestitutionOutlook learnRestitution(const Body& body,
                                                  const SurfaceProperties& surface,
                                                  const std::filesystem::path& cache,
                                                  const Progress& progress);

/// The same of how likely the body makes a rhythm.
/// @param surface  with its J_ref
[[nodiscard]] RhythmLikelihood learnRhythm(const Body& body, const SurfaceProperties& surface,
                                           const std::filesystem::path& cache,
                                           const Progress& progress);

}  // namespace ifa
