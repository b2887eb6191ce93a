// SPDX-License-Identifier: Apache-2.0
#include "render/timeline.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "audit/analytic_motion.h"
#include "render/svg_text.h"

namespace ifa {
namespace {

using testing::HasSubstr;
using testing::Not;

/// Clicks that decay, one per contact.
Sound clicks(const Motion& motion, double seconds) {
  Sound sound;
  sound.rate = 44100;
  sound.samples.resize(static_cast<std::size_t>(seconds * sound.rate));
  for (const MotionContact& contact : motion.contacts) {
    const double start = motion.sound.firstContact + contact.time;
    const auto from = static_cast<std::size_t>(std::max(0.0, start * sound.rate));
    for (std::size_t i = from; i < std::min(from + 8820, sound.samples.size()); ++i) {
      const double t = static_cast<double>(i) / sound.rate - start;
      const double value =
          0.5 * contact.targetAmplitude * std::exp(-t / 0.012) * std::sin(9000 * t);
      sound.samples[i] += static_cast<float>(value);
    }
  }
  return sound;
}

/// `count` contacts with all sorts of factors.
Motion motionWith(std::size_t count) {
  Motion motion = test::makeTumblingMotion(test::makeDrawableBox());
  const MotionContact first = motion.contacts.front();
  motion.contacts.clear();
  for (std::size_t i = 0; i < count; ++i) {
    const double x = static_cast<double>(i) / static_cast<double>(count);
    MotionContact contact = first;
    contact.targetTime = contact.time = 1.6 * std::pow(x, 0.6);
    contact.targetDuration = i % 4 == 3 ? 0.02 : 0;
    contact.end = contact.time + (i % 5 == 3 ? 0.025 : 0);
    contact.targetAmplitude = 1 - 0.9 * x;
    contact.amplitude = contact.targetAmplitude * (1 + 0.3 * std::sin(9 * x));
    contact.bend = 1.6 * std::abs(std::sin(7 * x));
    contact.factors.v = std::exp(-contact.bend * contact.bend);
    contact.factors.a = 1 - 0.4 * std::abs(std::cos(23 * x));
    contact.factors.l = 1 - 0.9 * std::pow(x, 6);
    motion.contacts.push_back(contact);
  }
  motion.contacts.back().terminal = true;
  motion.silent = {{1.2, 1.3}};
  motion.score = 0.87;
  return motion;
}

std::size_t countOf(const std::string& text, const std::string& what) {
  std::size_t count = 0;
  for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; ++at) ++count;
  return count;
}

TEST(Timeline, ShowsEveryContactAndTheScore) {
  const Motion motion = motionWith(12);
  const std::string svg = timelineSvg(motion, clicks(motion, 2.2));
  EXPECT_THAT(svg, HasSubstr("Score 0.87"));
  EXPECT_THAT(svg, HasSubstr("12 contacts, comes to rest"));
  EXPECT_EQ(countOf(svg, "<title>contact "), 12u);
  EXPECT_EQ(countOf(svg, "class=\"region\""), 3u);
  EXPECT_EQ(countOf(svg, "class=\"wave\""), 1u);
  EXPECT_THAT(svg, HasSubstr("prefers-color-scheme:dark"));
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
  EXPECT_THAT(svg, Not(HasSubstr("No acceptable motion")));
}

TEST(Timeline, PutsMarksWhereTheSoundHasThem) {
  // One contact 1 s into the sound: 0.25 s are shown before it and 0.35 s after.
  Motion motion = motionWith(1);
  motion.sound.firstContact = 1;
  const std::string svg = timelineSvg(motion, clicks(motion, 2));
  EXPECT_THAT(svg, HasSubstr("class=\"mark\" d=\"M546.0 "));  // 96 + 1080 * 0.25 / 0.6
}

TEST(Timeline, TellsAFailure) {
  Motion motion = motionWith(3);
  motion.success = false;
  motion.failure = "contact 4 <too long a gap> & more";
  EXPECT_THAT(timelineSvg(motion, {}), HasSubstr("contact 4 &lt;too long a gap&gt; &amp; more"));
}

TEST(Timeline, StaysSmall) {
  const Motion motion = motionWith(200);
  EXPECT_LT(timelineSvg(motion, clicks(motion, 60)).size(), 200u * 1000);
  const Motion crowd = motionWith(400);
  EXPECT_LT(timelineSvg(crowd, clicks(motion, 60)).size(), 250u * 1000);
}

TEST(Timeline, TakesWhatIsMissing) {
  EXPECT_THAT(timelineSvg(Motion{}, Sound{}), HasSubstr("</svg>"));
  Motion late = motionWith(3);
  late.sound.firstContact = 100;  // beyond the sound's end
  EXPECT_THAT(timelineSvg(late, clicks(motionWith(3), 1)), HasSubstr("</svg>"));
}

TEST(SvgText, EscapesWhatXmlCannotHold) {
  EXPECT_EQ(escapeXml("a<b>&\"\x01\xC3\xA4\xFFz\xC3"), "a&lt;b&gt;&amp;&quot; \xC3\xA4?z?");
}

}  // namespace
}  // namespace ifa
