// SPDX-License-Identifier: Apache-2.0
#include "base/paths.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <regex>
#include <string>

#include "base/version.h"

namespace ifa {
namespace {

TEST(ObjectsFolder, IsThatOfTheSourceTreeForAProgramThatIsNotInstalled) {
  ::unsetenv("IFA_OBJECTS");
  EXPECT_EQ(objectsFolder(), std::filesystem::path(IFA_SOURCE_DIR) / "objects");
}

TEST(ObjectsFolder, IsTheOneThatTheEnvironmentNames) {
  ::setenv("IFA_OBJECTS", "/some/where", 1);
  EXPECT_EQ(objectsFolder(), "/some/where");
  ::setenv("IFA_OBJECTS", "", 1);
  EXPECT_EQ(objectsFolder(), std::filesystem::path(IFA_SOURCE_DIR) / "objects");
  ::unsetenv("IFA_OBJECTS");
}

TEST(ProgramVersion, HasThreeNumbers) {
  EXPECT_TRUE(std::regex_match(std::string(programVersion()), std::regex(R"(\d+\.\d+\.\d+)")));
}

}  // namespace
}  // namespace ifa
