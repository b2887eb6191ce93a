// SPDX-License-Identifier: Apache-2.0
// Tunables of the shooting planner (docs/planner.md).
#pragma once

#include <cstddef>

namespace ifa {

struct ShootingPlannerSettings {
  int firstContacts = 3000;  ///< initial states tried
  int fewContacts = 4;       ///< signatures of so few contacts also begin ...
  int lateContacts = 2000;   ///< ... late in so many drops
  int beam = 300;            ///< partial motions kept from one contact to the next
  int children = 8;          ///< changes of velocity tried on each
  double mostEffort = 6;     ///< a small beam gets more children, by up to this factor
  int lastContacts = 2;      ///< contacts before the end that get more ...
  int lastFactor = 6;        ///< ... by this factor: few motions come to rest exactly there
  int perParent = 3;         ///< of the kept ones, at most so many have one parent, ...
  int perRoot = 30;          ///< ... one first contact, ...
  /// ... and energies within one bin of log(energy), so that the beam keeps motions that can still
  /// differ.
  int perEnergyBin = 50;
  double energyBin = 0.3;      ///< width of a bin, in log(energy)
  double spread = 0.35;        ///< standard deviation of a change, in units of the plausible region
  double lookAheadWeight = 1;  ///< of what the way to the next contact costs, in rank
  double outlookWeight = 0.5;  ///< of the energy outlook beyond one standard deviation
  /// Bends over this cost more than their factor, so much times the square of what is over: one
  /// ugly contact is seen whatever the Score is.
  double largeBend = 0.9, bendAversion = 10;
  double warpWeight = 0.5;  ///< share of what a time warp costs that counts in rank
  double hopeless = 8;  ///< log units that a motion without a way to the next contact loses in rank
  double restless = 4;  ///< and when it would not come to rest in the last contact
  int silentProbes = 16;  ///< changes tried where the next contact comes after silent contact
  int silentTries = 3;    ///< pairs of them, one too early and one too late, that are followed up
  int silentBeam = 150;   ///< best motions on which that is tried
  /// Where the motion flies there too, silence is tried only if unchanged it misses by less; 10 %
  /// of the gap is 1.
  double silentReach = 2.5;
  double restitutionRange = 0.2;  ///< share by which a contact may be livelier or deader
  int passes = 10;                ///< searches with other seeds and wider beams, at most
  double widest = 2.5;            ///< no pass is wider than so many times the first
  /// Of motion simulated, after which no other pass begins, but for further takes.
  double mostPieces = 3.8e6;
  /// A pass that finds nothing is gone on with so many times, from so many contacts before the last
  /// that it reached.
  int again = 2, againFrom = 3;
  double goodScore = 0.9;  ///< enough to stop after the first pass, ...
  double goodBend = 1.2;   ///< ... if no bend is over this
  /// Contacts before one that a pass did not get past, in which the next passes follow so many
  /// times the beam for so many contacts as they would go on by themselves, and what a rhythm that
  /// fits is worth in rank.
  int hardContacts = 5, hardBeam = 6, hardAhead = 6;
  double hardWeight = 1.5;
  /// Further takes are looked for among motions that go so many times as many ways as are missing.
  std::size_t waysPerTake = 2;
  int outlookDrops = 1000;  ///< drops from which the energy outlook is learnt
  /// Transitions to events of a database; none with "shoot" (docs/hybrid.md).
  int aimedEvents = 0;        ///< candidates for each contact, by rhythm
  int aimedEndings = 0;       ///< likewise for a terminal last contact
  int aimedRoots = 0;         ///< of them, first contacts
  int aimedBeam = 40;         ///< best motions that are aimed at candidates ...
  int aimedEndingBeam = 300;  ///< ... and at endings
  int aimedTries = 3;         ///< of which so many are flown to
  double aimedCost = 10;      ///< log units that one may cost

  /// Of the planner "hybrid".
  [[nodiscard]] static ShootingPlannerSettings hybrid() {
    ShootingPlannerSettings settings;
    settings.aimedEvents = 150;
    settings.aimedEndings = 1500;
    settings.aimedRoots = 300;
    return settings;
  }
};

}  // namespace ifa
