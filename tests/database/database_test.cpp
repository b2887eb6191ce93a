// SPDX-License-Identifier: Apache-2.0
#include "database/database.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>

#include "database_files.h"
#include "support/box_body.h"
#include "support/temporary_folder.h"

namespace ifa {
namespace {

using testing::HasSubstr;

class DatabaseTest : public testing::Test {
 protected:
  void SetUp() override {
    header_.identity.bodyHash = hashOf(makeDieBody());
    test::writeDatabase(path_, header_);
    good_ = test::readText(path_);
  }
  [[nodiscard]] std::string whyRefused(const std::string& bytes) const {
    test::writeText(path_, bytes);
    const auto opened = EventDatabase::open(path_);
    if (opened) return {};
    EXPECT_EQ(opened.error().code, ErrorCode::kBadInput);
    EXPECT_EQ(opened.error().place, path_.string());
    EXPECT_FALSE(opened.error().remedy.empty());
    return opened.error().message;
  }
  /// The file with a changed header that is sealed as if it were right.
  template <class Change>
  [[nodiscard]] std::string withHeader(Change change) const {
    DatabaseHeader header;
    std::memcpy(static_cast<void*>(&header), good_.data(), sizeof header);
    change(header);
    seal(header);
    std::string bytes = good_;
    std::memcpy(bytes.data(), &header, sizeof header);
    return bytes;
  }

  test::TemporaryFolder folder_;
  std::filesystem::path path_ = folder_ / "d.ifadb";
  DatabaseHeader header_ = test::headerOfRange(0, 23, 23);
  std::string good_;
};

TEST_F(DatabaseTest, GivesBackWhatWasWritten) {
  const auto database = EventDatabase::open(path_);
  ASSERT_TRUE(database) << database.error().text();
  EXPECT_TRUE(database->check());
  EXPECT_EQ(database->simulations(), 23U);
  std::size_t event = 0;
  for (std::uint64_t i = 0; i < 23; ++i) {
    EXPECT_EQ(database->firstEvent(i), event);
    for (std::uint32_t k = 0; k < i % 4; ++k, ++event) {
      const EventRecord record = database->record(event), expected = test::makeRecord(i, k);
      EXPECT_EQ(std::memcmp(&record, &expected, sizeof record), 0);
      EXPECT_EQ(database->nameOf(event).simulation, i);
      EXPECT_EQ(database->nameOf(event).event, k);
      EXPECT_EQ(database->values(kGap)[event], expected.gap);
      EXPECT_EQ(database->values(kBeforeHeight)[event], expected.before.height);
      EXPECT_EQ(database->values(kAfterSpinZ)[event], expected.after.angularVelocity[2]);
      EXPECT_EQ(database->values(kNextY)[event], expected.next[1]);
      EXPECT_EQ(database->flags()[event], expected.flags);
    }
  }
  EXPECT_EQ(database->events(), event);
  EXPECT_EQ(database->firstEvent(23), event);
}

TEST_F(DatabaseTest, ColumnsAreAligned) {
  const auto database = EventDatabase::open(path_);
  ASSERT_TRUE(database);
  for (std::size_t i = 0; i < kColumns; ++i) {
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(database->bytes(i).data()) % 64, 0U);
  }
}

TEST_F(DatabaseTest, IsThereOrNotButNeverHalf) {
  EXPECT_THAT(folder_.names(), testing::ElementsAre("d.ifadb"));
}

TEST_F(DatabaseTest, MayHaveNoEvents) {
  test::writeDatabase(folder_ / "none", test::headerOfRange(0, 1, 1));
  const auto database = EventDatabase::open(folder_ / "none");
  ASSERT_TRUE(database);
  EXPECT_TRUE(database->check());
  EXPECT_EQ(database->events(), 0U);
}

TEST_F(DatabaseTest, StaysWhatItWasWhenTheFileIsReplaced) {
  const auto database = EventDatabase::open(path_);
  ASSERT_TRUE(database);
  const std::uint64_t hash = database->hash();
  test::writeDatabase(path_, test::headerOfRange(0, 5, 5));
  EXPECT_TRUE(database->check());
  EXPECT_NE(EventDatabase::open(path_)->hash(), hash);
}

TEST_F(DatabaseTest, RefusesWhatIsNoDatabase) {
  EXPECT_THAT(whyRefused(""), HasSubstr("is not an event database"));
  EXPECT_THAT(whyRefused("IFA"), HasSubstr("is not an event database"));
  EXPECT_THAT(whyRefused("RIFF" + good_), HasSubstr("is not an event database"));
  EXPECT_THAT(EventDatabase::open(folder_ / "no").error().text(), HasSubstr("no such file"));
  EXPECT_THAT(EventDatabase::open(folder_.path()).error().text(), HasSubstr("is not a file"));
}

TEST_F(DatabaseTest, RefusesAFileThatIsCutOffAnywhere) {
  for (std::size_t length = 8; length < good_.size(); length += 97) {
    EXPECT_THAT(whyRefused(good_.substr(0, length)), HasSubstr("is cut off")) << length;
  }
  EXPECT_THAT(whyRefused(good_ + "x"), HasSubstr("has 1 bytes more"));
}

TEST_F(DatabaseTest, RefusesAnotherVersion) {
  EXPECT_THAT(whyRefused(withHeader([](auto& header) { header.version = 0; })),
              HasSubstr("is of the older version 0"));
  EXPECT_THAT(whyRefused(withHeader([](auto& header) { header.version = 99; })),
              HasSubstr("is of the newer version 99"));
  EXPECT_THAT(whyRefused(withHeader([](auto& header) { --header.identity.simulationVersion; })),
              HasSubstr("was simulated by version"));
}

TEST_F(DatabaseTest, RefusesCountsAndPlacesThatCannotBe) {
  const auto refused = [&](auto change) { return whyRefused(withHeader(change)); };
  EXPECT_NE(refused([](auto& header) { header.events = ~std::uint64_t{0} / 8; }), "");
  EXPECT_NE(refused([](auto& header) { ++header.events; }), "");
  EXPECT_NE(refused([](auto& header) { header.simulations += 64; }), "");
  EXPECT_NE(refused([](auto& header) { header.columns[3].offset = 1 << 30; }), "");
  EXPECT_NE(refused([](auto& header) { header.columns[3].bytes = 1 << 30; }), "");
  EXPECT_EQ(refused([](auto& header) { header.firstSimulation = 0; }), "");
}

TEST_F(DatabaseTest, RefusesABuildThatIsNotDone) {
  auto journal = Journal::create(path_, header_);
  ASSERT_TRUE(journal);
  EXPECT_THAT(whyRefused(test::readText(journalPath(path_))), HasSubstr("is a build that is not"));
}

TEST_F(DatabaseTest, EveryFlippedBitIsFound) {
  auto file = RawFile::open(path_, RawFile::Mode::kUpdate);
  ASSERT_TRUE(file);
  for (std::size_t at = 0; at < good_.size(); ++at) {
    const auto put = [&](int value) {
      const std::array bytes = {static_cast<std::byte>(value)};
      ASSERT_TRUE(file->write(bytes, at));
    };
    put(good_[at] ^ (1 << (at % 8)));
    const auto opened = EventDatabase::open(path_);
    EXPECT_EQ(opened.has_value(), at >= sizeof(DatabaseHeader)) << at;
    if (opened) {
      EXPECT_THAT(opened->check().error().text(), HasSubstr("is damaged")) << at;
    }
    put(good_[at]);
  }
  EXPECT_TRUE(EventDatabase::open(path_)->check());
}

TEST_F(DatabaseTest, StaysInBoundsWhenTheTableOfSimulationsIsDamaged) {
  DatabaseHeader header;
  std::memcpy(static_cast<void*>(&header), good_.data(), sizeof header);
  std::string bytes = good_;
  std::memset(bytes.data() + header.columns[kFirstEvents].offset, 0xff, 16);
  test::writeText(path_, bytes);
  const auto database = EventDatabase::open(path_);
  ASSERT_TRUE(database);
  EXPECT_LE(database->firstEvent(0), database->events());
  EXPECT_LE(database->firstEvent(1), database->events());
  (void)database->nameOf(0);
}

TEST_F(DatabaseTest, KnowsItsBody) {
  const auto database = EventDatabase::open(path_);
  ASSERT_TRUE(database);
  EXPECT_TRUE(database->checkBody(makeDieBody()));
  Body other = makeDieBody();
  other.mass *= 1.01;
  const auto wrong = database->checkBody(other);
  ASSERT_FALSE(wrong);
  EXPECT_THAT(wrong.error().text(), HasSubstr("was made of another body: thing"));
}

TEST_F(DatabaseTest, KnowsWhatItWasMadeWith) {
  const auto database = EventDatabase::open(path_);
  ASSERT_TRUE(database);
  DatabaseIdentity wanted = header_.identity;
  EXPECT_TRUE(database->checkIdentity(wanted));
  wanted.settings.restitution = 0.7;
  EXPECT_THAT(database->checkIdentity(wanted).error().text(),
              HasSubstr("restitution 0.5 there, 0.7 here"));
}

TEST_F(DatabaseTest, CheckingStopsWhenAsked) {
  const std::atomic<bool> stop = true;
  const auto checked = EventDatabase::open(path_)->check({{}, &stop});
  ASSERT_FALSE(checked);
  EXPECT_EQ(checked.error().code, ErrorCode::kInterrupted);
}

}  // namespace
}  // namespace ifa
