// SPDX-License-Identifier: Apache-2.0
// Root finding on functions that are known, jumps among them.
#include "planner/silent_search.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace ifa {
namespace {

/// Offs that were found for a function of the first coordinate.
template <class Off>
std::vector<double> found(const Off& off, const SilentSearchSettings& settings) {
  std::vector<double> all;
  double last = 0;
  RandomStream random(7, 0);
  findOnTime(
      [&](const Coordinates& y) {
        last = off(y[0]);
        return SilentProbe{y, last, Eigen::Vector3d(0, 0, y[0] < 0 ? 1 : -1)};
      },
      [&] { all.push_back(last); }, settings, random);
  return all;
}

TEST(SilentSearch, ClosesInOnARoot) {
  const auto all = found([](double x) { return 0.1 * x * x * x + 0.05 * x - 0.013; }, {});
  ASSERT_FALSE(all.empty());
  for (const double off : all) EXPECT_LT(std::abs(off), kSilentPrecision);
}

TEST(SilentSearch, TakesNoJumpForARoot) {
  EXPECT_TRUE(found([](double x) { return x < 0.1 ? -0.02 : 0.03; }, {}).empty());
}

TEST(SilentSearch, LeavesAJumpSoonAndARootBesideOneNot) {
  int probes = 0;
  const auto jump = [&](double x) {
    ++probes;
    return 0.02 * x + (x < 0.1 ? -0.02 : 0.03);
  };
  SilentSearchSettings settings;
  EXPECT_TRUE(found(jump, settings).empty());
  // False position alone would spend fifty on each pair.
  EXPECT_LE(probes, settings.probes + 1 + 20 * settings.tries);
  // A root so near a jump that most pairs have both between them.
  const auto both = found([](double x) { return x < 0 ? -0.05 : x - 0.01; }, settings);
  ASSERT_FALSE(both.empty());
  for (const double off : both) EXPECT_LT(std::abs(off), kSilentPrecision);
}

TEST(SilentSearch, FindsTheWayIntoABalance) {
  // Between falling to one side and to the other it takes ever longer.
  const auto off = [](double x) { return std::min(0.3, -0.05 - 0.01 * std::log(std::abs(x))); };
  const auto all = found(off, {});
  ASSERT_FALSE(all.empty());
  for (const double each : all) EXPECT_LT(std::abs(each), kSilentPrecision);
}

TEST(SilentSearch, WithSlackTakesWhatIsNearEnoughAndNoMore) {
  SilentSearchSettings settings;
  settings.precision = 0.02;
  const auto all = found([](double x) { return 0.1 * x + 0.01; }, settings);
  ASSERT_EQ(all.size(), static_cast<std::size_t>(settings.tries) + 1);
  for (const double off : all) EXPECT_LT(std::abs(off), settings.precision);
  settings.precision = 0.001;
  for (const double off : found([](double x) { return 0.1 * x + 0.01; }, settings)) {
    EXPECT_LT(std::abs(off), settings.precision);
  }
}

}  // namespace
}  // namespace ifa
