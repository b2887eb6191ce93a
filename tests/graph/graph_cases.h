// SPDX-License-Identifier: Apache-2.0
// Questions to the graphs of simulated drops.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <vector>

#include "base/random.h"
#include "graph/contact_graph.h"
#include "support/box_body.h"
#include "support/drop_database.h"

namespace ifa::test {

struct Question {
  TransitionSource source;
  TransitionTarget target;
};

/// Contacts of drops, and what followed them, changed a little.
inline std::vector<Question> questions(const DropDatabase& drops, std::size_t count) {
  const EventDatabase database = drops.open();
  std::vector<Question> all;
  for (std::size_t q = 0; all.size() < count; ++q) {
    RandomStream random(5, q);
    const std::size_t i = random.below(database.events() - 1);
    const EventRecord from = database.record(i);
    if (!from.has(EventRecord::kFollowed) || from.has(EventRecord::kSilentPassage)) continue;
    const double first = database.header().identity.settings.referenceImpulse;
    HeardEvent heard = heardEvent(database, i + 1, first);
    heard.amplitude *= random.uniform(0.7, 1.3);
    all.push_back({{unpack(from.before), unpack(from.after)},
                   {from.gap * random.uniform(0.9, 1.1), heard,
                    database.record(i + 1).has(EventRecord::kTerminal), first}});
  }
  return all;
}

inline void expectSame(const std::vector<Transition>& a, const std::vector<Transition>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].sibling, b[i].sibling);
    EXPECT_EQ(a[i].total, b[i].total);
    EXPECT_EQ(a[i].symmetry, b[i].symmetry);
  }
}

}  // namespace ifa::test
