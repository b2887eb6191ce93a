// SPDX-License-Identifier: Apache-2.0
#include "audit/audit.h"

#include <fmt/format.h>

#include <algorithm>

#include "audit/checks.h"

namespace ifa {

bool AuditReport::passed() const {
  return !checks.empty() && std::all_of(checks.begin(), checks.end(),
                                        [](const AuditCheck& check) { return check.passed; });
}

const AuditCheck* AuditReport::find(const std::string& name) const {
  const auto found = std::find_if(checks.begin(), checks.end(),
                                  [&](const AuditCheck& check) { return check.name == name; });
  return found == checks.end() ? nullptr : &*found;
}

AuditReport audit(const Motion& motion, const Body& body, const AuditSettings& settings) {
  AuditReport report;
  audit_detail::checkSamples(motion, report.checks);
  if (!audit_detail::canBeJudged(motion)) return report;
  const auto evidence = audit_detail::gatherEvidence(motion, body, settings);
  audit_detail::checkContacts(evidence, report.checks);
  audit_detail::checkFlight(evidence, report.checks);
  audit_detail::checkTouching(evidence, report.checks);
  audit_detail::checkEnergy(evidence, report.checks);
  audit_detail::checkGround(evidence, report.checks);
  audit_detail::checkRest(evidence, report.checks);
  audit_detail::checkOrientations(evidence, report.checks);
  audit_detail::checkBend(evidence, report.checks);
  const auto ugly = std::count_if(motion.contacts.begin(), motion.contacts.end(),
                                  [](const MotionContact& contact) { return contact.bend > 1; });
  report.bendShareOverOne = static_cast<double>(ugly) / static_cast<double>(motion.contacts.size());
  return report;
}

std::string formatAudit(const AuditReport& report) {
  std::string text;
  for (const AuditCheck& check : report.checks) {
    text += fmt::format("{:4}  {:24} {:>10.3g} of {:<8.3g} {:16}", check.passed ? "ok" : "FAIL",
                        check.name, check.worst, check.limit, check.unit);
    if (check.worst > 0) text += fmt::format(" at {:.4f} s", check.time);
    if (!check.passed && !check.detail.empty()) text += ": " + check.detail;
    text.erase(text.find_last_not_of(' ') + 1);
    text += '\n';
  }
  text += fmt::format("contacts with a bend over 1: {:.0f} %\n", 100 * report.bendShareOverOne);
  return text;
}

}  // namespace ifa
