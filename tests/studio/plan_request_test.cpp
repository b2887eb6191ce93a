// SPDX-License-Identifier: Apache-2.0
#include "studio/plan_request.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "signature/csv.h"

namespace ifa::studio {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Not;

const std::map<std::string, CatalogueEntry>& catalogue() {
  static const std::map<std::string, CatalogueEntry> kEntries = {
      {"d6", {"Die", "acrylic", "desk", {"desk", "wood"}, {{"1", {0, 0, 1}}, {"6", {0, 0, -1}}}}}};
  return kEntries;
}

Answer<PlanRequest> parse(const std::string& json) { return parsePlanRequest(json, catalogue()); }

TEST(PlanRequest, ReadsAllThatAPageAsks) {
  const auto request = parse(
      R"({"marks": [{"start": 0.1}, {"start": 0.3, "end": 0.4, "weight": 0.5}], "object": "d6",
          "surface": "wood", "face": "6", "terminal": false, "takes": 2, "seed": 7, "fit": true, "landing": {"x": 0.1, "y": -2}})");
  ASSERT_TRUE(request);
  EXPECT_EQ(request->marks.size(), 2U);
  EXPECT_EQ(request->marks[1].weight, 0.5);
  EXPECT_EQ(request->marks[1].text, "non-terminal");
  EXPECT_EQ(placesTable(*request), "1\t0\t0\nlast\t0.1\t-2\n");
  const auto words = syncArguments(*request, {"s.wav", "m.csv", "p.tsv"}, "out");
  EXPECT_THAT(words, Contains("p.tsv"));
  EXPECT_THAT(words, Contains("last:6=up"));
  EXPECT_THAT(words, Contains("--fit"));
  EXPECT_THAT(words, Contains("wood"));
}

TEST(PlanRequest, ItsTableIsWhatSyncReads) {
  const auto request = parse(
      R"({"marks": [{"start": 0.1}, {"start": 0.3, "end": 0.4, "weight": 0.5}], "object": "d6"})");
  ASSERT_TRUE(request);
  const auto labels = parseCsv(marksTable(*request), "marks");
  ASSERT_TRUE(labels);
  ASSERT_EQ(labels->size(), 2U);
  EXPECT_NEAR((*labels)[1].end, 0.4, 1e-9);
  EXPECT_EQ((*labels)[1].weight, 0.5);
  EXPECT_TRUE(labelsAreTerminal(*labels));
}

TEST(PlanRequest, NoTextOfARequestBecomesAnArgumentUnlessTheCatalogueHasIt) {
  for (const char* object : {"../d6", "/etc/passwd", "d6,d8", "--help", "auto", "", "D6"}) {
    const auto request =
        parse(R"({"marks": [{"start": 0.1}], "object": ")" + std::string(object) + "\"}");
    ASSERT_FALSE(request) << object;
    EXPECT_EQ(request.error().status, 422);
  }
  EXPECT_FALSE(parse(R"({"marks": [{"start": 0.1}], "object": "d6", "surface": "moon"})"));
  EXPECT_FALSE(parse(R"({"marks": [{"start": 0.1}], "object": "d6", "face": "6=up --seed"})"));
  const auto plain = parse(R"({"marks": [{"start": 0.1}], "object": "d6", "extra": "--planner"})");
  ASSERT_TRUE(plain);
  EXPECT_EQ(placesTable(*plain), "");
  const auto words = syncArguments(*plain, {"s", "m", "p"}, "o");
  EXPECT_THAT(words, Not(Contains(HasSubstr("planner"))));
  EXPECT_THAT(words, Not(Contains("--positions")));
}

TEST(PlanRequest, NamesTheFieldThatIsWrong) {
  const auto problem = [](const std::string& marks, const std::string& rest = "") {
    const auto request = parse(R"({"object": "d6", "marks": )" + marks + rest + "}");
    return request ? std::string() : request.error().message;
  };
  EXPECT_THAT(problem("[]"), HasSubstr("no contacts"));
  EXPECT_THAT(problem("5"), HasSubstr("no contacts"));
  EXPECT_THAT(problem("[5]"), HasSubstr("no object"));
  EXPECT_THAT(problem("[{}]"), HasSubstr("contact 1: start is missing"));
  EXPECT_THAT(problem(R"([{"start": "1"}])"), HasSubstr("contact 1: start"));
  EXPECT_THAT(problem(R"([{"start": -1}])"), HasSubstr("contact 1: start"));
  EXPECT_THAT(problem(R"([{"start": 1e999}])"), Not(testing::IsEmpty()));
  EXPECT_THAT(problem(R"([{"start": 1}, {"start": 1}])"),
              HasSubstr("contact 2: start is not after"));
  EXPECT_THAT(problem(R"([{"start": 1, "end": 0.5}])"), HasSubstr("before its start"));
  EXPECT_THAT(problem(R"([{"start": 1}])", R"(, "takes": 100)"), HasSubstr("takes"));
  EXPECT_THAT(problem(R"([{"start": 1}])", R"(, "fit": "yes")"), HasSubstr("fit"));
  const auto landing = [&](const std::string& value) {
    return problem(R"([{"start": 1}, {"start": 2}])", R"(, "landing": )" + value);
  };
  EXPECT_EQ(landing(R"({"x": 100, "y": -100})"), "");
  EXPECT_EQ(landing("null"), "");
  EXPECT_THAT(landing("[1, 2]"), HasSubstr("landing is no place"));
  EXPECT_THAT(landing(R"({"x": 1})"), HasSubstr("landing needs x and y"));
  EXPECT_THAT(landing(R"({"x": 1, "y": 100.1})"), HasSubstr("landing: y is not a number from"));
  EXPECT_THAT(landing(R"({"x": "1\t2", "y": 0})"), HasSubstr("landing: x is not"));
  EXPECT_THAT(landing(R"({"x": 1e999, "y": 0})"), Not(testing::IsEmpty()));
  EXPECT_THAT(problem(R"([{"start": 1}])", R"(, "landing": {"x": 0, "y": 0})"),
              HasSubstr("needs a contact before it"));
  std::string many = "[";
  for (int i = 0; i < 501; ++i) many += fmt::format(R"({}{{"start": {}}})", i > 0 ? "," : "", i);
  EXPECT_THAT(problem(many + "]"), HasSubstr("more than 500"));
}

TEST(PlanRequest, GarbageIsRefused) {
  for (const std::string& text :
       {std::string(), std::string("null"), std::string("[]"), std::string("{"),
        std::string("\xff\xfe"), std::string(100000, '[')}) {
    EXPECT_FALSE(parse(text));
  }
}

}  // namespace
}  // namespace ifa::studio
