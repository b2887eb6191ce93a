// SPDX-License-Identifier: Apache-2.0
// Plans become trajectories that keep what the plan says, and that the audit finds nothing wrong
// with.
#include "motion/build_motion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "audit/audit.h"
#include "planner/shooting_cases.h"

namespace ifa {
namespace {

constexpr double kPreRoll = 0.3;  // s

struct Case {
  const char *name, *object;
  std::size_t drop = 0;  ///< which of the drops with so many contacts is planned ...
  std::size_t fewest = 0, most = 0;
  ContactSignature signature = {};  ///< ... or this
  int takes = 1;
  double timeWarp = 0;
};

const std::vector<Case>& cases() {
  using test::clicks;
  static const std::vector<Case> all = {
      {"Die", "d6", 0, 5, 9},
      {"OtherDie", "d6", 1, 5, 9},
      {"Cup", "CoffeeCup", 0, 4, 10},
      {"OtherCup", "CoffeeCup", 1, 4, 10},
      {"Eraser", "Eraser", 0, 3, 6},
      {"OneContact", "Eraser", 0, 0, 0, clicks({{0, 0.03, 1, 0.01, 1}}, true)},
      {"BouncesOn", "d6", 0, 0, 0,
       clicks({{0, 0, 1, 0, 1}, {0.25, 0, 0.8, 0, 1}, {0.45, 0, 0.6, 0, 1}}, false), 3},
      {"Partial", "d6", 0, 0, 0,
       clicks({{0, 0, 1, 0, 1}, {0.25, 0, 0.8, 0, 1}, {2.25, 0, 0.6, 0, 1}}, true)},
      {"WarpedDie", "d6", 2, 5, 9, {}, 1, 0.29},
      {"WarpedCup", "CoffeeCup", 2, 4, 10, {}, 1, 0.29},
  };
  return all;
}

ContactSignature signatureOf(const Case& wanted, const Body& body) {
  if (wanted.most == 0) return wanted.signature;
  return test::signatures(body, wanted.drop + 1, wanted.fewest, wanted.most).back();
}

struct Built {
  Body body;
  PlanRequest request;
  std::vector<Plan> plans;
  std::vector<Motion> motions;
};

/// Plans and their motions, made once for all tests of a case.
const Built& built(std::size_t index) {
  static std::map<std::size_t, Built> all;
  const auto found = all.find(index);
  if (found != all.end()) return found->second;
  const Case& wanted = cases()[index];
  Built& made = all[index];
  made.body = loadObject(wanted.object).value();
  made.request = test::requestFor(made.body);
  made.request.signature = signatureOf(wanted, made.body);
  made.request.settings.takes = wanted.takes;
  made.request.settings.timeWarp = wanted.timeWarp;
  // Few first contacts bring a body to rest at once.
  const bool one = made.request.signature.events.size() == 1;
  const ShootingPlanner planner(one ? ShootingPlannerSettings() : test::smallSearch());
  made.plans = planner.plan(made.request, {}).value();
  for (const Plan& plan : made.plans) {
    auto motion = buildMotion(made.request, plan, kPreRoll);
    EXPECT_TRUE(motion.has_value()) << motion.error().text();
    if (!motion) continue;
    motion->object.surface = made.body.definition.defaultSurface;
    made.motions.push_back(std::move(*motion));
  }
  return made;
}

class BuildMotion : public testing::TestWithParam<std::size_t> {
 protected:
  BuildMotion() : built_(built(GetParam())) {}
  void SetUp() override {
    ASSERT_FALSE(built_.plans.empty());
    ASSERT_EQ(built_.motions.size(), built_.plans.size()) << "a replay differs from its plan";
    for (const Motion& motion : built_.motions) ASSERT_FALSE(motion.trajectory.empty());
  }

  [[nodiscard]] double lowest(const MotionSample& sample) const {
    double least = 1e9;
    for (const Eigen::Vector3d& vertex : built_.body.hull) {
      least = std::min(least, (sample.position + sample.orientation * vertex).z());
    }
    return least;
  }

  const Built& built_;
};

TEST_P(BuildMotion, HasASampleAtTheStartAndEndOfEveryContact) {
  for (const Motion& motion : built_.motions) {
    const auto& samples = motion.trajectory;
    for (const MotionContact& contact : motion.contacts) {
      for (const double time : {contact.time, contact.end}) {
        EXPECT_TRUE(std::any_of(samples.begin(), samples.end(), [&](const MotionSample& sample) {
          return std::abs(sample.time - time) < 1e-9;
        })) << time;
      }
    }
  }
}

TEST_P(BuildMotion, SaysOfContactsWhatThePlanSays) {
  for (std::size_t i = 0; i < built_.plans.size(); ++i) {
    const Plan& plan = built_.plans[i];
    const Motion& motion = built_.motions[i];
    ASSERT_EQ(motion.contacts.size(), plan.contacts.size());
    EXPECT_EQ(motion.success, plan.solved);
    EXPECT_EQ(motion.failure, plan.failure);
    EXPECT_EQ(motion.score, plan.score);
    EXPECT_EQ(motion.bend.max, plan.bendMax);
    for (std::size_t k = 0; k < plan.contacts.size(); ++k) {
      const PlannedContact& planned = plan.contacts[k];
      const MotionContact& contact = motion.contacts[k];
      const auto& target =
          built_.request.signature.events[static_cast<std::size_t>(planned.target)];
      EXPECT_EQ(contact.targetTime, target.time);
      EXPECT_EQ(contact.targetDuration, target.duration);
      EXPECT_EQ(contact.targetAmplitude, target.amplitude);
      EXPECT_NEAR(contact.time, target.time, 1e-5);
      EXPECT_NEAR(contact.end - contact.time, planned.event.end, 1e-12);
      EXPECT_EQ(contact.terminal, planned.event.terminal);
      EXPECT_EQ(contact.arrival, planned.arrival);
      EXPECT_EQ(contact.bend, planned.bend);
      EXPECT_EQ(contact.retiming, planned.retiming);
      if (k == 0) {
        EXPECT_EQ(contact.impulseChange.norm(), 0);
        continue;
      }
      const Eigen::Vector3d change = built_.body.mass * plan.contacts[k - 1].velocityChange;
      EXPECT_LT((contact.impulseChange - change).norm(), 1e-15);
    }
  }
}

TEST_P(BuildMotion, MovesWithoutJumps) {
  for (const Motion& motion : built_.motions) {
    for (std::size_t i = 1; i < motion.trajectory.size(); ++i) {
      const MotionSample &a = motion.trajectory[i - 1], &b = motion.trajectory[i];
      const double step = b.time - a.time;
      ASSERT_GE(step, 0) << a.time;
      ASSERT_LT(step, 1 / 240.0 + 1e-5) << a.time;
      const double speed = std::max(a.velocity.norm(), b.velocity.norm()) + kGravity * step;
      EXPECT_LE((b.position - a.position).norm(), speed * step + 1e-6) << a.time;
      // In flight of an uneven body the spin's direction changes, its length by less than this.
      const double spin = 3 * std::max(a.angularVelocity.norm(), b.angularVelocity.norm());
      EXPECT_LE(a.orientation.angularDistance(b.orientation), spin * step + 1e-5) << a.time;
      EXPECT_GE(a.orientation.dot(b.orientation), 0) << a.time;
      EXPECT_NEAR(b.orientation.norm(), 1, 1e-12);
    }
  }
}

TEST_P(BuildMotion, FallsFreelyBeforeTheFirstContact) {
  for (const Motion& motion : built_.motions) {
    const MotionSample& first = motion.trajectory.front();
    EXPECT_LE(first.time, 0);
    EXPECT_GE(first.time, -kPreRoll - 1e-9);
    // Where it does not begin at the pre-roll's start, it begins on the ground.
    if (first.time > -kPreRoll + 1e-6) {
      EXPECT_NEAR(lowest(first), 0, 1e-6);
    }
    for (const MotionSample& sample : motion.trajectory) {
      if (sample.time >= 0) break;
      const double t = sample.time - first.time;
      Eigen::Vector3d there = first.position + first.velocity * t;
      there.z() -= 0.5 * kGravity * t * t;
      EXPECT_LT((sample.position - there).norm(), 1e-9) << sample.time;
      EXPECT_GT(lowest(sample), -built_.body.tolerance()) << sample.time;
    }
  }
}

TEST_P(BuildMotion, TheEndIsRest) {
  for (const Motion& motion : built_.motions) {
    const auto& samples = motion.trajectory;
    const MotionSample& last = samples.back();
    if (!motion.success || !motion.contacts.back().terminal) continue;
    auto first = std::find_if(samples.begin(), samples.end(), [&](const MotionSample& sample) {
      return sample.time > last.time - 0.499;
    });
    for (; first != samples.end(); ++first) {
      EXPECT_EQ(first->position, last.position);
      EXPECT_EQ(first->orientation.coeffs(), last.orientation.coeffs());
      EXPECT_EQ(first->velocity.norm(), 0);
      EXPECT_EQ(first->angularVelocity.norm(), 0);
    }
    EXPECT_NEAR(lowest(last), 0, built_.body.tolerance());
  }
}

TEST_P(BuildMotion, SilentContactLiesBetweenContacts) {
  for (const Motion& motion : built_.motions) {
    const auto& contacts = motion.contacts;
    double last = contacts.front().end;
    for (const auto& [begin, end] : motion.silent) {
      EXPECT_LE(begin, end);
      EXPECT_GE(begin, last - 1e-9);
      EXPECT_LE(end, motion.trajectory.back().time + 1e-9);
      last = end;
      const double middle = 0.5 * (begin + end);
      for (const MotionContact& contact : contacts) {
        EXPECT_FALSE(middle > contact.time && middle < contact.end) << middle;
      }
    }
    for (std::size_t k = 1; k < contacts.size(); ++k) {
      const bool marked =
          std::any_of(motion.silent.begin(), motion.silent.end(), [&](const auto& interval) {
            return interval[0] >= contacts[k - 1].end - 1e-9 &&
                   interval[1] <= contacts[k].time + 1e-9;
          });
      EXPECT_EQ(marked, contacts[k].arrival == Arrival::kSilentContact) << k;
    }
  }
}

TEST_P(BuildMotion, HoldsTheAudit) {
  for (const Motion& motion : built_.motions) {
    if (!motion.success) continue;
    const AuditReport report = audit(motion, built_.body);
    EXPECT_TRUE(report.passed()) << formatAudit(report);
  }
}

TEST_P(BuildMotion, NeedsNoPreRoll) {
  const auto motion = buildMotion(built_.request, built_.plans[0], 0);
  ASSERT_TRUE(motion.has_value());
  EXPECT_EQ(motion->trajectory.front().time, 0);
}

INSTANTIATE_TEST_SUITE_P(Plans, BuildMotion, testing::Range<std::size_t>(0, 10),
                         [](const auto& planned) {
                           return std::string(cases()[planned.param].name);
                         });

TEST(BuildMotionTest, EverySolvedPlanOfSeveralIsReplayed) {
  EXPECT_EQ(built(6).motions.size(), 3U);
}

TEST(BuildMotionTest, PartialPlansSayWhatFailed) {
  const Motion& motion = built(7).motions.at(0);
  EXPECT_FALSE(motion.success);
  EXPECT_FALSE(motion.failure.empty());
  EXPECT_EQ(motion.contacts.size(), 2U);
  EXPECT_GT(motion.trajectory.back().time, 0.25);
}

TEST(BuildMotionTest, WarpsFlightsAndSilentContact) {
  const auto warped = [](Arrival arrival) {
    int count = 0;
    for (const std::size_t index : {std::size_t{8}, std::size_t{9}}) {
      for (const MotionContact& contact : built(index).motions.at(0).contacts) {
        EXPECT_LT(std::max(contact.retiming, 1 / contact.retiming), 1.3);
        if (contact.retiming != 1 && contact.arrival == arrival) ++count;
      }
    }
    return count;
  };
  EXPECT_GT(warped(Arrival::kFlight), 0);
  EXPECT_GT(warped(Arrival::kSilentContact), 0);
}

TEST(BuildMotionTest, AMotionThatIsNotTerminalGoesOn) {
  const Motion& motion = built(6).motions.at(0);
  EXPECT_FALSE(motion.contacts.back().terminal);
  EXPECT_GT(motion.trajectory.back().time, motion.contacts.back().end + 0.2);
}

TEST(BuildMotionTest, AReplayThatDiffersIsABug) {
  const Built& die = built(0);
  Plan plan = die.plans[0];
  plan.contacts[1].event.after.velocity.z() += 1e-12;
  const auto motion = buildMotion(die.request, plan, kPreRoll);
  ASSERT_FALSE(motion.has_value());
  EXPECT_EQ(motion.error().code, ErrorCode::kInternal);
  EXPECT_NE(motion.error().message.find("contact 2"), std::string::npos);
}

TEST(BuildMotionTest, APlanWithoutContactsHasNoTrajectory) {
  const Built& die = built(0);
  Plan plan;
  plan.failure = "nothing was found";
  const auto motion = buildMotion(die.request, plan, kPreRoll);
  ASSERT_TRUE(motion.has_value());
  EXPECT_FALSE(motion->success);
  EXPECT_EQ(motion->failure, "nothing was found");
  EXPECT_TRUE(motion->trajectory.empty());
}

}  // namespace
}  // namespace ifa
