// SPDX-License-Identifier: Apache-2.0
// The audit of a motion, by arithmetic of its own (docs/audit.md): it shares no code with what
// planned or built the motion, and finds every contact again from body and trajectory.
#pragma once

#include <string>
#include <vector>

#include "body/body.h"
#include "ifa/motion.h"

namespace ifa {

/// Limits of the audit. The defaults are those of docs/audit.md.
struct AuditSettings {
  double startError = 1e-4;             ///< contact starts against targets, s
  double flightPosition = 1e-6;         ///< flight predicted from the previous sample, m
  double flightAngle = 1e-5;            ///< likewise, rad
  double flightVelocity = 1e-4;         ///< likewise, m/s
  double angularMomentum = 1e-6;        ///< relative change over a flight
  double timeWarp = 0.3;                ///< |retiming - 1|, or of its inverse (IFA 5.3.2)
  double frictionMargin = 0.02;         ///< share by which an impulse may leave the friction cone
  double energyRounding = 1e-6;         ///< relative; what counts as no gain of energy
  double audibleShare = kAudibleShare;  ///< threshold of hearing as a share of J_ref (method, 2);
                                        ///< not for motions of the paper's cut
  double noiseTime = 1e-6;              ///< impulses under m g times this are rounding, s
  double restDrift = 1e-9;              ///< m and rad, pose while at rest
};

/// One check: passed when `worst` is not above `limit`.
struct AuditCheck {
  std::string name;  ///< a few words: "contact starts", "flight position"...
  bool passed = true;
  double worst = 0;    ///< in `unit`
  double limit = 0;    ///< in `unit`
  std::string unit;    ///< "s", "m", "rad", "" ...
  double time = 0;     ///< s after the first contact, where the worst lies
  std::string detail;  ///< what was found there; empty when there is nothing to say
};

/// All checks, in a fixed order, failed or not.
struct AuditReport {
  std::vector<AuditCheck> checks;
  double bendShareOverOne = 0;  ///< share of contacts with a bend above 1

  [[nodiscard]] bool passed() const;
  /// The check of that name, or null.
  [[nodiscard]] const AuditCheck* find(const std::string& name) const;
};

/// Checks `motion` of `body`; the surface is looked up by `motion.object.surface` (J_ref),
/// friction, mass and what counts as a contact (`motion.cut`) are the motion's own. Never fails: a
/// motion without samples fails its checks. Thread safe.
[[nodiscard]] AuditReport audit(const Motion& motion, const Body& body,
                                const AuditSettings& settings = {});

/// The report as a table for people, one check a line.
[[nodiscard]] std::string formatAudit(const AuditReport& report);

}  // namespace ifa
