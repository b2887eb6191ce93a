// SPDX-License-Identifier: Apache-2.0
#include "studio/child_program.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <thread>

#include "studio/job_slots.h"

namespace ifa::studio {
namespace {

using testing::ElementsAre;
using Kind = ChildEnd::Kind;

ChildEnd runShell(
    const std::string& text, std::vector<std::string>* lines = nullptr,
    const std::function<bool()>& goOn = [] { return true; }) {
  return runChild("/bin/sh", {"-c", text},
                  {[lines](std::string_view line) {
                     if (lines != nullptr) lines->emplace_back(line);
                   },
                   goOn});
}

TEST(ChildProgram, TellsLinesOutputAndCode) {
  std::vector<std::string> lines;
  const ChildEnd end = runShell("echo a >&2; echo b; printf 'c\\nd' >&2; exit 4", &lines);
  EXPECT_EQ(end.kind, Kind::kExited);
  EXPECT_EQ(end.code, 4);
  EXPECT_EQ(end.output, "b\n");
  EXPECT_THAT(lines, ElementsAre("a", "c"));  // what has no end is no line
}

TEST(ChildProgram, SurvivesItsDeath) {
  EXPECT_EQ(runShell("kill -SEGV $$").kind, Kind::kCrashed);
  EXPECT_EQ(runShell("kill -KILL $$").kind, Kind::kCrashed);
  EXPECT_EQ(runChild("/no/such/program", {}, {[](std::string_view) {}, [] { return true; }}).code,
            127);
}

TEST(ChildProgram, EndsItWhenNobodyWantsItAnyMore) {
  const auto start = std::chrono::steady_clock::now();
  int asked = 0;
  const ChildEnd end = runShell("exec sleep 30", nullptr, [&asked] { return ++asked < 3; });
  EXPECT_EQ(end.kind, Kind::kCancelled);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(5));
}

TEST(ChildProgram, TakesNoMoreOutputThanItKeeps) {
  std::vector<std::string> lines;
  const ChildEnd end =
      runShell("yes | head -c 3000000; yes | tr -d '\\n' | head -c 3000000 >&2; echo >&2", &lines);
  EXPECT_EQ(end.output.size(), 65536U);
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_EQ(lines[0].size(), 65536U);
}

TEST(ChildProgram, SeesNoFileOfItsParent) {
  const int file = ::dup2(STDIN_FILENO, 77);
  ASSERT_EQ(file, 77);
  EXPECT_EQ(runShell("[ -e /proc/$$/fd/77 ] && echo open || echo closed").output, "closed\n");
  ::close(file);
}

TEST(JobSlots, RunOneAfterTheOtherAndRefuseTooMany) {
  JobSlots slots(1, 1);
  const auto go = [](std::size_t) { return true; };
  auto first = slots.enter();
  ASSERT_TRUE(first.queued());
  ASSERT_TRUE(first.wait(go));
  auto second = slots.enter();
  ASSERT_TRUE(second.queued());
  EXPECT_FALSE(slots.enter().queued());
  EXPECT_FALSE(second.wait([](std::size_t before) { return before == 0; }));  // one is before it
  std::thread ends(
      [held = std::move(first)] { std::this_thread::sleep_for(std::chrono::milliseconds(50)); });
  EXPECT_TRUE(second.wait(go));
  ends.join();
}

}  // namespace
}  // namespace ifa::studio
