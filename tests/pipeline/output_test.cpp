// SPDX-License-Identifier: Apache-2.0
#include "pipeline/output.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>

#include "body/object_file.h"
#include "support/temporary_folder.h"

namespace ifa {
namespace {

using testing::Contains;
using testing::Not;

Heard heardAt(double firstContact) {
  Heard heard;
  heard.sound = Sound{};
  heard.sound->rate = 1000;
  heard.sound->samples.assign(2000, 0.25F);
  heard.signature.events.resize(1);
  heard.signature.firstContact = firstContact;
  return heard;
}

Motion motionFrom(double begin) {
  Motion motion;
  motion.trajectory.resize(2);
  motion.trajectory[0].time = begin;
  motion.trajectory[1].time = 0;
  return motion;
}

TEST(PlaceInSound, AddsTheSilenceThatTheMotionNeeds) {
  Motion motion = motionFrom(-0.5);
  placeInSound(motion, heardAt(0.2));
  EXPECT_EQ(motion.sound.file, "sound.wav");
  EXPECT_NEAR(motion.sound.firstContact, 0.5, 1e-12);
  EXPECT_NEAR(motion.sound.duration, 2.3, 1e-12);
}

TEST(PlaceInSound, RoundsSilenceUpToWholeSamples) {
  Motion motion = motionFrom(-0.5004);
  placeInSound(motion, heardAt(0.2));
  EXPECT_NEAR(motion.sound.firstContact, 0.501, 1e-12);
  EXPECT_NEAR(motion.sound.duration, 2.301, 1e-12);
}

TEST(PlaceInSound, LeavesASoundAloneThatBeginsEarlyEnough) {
  Motion motion = motionFrom(-0.5);
  placeInSound(motion, heardAt(0.7));
  EXPECT_EQ(motion.sound.firstContact, 0.7);
  EXPECT_EQ(motion.sound.duration, 2.0);
}

TEST(PlaceInSound, StartsAtTheMotionWhereThereIsNoSound) {
  Heard heard = heardAt(0);
  heard.sound.reset();
  Motion motion = motionFrom(-0.4);
  placeInSound(motion, heard);
  EXPECT_TRUE(motion.sound.file.empty());
  EXPECT_EQ(motion.sound.firstContact, 0.4);
}

TEST(WriteTakes, ASearchThatFoundNothingStillSaysWhy) {
  const test::TemporaryFolder folder;
  const Body body = loadObject("d6").value();
  Motion motion;
  motion.object = {"d6", "d6.obj", "desk", body.mass, 0.5, 0.3};
  motion.failure = "contact 1 cannot be met";
  const Heard heard = heardAt(0.2);
  placeInSound(motion, heard);
  const auto written = writeTakes(folder.path(), {motion}, false, body, heard,
                                  {{OutputFormat::kGlb}, {}, false}, {});
  ASSERT_TRUE(written) << written.error().text();
  EXPECT_THAT(folder.names(), Contains("motion.json"));
  EXPECT_THAT(folder.names(), Not(Contains("motion.glb")));
  EXPECT_THAT(test::readText(folder / "motion.json"), testing::HasSubstr(motion.failure));
}

TEST(WriteTakes, NumbersThemEvenWhenThereIsOnlyOne) {
  const test::TemporaryFolder folder;
  const Body body = loadObject("d6").value();
  Motion motion;
  motion.object = {"d6", "d6.obj", "desk", body.mass, 0.5, 0.3};
  const Heard heard = heardAt(0.2);
  placeInSound(motion, heard);
  ASSERT_TRUE(writeTakes(folder.path(), {motion}, true, body, heard, {{}, {}, false}, {}));
  EXPECT_THAT(folder.names(), Contains("take-1/motion.json"));
  EXPECT_THAT(folder.names(), Not(Contains("motion.json")));
}

class WriteFilmOfTake : public testing::Test {
 protected:
  WriteFilmOfTake() {
    motion_ = motionFrom(-0.5);
    motion_.object = {"d6", "d6.obj", "desk", body_.mass, 0.5, 0.3};
    for (MotionSample& sample : motion_.trajectory) sample.position.z() = 0.008;
    placeInSound(motion_, heard_);
    output_.formats = {OutputFormat::kMp4};
    output_.film.width = output_.film.height = 64;
    output_.film.framesPerSecond = 10;
  }

  const test::TemporaryFolder folder_;
  const Body body_ = loadObject("d6").value();
  const Heard heard_ = heardAt(0.2);
  Motion motion_;
  OutputSettings output_;
};

TEST_F(WriteFilmOfTake, LiesBesideTheMotionAndInTheManifest) {
  if (!filmsCanBeWritten()) GTEST_SKIP() << "built without libav";
  const auto told = writeTakes(folder_.path(), {motion_}, false, body_, heard_, output_, {});
  ASSERT_TRUE(told) << told.error().text();
  EXPECT_THAT(*told, testing::IsEmpty());
  EXPECT_THAT(folder_.names(), Contains("motion.mp4"));
  EXPECT_THAT(test::readText(folder_ / "manifest.json"), testing::HasSubstr("\"film\""));
}

TEST_F(WriteFilmOfTake, IsLeftOutWhenInterruptedAndTheRestIsKept) {
  if (!filmsCanBeWritten()) GTEST_SKIP() << "built without libav";
  const std::atomic<bool> stop{true};
  Progress progress;
  progress.stop = &stop;
  ASSERT_TRUE(writeTakes(folder_.path(), {motion_}, false, body_, heard_, output_, progress));
  EXPECT_THAT(folder_.names(), Contains("motion.json"));
  EXPECT_THAT(folder_.names(), Not(Contains("motion.mp4")));
}

TEST_F(WriteFilmOfTake, OptionsOutOfRangeAreToldBeforeTheSearch) {
  output_.film.framesPerSecond = 0;
  const auto checked = checkOutput(output_);
  ASSERT_FALSE(checked);
  EXPECT_EQ(checked.error().code, ErrorCode::kUsage);
}

TEST(RefuseToOverwrite, LooksAtFilesAndNotAtNames) {
  const test::TemporaryFolder folder;
  std::filesystem::create_directory(folder / "out");
  test::writeText(folder / "out/sound.wav", "x");
  test::writeText(folder / "out/other.wav", "x");
  test::writeText(folder / "sound.wav", "x");
  const auto refuse = [&](const std::string& input) {
    return !refuseToOverwrite(folder / "out", {folder / input}, ObjectDefinition{}).has_value();
  };
  EXPECT_TRUE(refuse("out/sound.wav"));
  EXPECT_TRUE(refuse("out/../out/./sound.wav"));
  EXPECT_FALSE(refuse("out/other.wav"));
  EXPECT_FALSE(refuse("sound.wav"));
}

}  // namespace
}  // namespace ifa
