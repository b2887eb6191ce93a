// SPDX-License-Identifier: Apache-2.0
#include "signature/signature_json.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <nlohmann/json.hpp>

#include "support/temporary_folder.h"

namespace ifa {
namespace {

using testing::HasSubstr;
using Json = nlohmann::json;

Json good() {
  return {{"format", "inverse-foley-signature"},
          {"version", 1},
          {"events",
           {{{"time", 0}, {"duration", 0.02}, {"amplitude", 2}, {"centroid", 0.01}, {"weight", 1}},
            {{"time", 0.25}}}},
          {"terminal", false}};
}

std::string complaint(const std::string& text) {
  const auto signature = parseSignature(text, "a.json");
  if (signature) return "";
  EXPECT_EQ(signature.error().code, ErrorCode::kBadInput);
  return signature.error().text();
}

/// The complaint after one change at a JSON pointer.
std::string complaintAfter(const std::string& pointer, const Json& value) {
  Json changed = good();
  changed[Json::json_pointer(pointer)] = value;
  return complaint(changed.dump());
}

TEST(ParseSignature, ReadsTheFormatOfTheContract) {
  const auto signature = parseSignature(good().dump(), "a.json");
  ASSERT_TRUE(signature) << signature.error().text();
  ASSERT_EQ(signature->events.size(), 2U);
  EXPECT_FALSE(signature->terminal);
  EXPECT_EQ(signature->events[0].amplitude, 1);
  EXPECT_EQ(signature->events[0].duration, 0.02);
  EXPECT_EQ(signature->events[0].centroid, 0.01);
  EXPECT_EQ(signature->events[1].time, 0.25);
  EXPECT_EQ(signature->events[1].amplitude, 0.5) << "1, the default, beside a first one of 2";
  EXPECT_EQ(signature->events[1].weight, 1);
}

TEST(ParseSignature, MovesTheFirstEventToZero) {
  Json shifted = good();
  shifted["events"][0]["time"] = 0.125;
  shifted["first_contact"] = 0.5;
  const auto signature = parseSignature(shifted.dump(), "a.json");
  ASSERT_TRUE(signature);
  EXPECT_EQ(signature->firstContact, 0.625);
  EXPECT_EQ(signature->events[0].time, 0);
  EXPECT_EQ(signature->events[1].time, 0.125);
}

TEST(ParseSignature, EachBadFileHasItsOwnMessage) {
  EXPECT_THAT(complaint(""), HasSubstr("a.json: is not a JSON object"));
  EXPECT_THAT(complaint("[1, 2]"), HasSubstr("not a JSON object"));
  EXPECT_THAT(complaint("{\"format\": "), HasSubstr("not a JSON object"));
  EXPECT_THAT(complaint(std::string(100000, '[')), HasSubstr("not a JSON object"));
  EXPECT_THAT(complaintAfter("/format", "something"), HasSubstr("a.json: format"));
  EXPECT_THAT(complaintAfter("/version", 2), HasSubstr("version"));
  EXPECT_THAT(complaintAfter("/terminal", "yes"), HasSubstr("true or false"));
  EXPECT_THAT(complaintAfter("/events", Json::array()), HasSubstr("no events"));
  EXPECT_THAT(complaintAfter("/events", 7), HasSubstr("no events"));
  EXPECT_THAT(complaintAfter("/events/1", 7), HasSubstr("events[1]"));
  EXPECT_THAT(complaintAfter("/events/1", Json::object()), HasSubstr("events[1].time: is missing"));
  EXPECT_THAT(complaintAfter("/events/1/time", "0.25"),
              HasSubstr("events[1].time: must be a number"));
  EXPECT_THAT(complaintAfter("/events/1/time", nullptr), HasSubstr("events[1].time"));
  EXPECT_THAT(complaintAfter("/events/1/time", 1e300), HasSubstr("events[1].time"));
  EXPECT_THAT(complaintAfter("/events/1/time", 0), HasSubstr("sort the events"));
  EXPECT_THAT(complaintAfter("/events/1/time", 0.015), HasSubstr("inside the event before"));
  EXPECT_THAT(complaintAfter("/events/0/duration", -1), HasSubstr("events[0].duration"));
  EXPECT_THAT(complaintAfter("/events/0/amplitude", 0), HasSubstr("events[0].amplitude"));
  EXPECT_THAT(complaintAfter("/events/0/centroid", 0.5), HasSubstr("after the event's end"));
  EXPECT_THAT(complaintAfter("/events/0/weight", 1.5), HasSubstr("events[0].weight"));
  EXPECT_THAT(complaintAfter("/first_contact", -1), HasSubstr("first_contact"));
  EXPECT_THAT(complaintAfter("/events/1/alternatives", 0.3), HasSubstr("events[1].alternatives"));
  EXPECT_THAT(complaintAfter("/events/1/alternatives", {{{"time", 0.3}}}),
              HasSubstr("events[1].alternatives[0].cost: is missing"));
  EXPECT_THAT(complaintAfter("/events/1/alternatives", {{{"time", 0}, {"cost", 1}}}),
              HasSubstr("outside the events"));
  EXPECT_THAT(complaintAfter("/events/0/alternatives", {{{"time", 0.1}, {"cost", 1}}}),
              HasSubstr("first event"));
  Json many = good();
  for (int i = 0; i < 10000; ++i) many["events"].push_back({{"time", i + 1}});
  EXPECT_THAT(complaint(many.dump()), HasSubstr("more than 10000"));
}

TEST(ReadSignature, MissingFile) {
  const test::TemporaryFolder folder;
  EXPECT_FALSE(readSignature(folder / "none.json"));
}

TEST(FormatSignature, ReadsBackToTheLastBit) {
  EXPECT_TRUE(rc::check("signature -> JSON -> signature", [] {
    const auto draws = *rc::gen::nonEmpty(
        rc::gen::container<std::vector<std::uint32_t>>(rc::gen::arbitrary<std::uint32_t>()));
    ContactSignature signature;
    signature.firstContact = draws[0] / 4294967296.0;
    signature.terminal = draws[0] % 2 == 0;
    double time = 0;
    for (const std::uint32_t draw : draws) {
      SignatureEvent event;
      event.time = time;
      event.duration = draw % 3 == 0 ? draw / 3e11 : 0;
      event.centroid = event.duration / 3;
      event.amplitude = time > 0 ? draw / 7e8 : 1;
      event.weight = draw % 5 / 4.0;
      if (time > 0 && draw % 4 == 0) event.alternatives = {{time + 0.004, draw / 7e8}};
      time += event.duration + 0.01 + draw / 1e11;
      signature.events.push_back(event);
    }
    const auto back = parseSignature(formatSignature(signature), "a");
    RC_ASSERT(back.has_value());
    RC_ASSERT(back->events.size() == signature.events.size());
    RC_ASSERT(back->terminal == signature.terminal);
    RC_ASSERT(back->firstContact == signature.firstContact);
    for (std::size_t i = 0; i < signature.events.size(); ++i) {
      RC_ASSERT(back->events[i].time == signature.events[i].time);
      RC_ASSERT(back->events[i].duration == signature.events[i].duration);
      RC_ASSERT(back->events[i].amplitude == signature.events[i].amplitude);
      RC_ASSERT(back->events[i].centroid == signature.events[i].centroid);
      RC_ASSERT(back->events[i].weight == signature.events[i].weight);
      const auto &before = signature.events[i].alternatives, &now = back->events[i].alternatives;
      RC_ASSERT(now.size() == before.size());
      // RC_ASSERT does not cut || short.
      if (!now.empty()) RC_ASSERT(now[0].time == before[0].time && now[0].cost == before[0].cost);
    }
  }));
}

TEST(WriteSignature, WritesWhatIsRead) {
  const test::TemporaryFolder folder;
  const auto signature = parseSignature(good().dump(), "a.json");
  ASSERT_TRUE(writeSignature(folder / "a.json", *signature));
  EXPECT_EQ(readSignature(folder / "a.json")->events.size(), 2U);
  EXPECT_FALSE(writeSignature(folder / "missing" / "a.json", *signature));
}

}  // namespace
}  // namespace ifa
