// SPDX-License-Identifier: Apache-2.0
// `ifa sync` from the shell's side: files, exit codes, streams.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <tuple>

#include "ifa/film.h"
#include "run_program.h"
#include "support/clicks.h"
#include "support/temporary_folder.h"

namespace ifa::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::HasSubstr;
using testing::IsEmpty;

// The rhythm of an eraser that bounces a few times and clatters to rest; the recording starts later
// than the pre-roll.
const std::vector<Click> kThrow = {
    {0.20, 0.9}, {0.38, 0.63}, {0.49, 0.45}, {0.56, 0.36}, {0.62, 0.36}};
constexpr double kClatter = 0.06;

class Sync : public testing::Test {
 protected:
  void SetUp() override {
    writeClicks(folder_ / "throw.wav", kThrow, 1.2);
    writeClickLabels(folder_ / "throw.txt", kThrow, kClatter);
  }
  std::vector<std::string> command(const std::string& out,
                                   const std::vector<std::string>& more = {}) const {
    std::vector<std::string> words = {
        "sync", folder_ / "throw.wav", "--labels", folder_ / "throw.txt", "--object", object_,
        "-o",   folder_ / out};
    // A film takes a while; one test sees that there is one by default.
    const bool hasFormats = std::find(more.begin(), more.end(), "--formats") != more.end();
    if (!withFilm_ && !hasFormats) words.insert(words.end(), {"--formats", "json,glb"});
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }
  json motion(const std::string& out) const {
    return json::parse(readText(folder_ / out / "motion.json"));
  }
  TemporaryFolder folder_;
  std::string object_ = "Eraser";
  bool withFilm_ = false;
};

TEST_F(Sync, PutsEveryContactOnTheSound) {
  const auto result = runProgram(command("out"));
  ASSERT_EQ(result.exit, 0) << result.err;
  EXPECT_THAT(result.err, IsEmpty());
  const auto found = motion("out");
  EXPECT_TRUE(found.at("success").get<bool>());
  ASSERT_EQ(found.at("contacts").size(), kThrow.size());
  for (std::size_t i = 0; i < kThrow.size(); ++i) {
    const auto& contact = found.at("contacts")[i];
    EXPECT_NEAR(contact.at("time").get<double>(), kThrow[i].time - kThrow[0].time, 1e-4);
    EXPECT_NEAR(contact.at("target_time").get<double>(), kThrow[i].time - kThrow[0].time, 1e-9);
  }
}

TEST_F(Sync, WritesAFolderThatStandsAlone) {
  withFilm_ = true;
  ASSERT_EQ(runProgram(command("out")).exit, 0);
  const auto found = motion("out");
  for (const char* name :
       {"motion.json", "motion.glb", "sound.wav", "timeline.svg", "Eraser.json"}) {
    EXPECT_GT(fs::file_size(folder_ / "out" / name), 0U) << name;
  }
  EXPECT_EQ(fs::exists(folder_ / "out/motion.mp4"), filmsCanBeWritten());
  EXPECT_TRUE(fs::exists(folder_ / "out" / found.at("object").at("mesh").get<std::string>()));
  // Silence was put in front, so that the motion begins within the sound.
  const double begin = found.at("trajectory").at("time").front().get<double>();
  const double firstContact = found.at("sound").at("first_contact").get<double>();
  EXPECT_GE(firstContact + begin, -1e-9);
  EXPECT_NEAR(found.at("sound").at("duration").get<double>(), 1.2 + firstContact - 0.2, 1e-4);
  EXPECT_EQ(runProgram({"verify", folder_ / "out/motion.json"}).exit, 0);
}

TEST_F(Sync, ListsWhatItWrote) {
  ASSERT_EQ(runProgram(command("out", {"--formats", "glb,csv"})).exit, 0);
  const auto manifest = json::parse(readText(folder_ / "out/manifest.json"));
  EXPECT_EQ(manifest.at("object"), "Eraser");
  EXPECT_TRUE(manifest.at("success").get<bool>());
  std::map<std::string, std::string> roles;
  for (const auto& file : manifest.at("files")) {
    const std::string name = file.at("name");
    EXPECT_EQ(fs::file_size(folder_ / "out" / name), file.at("bytes").get<std::size_t>()) << name;
    roles[name] = file.at("role");
  }
  EXPECT_EQ(roles.at("motion.glb"), "animation");
  EXPECT_EQ(roles.at("contacts.csv"), "contacts");
  EXPECT_EQ(roles.at("Eraser.json"), "object");
  std::size_t others = 0;
  for (const auto& entry : fs::directory_iterator(folder_ / "out")) {
    others += roles.count(entry.path().filename().string()) == 0 ? 1 : 0;
  }
  EXPECT_EQ(others, 1U) << "only the manifest itself is not listed";
}

TEST_F(Sync, WritesTheFormatsThatAreAskedFor) {
  ASSERT_EQ(runProgram(command("out", {"--formats", "csv,usda"})).exit, 0);
  for (const char* name : {"motion.json", "motion.csv", "contacts.csv", "motion.usda"}) {
    EXPECT_GT(fs::file_size(folder_ / "out" / name), 0U) << name;
  }
  EXPECT_FALSE(fs::exists(folder_ / "out/motion.glb"));
  EXPECT_NE(readText(folder_ / "out/motion.usda").find("@./sound.wav@"), std::string::npos);
  // What an earlier run left and this one did not make would belong to another motion.
  ASSERT_EQ(runProgram(command("out", {"--formats", "glb", "--glb-set"})).exit, 0);
  EXPECT_NE(readText(folder_ / "out/motion.glb").find("KHR_lights_punctual"), std::string::npos);
  EXPECT_FALSE(fs::exists(folder_ / "out/motion.csv"));
  EXPECT_FALSE(fs::exists(folder_ / "out/motion.usda"));
}

// The one field that tells of this run and not of the motion.
std::string withoutTiming(const std::string& text) {
  return std::regex_replace(text, std::regex("\"search_seconds\": *[-+.0-9e]+"), "");
}

TEST_F(Sync, GivesTheSameMotionForAnyNumberOfThreads) {
  ASSERT_EQ(runProgram(command("one", {"--threads", "1"})).exit, 0);
  ASSERT_EQ(runProgram(command("two", {"--threads", "2"})).exit, 0);
  const auto one = withoutTiming(readText(folder_ / "one/motion.json"));
  EXPECT_EQ(one, withoutTiming(readText(folder_ / "two/motion.json")));
  EXPECT_EQ(readText(folder_ / "one/motion.glb"), readText(folder_ / "two/motion.glb"));
  ASSERT_EQ(runProgram(command("other", {"--seed", "2"})).exit, 0);
  EXPECT_NE(one, withoutTiming(readText(folder_ / "other/motion.json")));
}

TEST_F(Sync, GivesSeveralTakesInFoldersOfTheirOwn) {
  ASSERT_EQ(runProgram(command("out", {"--takes", "2", "--formats", "json"})).exit, 0);
  const auto first = json::parse(readText(folder_ / "out/take-1/motion.json"));
  const auto second = json::parse(readText(folder_ / "out/take-2/motion.json"));
  EXPECT_GE(first.at("score").get<double>(), second.at("score").get<double>());
  EXPECT_NE(first.at("trajectory"), second.at("trajectory"));
  EXPECT_FALSE(fs::exists(folder_ / "out/take-1/motion.glb"));
  // One motion afterwards replaces them, and leaves what is the user's.
  writeText(folder_ / "out/mine.txt", "x");
  ASSERT_EQ(runProgram(command("out", {"--formats", "json"})).exit, 0);
  EXPECT_FALSE(fs::exists(folder_ / "out/take-1/motion.json"));
  EXPECT_TRUE(fs::exists(folder_ / "out/mine.txt"));
}

TEST_F(Sync, LooksForTheRestitutionAndTellsWhichItTook) {
  const auto result = runProgram(command("out", {"--fit", "--restitution", "0.5"}));
  ASSERT_EQ(result.exit, 0) << result.err;
  const auto found = motion("out");
  EXPECT_EQ(found.at("fit").at("given_surface"), "desk");
  EXPECT_EQ(found.at("fit").at("given_restitution"), 0.5);
  const double used = found.at("object").at("restitution").get<double>();
  EXPECT_GE(used, 0.35);
  EXPECT_LE(used, 0.5 / 0.7);
  EXPECT_THAT(result.out, HasSubstr("(0.50 was given)"));
  // The object beside it is the one as used, and the motion holds its audit with it.
  const auto object = json::parse(readText(folder_ / "out/Eraser.json"));
  EXPECT_EQ(object.at("surfaces").at("desk").at("restitution").get<double>(), used);
  EXPECT_EQ(runProgram({"verify", folder_ / "out/motion.json"}).exit, 0);
}

TEST_F(Sync, ShowsTheFaceThatIsAskedFor) {
  object_ = "d6";
  for (const char* face : {"2", "5"}) {
    const std::string wish = std::string("last:") + face + "=up";
    const auto result = runProgram(command(face, {"--orient", wish, "--formats", "json"}));
    ASSERT_EQ(result.exit, 0) << result.err;
    const auto found = motion(face);
    ASSERT_EQ(found.at("orientations").size(), 1U);
    EXPECT_EQ(found.at("orientations")[0].at("contact"), -1);
    const auto report = runProgram({"verify", folder_ / face / "motion.json"});
    EXPECT_EQ(report.exit, 0);
    EXPECT_THAT(report.out, HasSubstr("orientation as asked"));
  }
}

TEST_F(Sync, RefusesWishesThatMakeNoSense) {
  object_ = "d6";
  const std::vector<std::pair<std::string, std::string>> all = {
      {"last=up", "CONTACT"},          {"0:6=up", "contact's number"},
      {"last:6=sideways", "up, down"}, {"last:=up", "no face"},
      {"last:seven=up", "its faces"},  {"99:6=up", "contacts"},
      {"last:0,0,0=up", "no length"},  {"last:6=1,2", "up, down"},
      {"1e9:6=up", "number"},          {"last:0,0,1=nan,0,0", "numbers"}};
  for (const auto& [wish, told] : all) {
    const auto result = runProgram(command("out", {"--orient", wish}));
    EXPECT_EQ(result.exit, 2) << wish;
    EXPECT_THAT(result.err, HasSubstr(told)) << wish;
  }
}

TEST_F(Sync, PutsTheBodyWhereItIsAskedFor) {
  writeText(folder_ / "places.tsv", "# contact, x, y\n1\t0.5\t-0.25\n");
  const auto result = runProgram(command("out", {"--positions", folder_ / "places.tsv"}));
  ASSERT_EQ(result.exit, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("missed by 0.0 mm"));
  const auto position = motion("out").at("contacts")[0].at("position");
  EXPECT_NEAR(position[0].get<double>(), 0.5, 1e-9);
  EXPECT_NEAR(position[1].get<double>(), -0.25, 1e-9);
  EXPECT_EQ(motion("out").at("positions").size(), 1U);
  EXPECT_EQ(runProgram({"verify", folder_ / "out/motion.json"}).exit, 0);
}

// From the first contact to the last, whatever its number.
TEST_F(Sync, PutsTheLastContactWhereItIsAskedFor) {
  writeText(folder_ / "places.tsv", "1\t0\t0\nlast\t0.06\t-0.08\n");
  const auto result = runProgram(command("out", {"--positions", folder_ / "places.tsv"}));
  ASSERT_EQ(result.exit, 0) << result.err;
  const auto made = motion("out");
  const auto& contacts = made.at("contacts");
  EXPECT_EQ(made.at("positions")[1].at("contact"), contacts.size() - 1);
  const auto position = contacts.back().at("position");
  EXPECT_NEAR(position[0].get<double>(), 0.06, 0.01);
  EXPECT_NEAR(position[1].get<double>(), -0.08, 0.01);
}

TEST_F(Sync, RefusesPlacesThatAreNone) {
  const std::vector<std::tuple<std::string, int, std::string>> all = {
      {"1\t0.5\n", 3, ":1"},
      {"# only this\n", 3, "no place"},
      {"1.5\t0\t0\n", 3, ":1"},
      {"1\t0\t0\n2\tx\t0\n", 3, ":2"},
      {"1\t0\tnan\n", 3, ":1"},
      {"first\t0\t0\n", 3, ":1"},
      {"99\t0\t0\n", 2, "contact 99"},
      {"1\t0\t0\n1\t1\t0\n", 2, "two places"},
      {"last\t0\t0\nlast\t1\t0\n", 2, "two places"},
      {"1\t1e6\t0\n", 2, "metres"}};
  for (const auto& [text, exit, told] : all) {
    writeText(folder_ / "places.tsv", text);
    const auto result = runProgram(command("out", {"--positions", folder_ / "places.tsv"}));
    EXPECT_EQ(result.exit, exit) << text;
    EXPECT_THAT(result.err, HasSubstr(told)) << text;
  }
  EXPECT_EQ(runProgram(command("out", {"--positions", folder_ / "none.tsv"})).exit, 3);
}

TEST_F(Sync, PlansWithTheRestitutionThatIsGiven) {
  ASSERT_EQ(runProgram(command("out", {"--restitution", "0.4"})).exit, 0);
  EXPECT_EQ(motion("out").at("object").at("restitution"), 0.4);
  EXPECT_FALSE(motion("out").contains("fit"));
}

TEST_F(Sync, TellsAProgramWhatItDoes) {
  const auto result = runProgram(command("out", {"--json-progress"}));
  ASSERT_EQ(result.exit, 0);
  const auto lines = linesOf(result.err);
  ASSERT_GE(lines.size(), 2U);
  for (const auto& line : lines) {
    const auto parsed = json::parse(line);
    if (parsed.at("type") != "progress") continue;
    EXPECT_THAT(parsed.at("stage").get<std::string>(), testing::Not(IsEmpty()));
    EXPECT_GE(parsed.at("value").get<double>(), 0.0);
    EXPECT_LE(parsed.at("value").get<double>(), 1.0);
  }
  EXPECT_EQ(json::parse(lines.back()).at("type"), "success");
}

TEST_F(Sync, WritesTheBestPartialMotionWhereNoneIsPossible) {
  // Nothing thrown by hand flies for two seconds.
  object_ = "d6";
  const std::vector<Click> gap = {{0.2, 0.9}, {2.2, 0.5}, {2.3, 0.3}};
  writeClicks(folder_ / "throw.wav", gap, 3);
  writeClickLabels(folder_ / "throw.txt", gap);
  const auto result = runProgram(command("out"));
  EXPECT_EQ(result.exit, 4);
  EXPECT_THAT(result.err, HasSubstr("contact 2"));
  EXPECT_THAT(result.err, HasSubstr("--fit"));
  const auto found = motion("out");
  EXPECT_FALSE(found.at("success").get<bool>());
  EXPECT_THAT(found.at("failure").get<std::string>(), HasSubstr("contact 2"));
}

TEST_F(Sync, DoesAFolderOfSoundsAndListsFailures) {
  fs::create_directory(folder_ / "in");
  for (const char* name : {"throw.wav", "throw.txt"}) {
    fs::rename(folder_ / name, folder_ / "in" / name);
  }
  writeText(folder_ / "in/bad.wav", "this is no sound");
  const std::vector<std::string> words = {"sync", folder_ / "in",  "--object",  "Eraser",
                                          "-o",   folder_ / "out", "--formats", "json"};
  const auto result = runProgram(words);
  EXPECT_EQ(result.exit, 4);
  EXPECT_THAT(result.out, HasSubstr("bad.wav"));
  EXPECT_TRUE(fs::exists(folder_ / "out/throw/motion.json"));
  EXPECT_FALSE(fs::exists(folder_ / "out/bad"));
  const auto before = fs::last_write_time(folder_ / "out/throw/motion.json");
  fs::remove(folder_ / "in/bad.wav");
  EXPECT_EQ(runProgram(words).exit, 0);
  EXPECT_EQ(fs::last_write_time(folder_ / "out/throw/motion.json"), before) << "done before";
}

TEST_F(Sync, DoesAFolderAgainWhereItIsAskedToLieOtherwise) {
  fs::create_directory(folder_ / "in");
  for (const char* name : {"throw.wav", "throw.txt"}) {
    fs::rename(folder_ / name, folder_ / "in" / name);
  }
  const auto run = [&](const std::string& wish) {
    const auto result = runProgram({"sync", folder_ / "in", "--object", "d6", "-o", folder_ / "out",
                                    "--formats", "json", "--orient", wish});
    EXPECT_EQ(result.exit, 0) << result.err;
    return fs::last_write_time(folder_ / "out/throw/motion.json");
  };
  const auto first = run("last:6=up");
  EXPECT_EQ(run("last:6=up"), first);
  EXPECT_NE(run("last:1=up"), first);
}

TEST_F(Sync, CanBeInterrupted) {
  for (const int signal : {SIGINT, SIGTERM}) {
    const auto result =
        runAndSignal(command("out", {"--takes", "32", "--json-progress"}), "\"progress\"", signal);
    EXPECT_EQ(result.exit, 5) << result.err;
    const auto last = json::parse(linesOf(result.err).back());
    EXPECT_EQ(last.at("type"), "failure");
    EXPECT_EQ(last.at("code"), 5);
    // What was finished is kept; nothing half-written is left.
    for (const auto& name : folder_.names()) EXPECT_THAT(name, testing::Not(HasSubstr(".ifa-")));
  }
}

}  // namespace
}  // namespace ifa::test
