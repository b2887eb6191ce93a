// SPDX-License-Identifier: Apache-2.0
#include "export/motion_csv.h"

#include <gtest/gtest.h>

#include <map>
#include <sstream>

#include "audit/analytic_motion.h"
#include "base/file.h"
#include "support/temporary_folder.h"

namespace ifa {
namespace {

/// A table by the names of its columns; fields as they stand there.
std::map<std::string, std::vector<std::string>> readTable(const std::string& text) {
  const auto split = [](const std::string& line) {
    std::vector<std::string> fields;
    std::istringstream stream(line);
    for (std::string field; std::getline(stream, field, ',');) fields.push_back(field);
    return fields;
  };
  std::istringstream lines(text);
  std::string line;
  std::getline(lines, line);
  const auto names = split(line);
  std::map<std::string, std::vector<std::string>> table;
  while (std::getline(lines, line)) {
    const auto fields = split(line);
    EXPECT_EQ(fields.size(), names.size()) << line;
    for (std::size_t i = 0; i < std::min(fields.size(), names.size()); ++i) {
      table[names[i]].push_back(fields[i]);
    }
  }
  return table;
}

Motion bouncing() {
  Motion motion = test::makeTumblingMotion(test::makeDrawableBox());
  motion.sound.firstContact = 0.375;
  return motion;
}

TEST(MotionCsv, ReadsBackToTheSameBits) {
  const Motion motion = bouncing();
  const auto table = readTable(formatPoses(motion));
  ASSERT_EQ(table.at("time").size(), motion.trajectory.size());
  for (std::size_t i = 0; i < motion.trajectory.size(); ++i) {
    const MotionSample& sample = motion.trajectory[i];
    EXPECT_EQ(std::stod(table.at("time")[i]), sample.time);
    EXPECT_EQ(std::stod(table.at("sound_time")[i]), sample.time + 0.375);
    EXPECT_EQ(std::stod(table.at("z")[i]), sample.position.z());
    EXPECT_EQ(std::stod(table.at("qw")[i]), sample.orientation.w());
    EXPECT_EQ(std::stod(table.at("vz")[i]), sample.velocity.z());
    EXPECT_EQ(std::stod(table.at("wx")[i]), sample.angularVelocity.x());
  }
}

TEST(MotionCsv, ListsEveryContact) {
  Motion motion = bouncing();
  motion.contacts.back().arrival = Arrival::kSilentContact;
  const auto table = readTable(formatContacts(motion));
  ASSERT_EQ(table.at("contact").size(), motion.contacts.size());
  for (std::size_t i = 0; i < motion.contacts.size(); ++i) {
    const MotionContact& contact = motion.contacts[i];
    EXPECT_EQ(table.at("contact")[i], std::to_string(i + 1));
    EXPECT_EQ(std::stod(table.at("sound_time")[i]), contact.time + 0.375);
    EXPECT_EQ(std::stod(table.at("bend")[i]), contact.bend);
    EXPECT_EQ(std::stod(table.at("target_time")[i]), contact.targetTime);
    EXPECT_EQ(table.at("terminal")[i], contact.terminal ? "1" : "0");
  }
  EXPECT_EQ(table.at("arrival").back(), "silent_contact");
}

TEST(MotionCsv, WritesBothTablesOrSaysWhichCannotBe) {
  const test::TemporaryFolder folder;
  ASSERT_TRUE(writeCsv(folder.path(), bouncing()));
  EXPECT_EQ(readFile(folder / "motion.csv", 1 << 24).value(), formatPoses(bouncing()));
  EXPECT_EQ(readFile(folder / "contacts.csv", 1 << 24).value(), formatContacts(bouncing()));
  const auto refused = writeCsv(folder / "gone", bouncing());
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().place, (folder / "gone" / "motion.csv").string());
}

}  // namespace
}  // namespace ifa
