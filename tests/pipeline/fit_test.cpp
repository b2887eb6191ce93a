// SPDX-License-Identifier: Apache-2.0
#include "pipeline/fit.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>

#include "base/parallel.h"
#include "body/object_file.h"
#include "support/temporary_folder.h"

namespace ifa {
namespace {

using testing::HasSubstr;

/// A planner whose Score is a function of the surface; it keeps what it was asked for.
class PlannerByFormula : public Planner {
 public:
  using Score = std::function<double(const SurfaceProperties&)>;
  explicit PlannerByFormula(Score score) : score_(std::move(score)) {}

  Result<std::vector<Plan>> plan(const PlanRequest& request, const Progress&) const override {
    asked.push_back(request);
    Plan plan;
    plan.score = score_(request.surface);
    plan.solved = plan.score >= 0.5;
    plan.contacts.resize(plan.solved ? 3 : 2);
    if (!plan.solved) plan.failure = "contact 3 cannot be met";
    const int takes = plan.solved ? request.settings.takes : 1;
    return std::vector<Plan>(static_cast<std::size_t>(takes), plan);
  }

  mutable std::vector<PlanRequest> asked;

 private:
  Score score_;
};

class FitTest : public testing::Test {
 protected:
  FitTest() {
    request_.plan.body = &die_;
    request_.plan.signature.events = {{0, 0, 1, 0, 1}, {0.2, 0, 0.6, 0, 1}, {0.3, 0, 0.4, 0, 1}};
    request_.surfaces = die_.definition.surfaces;
    request_.first = "desk";
    static const test::TemporaryFolder kFolder;
    request_.cache = kFolder.path();  // what is learnt is the same for all tests
  }
  Fit fitWith(const PlannerByFormula& planner) {
    request_.planner = &planner;
    auto fit = planWithFit(request_, {});
    EXPECT_TRUE(fit.has_value());
    return fit.value_or(Fit{});
  }
  static double work(const PlannerByFormula& planner) {
    double sum = 0;
    for (const PlanRequest& request : planner.asked) sum += request.settings.effort;
    return sum;
  }

  Body die_ = loadObject("d6").value();
  FitRequest request_;
};

PlannerByFormula::Score peakAt(double restitution) {
  return [=](const SurfaceProperties& s) { return 1 - std::abs(s.restitution - restitution); };
}

TEST_F(FitTest, LooksWhereTheGivenOneMayBeOffByThirtyPercent) {
  EXPECT_DOUBLE_EQ(fitRange(0.5).least, 0.35);
  EXPECT_DOUBLE_EQ(fitRange(0.5).most, 0.5 / 0.7);
  EXPECT_DOUBLE_EQ(fitRange(0.9).most, 0.95);
  EXPECT_EQ(fitRange(0).most, 0);
  const auto candidates = fitCandidates(request_, {});
  ASSERT_EQ(candidates.size(), 2U);
  const auto range = fitRange(request_.surfaces.at("desk").restitution);
  for (const FitCandidate& candidate : candidates) {
    EXPECT_EQ(candidate.surface, "desk");
    EXPECT_GE(candidate.restitution, range.least);
    EXPECT_LE(candidate.restitution, range.most);
  }
  EXPECT_NE(candidates[0].restitution, candidates[1].restitution);
}

TEST_F(FitTest, OneContactTellsNothing) {
  request_.plan.signature.events.resize(1);
  const auto candidates = fitCandidates(request_, {});
  ASSERT_EQ(candidates.size(), 1U);
  EXPECT_EQ(candidates[0].restitution, request_.surfaces.at("desk").restitution);
}

TEST_F(FitTest, TakesTheBestThatItSaw) {
  const PlannerByFormula planner(peakAt(0.7));
  const Fit fit = fitWith(planner);
  double best = 0;
  for (const PlanRequest& asked : planner.asked) best = std::max(best, peakAt(0.7)(asked.surface));
  EXPECT_EQ(fit.plans.front().score, best);
  EXPECT_EQ(peakAt(0.7)(fit.request.surface), best);
  EXPECT_EQ(fit.given, request_.surfaces.at("desk").restitution);
  EXPECT_LE(work(planner), 3);
}

TEST_F(FitTest, AGoodFirstLookIsEnough) {
  const PlannerByFormula planner([](const SurfaceProperties&) { return 0.97; });
  const Fit fit = fitWith(planner);
  EXPECT_EQ(planner.asked.size(), 1U);
  EXPECT_LT(work(planner), 0.2);
  EXPECT_EQ(fit.request.settings.effort, 1);
}

TEST_F(FitTest, CostsAtMostThreePlansAndSaysWhatWasTried) {
  const PlannerByFormula planner([](const SurfaceProperties&) { return 0.2; });
  const Fit fit = fitWith(planner);
  EXPECT_GT(planner.asked.size(), 3U);
  EXPECT_LE(work(planner), 3);
  EXPECT_FALSE(fit.plans.front().solved);
  EXPECT_THAT(fit.plans.front().failure, HasSubstr("contact 3"));
  EXPECT_THAT(fit.plans.front().failure, HasSubstr("were tried"));
}

TEST_F(FitTest, EndsWithTheGivenOneWhereNothingElseDoes) {
  const double given = request_.surfaces.at("desk").restitution;
  request_.plan.signature.events = {{0, 0, 1, 0, 1}, {0.05, 0, 0.3, 0, 1}, {0.06, 0, 0.1, 0, 1}};
  const PlannerByFormula planner(
      [=](const SurfaceProperties& s) { return s.restitution == given ? 0.8 : 0.1; });
  const Fit fit = fitWith(planner);
  EXPECT_TRUE(fit.plans.front().solved);
  EXPECT_EQ(fit.request.surface.restitution, given);
  EXPECT_LE(work(planner), 3);
}

// A sound that takes all the passes there are is solved with --fit where it is solved without.
TEST_F(FitTest, TheGivenOneGetsAllThatItWouldGetAlone) {
  const double given = request_.surfaces.at("desk").restitution;
  for (const double estimate : {0.05, 0.2}) {  // s, of the gap that the estimate goes by
    request_.plan.signature.events[1].time = estimate;
    const PlannerByFormula planner([](const SurfaceProperties&) { return 0.2; });
    (void)fitWith(planner);
    EXPECT_TRUE(std::any_of(planner.asked.begin(), planner.asked.end(), [&](const auto& asked) {
      return asked.surface.restitution == given && asked.settings.effort == 1;
    }));
    EXPECT_LE(work(planner), 3);
  }
}

TEST_F(FitTest, IsNoWorseThanThePlanWithoutIt) {
  const double given = request_.surfaces.at("desk").restitution;
  request_.plan.signature.events = {{0, 0, 1, 0, 1}, {0.05, 0, 0.3, 0, 1}, {0.06, 0, 0.1, 0, 1}};
  const PlannerByFormula planner(
      [=](const SurfaceProperties& s) { return s.restitution == given ? 0.85 : 0.7; });
  const Fit fit = fitWith(planner);
  EXPECT_EQ(fit.plans.front().score, 0.85);
  EXPECT_EQ(fit.request.surface.restitution, given);
  EXPECT_LE(work(planner), 3);
}

TEST_F(FitTest, GivesAllTakesThatWereAskedFor) {
  request_.plan.settings.takes = 5;
  const PlannerByFormula planner(peakAt(0.8));
  EXPECT_EQ(fitWith(planner).plans.size(), 5U);
  EXPECT_LE(work(planner), 3);
}

TEST_F(FitTest, ChoosesAmongSurfaces) {
  SurfaceProperties felt = request_.surfaces.at("desk");
  felt.friction = 0.7;
  request_.surfaces["felt"] = felt;
  request_.surfaces["stone"] = request_.surfaces.at("desk");
  const PlannerByFormula planner(
      [](const SurfaceProperties& s) { return s.friction == 0.7 ? 0.9 : 0.6; });
  const Fit fit = fitWith(planner);
  EXPECT_EQ(fit.surface, "felt");
  EXPECT_EQ(fit.request.surface.friction, 0.7);
  EXPECT_EQ(fit.request.surface.referenceImpulse, felt.referenceImpulse);
  EXPECT_LE(work(planner), 3);
}

TEST_F(FitTest, SaysThatTheTimeLimitWasReached) {
  request_.plan.settings.timeLimitSeconds = 1e-6;
  const PlannerByFormula planner([](const SurfaceProperties&) { return 0.2; });
  const Fit fit = fitWith(planner);
  EXPECT_EQ(planner.asked.size(), 1U);  // something is always looked at
  EXPECT_TRUE(fit.plans.front().timeLimitReached);
}

TEST_F(FitTest, StopsWhenAsked) {
  const std::atomic<bool> stop{true};
  Progress progress;
  progress.stop = &stop;
  const auto planner = makePlanner("shoot").value();
  request_.planner = planner.get();
  const auto fit = planWithFit(request_, progress);
  ASSERT_FALSE(fit.has_value());
  EXPECT_EQ(fit.error().code, ErrorCode::kInterrupted);
}

TEST_F(FitTest, TheSameForAnyNumberOfThreads) {
  const auto planner = makePlanner("shoot").value();
  request_.planner = planner.get();
  request_.surfaces.at("desk").restitution = 0.6;
  request_.plan.settings.effort = 0.1;
  const auto run = [&](int threads) {
    setThreadCount(threads);
    auto fit = planWithFit(request_, {}).value();
    setThreadCount(0);
    return fit;
  };
  const Fit one = run(1), two = run(2);
  EXPECT_EQ(one.request.surface.restitution, two.request.surface.restitution);
  ASSERT_EQ(one.plans.front().contacts.size(), two.plans.front().contacts.size());
  EXPECT_EQ(one.plans.front().score, two.plans.front().score);
  EXPECT_FALSE(one.plans.front().contacts.empty());
}

}  // namespace
}  // namespace ifa
