// SPDX-License-Identifier: Apache-2.0
#include "signature/signature.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <functional>

#include "sound/synthetic_sound.h"

namespace ifa {
namespace {

Label label(double start, double end, const std::string& text = "") {
  Label made;
  made.start = start;
  made.end = end;
  made.text = text;
  return made;
}
Label point(double time) { return label(time, time); }

/// A sound of alternating sign whose envelope is `shape` of the time in s.
Sound shaped(double seconds, const std::function<double(double)>& shape) {
  Sound sound = test::silence(seconds, 48000);
  for (std::size_t i = 0; i < sound.samples.size(); ++i) {
    const double value = shape(static_cast<double>(i) / sound.rate);
    sound.samples[i] = static_cast<float>(i % 2 == 0 ? value : -value);
  }
  return sound;
}

TEST(SignatureFromLabels, TimesCountFromTheFirstContact) {
  const auto sound = shaped(2, [](double) { return 0.5; });
  const auto signature = signatureFromLabels(sound, {point(0.5), label(0.75, 1.0), point(1.5)});
  ASSERT_TRUE(signature);
  EXPECT_EQ(signature->firstContact, 0.5);
  ASSERT_EQ(signature->events.size(), 3U);
  EXPECT_EQ(signature->events[0].time, 0);
  EXPECT_NEAR(signature->events[1].time, 0.25, 1e-12);
  EXPECT_NEAR(signature->events[1].duration, 0.25, 1e-12);
  EXPECT_NEAR(signature->events[2].time, 1.0, 1e-12);
  EXPECT_EQ(signature->events[2].duration, 0);
}

TEST(SignatureFromLabels, ADiscreteAmplitudeIsThePeakOfTwentyMilliseconds) {
  Sound sound = test::silence(1, 10000);
  const auto set = [&](double time, float value) {
    sound.samples[static_cast<std::size_t>(std::lround(time * sound.rate))] = value;
  };
  set(0.1150, 0.4F);  // the first contact's peak, 15 ms on
  set(0.1250, 0.9F);  // too late to be its
  set(0.3000, -0.1F);
  set(0.3130, 0.2F);  // 13 ms after the second, but already the third's
  set(0.3215, 0.05F);
  const auto signature =
      signatureFromLabels(sound, {point(0.1), point(0.3), point(0.312), point(0.9)});
  ASSERT_TRUE(signature);
  EXPECT_NEAR(signature->events[0].amplitude, 1, 1e-12);
  EXPECT_NEAR(signature->events[1].amplitude, 0.1 / 0.4, 1e-6);
  EXPECT_NEAR(signature->events[2].amplitude, 0.2 / 0.4, 1e-6);
  EXPECT_EQ(signature->events[3].amplitude, 0);
}

TEST(SignatureFromLabels, CentroidsOfKnownShapes) {
  // A constant envelope has its centroid in the middle, a linear rise at two thirds, a linear fall
  // at one third, exp(-t/a) over D at a - D / (exp(D/a) - 1).
  const double length = 0.2, a = 0.05;
  const std::vector<std::pair<std::function<double(double)>, double>> cases{
      {[](double) { return 0.3; }, length / 2},
      {[&](double t) { return 0.9 * t / length; }, 2 * length / 3},
      {[&](double t) { return 0.9 * (1 - t / length); }, length / 3},
      {[&](double t) { return 0.9 * std::exp(-t / a); }, a - length / (std::exp(length / a) - 1)}};
  for (const auto& [shape, centroid] : cases) {
    const auto sound = shaped(1, [&, &curve = shape](double t) {
      return t < 0.2 ? 0.6 : (t >= 0.3 && t < 0.3 + length ? curve(t - 0.3) : 0.0);
    });
    const auto signature = signatureFromLabels(sound, {point(0.1), label(0.3, 0.3 + length)});
    ASSERT_TRUE(signature);
    EXPECT_NEAR(signature->events[1].centroid, centroid, 0.0006);
    EXPECT_EQ(signature->events[0].centroid, 0);
  }
}

TEST(SignatureFromLabels, AContinuousAmplitudeIsTheEnvelopesMaximum) {
  const auto sound = shaped(1, [](double t) { return t < 0.3 ? 0.5 : (t < 0.45 ? 0.1 : 0.25); });
  const auto signature = signatureFromLabels(sound, {label(0.1, 0.2), label(0.31, 0.6)});
  ASSERT_TRUE(signature);
  EXPECT_NEAR(signature->events[0].amplitude, 1, 1e-12);
  EXPECT_NEAR(signature->events[1].amplitude, 0.5, 1e-6);
}

TEST(SignatureFromLabels, MergesLikeMotions) {
  const auto sound = shaped(1, [](double) { return 0.5; });
  // 6 ms apart: one discrete event. 8 ms apart three times: 16 ms long, hence continuous.
  const std::vector<Label> labels{point(0.1),   point(0.106), point(0.3),
                                  point(0.308), point(0.316), label(0.5, 0.505)};
  const auto signature = signatureFromLabels(sound, labels);
  ASSERT_TRUE(signature);
  ASSERT_EQ(signature->events.size(), 3U);
  EXPECT_EQ(signature->events[0].duration, 0);
  EXPECT_NEAR(signature->events[1].time, 0.2, 1e-12);
  EXPECT_NEAR(signature->events[1].duration, 0.016, 1e-12);
  EXPECT_EQ(signature->events[2].duration, 0);
  SignatureSettings garlic;
  garlic.mergeGap = 0.030;
  EXPECT_EQ(
      signatureFromLabels(sound, {point(0.1), point(0.125), point(0.2)}, garlic)->events.size(),
      2U);
}

TEST(SignatureFromLabels, TerminalFlag) {
  const auto sound = shaped(1, [](double) { return 0.5; });
  const std::vector<Label> open{point(0.1), label(0.3, 0.3, "c2 non-terminal")};
  EXPECT_TRUE(signatureFromLabels(sound, {point(0.1)})->terminal);
  EXPECT_FALSE(signatureFromLabels(sound, open)->terminal);
  SignatureSettings settings;
  settings.terminal = false;
  EXPECT_FALSE(signatureFromLabels(sound, {point(0.1)}, settings)->terminal);
  settings.terminal = true;
  EXPECT_TRUE(signatureFromLabels(sound, open, settings)->terminal);
}

TEST(SignatureFromLabels, RefusesWhatCannotBe) {
  const auto sound = shaped(1, [](double t) { return t < 0.5 ? 0.0 : 0.5; });
  EXPECT_FALSE(signatureFromLabels(sound, {}));
  EXPECT_FALSE(signatureFromLabels(sound, {point(2)}));
  const auto silent = signatureFromLabels(sound, {point(0.1), point(0.6)}, {}, "a.txt");
  ASSERT_FALSE(silent);
  EXPECT_THAT(silent.error().text(), testing::HasSubstr("a.txt: the sound is silent at the first"));
}

TEST(MergeLabels, KeepsWhatTheLastOneSaysOfTheEnd) {
  const auto merged = mergeLabels({label(1, 1, "c1"), label(1.005, 1.2, "c2 terminal")}, 0.010);
  ASSERT_EQ(merged.size(), 1U);
  EXPECT_EQ(merged[0].start, 1);
  EXPECT_EQ(merged[0].end, 1.2);
  EXPECT_EQ(merged[0].text, "c2 terminal");
}

TEST(MergeLabels, AnEventMayBeginWithoutAMarkInDoubt) {
  auto labels =
      std::vector{label(0.2, 0.2, "c1"), label(0.5, 0.5, "c2"), label(0.506, 0.506, "c3")};
  EXPECT_TRUE(mergeLabels(labels, 0.010)[1].alternatives.empty());
  labels[1].weight = 0.5;
  const auto merged = mergeLabels(labels, 0.010);
  ASSERT_EQ(merged[1].alternatives.size(), 1U);
  EXPECT_DOUBLE_EQ(merged[1].alternatives[0].time, 0.506);
  EXPECT_DOUBLE_EQ(merged[1].alternatives[0].cost, 3);
  EXPECT_EQ(merged[1].weight, 1);  // one of the two is sure
}

TEST(MergeLabels, AsManyAlternativesAsASignatureHolds) {
  std::vector labels = {label(0.1, 0.1, "c1")};
  for (int i = 0; i < 40; ++i) {
    const double start = 0.5 + 0.008 * i;
    labels.push_back(label(start, start, "c"));
    labels.back().weight = 0.5;
  }
  const auto signature = signatureWithoutSound(labels, {}, "a.txt");
  ASSERT_TRUE(signature);
  ASSERT_EQ(signature->events.size(), 2U);
  EXPECT_EQ(signature->events[1].alternatives.size(), kMaxAlternatives);
  EXPECT_NEAR(signature->events[1].alternatives.back().time, 0.4 + 0.008 * 16, 1e-12);
}

TEST(LabelsFromContacts, DoubtIsAWeight) {
  std::vector<DetectedContact> contacts(2);
  contacts[0].confidence = 0.95;
  contacts[1].start = contacts[1].end = 0.3;
  contacts[1].confidence = 0.7134;
  const auto labels = labelsFromContacts(contacts);
  EXPECT_EQ(labels[0].weight, 1);
  EXPECT_EQ(labels[1].weight, 0.71);
}

TEST(MergeLabels, LeavesGapsOfAtLeastTheGiven) {
  EXPECT_TRUE(rc::check(
      "gaps at least delta t, lengths 0 or at least delta t, and a second time no change", [] {
        const auto steps =
            *rc::gen::container<std::vector<int>>(rc::gen::inRange(0, 60));  // half milliseconds
        std::vector<Label> labels;
        double time = 0;
        for (std::size_t i = 0; i + 1 < steps.size(); i += 2) {
          labels.push_back(label(time, time + steps[i] % 20 * 0.0005));
          time = labels.back().end + steps[i + 1] * 0.0005;
        }
        const double gap = 0.010;
        const auto merged = mergeLabels(labels, gap);
        for (std::size_t i = 0; i < merged.size(); ++i) {
          const double length = merged[i].end - merged[i].start;
          RC_ASSERT(length == 0 || length >= gap - 1e-6);
          // A point may stand for something short, so its gap counts from where that ended.
          if (i > 0) RC_ASSERT(merged[i].start - merged[i - 1].end >= gap - 1e-6);
        }
        RC_ASSERT(merged.empty() == labels.empty());
        const auto again = mergeLabels(merged, gap);
        RC_ASSERT(again.size() == merged.size());
      }));
}

TEST(LabelsFromContacts, CountedAndWithAnEnding) {
  const std::vector<DetectedContact> contacts{{0.1, 0.1, 0, 20}, {0.3, 0.4, -6, 10}};
  const auto labels = labelsFromContacts(contacts);
  ASSERT_EQ(labels.size(), 2U);
  EXPECT_EQ(labels[0].text, "c1");
  EXPECT_TRUE(labels[0].isPoint());
  EXPECT_EQ(labels[1].text, "c2 terminal");
  EXPECT_EQ(labels[1].end, 0.4);
  EXPECT_FALSE(labelsAreTerminal(labelsFromContacts(contacts, false)));
  EXPECT_TRUE(labelsFromContacts({}).empty());
}

}  // namespace
}  // namespace ifa
