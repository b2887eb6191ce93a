// SPDX-License-Identifier: Apache-2.0
#include "sonify/sonify.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "model/rigid_state.h"
#include "sonify/contact_force.h"
#include "sonify/room.h"
#include "sound/envelope.h"
#include "support/box_body.h"

namespace ifa {
namespace {

SonifySettings settingsFor(const char* material) {
  SonifySettings settings;
  settings.material = findSoundMaterial(material).value();
  settings.floor = soundFloor("desk");
  return settings;
}

Strike strikeAt(double time, double impulse) {
  return {time, 0, impulse, Eigen::Vector3d::UnitZ(), {0.008, 0.008, -0.008}};
}

double decibels(double ratio) { return 20 * std::log10(ratio); }

MotionSample sampleAt(double time, double speed) {
  MotionSample sample;
  sample.time = time;
  sample.velocity = {0, 0, speed};
  return sample;
}

TEST(Strikes, AreWhereVelocityJumpsAndNotInFlightNorAtRest) {
  const Body die = makeDieBody();
  Motion motion;
  const double fall = kGravity / 240;
  const double falling = 0.5 - kGravity * 1e-3;
  motion.trajectory = {sampleAt(-1.0 / 240, -1 + fall),
                       sampleAt(0, -1),
                       sampleAt(0, 0.5),
                       sampleAt(0.001, falling),
                       sampleAt(0.002, falling),  // the floor carries the weight
                       sampleAt(0.1, -0.2),       // after a flight
                       sampleAt(0.101, 0),
                       sampleAt(0.102, 0)};
  const auto strikes = strikesOf(motion, die);
  ASSERT_EQ(strikes.size(), 2U);
  EXPECT_NEAR(strikes[0].impulse, 1.5 * die.mass, 1e-9);
  EXPECT_EQ(strikes[0].time, 0);
  EXPECT_NEAR(strikes[0].point.z(), -0.008, 1e-12);
  EXPECT_NEAR(strikes[0].direction.z(), 1, 1e-12);
  // From -0.2 m/s to rest, and what a bin may carry quietly taken off.
  EXPECT_NEAR(strikes[1].impulse, die.mass * (0.2 + kGravity * 1e-3 - 2 * kGravity * 1e-3), 1e-9);
  EXPECT_EQ(strikes[1].time, 0.1);
  EXPECT_NEAR(strikes[1].duration, 1e-3, 1e-12);
}

TEST(Strikes, OfADropSeePrincipalAxes) {
  Body die = makeDieBody();
  die.bodyFromPrincipal << 0, 0, 1, 1, 0, 0, 0, 1, 0;
  ContactStep step;
  step.time = 0.3;
  step.impulse = {0, 0, 0.004};
  const auto strikes = strikesOf(std::vector<ContactStep>{step}, die);
  ASSERT_EQ(strikes.size(), 1U);
  EXPECT_NEAR(strikes[0].impulse, 0.004, 1e-12);
  // Up is the principal z axis, which is the body's x axis.
  EXPECT_NEAR(strikes[0].direction.x(), 1, 1e-12);
  EXPECT_NEAR(strikes[0].point.x(), -0.008, 1e-12);
}

TEST(ContactForce, CarriesTheImpulseWhereverItFallsBetweenSamples) {
  for (const double start : {0.01, 0.010007, 0.0100201}) {
    const ForcePulse pulse = forcePulse(0.005, start, 3e-4, kSonifyRate);
    const double sum = std::accumulate(pulse.force.begin(), pulse.force.end(), 0.0);
    EXPECT_NEAR(sum / kSonifyRate, 0.005, 1e-12);
    EXPECT_NEAR(static_cast<double>(pulse.first) / kSonifyRate, start, 1.0 / kSonifyRate);
  }
}

TEST(ContactForce, LastsAsHertzSays) {
  const Body die = makeDieBody();
  const auto steel = findSoundMaterial("steel").value(),
             rubber = findSoundMaterial("rubber").value();
  const auto floor = soundFloor("stone").material;
  const double hard = contactTime(die, strikeAt(0, 0.005), steel, floor);
  EXPECT_GT(contactTime(die, strikeAt(0, 0.005), rubber, floor), 5 * hard);
  EXPECT_NEAR(contactTime(die, strikeAt(0, 0.16), steel, floor) / hard, 0.5, 1e-6);
  EXPECT_GT(hard, 1e-5);
  EXPECT_LT(hard, 3e-4);
}

TEST(Sonify, ADieOnADeskSoundsShortAndAtItsTime) {
  const Body die = makeDieBody();
  auto settings = settingsFor("acrylic");
  settings.lead = 0.1;
  const Sound sound = sonify(die, {strikeAt(0, 0.008)}, settings);
  EXPECT_EQ(sound.rate, kSonifyRate);
  EXPECT_NEAR(sound.duration(), 0.1 + kSonifyTail, 1e-3);
  EXPECT_EQ(peakAmplitude(sound, 0, 0.0999), 0);
  EXPECT_NEAR(peakAmplitude(sound, 0.1, 0.103), kSonifyPeak, 1e-3);
  // Recordings of dice on a table fall by 20 dB in 10 to 40 ms.
  const double early = decibels(peakAmplitude(sound, 0.110, 0.115) / kSonifyPeak);
  const double late = decibels(peakAmplitude(sound, 0.140, 0.145) / kSonifyPeak);
  EXPECT_LT(early, -8);
  EXPECT_GT(early, -30);
  EXPECT_LT(late, -25);
}

TEST(Sonify, ASteelBarRingsLongerThanAWoodenOne) {
  const Body bar = makeBoxBody({0.15, 0.012, 0.012}, 0.17);
  const std::vector<Strike> strikes = {
      {0, 0, 0.1, Eigen::Vector3d::UnitZ(), {0.07, 0.006, -0.006}}};
  const Sound steel = sonify(bar, strikes, settingsFor("steel"));
  const Sound wood = sonify(bar, strikes, settingsFor("wood"));
  EXPECT_GT(peakAmplitude(steel, 0.2, 0.25), 10 * peakAmplitude(wood, 0.2, 0.25));
}

TEST(Sonify, ATenthOfTheImpulseIsTwentyDecibelsSofter) {
  const Body die = makeDieBody();
  const Sound sound =
      sonify(die, {strikeAt(0.1, 0.01), strikeAt(0.5, 0.001)}, settingsFor("acrylic"));
  // A slower blow lasts longer and is duller, so it loses a little more.
  const double fall = decibels(peakAmplitude(sound, 0.5, 0.55) / peakAmplitude(sound, 0.1, 0.15));
  EXPECT_LT(fall, -19);
  EXPECT_GT(fall, -28);
}

TEST(Sonify, TheSeedIsAllThatChanceHangsOn) {
  const Body die = makeDieBody();
  auto settings = settingsFor("acrylic");
  settings.reverberation = 0.1;
  std::vector<Strike> strikes = {strikeAt(0, 0.008), strikeAt(0.05, 0.003)};
  strikes[1].duration = 1e-3;
  const auto first = sonify(die, strikes, settings).samples;
  EXPECT_EQ(sonify(die, strikes, settings).samples, first);
  settings.seed = 2;
  EXPECT_NE(sonify(die, strikes, settings).samples, first);
}

TEST(Sonify, WithoutAStrikeIsSilence) {
  auto settings = settingsFor("acrylic");
  settings.duration = 0.2;
  const Sound sound = sonify(makeDieBody(), {strikeAt(-1, 0.01)}, settings);
  EXPECT_NEAR(sound.duration(), 0.2, 1e-3);
  EXPECT_EQ(peakAmplitude(sound, 0, 1), 0);
}

TEST(Room, TheTailFallsBySixtyDecibels) {
  Sound sound;
  sound.rate = 48000;
  sound.samples.assign(4800, 0.0F);
  sound.samples[0] = 1;
  addReverberation(sound, 0.4, 1);
  const auto energy = [&](double from, double to) {
    double sum = 0;
    for (double t = from * 48000; t < to * 48000; ++t) {
      const auto sample = static_cast<double>(sound.samples[static_cast<std::size_t>(t)]);
      sum += sample * sample;
    }
    return sum;
  };
  EXPECT_EQ(energy(3e-5, 0.0019), 0);
  EXPECT_NEAR(10 * std::log10(energy(0.30, 0.36) / energy(0.01, 0.07)), -43.5, 2);
}

TEST(Room, NoiseHasThePowerAskedFor) {
  Sound sound;
  sound.rate = 48000;
  sound.samples.assign(96000, 0.0F);
  for (std::size_t i = 24000; i < 72000; ++i) sound.samples[i] = i % 2 == 0 ? 0.5F : -0.5F;
  addNoise(sound, 20, 1);
  double power = 0;
  for (std::size_t i = 0; i < 24000; ++i) {
    power += static_cast<double>(sound.samples[i]) * static_cast<double>(sound.samples[i]) / 24000;
  }
  EXPECT_NEAR(10 * std::log10(power / 0.25), -20, 0.2);
}

TEST(SoundMaterials, AreFoundInAnyCaseAndOthersAreRefused) {
  EXPECT_EQ(findSoundMaterial("STEEL").value().name, "steel");
  const auto none = findSoundMaterial("cheese");
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().code, ErrorCode::kUsage);
  EXPECT_THAT(none.error().remedy, testing::HasSubstr("acrylic"));
  EXPECT_EQ(soundFloor("marsh").name, "desk");
}

}  // namespace
}  // namespace ifa
