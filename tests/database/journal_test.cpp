// SPDX-License-Identifier: Apache-2.0
#include "database/journal.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "database_files.h"
#include "support/temporary_folder.h"

namespace ifa {
namespace {

using testing::HasSubstr;

class JournalTest : public testing::Test {
 protected:
  void SetUp() override {
    test::writeDatabase(folder_ / "whole", header_);
    whole_ = test::readText(folder_ / "whole");
    auto journal = Journal::create(path_, header_);
    ASSERT_TRUE(journal);
    test::fillJournal(*journal, header_, 5);
    part_ = test::readText(journalPath(path_));
  }
  /// What a build that goes on with `part` makes of it.
  [[nodiscard]] std::string goOn(const std::string& part, std::uint64_t& kept) const {
    test::writeText(journalPath(path_), part);
    auto journal = Journal::resume(path_, header_);
    if (!journal) return journal.error().text();
    if (!*journal) journal->emplace(std::move(*Journal::create(path_, header_)));
    kept = (*journal)->simulations();
    // Blocks of another size give the same file.
    test::fillJournal(**journal, header_, 4);
    EXPECT_TRUE((*journal)->assemble(path_, [](double) {}));
    return test::readText(path_);
  }

  test::TemporaryFolder folder_;
  std::filesystem::path path_ = folder_ / "d.ifadb";
  DatabaseHeader header_ = test::headerOfRange(3, 20, 40);
  std::string whole_, part_;
};

TEST_F(JournalTest, GoesOnWhereverItWasCutOff) {
  std::uint64_t kept = 0, before = 0;
  for (std::size_t length = 0; length < part_.size(); length += length < 4090 ? 409 : 61) {
    ASSERT_EQ(goOn(part_.substr(0, length), kept), whole_) << length;
    EXPECT_GE(kept, before);
    EXPECT_EQ(kept % 5, 0U);
    before = kept;
  }
  EXPECT_EQ(before, 15U);
  ASSERT_EQ(goOn(part_, kept), whole_);
  EXPECT_EQ(kept, 20U);
}

TEST_F(JournalTest, GoesOnBeforeABlockThatIsDamaged) {
  for (std::size_t at = sizeof(DatabaseHeader); at < part_.size(); at += 67) {
    std::string bad = part_;
    bad[at] = static_cast<char>(bad[at] ^ 4);
    std::uint64_t kept = 0;
    ASSERT_EQ(goOn(bad, kept), whole_) << at;
    EXPECT_LT(kept, 20U);
  }
}

TEST_F(JournalTest, GoesOnBeforeWhatADiskLeftAsZeros) {
  std::uint64_t kept = 99;
  ASSERT_EQ(goOn(part_.substr(0, sizeof(DatabaseHeader)) + std::string(5000, '\0'), kept), whole_);
  EXPECT_EQ(kept, 0U);
}

TEST_F(JournalTest, RefusesAForeignOrDamagedFile) {
  std::uint64_t kept = 0;
  std::string bad = part_;
  bad[100] = static_cast<char>(bad[100] ^ 1);
  EXPECT_THAT(goOn(bad, kept), HasSubstr("has a damaged header (remove it"));
  EXPECT_THAT(goOn(std::string(5000, 'x'), kept), HasSubstr("is not an event database"));
}

TEST_F(JournalTest, RefusesAnotherBuildAndSaysWhatDiffers) {
  const auto refusal = [&](const DatabaseHeader& wanted) {
    const auto journal = Journal::resume(path_, wanted);
    return journal ? std::string() : journal.error().text();
  };
  DatabaseHeader wanted = header_;
  EXPECT_EQ(refusal(wanted), "");
  wanted.identity.seed = 8;
  EXPECT_THAT(refusal(wanted), HasSubstr("seed 7 there, 8 here"));
  wanted = header_;
  wanted.identity.settings.restitution = 0.25;
  EXPECT_THAT(refusal(wanted), HasSubstr("restitution 0.5 there, 0.25 here"));
  wanted = header_;
  wanted.identity.bodyHash = 1;
  EXPECT_THAT(refusal(wanted), HasSubstr("shape or mass of the body"));
  wanted = header_;
  wanted.identity.backend = Backend::kOde;
  EXPECT_THAT(refusal(wanted), HasSubstr("backend native there, ode here"));
  wanted = test::headerOfRange(3, 21, 40);
  EXPECT_THAT(refusal(wanted), HasSubstr("simulations 3 to 22 there, 3 to 23 here"));
}

TEST_F(JournalTest, IsNotThereWhereNothingWasBegun) {
  const auto journal = Journal::resume(folder_ / "other", header_);
  ASSERT_TRUE(journal);
  EXPECT_FALSE(journal->has_value());
}

}  // namespace
}  // namespace ifa
