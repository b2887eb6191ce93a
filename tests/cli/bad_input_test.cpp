// SPDX-License-Identifier: Apache-2.0
// Input that cannot be used: exit 3, a message that names the place, nothing left behind.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <ostream>

#include "run_program.h"
#include "support/clicks.h"
#include "support/temporary_folder.h"

namespace ifa::test {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

constexpr const char* kObject = R"({"format": "inverse-foley-object", "version": 1,
  "name": "thing", "mesh": "thing.obj", "units": "m", "kind": "solid", "mass": MASS,
  "surfaces": {"desk": {"restitution": RESTITUTION, "friction": 0.35}},
  "default_surface": "desk"})";

std::string object(std::string mass, std::string restitution) {
  std::string text = kObject;
  text.replace(text.find("MASS"), 4, mass);
  return text.replace(text.find("RESTITUTION"), 11, restitution);
}

// `name` is overwritten with `content`, then the program is called with the file in its place.
struct BadFile {
  std::string about, name, content, expected;
};

void PrintTo(const BadFile& file, std::ostream* stream) { *stream << file.about; }

class BadPlace : public testing::Test {
 protected:
  void SetUp() override {
    writeClicks(folder_ / "a.wav", {{0.2, 0.9}, {0.4, 0.4}}, 1.0);
    writeText(folder_ / "a.txt", "0.2\t0.2\thit\n0.4\t0.4\tterminal\n");
    writeText(folder_ / "thing.json", object("0.01", "0.5"));
    writeText(folder_ / "thing.obj",
              "v 0 0 0\nv 0.02 0 0\nv 0 0.02 0\nv 0 0 0.02\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n");
  }
  ProgramResult sync() const {
    return runProgram({"sync", folder_ / "a.wav", "--labels", folder_ / "a.txt", "--object",
                       folder_ / "thing.json", "-o", folder_ / "out"});
  }
  TemporaryFolder folder_;
};

class BadInput : public BadPlace, public testing::WithParamInterface<BadFile> {};

TEST_P(BadInput, IsRefusedWithAMessageOfItsOwn) {
  const auto& file = GetParam();
  if (file.name == "a.wav" && file.content == "silence") {
    writeClicks(folder_ / "a.wav", {}, 1.0);
  } else {
    writeText(folder_ / file.name, file.content);
  }
  const auto before = folder_.names();
  const auto result = sync();
  EXPECT_EQ(result.exit, 3) << result.err;
  EXPECT_THAT(result.out, IsEmpty());
  EXPECT_THAT(result.err, HasSubstr(file.name));
  EXPECT_THAT(result.err, HasSubstr(file.expected));
  EXPECT_EQ(folder_.names(), before);
}

INSTANTIATE_TEST_SUITE_P(
    Cases, BadInput,
    testing::Values(
        BadFile{"not a sound", "a.wav", "hello, I am text", "sound"},
        BadFile{"an empty file", "a.wav", "", "empty"},
        BadFile{"silence", "a.wav", "silence", "silent"},
        BadFile{"labels outside the sound", "a.txt", "0.2\t0.2\ta\n7\t7\tb\n", "a.txt:2"},
        BadFile{"labels out of order", "a.txt", "0.4\t0.4\ta\n0.2\t0.2\tb\n", "a.txt:2"},
        BadFile{"labels that overlap", "a.txt", "0.2\t0.5\ta\n0.4\t0.6\tb\n", "a.txt:2"},
        BadFile{"no labels", "a.txt", "\n", "no label"},
        BadFile{"a label that is not a number", "a.txt", "0.2\t0.2\ta\nnan\tnan\tb\n", "a.txt:2"},
        BadFile{"no JSON", "thing.json", "{", "JSON"},
        BadFile{"no mass", "thing.json", object("0", "0.5"), "mass"},
        BadFile{"mass of the wrong kind", "thing.json", object("\"x\"", "0.5"), "mass"},
        BadFile{"restitution over one", "thing.json", object("0.01", "1.5"), "restitution"},
        BadFile{"an infinite number", "thing.json", object("1e999", "0.5"), ""},
        BadFile{"text that is no mesh", "thing.obj", "hello, I am text", ""},
        BadFile{"one triangle", "thing.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", ""},
        BadFile{"a mesh without volume", "thing.obj",
                "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 3 2\n", ""}));

TEST_F(BadPlace, UnknownObjectIsAnsweredWithThoseThatThereAre) {
  const auto result =
      runProgram({"sync", folder_ / "a.wav", "--object", "unicorn", "-o", folder_ / "out"});
  EXPECT_EQ(result.exit, 3);
  EXPECT_THAT(result.err, HasSubstr("unicorn"));
  EXPECT_THAT(result.err, HasSubstr("d6"));
}

TEST_F(BadPlace, UnknownSurfaceIsAnsweredWithThoseThatThereAre) {
  const auto result = runProgram({"sync", folder_ / "a.wav", "--object", folder_ / "thing.json",
                                  "--surface", "moon", "-o", folder_ / "out"});
  EXPECT_EQ(result.exit, 3);
  EXPECT_THAT(result.err, HasSubstr("moon"));
  EXPECT_THAT(result.err, HasSubstr("desk"));
}

TEST_F(BadPlace, OutputThatCannotBeWrittenIsToldBeforeTheSearch) {
  const auto before = folder_.names();
  for (const std::string& out :
       {(folder_ / "a.txt/out").string(), (folder_ / "a.txt").string(), std::string("/proc/x")}) {
    const auto result = runProgram({"sync", folder_ / "a.wav", "--object", folder_ / "thing.json",
                                    "--json-progress", "-o", out});
    EXPECT_EQ(result.exit, 3) << out;
    EXPECT_THAT(result.err, HasSubstr(out));
    EXPECT_THAT(result.err, testing::Not(HasSubstr("\"progress\"")));
  }
  EXPECT_EQ(folder_.names(), before);
}

TEST_F(BadPlace, InputIsNotOverwritten) {
  std::filesystem::rename(folder_ / "a.wav", folder_ / "sound.wav");
  const auto sound = readText(folder_ / "sound.wav");
  const auto before = folder_.names();
  for (const std::string& object : {std::string("Eraser"), (folder_ / "thing.json").string()}) {
    const auto result =
        runProgram({"sync", folder_ / "sound.wav", "--object", object, "-o", folder_.path()});
    EXPECT_EQ(result.exit, 2);
    EXPECT_THAT(result.err, HasSubstr("overwritten"));
  }
  EXPECT_EQ(folder_.names(), before);
  EXPECT_EQ(readText(folder_ / "sound.wav"), sound);
}

TEST_F(BadPlace, FolderWithoutASoundIsRefused) {
  std::filesystem::create_directory(folder_ / "in");
  const auto result = runProgram({"sync", folder_ / "in", "--object", "d6", "-o", folder_ / "out"});
  EXPECT_EQ(result.exit, 3);
  EXPECT_THAT(result.err, HasSubstr(folder_ / "in"));
}

TEST_F(BadPlace, NamesDoNotMoveTheCursor) {
  const auto result = runProgram(
      {"sync", folder_ / "\x1b[31m\a\u00e4.wav", "--object", "d6", "-o", folder_ / "out"});
  EXPECT_EQ(result.exit, 3);
  EXPECT_THAT(result.err, HasSubstr("\\x1b[31m\\x07\u00e4.wav"));
}

}  // namespace
}  // namespace ifa::test
