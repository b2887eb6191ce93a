// SPDX-License-Identifier: Apache-2.0
// What the program says of itself, and of a call that makes no sense.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "run_program.h"

namespace ifa::test {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::MatchesRegex;
using testing::SizeIs;

TEST(Usage, VersionIsOneLineOnStdout) {
  const auto result = runProgram({"--version"});
  EXPECT_EQ(result.exit, 0);
  EXPECT_THAT(result.out, MatchesRegex("[0-9]+\\.[0-9]+\\.[0-9]+\n"));
  EXPECT_THAT(result.err, IsEmpty());
}

TEST(Usage, HelpNamesEveryCommand) {
  const auto result = runProgram({"--help"});
  EXPECT_EQ(result.exit, 0);
  for (const char* command : {"sync", "detect", "objects", "verify", "evaluate", "database"}) {
    EXPECT_THAT(result.out, HasSubstr(std::string("\n  ") + command)) << command;
    EXPECT_EQ(runProgram({command, "--help"}).exit, 0) << command;
  }
}

class BadCall : public testing::TestWithParam<std::vector<std::string>> {};

TEST_P(BadCall, ExitsWithTwoAndSaysWhy) {
  const auto result = runProgram(GetParam());
  EXPECT_EQ(result.exit, 2);
  EXPECT_THAT(result.out, IsEmpty());
  ASSERT_THAT(linesOf(result.err), SizeIs(1)) << result.err;
}

INSTANTIATE_TEST_SUITE_P(
    Cases, BadCall,
    testing::Values(
        std::vector<std::string>{}, std::vector<std::string>{"--nonsense"},
        std::vector<std::string>{"nonsense"}, std::vector<std::string>{"sync"},
        std::vector<std::string>{"sync", "a.wav", "--object", "d6"},
        std::vector<std::string>{"sync", "a.wav", "--object", "d6", "-o", "out", "--takes", "0"},
        std::vector<std::string>{"sync", "a.wav", "--object", "d6", "-o", "out", "--takes", "33"},
        std::vector<std::string>{"sync", "a.wav", "--object", "d6", "-o", "out", "--seed", "-1"},
        std::vector<std::string>{"sync", "a.wav", "--object", "d6", "-o", "out", "--seed", "x"},
        std::vector<std::string>{"sync", "a.wav", "--object", "d6", "-o", "out", "--pre-roll",
                                 "nan"},
        std::vector<std::string>{"sync", "a.wav", "--object", "d6", "-o", "out", "--energy-gain",
                                 "-1"},
        std::vector<std::string>{"sync", "a.wav", "--object", "d6", "-o", "out", "--formats",
                                 "json,fbx"},
        std::vector<std::string>{"sync", "a.wav", "--object", "d6", "-o", "out", "--planner",
                                 "chance"},
        std::vector<std::string>{"sync", "a.wav", "--object", "d6", "-o", "out", "--restitution",
                                 "0.96"},
        std::vector<std::string>{"sync", "a.wav", "--object", "d6", "-o", "out", "--fit",
                                 "--planner", "graph"},
        std::vector<std::string>{"evaluate", "a", "--restitution-scale", "0"},
        std::vector<std::string>{"sync", "a.wav", "--object", "d6", "-o", "out", "--early-exit",
                                 "2"},
        std::vector<std::string>{"sync", "a.wav", "--object", "d6", "-o", "out", "--simulations",
                                 "0"},
        std::vector<std::string>{"sync", "a.wav", "--object", "d6", "-o", "out", "--connection",
                                 "slerp"},
        std::vector<std::string>{"sync", "a.wav", "--object", "d6", "-o", "out", "--cut", "loud"},
        std::vector<std::string>{"database", "build", "d6", "-n", "5", "--cut", "loud"},
        std::vector<std::string>{"--threads", "0", "sync", "a.wav", "--object", "d6", "-o",
                                 "out"}));

TEST(Usage, SaysWhichPlannersThereAre) {
  const auto result =
      runProgram({"sync", "a.wav", "--object", "d6", "-o", "out", "--planner", "chance"});
  EXPECT_EQ(result.exit, 2);
  for (const char* planner : {"hybrid", "shoot", "graph"}) {
    EXPECT_THAT(result.err, HasSubstr(planner));
  }
}

TEST(Usage, FailureIsALineOfJsonWhereThatIsAskedFor) {
  const auto result = runProgram({"sync", "--json-progress"});
  EXPECT_EQ(result.exit, 2);
  const auto lines = linesOf(result.err);
  ASSERT_THAT(lines, SizeIs(1));
  const auto failure = nlohmann::json::parse(lines.front());
  EXPECT_EQ(failure.at("type"), "failure");
  EXPECT_EQ(failure.at("code"), 2);
  EXPECT_THAT(failure.at("message").get<std::string>(), testing::Not(IsEmpty()));
}

}  // namespace
}  // namespace ifa::test
