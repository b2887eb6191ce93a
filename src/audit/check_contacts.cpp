// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <string>

#include "audit/checks.h"

namespace ifa::audit_detail {
namespace {

constexpr double kSamePlace = 1e-6;  // m, of a contact's position and its sample
// An event begins with a bin that is heard. Where the bins of who found it lay is not quite known,
// so a little under the threshold will do.
constexpr double kFindShare = 0.9;

std::string label(std::size_t index) { return "contact " + std::to_string(index + 1); }

/// Excess impulse of the first millisecond of contact `index`, or of one step in it, N s.
double heardAtStart(const Evidence& all, std::size_t index) {
  double heard = 0;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Step& step : all.steps) {
    const bool mine = step.kind == StepKind::kEvent && step.contact == index;
    if (!mine || all.sample(step.from).time >= all.contact(index).time + kBin - kSameTime) continue;
    sum += step.impulse;
    heard = std::max({heard, all.excess(step.impulse, step.duration), all.excess(sum, kBin)});
  }
  return heard;
}

/// What, if anything, is wrong with the claim that contact `index` happens.
std::string whyNotFound(const Evidence& all, std::size_t index) {
  const MotionContact& contact = all.contact(index);
  bool touches = false, there = true;
  for (std::size_t i = 0; i < all.lowest.size(); ++i) {
    if (std::abs(all.sample(i).time - contact.time) > kSameTime) continue;
    touches = touches || std::abs(all.lowest[i]) <= all.depth;
    there = there && (all.sample(i).position - contact.position).norm() <= kSamePlace;
  }
  if (!touches) return "does not touch the ground";
  if (!(heardAtStart(all, index) > kFindShare * all.threshold)) return "cannot be heard";
  return there ? "" : "is not where the file says";
}

/// The file and the object speak of the same thing.
AuditCheck sameObject(const Evidence& all) {
  constexpr double kSameMass = 1e-6;
  Worst worst;
  if (all.body.definition.surfaces.count(all.motion.object.surface) == 0) {
    worst.see(1, 0, "the object has no surface called " + all.motion.object.surface);
  }
  worst.see(std::abs(all.motion.object.mass / all.mass - 1), 0, "another mass");
  return worst.check("object", "share", kSameMass);
}

AuditCheck starts(const Evidence& all) {
  Worst worst;
  for (std::size_t i = 0; i < all.motion.contacts.size(); ++i) {
    const MotionContact& contact = all.contact(i);
    worst.see(std::abs(contact.time - contact.targetTime), contact.time, label(i));
  }
  return worst.check("contact starts", "s", all.settings.startError);
}

AuditCheck found(const Evidence& all) {
  double missing = 0, time = 0;
  std::string detail;
  for (std::size_t i = 0; i < all.motion.contacts.size(); ++i) {
    const std::string why = whyNotFound(all, i);
    if (why.empty() || missing++ > 0) continue;
    time = all.contact(i).time;
    detail = label(i) + " " + why;
  }
  return {"contacts found", missing == 0, missing, 0, "missing", time, detail};
}

/// A single step that is heard by itself is heard however bins are laid.
AuditCheck unlisted(const Evidence& all) {
  Worst worst;
  for (const Step& step : all.steps) {
    if (step.kind == StepKind::kEvent || step.kind == StepKind::kAfter) continue;
    // The paper's cut clips the resting contact; "rest pose" sees that nothing moves in it.
    if (step.kind == StepKind::kRest && all.motion.cut == EventCut::kPaper) continue;
    if (all.sample(step.from).time < all.contact(0).time) continue;
    worst.see(all.excess(step.impulse, step.simulated), all.sample(step.from).time);
  }
  return worst.check("unlisted contacts", "N s", all.threshold);
}

}  // namespace

void checkContacts(const Evidence& all, Checks& checks) {
  checks.push_back(sameObject(all));
  checks.push_back(starts(all));
  checks.push_back(found(all));
  checks.push_back(unlisted(all));
}

}  // namespace ifa::audit_detail
