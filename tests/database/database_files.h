// SPDX-License-Identifier: Apache-2.0
// Small databases of made-up events.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <filesystem>

#include "base/random.h"
#include "database/journal.h"
#include "dynamics/simulator.h"

namespace ifa::test {

inline DatabaseHeader headerOfRange(std::uint64_t first, std::uint64_t count, std::uint64_t all) {
  DatabaseHeader header;
  header.identity.simulationVersion = kSimulationVersion;
  header.identity.seed = 7;
  header.identity.allSimulations = all;
  header.identity.settings.restitution = 0.5;
  header.identity.settingsHash = hashOf(header.identity.settings);
  setName(header.identity.object, "thing");
  header.firstSimulation = first;
  header.simulations = count;
  return header;
}

inline EventRecord makeRecord(std::uint64_t simulation, std::uint32_t event) {
  RandomStream random(simulation, event);
  std::array<float, EventRecord::kFloats> values{};
  for (float& value : values) value = static_cast<float>(random.uniform(-1, 1));
  EventRecord record;
  std::memcpy(static_cast<void*>(&record), values.data(), sizeof values);
  record.flags = static_cast<std::uint32_t>(random.below(16));
  return record;
}

/// Simulation i has i % 4 events.
inline EventBlock makeBlock(std::uint64_t first, std::uint64_t count) {
  EventBlock block;
  block.firstSimulation = first;
  for (std::uint64_t i = first; i < first + count; ++i) {
    block.counts.push_back(static_cast<std::uint32_t>(i % 4));
    for (std::uint32_t k = 0; k < i % 4; ++k) block.records.push_back(makeRecord(i, k));
  }
  return block;
}

/// Appends what the journal lacks of the range, `size` simulations a block.
inline void fillJournal(Journal& journal, const DatabaseHeader& header, std::uint64_t size) {
  while (journal.simulations() < header.simulations) {
    const std::uint64_t done = journal.simulations();
    const std::uint64_t count = std::min(size, header.simulations - done);
    ASSERT_TRUE(journal.append(makeBlock(header.firstSimulation + done, count)));
  }
}

inline void writeDatabase(const std::filesystem::path& path, const DatabaseHeader& header,
                          std::uint64_t size = 5) {
  auto journal = Journal::create(path, header);
  ASSERT_TRUE(journal);
  fillJournal(*journal, header, size);
  const auto assembled = journal->assemble(path, [](double) {});
  ASSERT_TRUE(assembled) << assembled.error().text();
  journal->remove();
}

}  // namespace ifa::test
