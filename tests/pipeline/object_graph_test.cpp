// SPDX-License-Identifier: Apache-2.0
// Which databases a graph may be made of.
#include "pipeline/object_graph.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <optional>

#include "body/object_file.h"
#include "pipeline/build_database.h"
#include "support/temporary_folder.h"

namespace ifa {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class ObjectGraph : public testing::Test {
 protected:
  void SetUp() override {
    eraser_ = *loadObject("Eraser");
    options_.database = folder_ / "eraser.ifadb";
    build(surfaceOf(eraser_));
  }
  static SurfaceProperties surfaceOf(const Body& body) {
    return body.definition.surfaces.at(body.definition.defaultSurface);
  }
  void build(const SurfaceProperties& surface, EventCut cut = EventCut::kAudible) {
    DatabaseRequest request;
    request.body = &eraser_;
    request.surface = surface;
    request.surfaceName = eraser_.definition.defaultSurface;
    request.simulations = 20;
    request.seed = 5;
    request.cut = cut;
    fs::remove(options_.database);
    ASSERT_TRUE(buildDatabase(request, options_.database, {}));
  }
  Result<std::shared_ptr<const ContactGraph>> get(GraphShelf& shelf, const Body& body) const {
    return shelf.get(body, surfaceOf(body), body.definition.defaultSurface, {});
  }

  test::TemporaryFolder folder_;
  Body eraser_;
  GraphOptions options_;
};

TEST_F(ObjectGraph, IsMadeOnce) {
  GraphShelf shelf(options_, 0.25);
  const auto first = get(shelf, eraser_);
  ASSERT_TRUE(first) << first.error().text();
  EXPECT_EQ((*first)->database().simulations(), 20U);
  EXPECT_EQ((*first)->settings().energyGain, 0.25);
  EXPECT_EQ(*first, *get(shelf, eraser_));
}

TEST_F(ObjectGraph, TakesTheOptionsOver) {
  options_.printedVelocity = options_.timeWarp = true;
  options_.symmetry = false;
  GraphShelf shelf(options_, 0);
  const auto graph = get(shelf, eraser_);
  ASSERT_TRUE(graph);
  EXPECT_EQ((*graph)->settings().velocityReference, VelocityReference::kPrinted);
  EXPECT_EQ((*graph)->settings().connection, ConnectionKind::kBlend);
  EXPECT_EQ((*graph)->symmetry().name(), "C1");
}

TEST_F(ObjectGraph, IsNotMadeOfAnotherBody) {
  GraphShelf shelf(options_, 0);
  const auto graph = get(shelf, *loadObject("d6"));
  ASSERT_FALSE(graph);
  EXPECT_EQ(graph.error().code, ErrorCode::kBadInput);
}

TEST_F(ObjectGraph, IsNotMadeOfAnotherSurface) {
  SurfaceProperties bouncier = surfaceOf(eraser_);
  bouncier.restitution += 0.01;
  build(bouncier);
  GraphShelf shelf(options_, 0);
  const auto graph = get(shelf, eraser_);
  ASSERT_FALSE(graph);
  EXPECT_EQ(graph.error().code, ErrorCode::kBadInput);
  EXPECT_THAT(graph.error().text(), HasSubstr("restitution"));
}

TEST_F(ObjectGraph, IsOfTheDatabasesCutUnlessAnotherIsAskedFor) {
  for (const EventCut cut : {EventCut::kAudible, EventCut::kPaper}) {
    build(surfaceOf(eraser_), cut);
    options_.cut.reset();
    GraphShelf any(options_, 0);
    const auto graph = get(any, eraser_);
    ASSERT_TRUE(graph) << graph.error().text();
    EXPECT_EQ(cutOf((*graph)->database().header().identity.settings), cut);
    options_.cut = cut;
    GraphShelf same(options_, 0);
    EXPECT_TRUE(get(same, eraser_));
    options_.cut = cut == EventCut::kPaper ? EventCut::kAudible : EventCut::kPaper;
    GraphShelf other(options_, 0);
    const auto refused = get(other, eraser_);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::kBadInput);
    EXPECT_THAT(refused.error().text(), HasSubstr("cut " + std::string(cutName(cut)) + " there"));
  }
}

TEST_F(ObjectGraph, NeedsItsFile) {
  options_.database = folder_ / "nowhere.ifadb";
  GraphShelf shelf(options_, 0);
  const auto graph = get(shelf, eraser_);
  ASSERT_FALSE(graph);
  EXPECT_THAT(graph.error().text(), HasSubstr("nowhere.ifadb"));
}

/// The cache in another place, as long as this lives.
class CacheAt {
 public:
  explicit CacheAt(const fs::path& place) {
    if (const char* before = std::getenv("XDG_CACHE_HOME")) before_ = before;
    ::setenv("XDG_CACHE_HOME", place.c_str(), 1);
  }
  ~CacheAt() {
    before_ ? ::setenv("XDG_CACHE_HOME", before_->c_str(), 1) : ::unsetenv("XDG_CACHE_HOME");
  }
  CacheAt(const CacheAt&) = delete;
  CacheAt& operator=(const CacheAt&) = delete;

 private:
  std::optional<std::string> before_;
};

// "hybrid" is the default: a home that cannot be written must not stop it.
TEST_F(ObjectGraph, DatabaseIsTheSameWhereItCannotBeKeptSlow) {
  const SurfaceProperties surface = withReferenceImpulse(eraser_, surfaceOf(eraser_), {});
  const GraphShelf shelf({}, 0);
  const auto open = [&](const fs::path& cache) {
    const CacheAt here(cache);
    return shelf.database(eraser_, surface, eraser_.definition.defaultSurface, {});
  };
  const auto kept = open(folder_ / "cache");
  ASSERT_TRUE(kept) << kept.error().text();
  EXPECT_EQ(kept->simulations(), kHybridSimulations);
  EXPECT_FALSE(fs::is_empty(folder_ / "cache" / "inverse-foley"));
  std::ofstream(folder_ / "file") << "no folder";
  const auto unkept = open(folder_ / "file" / "cache");
  ASSERT_TRUE(unkept) << unkept.error().text();
  EXPECT_EQ(unkept->header().checksum, kept->header().checksum);
  const auto of = [](const auto& database) { return database->values(kGap); };
  EXPECT_TRUE(std::ranges::equal(of(unkept), of(kept)));
}

}  // namespace
}  // namespace ifa
