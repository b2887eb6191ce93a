// SPDX-License-Identifier: Apache-2.0
#include "audit/separation.h"

#include <gtest/gtest.h>

#include "ensemble/made_motions.h"
#include "support/box_body.h"

namespace ifa {
namespace {

using Eigen::Vector3d;
using test::madeMotion;
using test::stillMotion;

TEST(LeastSeparation, OfBodiesAtRestIsTheirDistance) {
  const Body die = makeDieBody();
  const Motion one = stillMotion({0, 0, 0.008}), other = stillMotion({0.02, 0.02, 0.008});
  const Separation found = leastSeparation({{&one, &die}, {&other, &die}});
  ASSERT_TRUE(found.known);
  EXPECT_NEAR(found.least, std::hypot(0.004, 0.004), 1e-8);
  EXPECT_EQ(found.one, 0U);
  EXPECT_EQ(found.other, 1U);
  // Turned by 45 degrees about the origin, the second one's edge points to the first one's face.
  const Separation turned = leastSeparation({{&one, &die}, {&other, &die, M_PI / 4}});
  EXPECT_NEAR(turned.least, std::sqrt(2.0) * 0.02 - 0.008 - std::sqrt(2.0) * 0.008, 1e-7);
  const Separation shifted = leastSeparation({{&one, &die}, {&other, &die, 0, {0.1, -0.02}}});
  EXPECT_NEAR(shifted.least, 0.104, 1e-7);
}

TEST(LeastSeparation, FindsTheMomentAtWhichBodiesMeet) {
  const Body die = makeDieBody();
  const Motion post = madeMotion(0, 0, 2, [](double) { return Vector3d(0, 0, 0.008); });
  const Motion passing =
      madeMotion(0.3, -0.3, 1.7, [](double t) { return Vector3d(0.5 - t, 0, 0.008); });
  const Separation found = leastSeparation({{&post, &die}, {&passing, &die}});
  EXPECT_NEAR(found.least, -0.016, 1e-6) << "one right in the other";
  EXPECT_NEAR(found.time, 0.8, 1e-3) << "in the time of the sound";
}

TEST(LeastSeparation, BodiesThatAreNotThereYetMeetNobody) {
  const Body die = makeDieBody();
  // The first one is gone from the middle when the second one falls in, and rests from then on.
  const Motion leaving = madeMotion(0, 0, 1, [](double t) { return Vector3d(0.1 * t, 0, 0.008); });
  const Motion late = madeMotion(0, 0.9, 1.4, [](double) { return Vector3d(0, 0, 0.008); });
  const Separation found = leastSeparation({{&leaving, &die}, {&late, &die}});
  EXPECT_NEAR(found.least, 0.09 - 0.016, 1e-6);
  EXPECT_NEAR(found.time, 0.9, 1e-9);
  const Motion later = madeMotion(0, 5, 6, [](double) { return Vector3d(0.1, 0, 0.008); });
  EXPECT_LT(leastSeparation({{&leaving, &die}, {&later, &die}}).least, 0) << "where it rests";
  EXPECT_FALSE(leastSeparation({{&leaving, &die}}).known);
}

}  // namespace
}  // namespace ifa
