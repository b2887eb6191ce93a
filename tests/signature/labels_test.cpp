// SPDX-License-Identifier: Apache-2.0
#include "signature/labels.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <string>
#include <tuple>

#include "support/temporary_folder.h"

namespace ifa {
namespace {

using testing::HasSubstr;

std::vector<Label> parsed(const std::string& text) {
  const auto labels = parseLabels(text, "a.txt");
  EXPECT_TRUE(labels) << labels.error().text();
  return labels.value_or(std::vector<Label>());
}

/// The error of reading `text`, as a person sees it.
std::string complaint(const std::string& text) {
  const auto labels = parseLabels(text, "a.txt");
  if (labels) return "";
  EXPECT_EQ(labels.error().code, ErrorCode::kBadInput);
  EXPECT_FALSE(labels.error().remedy.empty());
  return labels.error().text();
}

TEST(ParseLabels, WhatAudacityWrites) {
  const auto labels = parsed("0.050544\t0.050544\tc1\n0.747370\t0.880000\tc15 terminal\n");
  ASSERT_EQ(labels.size(), 2U);
  EXPECT_TRUE(labels[0].isPoint());
  EXPECT_EQ(labels[0].start, 0.050544);
  EXPECT_EQ(labels[0].text, "c1");
  EXPECT_FALSE(labels[1].isPoint());
  EXPECT_EQ(labels[1].end, 0.88);
  EXPECT_EQ(labels[1].text, "c15 terminal");
  EXPECT_EQ(labels[1].line, 2);
}

TEST(ParseLabels, CommaDecimals) {
  const auto labels = parsed("0,5\t0,75\tein Wort, zwei\n");
  ASSERT_EQ(labels.size(), 1U);
  EXPECT_EQ(labels[0].start, 0.5);
  EXPECT_EQ(labels[0].end, 0.75);
  EXPECT_EQ(labels[0].text, "ein Wort, zwei");
}

TEST(ParseLabels, PointLabelsWithATextForTheirEnd) {
  const auto labels = parsed("0.5\thit\n0.6\n0.7\t\tslap\n0.8\t0.8\n");
  ASSERT_EQ(labels.size(), 4U);
  for (const Label& label : labels) EXPECT_TRUE(label.isPoint());
  EXPECT_EQ(labels[0].text, "hit");
  EXPECT_EQ(labels[1].text, "");
  EXPECT_EQ(labels[2].text, "slap");
  EXPECT_EQ(labels[3].start, 0.8);
}

TEST(ParseLabels, FrequencyLinesBelongToTheLabelBefore) {
  const auto labels =
      parsed("1\t2\ta\n\\\t100.5\t2000\n\\\tsomething newer\n3\t4\tb\n\\\t-1\t50\n");
  ASSERT_EQ(labels.size(), 2U);
  EXPECT_EQ(labels[0].lowHz, 100.5);
  EXPECT_EQ(labels[0].highHz, 2000);
  EXPECT_EQ(labels[1].highHz, 50);
  EXPECT_THAT(complaint("\\\t1\t2\n1\t2\ta\n"), HasSubstr("a.txt:1: a frequency line"));
}

TEST(ParseLabels, MarksLineEndsAndEmptyLines) {
  for (const char* text :
       {"\xEF\xBB\xBF"
        "1\t1\ta\r\n2\t2\tb\r\n",
        "1\t1\ta\r2\t2\tb", "\n\n1\t1\ta\n \t \n2\t2\tb\n\n", "1\t1\ta \n2 \t 2\tb"}) {
    const auto labels = parsed(text);
    ASSERT_EQ(labels.size(), 2U);
    EXPECT_EQ(labels[0].start, 1);
    EXPECT_EQ(labels[0].text, "a");
    EXPECT_EQ(labels[1].text, "b");
  }
  EXPECT_EQ(parsed("1\t1\ta\r\n\r\n2\t2\tb\r\n")[1].line, 3);
}

TEST(ParseLabels, OtherWaysToWriteANumber) {
  const auto labels = parsed("+1.5\t1e1\ta\n-0.25\t.5\tb\n");
  EXPECT_EQ(labels[0].start, 1.5);
  EXPECT_EQ(labels[0].end, 10);
  EXPECT_EQ(labels[1].start, -0.25);
  EXPECT_EQ(labels[1].end, 0.5);
}

TEST(ParseLabels, EachBadTrackHasItsOwnMessage) {
  EXPECT_THAT(complaint(""), HasSubstr("holds no labels"));
  EXPECT_THAT(complaint("\n\r\n\xC2\xA0"), HasSubstr("is not a time"));
  EXPECT_THAT(complaint("1\t1\ta\nfoo\t2\tb\n"), HasSubstr("a.txt:2: 'foo' is not a time"));
  EXPECT_THAT(complaint("1.0 1.0 a\n"), HasSubstr("tab"));
  EXPECT_THAT(complaint("1\t1\ta\nnan\t2\tb\n"),
              HasSubstr("a.txt:2: a label's time is not a finite"));
  EXPECT_THAT(complaint("1\tinf\ta\n"), HasSubstr("not a finite"));
  EXPECT_THAT(complaint("1\t1e999\ta\n"), HasSubstr("not a finite"));
  EXPECT_THAT(complaint("2\t1\ta\n"), HasSubstr("ends before it starts"));
  EXPECT_THAT(complaint("1\t1\ta\xFF\n"), HasSubstr("UTF-8"));
  EXPECT_THAT(complaint(std::string("1\t1\ta\0b\n", 8)), HasSubstr("UTF-8"));
  EXPECT_THAT(complaint(std::string("\xFF\xFE"
                                    "1\0\t\0",
                                    6)),
              HasSubstr("UTF-16"));
  EXPECT_THAT(complaint("RIFF\x24\xF0\n"), HasSubstr("UTF-8"));
  std::string many;
  for (int i = 0; i < 100001; ++i) many += "1\n";
  EXPECT_THAT(complaint(many), HasSubstr("more than 100000"));
}

TEST(ReadLabels, MissingFileAndFolder) {
  const test::TemporaryFolder folder;
  EXPECT_FALSE(readLabels(folder / "none.txt"));
  EXPECT_FALSE(readLabels(folder.path()));
}

TEST(ParseLabels, NeverTripsOverBytes) {
  EXPECT_TRUE(rc::check("any bytes give labels with finite times, or an error",
                        [](const std::string& text) {
                          if (const auto labels = parseLabels(text, "a")) {
                            for (const Label& label : *labels)
                              RC_ASSERT(std::isfinite(label.start));
                          }
                        }));
  EXPECT_TRUE(rc::check("so do bytes that look like labels", [] {
    const auto text = *rc::gen::container<std::string>(
        rc::gen::elementOf(std::string("0123456789.,\t\t\n\r\\-+einfa \xC3\xA4")));
    if (const auto labels = parseLabels(text, "a")) {
      for (const Label& label : *labels) RC_ASSERT(label.end >= label.start);
    }
  }));
}

/// Labels with times of six decimals and texts that Audacity could hold.
rc::Gen<Label> anyLabel() {
  const auto microseconds = rc::gen::inRange(0, 100000000);
  const auto word =
      rc::gen::container<std::string>(rc::gen::elementOf(std::string("abcxyz,.-0123456789")));
  return rc::gen::map(rc::gen::tuple(microseconds, microseconds, word, rc::gen::arbitrary<bool>()),
                      [](const std::tuple<int, int, std::string, bool>& parts) {
                        Label label;
                        label.start = std::get<0>(parts) / 1e6;
                        label.end = (std::get<0>(parts) + std::get<1>(parts)) / 1e6;
                        label.text = std::get<2>(parts);
                        if (std::get<3>(parts)) {
                          label.lowHz = 62.5;
                          label.highHz = label.start;
                        }
                        return label;
                      });
}

TEST(FormatLabels, ReadsBackAsItWas) {
  EXPECT_TRUE(rc::check("labels -> text -> labels", [] {
    const auto labels = *rc::gen::nonEmpty(rc::gen::container<std::vector<Label>>(anyLabel()));
    const auto back = parseLabels(formatLabels(labels), "a");
    RC_ASSERT(back.has_value());
    RC_ASSERT(back->size() == labels.size());
    for (std::size_t i = 0; i < labels.size(); ++i) {
      RC_ASSERT(std::abs((*back)[i].start - labels[i].start) < 1e-9);
      RC_ASSERT(std::abs((*back)[i].end - labels[i].end) < 1e-9);
      RC_ASSERT((*back)[i].text == labels[i].text);
      RC_ASSERT((*back)[i].lowHz == labels[i].lowHz);
    }
    // A second time nothing changes at all.
    RC_ASSERT(formatLabels(*back) == formatLabels(labels));
  }));
}

TEST(FormatLabels, SixDecimalsADotAndOneLine) {
  Label label;
  label.start = 1.0 / 3;
  label.end = 2;
  label.text = "a\tb\nc";
  EXPECT_EQ(formatLabels({label}), "0.333333\t2.000000\ta b c\n");
}

TEST(WriteLabels, LeavesNothingWhereItCannotWrite) {
  const test::TemporaryFolder folder;
  EXPECT_TRUE(writeLabels(folder / "a.txt", {Label{}}));
  EXPECT_EQ(readLabels(folder / "a.txt")->size(), 1U);
  EXPECT_FALSE(writeLabels(folder / "missing" / "a.txt", {Label{}}));
  EXPECT_EQ(folder.names(), std::vector<std::string>{"a.txt"});
}

std::string problem(const std::string& text, double duration = 10) {
  const auto good = checkLabels(parsed(text), duration, "a.txt");
  if (good) return "";
  EXPECT_EQ(good.error().code, ErrorCode::kBadInput);
  EXPECT_FALSE(good.error().remedy.empty());
  return good.error().text();
}

TEST(CheckLabels, EachBadTrackHasItsOwnMessage) {
  EXPECT_EQ(problem("1\t1\ta\n2\t3\tb\n3\t3\tc\n"), "");
  EXPECT_THAT(problem("2\t2\ta\n1\t1\tb\n"), HasSubstr("a.txt:2: labels are out of order"));
  EXPECT_THAT(problem("1\t3\ta\n2\t2\tb\n"), HasSubstr("a.txt:2: labels overlap"));
  EXPECT_THAT(problem("1\t1\ta\n11\t11\tb\n"), HasSubstr("a.txt:2: the label at 11.000000"));
  EXPECT_THAT(problem("1\t1\ta\n9\t10.5\tb\n"), HasSubstr("outside the sound"));
  EXPECT_THAT(problem("-0.1\t1\ta\n"), HasSubstr("outside the sound"));
  EXPECT_EQ(problem("9\t10.0009\ta\n"), "") << "a region drawn to the end";
  EXPECT_FALSE(checkLabels({}, 10, "a"));
  Label bad;
  bad.start = bad.end = NAN;
  const auto good = checkLabels({Label{}, bad}, 10, "detected");
  ASSERT_FALSE(good);
  EXPECT_THAT(good.error().text(), HasSubstr("detected, label 2"));
}

TEST(LabelsAreTerminal, UnlessTheLastOneSaysOtherwise) {
  EXPECT_TRUE(labelsAreTerminal(parsed("1\t1\ta non-terminal\n2\t2\tb\n")));
  EXPECT_TRUE(labelsAreTerminal(parsed("1\t1\ta\n2\t2\tc2 terminal\n")));
  EXPECT_FALSE(labelsAreTerminal(parsed("1\t1\ta\n2\t2\tc2 non-terminal\n")));
  EXPECT_FALSE(labelsAreTerminal(parsed("1\t1\tNon-Terminal \n")));
  EXPECT_TRUE(labelsAreTerminal(parsed("1\t1\tnon-terminal?\n")));
}

}  // namespace
}  // namespace ifa
