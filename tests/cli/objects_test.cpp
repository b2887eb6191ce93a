// SPDX-License-Identifier: Apache-2.0
// `ifa objects`: the library, one object, a mesh of the user's own.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <ostream>

#include "run_program.h"
#include "support/clicks.h"
#include "support/temporary_folder.h"

namespace ifa::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;

TEST(Objects, ListTellsWhatThereIs) {
  const auto result = runProgram({"objects"});
  EXPECT_EQ(result.exit, 0);
  EXPECT_THAT(result.err, IsEmpty());
  const auto lines = linesOf(result.out);
  ASSERT_GE(lines.size(), 12U);
  for (const char* name : {"d6", "d20", "Eraser", "CoffeeCup", "Nut", "Lego2x2"}) {
    EXPECT_THAT(lines, testing::Contains(testing::StartsWith(std::string(name) + " "))) << name;
  }
  const auto die = std::find_if(lines.begin(), lines.end(),
                                [](const std::string& line) { return line.starts_with("d6 "); });
  EXPECT_THAT(*die, AllOf(HasSubstr("16 x 16 x 16 mm"), HasSubstr(" 4.9 "), HasSubstr("desk")));
}

TEST(Objects, OneIsShownInFull) {
  const auto result = runProgram({"objects", "d6"});
  EXPECT_EQ(result.exit, 0);
  EXPECT_THAT(result.err, IsEmpty());
  for (const char* fact :
       {"d6: Six-sided die", "16 x 16 x 16 mm", "4.9 g, solid", "8 vertices",
        "Oh: order 48, 24 rotations", "on desk *", "restitution", "1, 2, 3, 4, 5, 6"}) {
    EXPECT_THAT(result.out, HasSubstr(fact));
  }
}

TEST(Objects, UnknownNameIsAnsweredWithThoseThatThereAre) {
  const auto result = runProgram({"objects", "unicorn"});
  EXPECT_EQ(result.exit, 3);
  EXPECT_THAT(result.out, IsEmpty());
  EXPECT_THAT(result.err, AllOf(HasSubstr("unicorn"), HasSubstr("Eraser")));
}

// A cube of 20 of the file's units as text, its triangles from the list of `faces`.
constexpr const char* kCorners =
    "v 0 0 0\nv 20 0 0\nv 20 20 0\nv 0 20 0\nv 0 0 20\nv 20 0 20\nv 20 20 20\nv 0 20 20\n";
constexpr const char* kFaces = "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

std::string cube() { return std::string(kCorners) + kFaces; }

// A file that is inspected in millimetres, what is said of it, and the exit code.
struct Inspected {
  std::string about, mesh, message, verdict;
  int exit = 0;
};

void PrintTo(const Inspected& inspected, std::ostream* stream) { *stream << inspected.about; }

class Inspection : public testing::TestWithParam<Inspected> {};

TEST_P(Inspection, SaysWhatIsWrongAndWhatTheMeshIsGoodFor) {
  const TemporaryFolder folder;
  writeText(folder / "thing.obj", GetParam().mesh);
  const auto before = folder.names();
  const auto result = runProgram({"objects", folder / "thing.obj", "--units", "mm"});
  EXPECT_EQ(result.exit, GetParam().exit) << result.err;
  EXPECT_THAT(result.out, AllOf(HasSubstr("thing.obj"), HasSubstr(GetParam().message),
                                HasSubstr("good for        " + GetParam().verdict + "\n")));
  if (GetParam().exit == 0) {
    EXPECT_THAT(result.err, IsEmpty());
  } else {
    EXPECT_THAT(linesOf(result.err), SizeIs(1));
    EXPECT_THAT(result.err, AllOf(HasSubstr("thing.obj"), HasSubstr(GetParam().message)));
  }
  EXPECT_EQ(folder.names(), before);
}

INSTANTIATE_TEST_SUITE_P(
    Cases, Inspection,
    testing::Values(
        Inspected{"a good mesh", cube(), "8 vertices", "a solid or a thin shell"},
        Inspected{"not closed",
                  std::string(kCorners) + "f 1 4 3 2\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n",
                  "it is not closed: 4 open edges", "a thin shell only"},
        Inspected{"flipped",
                  std::string(kCorners) +
                      "f 2 3 4 1\nf 8 7 6 5\nf 5 6 2 1\nf 6 7 3 2\nf 7 8 4 3\nf 8 5 1 4\n",
                  "it is flipped", "a solid or a thin shell"},
        Inspected{"one face the wrong way",
                  std::string(kCorners) +
                      "f 2 3 4 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n",
                  "not consistently oriented: at 4 edges", "a thin shell only"},
        Inspected{"degenerate", cube() + "v 10 0 0\nf 1 9 2\nf 2 9 1\n", "2 degenerate triangles",
                  "a solid or a thin shell"},
        Inspected{"one triangle", "v 0 0 0\nv 20 0 0\nv 0 20 0\nf 1 2 3\n",
                  "it has only 1 triangle", "nothing", 3},
        Inspected{"flat", "v 0 0 0\nv 20 0 0\nv 20 20 0\nv 0 20 0\nf 1 2 3 4\nf 4 3 2 1\n",
                  "it is flat", "nothing", 3}));

class OwnMesh : public testing::Test {
 protected:
  void SetUp() override { writeText(folder_ / "block.obj", cube()); }
  ProgramResult make(const std::vector<std::string>& more) const {
    std::vector<std::string> words = {"objects", folder_ / "block.obj", "-o",
                                      folder_ / "thing.json"};
    words.insert(words.end(), more.begin(), more.end());
    return runProgram(words);
  }
  TemporaryFolder folder_;
};

TEST_F(OwnMesh, InMillimetresByTheLookIsToldSo) {
  const auto result = runProgram({"objects", folder_ / "block.obj"});
  EXPECT_EQ(result.exit, 0);
  EXPECT_THAT(result.out, AllOf(HasSubstr("in millimetres by the look of it"),
                                HasSubstr("--units mm"), HasSubstr("20 x 20 x 20 m\n")));
  const auto made = make({"--units", "m", "--density", "1000"});
  EXPECT_EQ(made.exit, 3);
  EXPECT_THAT(made.err, AllOf(HasSubstr("block.obj"), HasSubstr("check the units")));
  EXPECT_THAT(folder_.names(), SizeIs(1));
}

TEST_F(OwnMesh, UnreadableMeshesAreBadInput) {
  writeText(folder_ / "empty.stl", "");
  writeText(folder_ / "text.ply", "hello, I am text");
  std::filesystem::create_directory(folder_ / "folder.obj");
  for (const auto& [name, message] : {std::pair{"empty.stl", "is empty"},
                                      {"text.ply", "not a mesh"},
                                      {"folder.obj", "not a file"},
                                      {"none.obj", "no such mesh file"}}) {
    const auto result = runProgram({"objects", folder_ / name});
    EXPECT_EQ(result.exit, 3) << name;
    EXPECT_THAT(result.out, IsEmpty());
    EXPECT_THAT(linesOf(result.err), SizeIs(1)) << result.err;
    EXPECT_THAT(result.err, AllOf(HasSubstr(name), HasSubstr(message)));
  }
}

TEST_F(OwnMesh, MakesAnObjectThatCanBeSynchronised) {
  const auto made = make({"--units", "mm", "--density", "1200", "--restitution", "0.5"});
  ASSERT_EQ(made.exit, 0) << made.err;
  EXPECT_THAT(made.err, IsEmpty());
  EXPECT_THAT(made.out, AllOf(HasSubstr("20 x 20 x 20 mm"), HasSubstr("9.6 g, solid"),
                              HasSubstr("8 vertices"), HasSubstr("restitution 0.5")));
  EXPECT_THAT(folder_.names(),
              testing::ElementsAre("block.obj", "thing.json", "thing.mtl", "thing.obj"));
  const auto shown = runProgram({"objects", folder_ / "thing.json"});
  EXPECT_EQ(shown.exit, 0) << shown.err;
  EXPECT_THAT(shown.out, HasSubstr("9.6 g, solid"));
  const std::vector<Click> clicks = {{0.2, 0.9}, {0.35, 0.6}, {0.45, 0.4}};
  writeClicks(folder_ / "a.wav", clicks, 0.8);
  writeClickLabels(folder_ / "a.txt", clicks, 0.08);
  const auto synced =
      runProgram({"sync", folder_ / "a.wav", "--labels", folder_ / "a.txt", "--object",
                  folder_ / "thing.json", "-o", folder_ / "out", "--formats", "json"});
  EXPECT_EQ(synced.exit, 0) << synced.err;
  const auto motion = nlohmann::json::parse(readText(folder_ / "out/motion.json"));
  EXPECT_EQ(motion.at("object").at("name"), "thing");
  EXPECT_NEAR(motion.at("object").at("mass").get<double>(), 0.0096, 1e-9);
  EXPECT_EQ(motion.at("contacts").size(), clicks.size());
}

TEST_F(OwnMesh, ReplacesAnObjectOnlyWhenAskedTo) {
  ASSERT_EQ(make({"--units", "mm", "--mass", "0.01"}).exit, 0);
  const auto first = readText(folder_ / "thing.json");
  const auto again = make({"--units", "mm", "--mass", "0.02"});
  EXPECT_EQ(again.exit, 3);
  EXPECT_THAT(again.err, AllOf(HasSubstr("thing.json"), HasSubstr("--force")));
  EXPECT_EQ(readText(folder_ / "thing.json"), first);
  EXPECT_EQ(make({"--units", "mm", "--mass", "0.02", "--force"}).exit, 0);
  EXPECT_NE(readText(folder_ / "thing.json"), first);
}

TEST_F(OwnMesh, WhatCannotBeMadeLeavesNothing) {
  writeText(folder_ / "block.obj", std::string(kCorners) + "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\n");
  const auto open = make({"--units", "mm", "--density", "1200"});
  EXPECT_EQ(open.exit, 3);
  EXPECT_THAT(open.err, AllOf(HasSubstr("not closed"), HasSubstr("--shell")));
  EXPECT_THAT(folder_.names(), SizeIs(1));
  // The remedy that it names helps.
  EXPECT_EQ(make({"--units", "mm", "--density", "3", "--shell"}).exit, 0);
}

TEST_F(OwnMesh, CallsThatMakeNoSenseAreUsageErrors) {
  const std::string mesh = folder_ / "block.obj", output = folder_ / "thing.json";
  const std::vector<std::vector<std::string>> calls = {
      {"objects", mesh, "-o", output},
      {"objects", mesh, "-o", output, "--units", "mm"},
      {"objects", mesh, "-o", output, "--units", "mm", "--mass", "1", "--density", "1"},
      {"objects", mesh, "-o", output, "--units", "furlong", "--mass", "1"},
      {"objects", mesh, "-o", output, "--units", "mm", "--mass", "0"},
      {"objects", mesh, "-o", output, "--units", "mm", "--mass", "nan"},
      {"objects", mesh, "-o", output, "--units", "mm", "--mass", "1", "--restitution", "1"},
      {"objects", mesh, "--density", "1000"},
      {"objects", "-o", output}};
  for (const auto& call : calls) {
    const auto result = runProgram(call);
    EXPECT_EQ(result.exit, 2) << testing::PrintToString(call);
    EXPECT_THAT(result.out, IsEmpty());
    EXPECT_THAT(linesOf(result.err), SizeIs(1));
  }
  EXPECT_THAT(folder_.names(), SizeIs(1));
}

// A ball of so many triangles that its hull is simplified.
std::string ball(double radius, int bands) {
  std::string text;
  const int around = 2 * bands;
  for (int i = 0; i <= bands; ++i) {
    for (int j = 0; j < around; ++j) {
      const double polar = 3.14159265358979 * i / bands, angle = 3.14159265358979 * j / bands;
      text += fmt::format("v {:.9g} {:.9g} {:.9g}\n", radius * std::sin(polar) * std::cos(angle),
                          radius * std::sin(polar) * std::sin(angle), radius * std::cos(polar));
    }
  }
  for (int i = 0; i < bands; ++i) {
    for (int j = 0; j < around; ++j) {
      const int a = i * around + j + 1, b = i * around + (j + 1) % around + 1;
      text += fmt::format("f {} {} {} {}\n", a, a + around, b + around, b);
    }
  }
  return text;
}

TEST_F(OwnMesh, HullOfManyVerticesIsSimplifiedAndThatIsTold) {
  writeText(folder_ / "block.obj", ball(20, 40));
  const auto told = AllOf(HasSubstr("512 vertices, simplified from 31"), HasSubstr("mm inside"));
  const auto inspected = runProgram({"objects", folder_ / "block.obj", "--units", "mm"});
  EXPECT_EQ(inspected.exit, 0) << inspected.err;
  EXPECT_THAT(inspected.out, told);
  const auto made = make({"--units", "mm", "--density", "1000"});
  EXPECT_EQ(made.exit, 0) << made.err;
  EXPECT_THAT(made.out, told);
  EXPECT_THAT(made.err, IsEmpty());
}

}  // namespace
}  // namespace ifa::test
