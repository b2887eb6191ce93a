// SPDX-License-Identifier: Apache-2.0
#include "export/motion_json.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>

#include "audit/analytic_motion.h"
#include "base/file.h"

namespace ifa {
namespace {

using Json = nlohmann::json;
using testing::HasSubstr;

/// A motion with something in every field.
Motion fullMotion() {
  Motion motion = test::makeSlidingMotion(test::makeDrawableBox());
  motion.failure = "contact 3: \"too long a gap\"\n\xC3\xA4";
  motion.database = DatabaseReference{400000, 6751058, "0123abcd"};
  motion.cut = EventCut::kPaper;
  motion.given = GivenSurface{"felt", 0.1 + 0.7};
  motion.score = 0.1 + 0.2;
  motion.contacts[1].arrival = Arrival::kSilentContact;
  motion.contacts[1].source = {SourceKind::kDatabase, -1, std::int64_t{1} << 60, 23};
  motion.contacts[1].factors = {0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 1.0 / 3};
  motion.contacts[1].impulseChange = {1e-300, -1e-5, 0.1};
  motion.contacts[2].arrivalImpulseChange = {0.1 + 0.2, -1e-7, 1.0 / 3};
  motion.contacts[2].arrivalAngularChange = {1e-300, 2.0 / 3, -0.7};
  motion.contacts[2].arrivalBend = 1.0 / 7;
  motion.contacts[1].moved = -0.1 / 3;
  motion.dropped = {0.1 + 0.2, 0.4};
  motion.orientations = {{-1, {0, 0.6, 0.8}, {0, 0, 1}}};
  motion.positions = {{2, {0.1 + 0.2, -1.5}}};
  return motion;
}

Json asJson(const Motion& motion) { return Json::parse(formatMotion(motion).value()); }

/// The error for the full motion after `damage`.
std::string errorAfter(const std::function<void(Json&)>& damage) {
  Json json = asJson(fullMotion());
  damage(json);
  const auto read = parseMotion(json.dump(), "m.json");
  return read ? "no error" : read.error().text();
}

TEST(MotionJson, HasTheFieldsOfTheContract) {
  const Json json = asJson(fullMotion());
  EXPECT_EQ(json["format"], "inverse-foley-motion");
  EXPECT_EQ(json["version"], 1);
  EXPECT_EQ(json["seed"].get<std::uint64_t>(), 18446744073709551615ULL);
  EXPECT_EQ(json["sound"]["first_contact"], 0.25);
  EXPECT_EQ(json["contacts"][1]["arrival"], "silent_contact");
  EXPECT_EQ(json["contacts"][1]["source"]["kind"], "database");
  EXPECT_EQ(json["trajectory"]["orientation"][0].size(), 4u);
  EXPECT_EQ(json["trajectory"]["orientation"][0][0], 1.0);  // w comes first
  EXPECT_EQ(json["database"]["events"], 6751058);
  EXPECT_EQ(json["cut"], "paper");
  EXPECT_EQ(json["fit"]["given_surface"], "felt");
  EXPECT_EQ(json["fit"]["given_restitution"], 0.1 + 0.7);
  EXPECT_EQ(json["failure"], fullMotion().failure);
}

TEST(MotionJson, LeavesOutWhatIsNotThere) {
  Motion motion = fullMotion();
  motion.failure.clear();
  motion.database.reset();
  motion.cut = EventCut::kAudible;
  motion.given.reset();
  const Json json = asJson(motion);
  EXPECT_FALSE(json.contains("cut"));
  EXPECT_FALSE(json.contains("fit"));
  EXPECT_FALSE(parseMotion(json.dump(), "m.json")->given);
  EXPECT_TRUE(json["failure"].is_null());
  EXPECT_FALSE(json.contains("database"));
  EXPECT_FALSE(json["contacts"][0].contains("moved"));
  for (const char* field : {"arrival_bend", "arrival_impulse_change", "arrival_angular_change"}) {
    EXPECT_FALSE(json["contacts"][1].contains(field));
    EXPECT_TRUE(json["contacts"][2].contains(field));
  }
}

TEST(MotionJson, ComesBackToTheLastBit) {
  const std::string text = formatMotion(fullMotion()).value();
  const auto read = parseMotion(text, "m.json");
  ASSERT_TRUE(read.has_value()) << read.error().text();
  EXPECT_EQ(formatMotion(*read).value(), text);
  const Motion original = fullMotion();
  ASSERT_EQ(read->trajectory.size(), original.trajectory.size());
  for (std::size_t i = 0; i < original.trajectory.size(); ++i) {
    const MotionSample &a = read->trajectory[i], &b = original.trajectory[i];
    EXPECT_EQ(a.time, b.time);
    EXPECT_EQ(a.position, b.position);
    EXPECT_EQ(a.orientation.coeffs(), b.orientation.coeffs());
    EXPECT_EQ(a.velocity, b.velocity);
    EXPECT_EQ(a.angularVelocity, b.angularVelocity);
  }
  EXPECT_EQ(read->contacts[1].impulseChange, original.contacts[1].impulseChange);
  EXPECT_EQ(read->contacts[2].arrivalImpulseChange, original.contacts[2].arrivalImpulseChange);
  EXPECT_EQ(read->contacts[2].arrivalAngularChange, original.contacts[2].arrivalAngularChange);
  EXPECT_EQ(read->contacts[2].arrivalBend, 1.0 / 7);
  EXPECT_EQ(read->contacts[1].arrivalBend, 0);
  EXPECT_EQ(read->contacts[1].moved, -0.1 / 3);
  EXPECT_EQ(read->contacts[0].moved, 0);
  EXPECT_EQ(read->dropped, original.dropped);
  ASSERT_EQ(read->orientations.size(), 1U);
  ASSERT_EQ(read->positions.size(), 1U);
  EXPECT_EQ(read->positions[0].contact, 2);
  EXPECT_EQ(read->positions[0].place, original.positions[0].place);
  EXPECT_EQ(read->orientations[0].contact, -1);
  EXPECT_EQ(read->orientations[0].body, original.orientations[0].body);
  EXPECT_EQ(read->orientations[0].world, original.orientations[0].world);
  EXPECT_EQ(read->contacts[1].source.event, std::int64_t{1} << 60);
  EXPECT_EQ(read->contacts[1].factors.p, 1.0 / 3);
  EXPECT_EQ(read->silent, original.silent);
  EXPECT_EQ(read->score, 0.1 + 0.2);
}

TEST(MotionJson, StaysReadable) {
  const std::string text = formatMotion(fullMotion()).value();
  std::size_t longest = 0, from = 0;
  for (std::size_t to; (to = text.find('\n', from)) != std::string::npos; from = to + 1) {
    longest = std::max(longest, to - from);
  }
  EXPECT_LT(longest, 1200u);
}

TEST(MotionJson, GoesThroughAFile) {
  const auto path = std::filesystem::path(testing::TempDir()) / "ifa_motion_json_test.json";
  ASSERT_TRUE(writeMotionJson(path, fullMotion()).has_value());
  const auto read = readMotionJson(path);
  std::filesystem::remove(path);
  ASSERT_TRUE(read.has_value()) << read.error().text();
  EXPECT_EQ(read->contacts.size(), 3u);
  EXPECT_THAT(readMotionJson(path).error().text(), HasSubstr(path.string()));
}

TEST(MotionJson, RefusesToWriteWhatIsNotFinite) {
  Motion motion = fullMotion();
  motion.trajectory[4].velocity.y() = std::numeric_limits<double>::infinity();
  const auto text = formatMotion(motion);
  ASSERT_FALSE(text.has_value());
  EXPECT_EQ(text.error().code, ErrorCode::kInternal);
  EXPECT_THAT(text.error().text(), HasSubstr("velocity"));
}

TEST(MotionJson, SkipsFieldsThatLaterVersionsAdd) {
  EXPECT_EQ(errorAfter([](Json& json) { json["contacts"][0]["loudness"] = {1, 2}; }), "no error");
}

TEST(MotionJson, NamesTheFieldThatIsWrong) {
  EXPECT_THAT(errorAfter([](Json& j) { j["format"] = "other"; }), HasSubstr("'format'"));
  EXPECT_THAT(errorAfter([](Json& j) { j["version"] = 2; }), HasSubstr("'version'"));
  EXPECT_THAT(errorAfter([](Json& j) { j.erase("seed"); }), HasSubstr("'seed' is missing"));
  EXPECT_THAT(errorAfter([](Json& j) { j["seed"] = -1; }), HasSubstr("'seed' is out of range"));
  EXPECT_THAT(errorAfter([](Json& j) { j["object"] = 3; }), HasSubstr("'object' is not an object"));
  EXPECT_THAT(errorAfter([](Json& j) { j["object"]["mass"] = 0; }), HasSubstr("'object.mass'"));
  EXPECT_THAT(errorAfter([](Json& j) { j["success"] = "yes"; }), HasSubstr("'success'"));
  EXPECT_THAT(errorAfter([](Json& j) { j["contacts"] = 1; }), HasSubstr("'contacts'"));
  EXPECT_THAT(errorAfter([](Json& j) { j["contacts"][2]["factors"]["v"] = nullptr; }),
              HasSubstr("'contacts[2].factors.v' is not a number"));
  EXPECT_THAT(errorAfter([](Json& j) { j["contacts"][2]["factors"]["q"] = 1.5; }),
              HasSubstr("'contacts[2].factors.q' is out of range"));
  EXPECT_THAT(errorAfter([](Json& j) { j["contacts"][0]["arrival"] = "train"; }),
              HasSubstr("'contacts[0].arrival'"));
  EXPECT_THAT(errorAfter([](Json& j) { j["contacts"][2]["arrival_bend"] = -1; }),
              HasSubstr("'contacts[2].arrival_bend'"));
  EXPECT_THAT(errorAfter([](Json& j) { j["contacts"][2].erase("arrival_angular_change"); }),
              HasSubstr("'contacts[2].arrival_angular_change' is missing"));
  EXPECT_THAT(errorAfter([](Json& j) { j["contacts"][2]["time"] = -1; }),
              HasSubstr("'contacts[2]' starts before"));
  EXPECT_THAT(errorAfter([](Json& j) { j["silent"][0] = {2, 1}; }), HasSubstr("'silent[0]'"));
}

TEST(MotionJson, NamesTheSampleThatIsWrong) {
  const auto in = [](const char* column, std::size_t row, const Json& value) {
    return errorAfter([&](Json& j) { j["trajectory"][column][row] = value; });
  };
  EXPECT_THAT(in("time", 5, -9), HasSubstr("'trajectory.time[5]' goes back"));
  EXPECT_THAT(in("position", 5, {1, 2}), HasSubstr("'trajectory.position[5]' has 2 items"));
  EXPECT_THAT(in("orientation", 6, {1, 1, 0, 0}), HasSubstr("[6]' is not a unit quaternion"));
  EXPECT_THAT(in("velocity", 7, {1, 2, 1e20}), HasSubstr("'trajectory.velocity[7][2]'"));
  EXPECT_THAT(errorAfter([](Json& j) { j["trajectory"]["velocity"].erase(3); }),
              HasSubstr("'trajectory.velocity' has"));
}

TEST(MotionJson, RefusesWhatIsNoJson) {
  EXPECT_THAT(parseMotion("{\"format\": ", "m.json").error().text(), HasSubstr("byte"));
  EXPECT_FALSE(parseMotion("", "m.json").has_value());
  EXPECT_FALSE(parseMotion("[]", "m.json").has_value());
  EXPECT_FALSE(parseMotion("{\"seed\": 1e999}", "m.json").has_value());
  EXPECT_FALSE(parseMotion(std::string(100000, '['), "m.json").has_value());
  const std::string text = formatMotion(fullMotion()).value();
  for (std::size_t cut = 0; cut < text.size(); cut += text.size() / 40) {
    EXPECT_FALSE(parseMotion(text.substr(0, cut), "m.json").has_value());
  }
}

}  // namespace
}  // namespace ifa
