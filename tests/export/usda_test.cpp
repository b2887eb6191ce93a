// SPDX-License-Identifier: Apache-2.0
#include "export/usda.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "audit/analytic_motion.h"
#include "base/file.h"
#include "model/pose_track.h"
#include "support/temporary_folder.h"

namespace ifa {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr double kCodes = 24;

/// What follows `name.timeSamples = {`: code and numbers of each sample.
std::vector<std::pair<double, std::vector<double>>> readSamples(const std::string& text,
                                                                const std::string& name) {
  std::vector<std::pair<double, std::vector<double>>> samples;
  std::istringstream lines(text.substr(text.find(name + ".timeSamples = {")));
  std::string line;
  std::getline(lines, line);
  while (std::getline(lines, line) && line.find('}') == std::string::npos) {
    for (char& c : line) {
      if (c == ':' || c == '(' || c == ')' || c == ',') c = ' ';
    }
    std::istringstream fields(line);
    double code = 0;
    fields >> code;
    std::vector<double> values;
    for (double value = 0; fields >> value;) values.push_back(value);
    samples.emplace_back(code, values);
  }
  return samples;
}

class Usda : public testing::Test {
 protected:
  Usda() {
    motion_.sound = {"sound.wav", 48000, 2.5, 0.5};
    text_ = formatUsda(motion_, body_).value();
  }
  Body body_ = [] {
    Body body = test::makeDrawableBox();
    body.definition.name = "3 sided \"die\"";
    return body;
  }();
  Motion motion_ = test::makeTumblingMotion(body_);
  std::string text_;
};

TEST_F(Usda, SaysItsUnitsAndClock) {
  EXPECT_EQ(text_.rfind("#usda 1.0\n(", 0), 0U);
  for (const char* field : {"metersPerUnit = 1\n", "upAxis = \"Z\"\n", "timeCodesPerSecond = 24\n",
                            "defaultPrim = \"motion\"\n", "startTimeCode = 0\n"}) {
    EXPECT_THAT(text_, HasSubstr(field));
  }
  EXPECT_THAT(text_, HasSubstr("def Xform \"_3_sided__die_\""));
}

TEST_F(Usda, ClosesWhatItOpens) {
  int depth = 0;
  for (const char c : text_) {
    depth += c == '{' ? 1 : c == '}' ? -1 : 0;
    ASSERT_GE(depth, 0);
  }
  EXPECT_EQ(depth, 0);
}

TEST_F(Usda, MovesAsTheMotionDoes) {
  const auto places = readSamples(text_, "xformOp:translate");
  const auto turns = readSamples(text_, "xformOp:orient");
  ASSERT_GT(places.size(), 20U);
  ASSERT_EQ(turns.size(), places.size());
  EXPECT_EQ(places.front().first, 0);
  const PoseTrack track(motion_);
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (i > 0) {
      EXPECT_GT(places[i].first, places[i - 1].first);
    }
    ASSERT_EQ(places[i].second.size(), 3U);
    ASSERT_EQ(turns[i].second.size(), 4U);
    const Pose pose = track.at(places[i].first / kCodes - motion_.sound.firstContact);
    const auto& p = places[i].second;
    const auto& q = turns[i].second;
    EXPECT_LT((Eigen::Vector3d(p[0], p[1], p[2]) - pose.position).norm(), 1e-5);
    const Eigen::Quaterniond turn(q[0], q[1], q[2], q[3]);
    EXPECT_NEAR(turn.norm(), 1, 1e-6);
    EXPECT_LT(turn.normalized().angularDistance(pose.orientation), 1e-4);
  }
}

TEST_F(Usda, HasASampleAtEveryContact) {
  const auto places = readSamples(text_, "xformOp:translate");
  for (const MotionContact& contact : motion_.contacts) {
    const double code = (contact.time + motion_.sound.firstContact) * kCodes;
    EXPECT_TRUE(std::any_of(places.begin(), places.end(), [&](const auto& sample) {
      return std::abs(sample.first - code) < 1e-4;
    })) << contact.time;
  }
}

TEST_F(Usda, GivesEveryMaterialAMeshOfItsOwn) {
  EXPECT_THAT(text_, HasSubstr("def Mesh \"red\""));
  EXPECT_THAT(text_, HasSubstr("def Mesh \"glass\""));
  EXPECT_THAT(text_, HasSubstr("rel material:binding = </motion/_3_sided__die_/materials/glass>"));
  EXPECT_THAT(text_, HasSubstr("float inputs:opacity = 0.5"));
  // Five sides of two triangles, and one.
  EXPECT_THAT(text_, HasSubstr("faceVertexCounts = [3, 3, 3, 3, 3, 3, 3, 3, 3, 3]\n"));
  EXPECT_THAT(text_, HasSubstr("faceVertexCounts = [3, 3]\n"));
}

TEST_F(Usda, IsPlainEnoughForOtherReaders) {
  EXPECT_THAT(text_, HasSubstr("] (\n                interpolation = \"vertex\"\n            )\n"));
  EXPECT_THAT(text_, Not(HasSubstr("timecode ")));
}

TEST_F(Usda, PlaysTheSoundWhereThereIsOne) {
  EXPECT_THAT(text_, HasSubstr("def SpatialAudio \"sound\""));
  EXPECT_THAT(text_, HasSubstr("filePath = @./sound.wav@"));
  EXPECT_THAT(text_, HasSubstr("auralMode = \"nonSpatial\""));
  EXPECT_THAT(text_, HasSubstr("playbackMode = \"onceFromStart\""));
  motion_.sound.file.clear();
  EXPECT_THAT(formatUsda(motion_, body_).value(), Not(HasSubstr("SpatialAudio")));
}

TEST_F(Usda, KeepsNamesApart) {
  body_.definition.name = "sound";
  body_.mesh.materials[1].name = "red";
  const std::string text = formatUsda(motion_, body_).value();
  EXPECT_THAT(text, HasSubstr("def Xform \"sound_\""));
  EXPECT_THAT(text, HasSubstr("def Material \"red_2\""));
}

TEST_F(Usda, RefusesWhatCannotBeShown) {
  motion_.trajectory.clear();
  EXPECT_FALSE(formatUsda(motion_, body_));
  body_.mesh.triangles.clear();
  EXPECT_FALSE(formatUsda(test::makeTumblingMotion(body_), body_));
}

TEST_F(Usda, IsWrittenWholeOrNotAtAll) {
  const test::TemporaryFolder folder;
  ASSERT_TRUE(writeUsda(folder / "motion.usda", motion_, body_));
  EXPECT_EQ(readFile(folder / "motion.usda", 1 << 26).value(), text_);
  EXPECT_FALSE(writeUsda(folder / "gone" / "motion.usda", motion_, body_));
}

}  // namespace
}  // namespace ifa
