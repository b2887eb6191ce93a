// SPDX-License-Identifier: Apache-2.0
// The audit passes motions that are right by construction, and every kind of damage is caught by
// the check that is meant for it.
#include "audit/audit.h"

#include <gtest/gtest.h>

#include "audit/analytic_motion.h"

namespace ifa {
namespace {

using test::makeDrawableBox;
using test::makeSlidingMotion;
using test::makeTumblingMotion;

const Body& box() {
  static const Body body = makeDrawableBox();
  return body;
}

bool fails(const Motion& motion, const std::string& name) {
  const AuditReport report = audit(motion, box());
  const AuditCheck* check = report.find(name);
  if (check == nullptr) ADD_FAILURE() << "no check called " << name;
  if (check == nullptr || check->passed) std::cout << formatAudit(report);
  return check != nullptr && !check->passed;
}

std::size_t sampleAt(const Motion& motion, double time) {
  std::size_t index = 0;
  while (motion.trajectory[index].time < time) ++index;
  return index;
}

/// A sample in the middle of the flight after contact `index`.
MotionSample& inFlight(Motion& motion, std::size_t index) {
  const double middle = 0.5 * (motion.contacts[index].end + motion.contacts[index + 1].time);
  return motion.trajectory[sampleAt(motion, middle)];
}

TEST(Audit, PassesATumblingMotion) {
  const AuditReport report = audit(makeTumblingMotion(box()), box());
  EXPECT_TRUE(report.passed()) << formatAudit(report);
  EXPECT_EQ(report.find("rest pose"), nullptr);
}

TEST(Audit, PassesASlidingMotion) {
  const AuditReport report = audit(makeSlidingMotion(box()), box());
  EXPECT_TRUE(report.passed()) << formatAudit(report);
  ASSERT_NE(report.find("rest pose"), nullptr);
}

TEST(Audit, PassesABounceAfterTheLastContact) {
  Motion motion = makeTumblingMotion(box());
  motion.contacts.pop_back();
  const AuditReport report = audit(motion, box());
  EXPECT_TRUE(report.passed()) << formatAudit(report);
}

TEST(Audit, CatchesAnotherObject) {
  Motion motion = makeTumblingMotion(box());
  motion.object.mass *= 1.001;
  EXPECT_TRUE(fails(motion, "object"));
  motion = makeTumblingMotion(box());
  motion.object.surface = "ice";
  EXPECT_TRUE(fails(motion, "object"));
}

TEST(Audit, CatchesAShiftedStart) {
  Motion motion = makeTumblingMotion(box());
  motion.contacts[2].targetTime += 2e-4;
  EXPECT_TRUE(fails(motion, "contact starts"));
}

TEST(Audit, CatchesAContactThatIsNotThere) {
  Motion motion = makeTumblingMotion(box());
  const MotionSample& middle = inFlight(motion, 1);
  MotionContact invented = motion.contacts[1];
  invented.targetTime = invented.time = invented.end = middle.time;
  invented.position = middle.position;
  motion.contacts.insert(motion.contacts.begin() + 2, invented);
  EXPECT_TRUE(fails(motion, "contacts found"));
}

TEST(Audit, CatchesAMisplacedContact) {
  Motion motion = makeTumblingMotion(box());
  motion.contacts[2].position.x() += 1e-4;
  EXPECT_TRUE(fails(motion, "contacts found"));
}

TEST(Audit, CatchesAContactTooSoftToHear) {
  Body body = box();
  body.definition.surfaces["desk"].referenceImpulse *= 1000;
  const AuditReport report = audit(makeTumblingMotion(body), body);
  EXPECT_FALSE(report.find("contacts found")->passed);
}

TEST(Audit, CatchesAnUnlistedContact) {
  Motion motion = makeTumblingMotion(box());
  motion.contacts.erase(motion.contacts.begin() + 2);
  EXPECT_TRUE(fails(motion, "unlisted contacts"));
  EXPECT_TRUE(fails(motion, "flight velocity"));
  // Marked as silent it can still be heard.
  const double time = makeTumblingMotion(box()).contacts[2].time;
  motion.silent.push_back({time, time});
  EXPECT_TRUE(fails(motion, "unlisted contacts"));
  EXPECT_FALSE(fails(motion, "flight velocity"));
}

TEST(Audit, CatchesASunkVertex) {
  Motion motion = makeSlidingMotion(box());
  for (MotionSample& sample : motion.trajectory) sample.position.z() -= 1.1 * box().tolerance();
  EXPECT_TRUE(fails(motion, "lowest vertex"));
  for (MotionSample& sample : motion.trajectory) sample.position.z() += 0.2 * box().tolerance();
  EXPECT_FALSE(fails(motion, "lowest vertex"));
}

TEST(Audit, CatchesADipBetweenSamples) {
  // Flat above the ground at both samples, upright and in it between them.
  Motion motion = makeTumblingMotion(box());
  MotionSample &a = motion.trajectory[10], &b = motion.trajectory[11];
  a.orientation = b.orientation = Eigen::Quaterniond::Identity();
  a.angularVelocity = {0, 2 * 3.14159265358979 / (b.time - a.time), 0};
  a.velocity.setZero();
  a.position.z() = b.position.z() = 0.0065;
  EXPECT_TRUE(fails(motion, "lowest vertex"));
}

TEST(Audit, CatchesAGainOfEnergy) {
  Motion motion = makeTumblingMotion(box());
  const std::size_t after = sampleAt(motion, motion.contacts[3].time) + 1;
  motion.trajectory[after].velocity *= 3;
  EXPECT_TRUE(fails(motion, "event energy"));
  motion.energyGain = 20;
  EXPECT_FALSE(fails(motion, "event energy"));
}

TEST(Audit, CatchesATransientRiseInAnEvent) {
  Motion motion = makeSlidingMotion(box());
  motion.contacts.back().end = motion.silent[0][1];
  motion.silent.clear();
  EXPECT_FALSE(fails(motion, "transient energy"));
  motion.trajectory[sampleAt(motion, motion.contacts.back().time + 0.05)].velocity.z() += 0.3;
  EXPECT_TRUE(fails(motion, "transient energy"));
}

TEST(Audit, CatchesEnergyThatRisesInSilence) {
  Motion motion = makeSlidingMotion(box());
  motion.trajectory[sampleAt(motion, motion.silent[0][0] + 0.05)].velocity.x() += 0.5;
  EXPECT_TRUE(fails(motion, "silent energy"));
}

TEST(Audit, CatchesAFlightThatIsNoParabola) {
  Motion motion = makeTumblingMotion(box());
  inFlight(motion, 1).position.y() += 2e-6;
  EXPECT_TRUE(fails(motion, "flight position"));
}

TEST(Audit, CatchesAWrongTurn) {
  Motion motion = makeTumblingMotion(box());
  MotionSample& sample = inFlight(motion, 1);
  sample.orientation = Eigen::AngleAxisd(2e-5, Eigen::Vector3d::UnitX()) * sample.orientation;
  EXPECT_TRUE(fails(motion, "flight angle"));
}

TEST(Audit, CatchesAWrongVelocity) {
  Motion motion = makeTumblingMotion(box());
  inFlight(motion, 1).velocity.x() += 2e-4;
  EXPECT_TRUE(fails(motion, "flight velocity"));
}

TEST(Audit, CatchesAChangeOfAngularMomentum) {
  Motion motion = makeTumblingMotion(box());
  inFlight(motion, 1).angularVelocity *= 1.00001;
  EXPECT_TRUE(fails(motion, "angular momentum"));
}

TEST(Audit, CatchesWrongGravity) {
  Motion motion = makeTumblingMotion(box());
  motion.contacts[3].retiming = 1.05;
  EXPECT_TRUE(fails(motion, "flight velocity"));
}

/// Plays the flight before contact `index` slower by `factor`.
Motion retimed(const Motion& original, std::size_t index, double factor) {
  Motion motion = original;
  const double from = original.contacts[index - 1].end, to = original.contacts[index].time;
  const double shift = (factor - 1) * (to - from);
  const std::size_t first = sampleAt(original, from) + 1, last = sampleAt(original, to);
  for (std::size_t i = first; i < motion.trajectory.size(); ++i) {
    MotionSample& sample = motion.trajectory[i];
    sample.time = i <= last + 1 ? from + factor * (sample.time - from) : sample.time + shift;
    if (i > last) continue;
    sample.velocity /= factor;
    sample.angularVelocity /= factor;
  }
  for (std::size_t i = index; i < motion.contacts.size(); ++i) {
    MotionContact& contact = motion.contacts[i];
    contact.targetTime = contact.time = contact.end = contact.time + shift;
  }
  motion.contacts[index].retiming = factor;
  return motion;
}

TEST(Audit, FollowsRetiming) {
  // Faster: samples stay close enough to each other.
  const Motion motion = retimed(makeTumblingMotion(box()), 3, 0.93);
  const AuditReport report = audit(motion, box());
  EXPECT_TRUE(report.passed()) << formatAudit(report);
}

TEST(Audit, CatchesTooMuchRetiming) {
  EXPECT_TRUE(fails(retimed(makeTumblingMotion(box()), 3, 0.76), "time warp"));
}

TEST(Audit, CatchesAFlippedQuaternion) {
  Motion motion = makeTumblingMotion(box());
  inFlight(motion, 2).orientation.coeffs() *= -1;
  EXPECT_TRUE(fails(motion, "orientation signs"));
  EXPECT_FALSE(fails(motion, "flight angle"));
}

TEST(Audit, CatchesDriftAtRest) {
  Motion motion = makeSlidingMotion(box());
  for (MotionSample& sample : motion.trajectory) {
    if (sample.time > motion.silent[0][1]) sample.position.x() += 1e-6 * sample.time;
  }
  EXPECT_TRUE(fails(motion, "rest pose"));
}

TEST(Audit, CatchesAnEarlyFreeze) {
  Motion motion = makeSlidingMotion(box());
  const std::size_t frozen = sampleAt(motion, motion.silent[0][0] + 0.02);
  motion.silent[0][1] = motion.trajectory[frozen].time;
  for (std::size_t i = frozen + 1; i < motion.trajectory.size(); ++i) {
    motion.trajectory[i].position = motion.trajectory[frozen].position;
    motion.trajectory[i].velocity.setZero();
  }
  EXPECT_TRUE(fails(motion, "rest speed"));
}

TEST(Audit, CatchesRestThatCannotStand) {
  // Tilted by 20 degrees, the body stands on one edge.
  Motion motion = makeSlidingMotion(box());
  const Eigen::Quaterniond tilt(Eigen::AngleAxisd(0.35, Eigen::Vector3d::UnitY()));
  for (MotionSample& sample : motion.trajectory) sample.orientation = tilt * sample.orientation;
  double lowest = 0;
  for (const auto& vertex : box().hull) lowest = std::min(lowest, (tilt * vertex).z());
  for (MotionSample& sample : motion.trajectory) sample.position.z() -= lowest + 0.006;
  EXPECT_TRUE(fails(motion, "rest support"));
}

TEST(Audit, CatchesABodyThatLiesOtherwiseThanAsked) {
  Motion motion = makeSlidingMotion(box());
  const Eigen::Vector3d shown = motion.trajectory.back().orientation * Eigen::Vector3d::UnitX();
  motion.orientations = {{-1, Eigen::Vector3d::UnitX(), shown}};
  EXPECT_TRUE(audit(motion, box()).passed());
  motion.orientations[0].world = -shown;
  EXPECT_TRUE(fails(motion, "orientation as asked"));
  // Five degrees are one too many, at a contact as at the end.
  const Eigen::Vector3d first =
      motion.trajectory[sampleAt(motion, 0)].orientation * Eigen::Vector3d::UnitX();
  const Eigen::Vector3d axis = first.unitOrthogonal();
  motion.orientations = {{0, Eigen::Vector3d::UnitX(), Eigen::AngleAxisd(0.06, axis) * first}};
  EXPECT_TRUE(audit(motion, box()).passed());
  motion.orientations[0].world = Eigen::AngleAxisd(0.087, axis) * first;
  EXPECT_TRUE(fails(motion, "orientation as asked"));
}

TEST(Audit, CatchesAMotionThatEndsBeforeItRests) {
  Motion motion = makeSlidingMotion(box());
  motion.trajectory.resize(sampleAt(motion, motion.silent[0][1] - 0.05));
  EXPECT_TRUE(fails(motion, "rest pose"));
}

TEST(Audit, CatchesTouchInTheAir) {
  Motion motion = makeTumblingMotion(box());
  const std::size_t index = sampleAt(motion, motion.contacts[1].time + 0.01);
  MotionSample pushed = motion.trajectory[index];
  pushed.velocity.x() += 1e-3;
  motion.trajectory.insert(motion.trajectory.begin() + static_cast<std::ptrdiff_t>(index) + 1,
                           pushed);
  motion.silent.push_back({pushed.time, pushed.time});
  EXPECT_TRUE(fails(motion, "touching on the ground"));
}

TEST(Audit, CatchesFrictionOutsideItsCone) {
  Motion motion = makeSlidingMotion(box());
  motion.object.friction = 0.30;
  EXPECT_TRUE(fails(motion, "friction cone"));
}

TEST(Audit, CatchesDisplacementInContact) {
  Motion motion = makeSlidingMotion(box());
  const std::size_t from = sampleAt(motion, motion.silent[0][0] + 0.03);
  for (std::size_t i = from; i < motion.trajectory.size(); ++i) {
    motion.trajectory[i].position.y() += 2e-4;
  }
  EXPECT_TRUE(fails(motion, "motion in contact"));
}

TEST(Audit, CatchesUglyContacts) {
  Motion motion = makeTumblingMotion(box());
  motion.contacts[1].bend = 2.5;
  EXPECT_TRUE(fails(motion, "bend"));
  EXPECT_NEAR(audit(motion, box()).bendShareOverOne, 0.2, 1e-12);
}

TEST(Audit, CatchesABendThatIsStatedTooSmall) {
  // A tenth of what the third contact does is said to be a change that was added.
  Motion motion = makeTumblingMotion(box());
  const std::size_t after = sampleAt(motion, motion.contacts[2].time) + 1;
  const Eigen::Vector3d jump =
      motion.trajectory[after].velocity - motion.trajectory[after - 1].velocity;
  motion.contacts[3].impulseChange = box().mass * 0.1 * jump;
  // 0.1 of the jump against 0.4 of the remaining 0.9 of it.
  motion.contacts[3].bend = 0.1 / (0.4 * 0.9) + 1e-9;
  EXPECT_FALSE(fails(motion, "bend understated"));
  motion.contacts[3].bend -= 1e-3;
  EXPECT_TRUE(fails(motion, "bend understated"));
  motion.contacts[3].impulseChange = box().mass * 0.5 * jump;
  EXPECT_TRUE(fails(motion, "bend"));
}

TEST(Audit, CatchesBrokenSamples) {
  const Motion good = makeTumblingMotion(box());
  Motion none = good, gap = good, missing = good, nan = good, stretched = good;
  none.trajectory.clear();
  EXPECT_TRUE(fails(none, "samples"));
  gap.trajectory.erase(gap.trajectory.begin() + 5, gap.trajectory.begin() + 7);
  EXPECT_TRUE(fails(gap, "samples"));
  missing.contacts[1].end = missing.contacts[1].time + 1e-4;
  EXPECT_TRUE(fails(missing, "samples"));
  nan.trajectory[7].velocity.x() = std::nan("");
  EXPECT_TRUE(fails(nan, "samples"));
  stretched.trajectory[7].orientation.coeffs() *= 1.001;
  EXPECT_TRUE(fails(stretched, "samples"));
}

}  // namespace
}  // namespace ifa
