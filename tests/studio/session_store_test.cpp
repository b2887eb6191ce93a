// SPDX-License-Identifier: Apache-2.0
#include "studio/session_store.h"

#include <gtest/gtest.h>

#include <chrono>
#include <set>

#include "support/temporary_folder.h"

namespace ifa::studio {
namespace {

namespace fs = std::filesystem;

TEST(SessionStore, NamesAreItsOwnAndAllDifferent) {
  const test::TemporaryFolder folder;
  const auto store = SessionStore::open(folder / "studio");
  ASSERT_TRUE(store);
  std::set<std::string> names;
  for (int i = 0; i < 20; ++i) names.insert(*(*store)->create());
  EXPECT_EQ(names.size(), 20U);
  for (const auto& name : names) EXPECT_TRUE((*store)->folder(name));
  EXPECT_EQ(fs::status(folder / "studio").permissions(), fs::perms::owner_all);
}

TEST(SessionStore, NoOtherTextLeadsAnywhere) {
  const test::TemporaryFolder folder;
  const auto store = SessionStore::open(folder / "studio");
  ASSERT_TRUE(store);
  const std::string name = *(*store)->create();
  for (const std::string& text :
       {std::string(), std::string("."), std::string(".."), std::string("../studio/") + name,
        name + "/", name + "/..", name.substr(1), std::string(32, 'A'), std::string(32, '0')}) {
    EXPECT_FALSE((*store)->folder(text)) << text;
    EXPECT_FALSE((*store)->createPlan(text)) << text;
  }
  ASSERT_EQ((*store)->createPlan(name), 1);
  EXPECT_TRUE((*store)->planFolder(name, "1"));
  for (const char* text :
       {"", "0", "01", "2", "-1", "+1", "1 ", "1/..", "..", "1e0", "99999999999999"}) {
    EXPECT_FALSE((*store)->planFolder(name, text)) << text;
  }
}

TEST(SessionStore, KeepsTheNewestPlansAndSessions) {
  const test::TemporaryFolder folder;
  const auto store = SessionStore::open(folder / "studio");
  ASSERT_TRUE(store);
  const std::string first = *(*store)->create();
  for (int plan = 1; plan <= 5; ++plan) {
    ASSERT_EQ((*store)->createPlan(first), plan);
    (*store)->keepPlansUpTo(first, plan);
  }
  EXPECT_FALSE((*store)->planFolder(first, "2"));
  EXPECT_TRUE((*store)->planFolder(first, "3"));
  fs::last_write_time(*(*store)->folder(first),
                      fs::file_time_type::clock::now() - std::chrono::hours(1));
  for (std::size_t i = 0; i < SessionStore::kMaxSessions; ++i) ASSERT_TRUE((*store)->create());
  EXPECT_FALSE((*store)->folder(first));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder / "studio"), fs::directory_iterator()),
            static_cast<std::ptrdiff_t>(SessionStore::kMaxSessions));
}

}  // namespace
}  // namespace ifa::studio
