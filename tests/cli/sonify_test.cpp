// SPDX-License-Identifier: Apache-2.0
// `ifa sonify`: a sound for a motion.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "run_program.h"
#include "sound/envelope.h"
#include "sound/sound.h"
#include "support/motion_folder.h"
#include "support/temporary_folder.h"

namespace ifa::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class Sonify : public testing::Test {
 protected:
  void SetUp() override { writeMotionFolder(folder_ / "one", makeDieMotion()); }
  ProgramResult sonify(const std::vector<std::string>& more) const {
    std::vector<std::string> words = {"sonify", folder_ / "one"};
    words.insert(words.end(), more.begin(), more.end());
    return runProgram(words);
  }
  TemporaryFolder folder_;
};

TEST_F(Sonify, TheFirstContactLiesWhereTheMotionSays) {
  const auto result = sonify({"-o", folder_ / "a.wav"});
  ASSERT_EQ(result.exit, 0) << result.err;
  EXPECT_THAT(linesOf(result.out), ElementsAre((folder_ / "a.wav").string()));
  const auto sound = readSound(folder_ / "a.wav");
  ASSERT_TRUE(sound) << sound.error().text();
  EXPECT_EQ(sound->rate, 48000);
  EXPECT_EQ(sound->format, SampleFormat::kPcm16);
  const Motion motion = makeDieMotion();
  const double first = motion.sound.firstContact;
  EXPECT_GE(sound->duration(), motion.sound.duration);
  EXPECT_LT(peakAmplitude(*sound, 0, first - 1e-3), 1e-4);
  EXPECT_GT(peakAmplitude(*sound, first, first + 0.01), 0.05);
}

TEST_F(Sonify, OptionsChangeTheSoundAndTheSameOnesDoNot) {
  ASSERT_EQ(sonify({"-o", folder_ / "a.wav"}).exit, 0);
  ASSERT_EQ(sonify({"-o", folder_ / "b.wav"}).exit, 0);
  EXPECT_EQ(readText(folder_ / "a.wav"), readText(folder_ / "b.wav"));
  for (const std::vector<std::string>& option :
       {std::vector<std::string>{"--material", "steel"}, {"--seed", "2"}, {"--reverb", "0.2"}}) {
    auto words = option;
    words.insert(words.end(), {"-o", folder_ / "b.wav"});
    ASSERT_EQ(sonify(words).exit, 0) << option.front();
    EXPECT_NE(readText(folder_ / "a.wav"), readText(folder_ / "b.wav")) << option.front();
  }
}

TEST_F(Sonify, DoesNotOverwriteTheRecording) {
  const auto before = readText(folder_ / "one/sound.wav");
  const auto result = sonify({"-o", folder_ / "one/sound.wav"});
  EXPECT_EQ(result.exit, 2);
  EXPECT_THAT(result.err, HasSubstr("overwritten"));
  EXPECT_EQ(readText(folder_ / "one/sound.wav"), before);
}

TEST_F(Sonify, CallsThatMakeNoSenseAreRefused) {
  EXPECT_EQ(runProgram({"sonify"}).exit, 2);
  EXPECT_EQ(sonify({}).exit, 2);
  EXPECT_EQ(sonify({"-o", folder_ / "a.wav", "--material", "cheese"}).exit, 2);
  EXPECT_EQ(sonify({"-o", folder_ / "a.wav", "--reverb", "-1"}).exit, 2);
  EXPECT_EQ(sonify({"-o", folder_ / "none/a.wav"}).exit, 3);
  const auto missing = runProgram({"sonify", folder_ / "two", "-o", folder_ / "a.wav"});
  EXPECT_EQ(missing.exit, 3);
  EXPECT_THAT(linesOf(missing.err), testing::SizeIs(1));
  EXPECT_THAT(namesBeside(folder_.path(), "one"), IsEmpty());
}

}  // namespace
}  // namespace ifa::test
