// SPDX-License-Identifier: Apache-2.0
// The corpora of the fuzzers, which hold what they have found, as tests of every build.
#include <gtest/gtest.h>

#include <filesystem>
#include <ostream>

#include "fuzz/fuzz_targets.h"
#include "support/temporary_folder.h"

namespace ifa::fuzz {

void PrintTo(const Target& target, std::ostream* stream) { *stream << target.name; }

namespace {

class Corpus : public testing::TestWithParam<Target> {};

TEST_P(Corpus, IsReadOrRefused) {
  const auto folder = std::filesystem::path(IFA_SOURCE_DIR) / "tests/fuzz/corpus" / GetParam().name;
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    SCOPED_TRACE(entry.path().string());
    const std::string bytes = test::readText(entry.path());
    GetParam().run(bytes);
    ++count;
    // Cut off anywhere, too: but no mesh, as assimp takes all the time that it has over some, nor
    // Ogg, of which libsndfile 1.2.0 leaks where it gives up.
    if (GetParam().name == "mesh" || entry.path().extension() == ".ogg") continue;
    for (std::size_t part = 0; part < 8; ++part) {
      GetParam().run(bytes.substr(0, bytes.size() * part / 8));
    }
  }
  EXPECT_GT(count, 0);
}

INSTANTIATE_TEST_SUITE_P(Targets, Corpus, testing::ValuesIn(kTargets),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace ifa::fuzz
