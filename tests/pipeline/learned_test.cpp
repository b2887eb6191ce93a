// SPDX-License-Identifier: Apache-2.0
#include "pipeline/learned.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "base/file.h"
#include "body/object_file.h"
#include "support/temporary_folder.h"

namespace ifa {
namespace {

namespace fs = std::filesystem;

class LearnObject : public testing::Test {
 protected:
  [[nodiscard]] Learned learn(const fs::path& cache) const {
    return learnObject(die_, surface_, cache, Progress());
  }
  [[nodiscard]] fs::path onlyFile() const {
    fs::path found;
    for (const auto& entry : fs::directory_iterator(folder_.path())) {
      EXPECT_TRUE(found.empty());
      found = entry.path();
    }
    return found;
  }
  static void expectSame(const Learned& a, const Learned& b) {
    const auto one = a.outlook.coefficients(), other = b.outlook.coefficients();
    EXPECT_EQ(a.referenceImpulse, b.referenceImpulse);
    EXPECT_EQ(one.weights, other.weights);
    EXPECT_EQ(one.spread, other.spread);
    EXPECT_EQ(one.restEnergy, other.restEnergy);
  }

  test::TemporaryFolder folder_;
  Body die_ = loadObject("d6").value();
  SurfaceProperties surface_ = die_.definition.surfaces.at("desk");
};

TEST_F(LearnObject, GivesTheSameBitsWithAndWithoutTheCache) {
  const Learned first = learn(folder_.path()), second = learn(folder_.path());
  expectSame(first, second);
  expectSame(first, learn({}));
  EXPECT_EQ(first.referenceImpulse, surface_.referenceImpulse);
  EXPECT_GT(first.outlook.restEnergy(), 0);
}

TEST_F(LearnObject, ReadsWhatItWrote) {
  (void)learn(folder_.path());
  const fs::path file = onlyFile();
  auto json = nlohmann::json::parse(readFile(file, 1 << 16).value());
  json["spread"] = 0.625;
  ASSERT_TRUE(writeFileAtomically(file, json.dump()));
  EXPECT_EQ(learn(folder_.path()).outlook.coefficients().spread, 0.625);
}

TEST_F(LearnObject, LearnsAgainWhereTheFileIsBrokenOrForeign) {
  const Learned known = learn(folder_.path());
  const fs::path file = onlyFile();
  const std::string good = readFile(file, 1 << 16).value();
  auto foreign = nlohmann::json::parse(good);
  foreign["key"] = 1;
  for (const std::string& text : {std::string("{"), std::string(), good.substr(0, good.size() / 2),
                                  foreign.dump(), std::string("[1, 2]")}) {
    ASSERT_TRUE(writeFileAtomically(file, text));
    expectSame(known, learn(folder_.path()));
    EXPECT_EQ(readFile(file, 1 << 16).value(), good);
  }
}

TEST_F(LearnObject, TellsSurfacesApart) {
  const double spread = learn(folder_.path()).outlook.coefficients().spread;
  surface_.restitution = 0.5;
  EXPECT_NE(learn(folder_.path()).outlook.coefficients().spread, spread);
}

TEST_F(LearnObject, MeasuresTheReferenceImpulseThatAnObjectLacks) {
  const double calibrated = surface_.referenceImpulse;
  surface_.referenceImpulse = 0;
  EXPECT_NEAR(learn({}).referenceImpulse, calibrated, 0.1 * calibrated);
}

TEST_F(LearnObject, KeepsWhatRestitutionsSoundLike) {
  const auto learnSounds = [&](const fs::path& cache) {
    return learnRestitution(die_, surface_, cache, Progress()).coefficients();
  };
  const auto first = learnSounds(folder_.path()), second = learnSounds(folder_.path());
  EXPECT_EQ(first.weights, second.weights);
  EXPECT_EQ(first.spread, second.spread);
  auto json = nlohmann::json::parse(readFile(onlyFile(), 1 << 16).value());
  json["spread"] = 0.625;
  ASSERT_TRUE(writeFileAtomically(onlyFile(), json.dump()));
  EXPECT_EQ(learnSounds(folder_.path()).spread, 0.625);
  EXPECT_EQ(learnSounds({}).weights, first.weights);
}

TEST_F(LearnObject, KeepsWhatRhythmsABodyMakes) {
  const auto learnRhythms = [&](const fs::path& cache) {
    return learnRhythm(die_, surface_, cache, Progress()).coefficients();
  };
  const auto first = learnRhythms(folder_.path()), second = learnRhythms(folder_.path());
  EXPECT_EQ(first.mean, second.mean);
  EXPECT_EQ(first.whitening, second.whitening);
  auto json = nlohmann::json::parse(readFile(onlyFile(), 1 << 16).value());
  json["heard"] = 0.625;
  ASSERT_TRUE(writeFileAtomically(onlyFile(), json.dump()));
  EXPECT_EQ(learnRhythms(folder_.path()).heard, 0.625);
  json["whitening"].erase(0);  // damaged: learnt again
  ASSERT_TRUE(writeFileAtomically(onlyFile(), json.dump()));
  EXPECT_EQ(learnRhythms(folder_.path()).heard, first.heard);
}

TEST_F(LearnObject, DoesWithoutACacheThatCannotBeWritten) {
  test::writeText(folder_ / "file", "in the way");
  expectSame(learn(folder_ / "file"), learn({}));
}

}  // namespace
}  // namespace ifa
