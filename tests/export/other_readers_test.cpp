// SPDX-License-Identifier: Apache-2.0
// Our files as three.js and TinyUSDZ understand them (check_animations.mjs).
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "audit/analytic_motion.h"
#include "export/glb.h"
#include "export/motion_json.h"
#include "export/usda.h"
#include "support/temporary_folder.h"

namespace ifa {
namespace {

TEST(OtherReaders, SeeTheMotion) {
  const std::filesystem::path here = std::filesystem::path(IFA_SOURCE_DIR) / "tests/export";
  if (!std::filesystem::exists(here / "node_modules/three")) {
    GTEST_SKIP() << "the readers are not installed: npm ci in tests/export";
  }
  const test::TemporaryFolder folder;
  std::string command = "node '" + (here / "check_animations.mjs").string() + "'";
  const Body box = test::makeDrawableBox();
  AnimationSettings settings;
  for (const auto& [name, motion] : {std::pair("tumbling", test::makeTumblingMotion(box)),
                                     std::pair("sliding", test::makeSlidingMotion(box))}) {
    const auto there = folder / name;
    std::filesystem::create_directories(there);
    ASSERT_TRUE(writeMotionJson(there / "motion.json", motion).has_value());
    ASSERT_TRUE(writeGlb(there / "motion.glb", motion, box, settings).has_value());
    ASSERT_TRUE(writeUsda(there / "motion.usda", motion, box).has_value());
    settings.floorAndLight = true;  // in the second
    command += " '" + there.string() + "'";
  }
  EXPECT_EQ(std::system(command.c_str()), 0);
}

}  // namespace
}  // namespace ifa
