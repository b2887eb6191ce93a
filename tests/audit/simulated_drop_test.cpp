// SPDX-License-Identifier: Apache-2.0
// What the simulator does by itself holds the audit, and `ifa verify` says so.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "audit/audit.h"
#include "audit/drop_motion.h"
#include "body/object_file.h"
#include "export/motion_json.h"

namespace ifa {
namespace {

class SimulatedDrop : public testing::TestWithParam<const char*> {};

TEST_P(SimulatedDrop, HoldsTheAudit) {
  const auto body = loadObject(GetParam());
  ASSERT_TRUE(body.has_value()) << body.error().text();
  for (std::uint64_t i = 0; i < 40; ++i) {
    const AuditReport report = audit(test::makeDropMotion(*body, i), *body);
    EXPECT_TRUE(report.passed()) << "drop " << i << "\n" << formatAudit(report);
  }
}

TEST_P(SimulatedDrop, HoldsTheAuditByThePapersCut) {
  const Body body = loadObject(GetParam()).value();
  for (std::uint64_t i = 0; i < 20; ++i) {
    const AuditReport report = audit(test::makeDropMotion(body, i, EventCut::kPaper), body);
    EXPECT_TRUE(report.passed()) << "drop " << i << "\n" << formatAudit(report);
  }
}

/// What is too soft to hear is a contact by the paper's cut, and missed where it is not listed.
TEST_P(SimulatedDrop, ThePapersCutMissesASoftContact) {
  const Body body = loadObject(GetParam()).value();
  int missed = 0;
  for (std::uint64_t i = 0; i < 20; ++i) {
    Motion motion = test::makeDropMotion(body, i);
    if (motion.silent.empty()) continue;
    motion.cut = EventCut::kPaper;
    missed += audit(motion, body).find("unlisted contacts")->passed ? 0 : 1;
  }
  EXPECT_GT(missed, 0);
}

INSTANTIATE_TEST_SUITE_P(Objects, SimulatedDrop,
                         testing::Values("d4", "d6", "d8", "d10", "d12", "d20", "CoffeeCup", "Nut",
                                         "Lego2x2", "Eraser"),
                         [](const auto& object) { return std::string(object.param); });

/// A motion in a folder of its own, and the program let loose on it.
class VerifyCommand : public testing::Test {
 protected:
  VerifyCommand() : folder_(testing::TempDir() + "ifa_verify_" + std::to_string(::getpid())) {
    std::filesystem::create_directories(folder_);
    motion_ = test::makeDropMotion(loadObject("d6").value(), 0);
  }
  ~VerifyCommand() override { std::filesystem::remove_all(folder_); }

  int verify() {
    EXPECT_TRUE(writeMotionJson(folder_ / "motion.json", motion_).has_value());
    return run(folder_ / "motion.json");
  }
  int run(const std::filesystem::path& motion) {
    const std::filesystem::path log = folder_ / "log";
    const std::string command = std::string("'") + IFA_PROGRAM + "' verify '" + motion.string() +
                                "' > '" + log.string() + "' 2>&1";
    const int status = std::system(command.c_str());
    std::ifstream stream(log);
    output_.assign(std::istreambuf_iterator<char>(stream), {});
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  std::filesystem::path folder_;
  Motion motion_;
  std::string output_;
};

TEST_F(VerifyCommand, PassesAGoodMotion) {
  EXPECT_EQ(verify(), 0) << output_;
  EXPECT_THAT(output_, testing::HasSubstr("the audit holds"));
  EXPECT_EQ(run(folder_), 0) << output_;  // the folder stands for the motion in it
}

TEST_F(VerifyCommand, JudgesByTheMotionsCut) {
  motion_ = test::makeDropMotion(loadObject("d6").value(), 0, EventCut::kPaper);
  EXPECT_EQ(verify(), 0) << output_;
  motion_ = test::makeDropMotion(loadObject("d6").value(), 0);
  motion_.cut = EventCut::kPaper;
  EXPECT_EQ(verify(), 4);
  EXPECT_THAT(output_, testing::HasSubstr("unlisted contacts"));
}

TEST_F(VerifyCommand, FailsADamagedMotion) {
  motion_.trajectory[20].position.x() += 1e-3;
  EXPECT_EQ(verify(), 4);
  EXPECT_THAT(output_, testing::HasSubstr("FAIL  "));
}

TEST_F(VerifyCommand, FailsAMotionThatSaysItFailed) {
  motion_.success = false;
  motion_.failure = "contact 9 is out of reach";
  EXPECT_EQ(verify(), 4);
  EXPECT_THAT(output_, testing::HasSubstr("contact 9 is out of reach"));
}

TEST_F(VerifyCommand, RefusesWhatIsNoMotion) {
  std::ofstream(folder_ / "other.json") << "{}";
  EXPECT_EQ(run(folder_ / "other.json"), 3);
  EXPECT_THAT(output_, testing::HasSubstr("'format' is missing"));
  EXPECT_EQ(run(folder_ / "nothing.json"), 3);
  motion_.object.name = "../../d6";
  EXPECT_EQ(verify(), 3);
}

}  // namespace
}  // namespace ifa
