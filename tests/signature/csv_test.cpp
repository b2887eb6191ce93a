// SPDX-License-Identifier: Apache-2.0
#include "signature/csv.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/temporary_folder.h"

namespace ifa {
namespace {

using testing::HasSubstr;

std::vector<Label> parsed(const std::string& text) {
  auto labels = parseCsv(text, "a.csv");
  EXPECT_TRUE(labels) << labels.error().text();
  return labels.value_or(std::vector<Label>());
}

std::string complaint(const std::string& text) {
  const auto labels = parseCsv(text, "a.csv");
  if (labels) return "";
  EXPECT_EQ(labels.error().code, ErrorCode::kBadInput);
  return labels.error().text();
}

TEST(ParseCsv, TimeAndDurationWithoutNames) {
  const auto labels = parsed("0.5,0.25\n1.5,0\n2\n3,,0.5,last non-terminal\n");
  ASSERT_EQ(labels.size(), 4U);
  EXPECT_EQ(labels[0].start, 0.5);
  EXPECT_EQ(labels[0].end, 0.75);
  EXPECT_FALSE(labels[0].amplitude);
  EXPECT_TRUE(labels[1].isPoint());
  EXPECT_TRUE(labels[2].isPoint());
  EXPECT_EQ(*labels[3].amplitude, 0.5);
  EXPECT_EQ(labels[3].line, 4);
  EXPECT_FALSE(labelsAreTerminal(labels));
}

TEST(ParseCsv, ColumnsInAnyOrderUnderTheirNames) {
  const auto labels = parsed(
      "# made by hand\r\nWeight, Label ,note,TIME,amplitude,centroid,end\r\n"
      "0.5,\"a, \"\"b\"\"\",x,0.25,2,0.125,0.5\r\n");
  ASSERT_EQ(labels.size(), 1U);
  EXPECT_EQ(labels[0].start, 0.25);
  EXPECT_EQ(labels[0].end, 0.5);
  EXPECT_EQ(labels[0].text, "a, \"b\"");
  EXPECT_EQ(*labels[0].amplitude, 2);
  EXPECT_EQ(*labels[0].centroid, 0.125);
  EXPECT_EQ(labels[0].weight, 0.5);
}

TEST(ParseCsv, OtherSeparatorsAndDecimalCommas) {
  for (const char* text : {"time;duration\n0,5;0,25\n1,5;0\n",
                           "\xEF\xBB\xBFtime\tduration\n0,5\t0,25\n1.5\t\n", "0,5;0,25\r1,5;0\r"}) {
    const auto labels = parsed(text);
    ASSERT_EQ(labels.size(), 2U) << text;
    EXPECT_EQ(labels[0].start, 0.5) << text;
    EXPECT_EQ(labels[0].end, 0.75) << text;
    EXPECT_EQ(labels[1].start, 1.5) << text;
  }
}

TEST(ParseCsv, EachBadTableHasItsOwnMessage) {
  EXPECT_THAT(complaint(""), HasSubstr("a.csv: holds no contacts"));
  EXPECT_THAT(complaint("time,duration\n"), HasSubstr("holds no contacts"));
  EXPECT_THAT(complaint("a,b\n1,2\n"), HasSubstr("a.csv:1: neither a time nor the names"));
  EXPECT_THAT(complaint("time\n0.1\nx\n"), HasSubstr("a.csv:3: \"x\" is not a number"));
  EXPECT_THAT(complaint("time,duration\n0.1,nan\n"), HasSubstr("a.csv:2: \"nan\""));
  EXPECT_THAT(complaint("time\n1e999\n"), HasSubstr("a.csv:2"));
  EXPECT_THAT(complaint("time\n-1\n"), HasSubstr("from 0 to 86400"));
  EXPECT_THAT(complaint("time,weight\n1,2\n"), HasSubstr("from 0 to 1"));
  EXPECT_THAT(complaint("time,duration\n,1\n"), HasSubstr("a.csv:2: a row has no time"));
  EXPECT_THAT(complaint("time,end\n2,1\n"), HasSubstr("a.csv:2: a contact ends before"));
  EXPECT_THAT(complaint("time\n\xFF\n"), HasSubstr("UTF-8"));
}

TEST(ReadCsv, MissingFile) {
  const test::TemporaryFolder folder;
  EXPECT_FALSE(readCsv(folder / "none.csv"));
}

}  // namespace
}  // namespace ifa
