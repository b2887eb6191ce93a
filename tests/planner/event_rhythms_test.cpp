// SPDX-License-Identifier: Apache-2.0
#include "planner/event_rhythms.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "planner/graph_plan_cases.h"
#include "support/drop_database.h"

namespace ifa {
namespace {

class EventRhythms : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    drops_ = new test::DropDatabase(test::graphDie(), test::graphDieSurface(), 300, 3);
    graph_ = new ContactGraph(test::graphOf(*drops_, test::graphDie()));
  }
  static void TearDownTestSuite() {
    delete graph_;
    delete drops_;
  }
  [[nodiscard]] static const EventDatabase& database() { return graph_->database(); }

  /// Signatures of events in a row, to the letter, and where each begins.
  [[nodiscard]] static std::vector<std::pair<ContactSignature, std::size_t>> cases(
      std::size_t count, bool terminal) {
    std::vector<std::pair<ContactSignature, std::size_t>> all;
    RandomStream random(1, 1);
    for (std::size_t first = 0; first + count <= database().events() && all.size() < 20;
         first += 7) {
      const auto signature = test::signatureFrom(*graph_, first, count, {0, 0}, random);
      if (signature && signature->terminal == terminal) all.emplace_back(*signature, first);
    }
    EXPECT_EQ(all.size(), 20U);
    return all;
  }

  static inline test::DropDatabase* drops_ = nullptr;
  static inline ContactGraph* graph_ = nullptr;
};

TEST_F(EventRhythms, FindsWhatTheSoundWasMadeOf) {
  for (const bool terminal : {false, true}) {
    for (const auto& [signature, first] : cases(5, terminal)) {
      for (std::size_t level = 0; level < 5; ++level) {
        const auto best = eventsInRhythm(database(), signature, level, database().events());
        const auto event = first + level;
        const auto own = std::find_if(best.begin(), best.end(), [&](const RhythmMatch& match) {
          return match.event == event;
        });
        ASSERT_NE(own, best.end()) << first << " " << level;
        EXPECT_NEAR(own->cost, 0, 1e-3);
        EXPECT_NEAR(best.front().cost, 0, 1e-3);
      }
    }
  }
}

TEST_F(EventRhythms, FewAreTheBestOfMany) {
  for (const auto& [signature, first] : cases(4, true)) {
    for (std::size_t level = 0; level < 4; ++level) {
      auto all = eventsInRhythm(database(), signature, level, database().events());
      EXPECT_TRUE(std::is_sorted(all.begin(), all.end(), [](const auto& a, const auto& b) {
        return a.cost != b.cost ? a.cost < b.cost : a.event < b.event;
      }));
      all.resize(std::min<std::size_t>(all.size(), 30));
      const auto few = eventsInRhythm(database(), signature, level, 30);
      ASSERT_EQ(few.size(), all.size());
      for (std::size_t i = 0; i < few.size(); ++i) {
        EXPECT_EQ(few[i].event, all[i].event) << first;
        EXPECT_EQ(few[i].cost, all[i].cost);
      }
    }
  }
}

TEST_F(EventRhythms, OnlyWhatRestsEndsAMotion) {
  for (const auto& [signature, first] : cases(3, true)) {
    for (std::size_t level = 0; level < 3; ++level) {
      for (const RhythmMatch& match : eventsInRhythm(database(), signature, level, 100)) {
        EXPECT_EQ(database().record(match.event).has(EventRecord::kTerminal), level == 2) << first;
      }
    }
  }
}

TEST_F(EventRhythms, AnotherGapCostsMore) {
  for (const auto& [signature, first] : cases(3, false)) {
    ContactSignature late = signature;
    for (std::size_t k = 1; k < 3; ++k) late.events[k].time += 0.02;
    const auto costOf = [&, at = first](const ContactSignature& what) {
      for (const RhythmMatch& match : eventsInRhythm(database(), what, 0, database().events())) {
        if (match.event == at) return match.cost;
      }
      return -1.0;
    };
    EXPECT_GT(costOf(late), costOf(signature) + 0.05);
  }
}

}  // namespace
}  // namespace ifa
