// SPDX-License-Identifier: Apache-2.0
#include "ensemble/ensemble_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ifa {
namespace {

using testing::HasSubstr;

Ensemble twoBodies() {
  Ensemble ensemble;
  ensemble.program = "1.2";
  ensemble.sound = "sound.wav";
  ensemble.seed = 5;
  ensemble.clearance = 0.004;
  ensemble.bodies = {{"a", "p", "bodies/a/motion.json", {0.1 + 0.2, {1 / 3.0, -2}}},
                     {"b \"c\"", "p", "bodies/b/motion.json", {-1, {0, 0}}}};
  return ensemble;
}

std::string complaint(std::string text, const std::string& what, const std::string& instead) {
  const auto at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  text.replace(at, what.size(), instead);
  const auto ensemble = parseEnsemble(text, "e.json");
  if (ensemble) return "";
  EXPECT_EQ(ensemble.error().code, ErrorCode::kBadInput);
  return ensemble.error().text();
}

TEST(EnsembleFile, ReadsBackToTheSameBits) {
  const Ensemble one = twoBodies();
  const auto other = parseEnsemble(formatEnsemble(one), "e.json");
  ASSERT_TRUE(other) << other.error().text();
  EXPECT_EQ(other->program, one.program);
  EXPECT_EQ(other->sound, one.sound);
  EXPECT_EQ(other->seed, one.seed);
  EXPECT_EQ(other->clearance, one.clearance);
  ASSERT_EQ(other->bodies.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(other->bodies[i].name, one.bodies[i].name);
    EXPECT_EQ(other->bodies[i].motion, one.bodies[i].motion);
    EXPECT_EQ(other->bodies[i].place.turn, one.bodies[i].place.turn);
    EXPECT_EQ(other->bodies[i].place.shift, one.bodies[i].place.shift);
  }
}

TEST(EnsembleFile, RefusesWhatCannotBe) {
  const std::string text = formatEnsemble(twoBodies());
  EXPECT_THAT(complaint(text, "{", "["), HasSubstr("not valid JSON"));
  EXPECT_THAT(complaint(text, "-ensemble", "-motion"), HasSubstr("e.json: format"));
  EXPECT_THAT(complaint(text, "\"version\": 1", "\"version\": 2"), HasSubstr("version"));
  EXPECT_THAT(complaint(text, "bodies/b/", "../"), HasSubstr("bodies[1].motion: leads out"));
  EXPECT_THAT(complaint(text, "bodies/b/", "/"), HasSubstr("leads out"));
  EXPECT_THAT(complaint(text, "\"turn\":-1.0", "\"turn\":1e9"), HasSubstr("bodies[1].turn"));
  EXPECT_THAT(complaint(text, "\"turn\":-1.0,", ""), HasSubstr("bodies[1].turn: is missing"));
  EXPECT_THAT(complaint(text, "\"bodies\": [", "\"others\": ["), HasSubstr("bodies"));
}

}  // namespace
}  // namespace ifa
