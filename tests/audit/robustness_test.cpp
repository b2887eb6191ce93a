// SPDX-License-Identifier: Apache-2.0
// Motions with random damage: nothing that looks at them breaks, and the audit passes none of those
// whose damage is more than a rounding error.
#include <gtest/gtest.h>

#include <limits>

#include "audit/analytic_motion.h"
#include "audit/audit.h"
#include "base/random.h"

namespace ifa {
namespace {

/// One number of the motion, chosen at random, in a trajectory or a contact.
double& anyNumber(Motion& motion, RandomStream& random) {
  MotionSample& sample = motion.trajectory[random.below(motion.trajectory.size())];
  MotionContact& contact = motion.contacts[random.below(motion.contacts.size())];
  switch (random.below(9)) {
    case 0:
      return sample.time;
    case 1:
      return sample.position[static_cast<Eigen::Index>(random.below(3))];
    case 2:
      return sample.orientation.coeffs()[static_cast<Eigen::Index>(random.below(4))];
    case 3:
      return sample.velocity[static_cast<Eigen::Index>(random.below(3))];
    case 4:
      return sample.angularVelocity[static_cast<Eigen::Index>(random.below(3))];
    case 5:
      return contact.time;
    case 6:
      return contact.end;
    case 7:
      return contact.position[static_cast<Eigen::Index>(random.below(3))];
    default:
      return contact.targetTime;
  }
}

double anyDamage(RandomStream& random) {
  constexpr double kValues[] = {0,     1e9,
                                -1e9,  1e-3,
                                1e3,   std::numeric_limits<double>::infinity(),
                                -50,   1e12,
                                -1e12, std::numeric_limits<double>::quiet_NaN()};
  return kValues[random.below(std::size(kValues))];
}

void expectCaught(const Motion& good, const Body& body, std::uint64_t seed) {
  for (std::uint64_t i = 0; i < 200; ++i) {
    RandomStream random(seed, i);
    Motion motion = good;
    double& number = anyNumber(motion, random);
    const double before = number;
    number = anyDamage(random);
    if (std::abs(number - before) < 1e-3) continue;
    EXPECT_FALSE(audit(motion, body).passed()) << i << ": " << before << " became " << number;
  }
}

TEST(AuditRobustness, CatchesDamageAnywhere) {
  const Body body = test::makeDrawableBox();
  expectCaught(test::makeTumblingMotion(body), body, 1);
  expectCaught(test::makeSlidingMotion(body), body, 2);
}

}  // namespace
}  // namespace ifa
