// SPDX-License-Identifier: Apache-2.0
// Chains of many simulations at a time have the records that each has alone.
#include "sampler/chain_batch.h"

#include <gtest/gtest.h>

#include <cstring>
#include <string>

#include "body/object_file.h"
#include "sampler/drop_statistics.h"
#include "sampler/initial_state.h"

namespace ifa {
namespace {

bool sameBits(const EventRecord& a, const EventRecord& b) {
  return a.before == b.before && a.after == b.after && a.shift == b.shift &&
         a.duration == b.duration && a.amplitude == b.amplitude && a.centroid == b.centroid &&
         a.gap == b.gap && a.next == b.next && a.flags == b.flags;
}

class ChainBatchTest : public testing::TestWithParam<std::string> {};

TEST_P(ChainBatchTest, HasTheRecordsOfEachAlone) {
  const auto body = loadObject(GetParam());
  ASSERT_TRUE(body) << body.error().text();
  const auto& surface = body->definition.surfaces.at(body->definition.defaultSurface);
  const BodyModel model(*body, surface);
  const RecorderSettings cut = audibleCut(*body, surface);
  std::vector<RigidState> starts;
  for (std::size_t i = 0; i < 70; ++i) starts.push_back(sampleInitialState(*body, 6, i));
  // 0.3 s cut every simulation off; 20 s let it come to rest.
  for (const double timeLimit : {0.3, 20.0}) {
    std::vector<std::vector<EventRecord>> alone(starts.size());
    EventChain chain(model, cut);
    for (std::size_t i = 0; i < starts.size(); ++i) chain.simulate(starts[i], timeLimit, alone[i]);
    for (const std::size_t places : {std::size_t{1}, std::size_t{7}, BatchStepper::kPlaces}) {
      ChainBatch batch(model, cut, places);
      // Used twice: nothing of the first time is left.
      for (int time = 0; time < 2; ++time) {
        const auto together = batch.simulate(starts, timeLimit);
        ASSERT_EQ(together.size(), alone.size());
        for (std::size_t i = 0; i < alone.size(); ++i) {
          ASSERT_EQ(together[i].size(), alone[i].size()) << i;
          for (std::size_t k = 0; k < alone[i].size(); ++k) {
            EXPECT_TRUE(sameBits(together[i][k], alone[i][k])) << i << ", " << k;
          }
        }
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Objects, ChainBatchTest, testing::Values("d6", "CoffeeCup"));

}  // namespace
}  // namespace ifa
