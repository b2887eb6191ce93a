// SPDX-License-Identifier: Apache-2.0
// A mesh of a person's own: what the studio makes of good ones, and of bad ones (docs/security.md).
#include "studio/own_object.h"

#include <gmock/gmock.h>

#include "studio_fixture.h"

namespace ifa::studio {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;
using test::statusOf;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;

constexpr const char* kWanted =
    R"({"units": "mm", "shell": false, "mass": 0.02, "restitution": 0.5, "friction": 0.4})";

/// A box of 30 x 20 x 10 mm, in millimetres.
std::string brick() {
  std::string text;
  for (int corner = 0; corner < 8; ++corner) {
    text +=
        fmt::format("v {} {} {}\n", 30 * (corner & 1), 20 * (corner >> 1 & 1), 10 * (corner >> 2));
  }
  return text + "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";
}

class OwnObjectTest : public StudioTest {
 protected:
  std::string newSession() { return "/api/sessions/" + openSound()["session"].get<std::string>(); }
  httplib::Result send(const std::string& session, const std::string& kind,
                       const std::string& bytes) {
    return client().Post((session + "/mesh?name=thing&kind=" + kind).c_str(), bytes, kBytes);
  }
  httplib::Result make(const std::string& session, const std::string& wanted = kWanted) {
    return client().Post((session + "/object").c_str(), wanted, kJson);
  }
};

// From a file of the library's to a motion that has its mass and size.
TEST_F(OwnObjectTest, AMeshBecomesAMotion) {
  const std::string session = newSession();
  const std::string mesh = test::readText(fs::path(IFA_SOURCE_DIR) / "objects/Eraser.obj");
  const auto told = send(session, "obj", mesh);
  ASSERT_TRUE(told);
  ASSERT_EQ(told->status, 200) << told->body;
  const Json report = Json::parse(told->body)["report"];
  EXPECT_EQ(report["solid"], true);
  EXPECT_NEAR(report["extent"][0].get<double>(), 0.06, 1e-6);
  EXPECT_NEAR(report["volume"].get<double>(), 0.06 * 0.022 * 0.012, 1e-8);
  EXPECT_EQ(client().Get((session + "/mesh/upload").c_str())->body, mesh);
  EXPECT_THAT(client().Get((session + "/mesh/mesh.obj").c_str())->body, HasSubstr("\nf "));
  EXPECT_EQ(Json::parse(client().Get(session.c_str())->body)["mesh"], Json::parse(told->body));

  const std::string plan =
      R"({"marks":[{"start":0.3},{"start":0.55}],"object":"own-object","takes":1,"terminal":false})";
  EXPECT_EQ(client().Post((session + "/plans").c_str(), plan, kJson)->status, 422);
  const auto made =
      make(session, R"({"units": "m", "mass": 0.021, "restitution": 0.4, "friction": 0.5})");
  ASSERT_EQ(made->status, 200) << made->body;
  const auto planned = client().Post((session + "/plans").c_str(), plan, kJson);
  ASSERT_THAT(planned->body, HasSubstr("event: done\n"));
  const auto motion = client().Get((session + "/plans/1/takes/1/motion.json").c_str());
  const Json object = Json::parse(motion->body)["object"];
  EXPECT_EQ(object["name"], "own-object");
  EXPECT_EQ(object["restitution"], 0.4);
  EXPECT_NEAR(object["mass"].get<double>(), 0.021, 1e-9);
}

TEST_F(OwnObjectTest, WhatIsOpenIsAShellOnly) {
  const std::string session = newSession();
  std::string open = brick();
  open.resize(open.rfind("f "));
  const auto told = send(session, "obj", open);
  ASSERT_EQ(told->status, 200) << told->body;
  const Json report = Json::parse(told->body)["report"];
  EXPECT_EQ(report["solid"], false);
  EXPECT_EQ(report["openEdges"], 4);
  const auto solid = make(session);
  EXPECT_EQ(solid->status, 422);
  EXPECT_THAT(solid->body, HasSubstr("not closed"));
  EXPECT_EQ(make(session, R"({"units": "mm", "shell": true, "mass": 0.02})")->status, 200);
}

TEST_F(OwnObjectTest, DamagedMeshesLeaveNothing) {
  const std::string session = newSession();
  const std::string good = brick();
  ASSERT_EQ(send(session, "obj", good)->status, 200);
  const auto before = files();
  std::string stl(84, '\0');
  stl.replace(80, 4, "\xff\xff\xff\xff");  // announces four thousand million triangles
  std::string glb("glTF\2\0\0\0\xff\xff\xff\x7f\xff\xff\xff\x7fJSON", 20);
  const std::vector<std::pair<std::string, std::string>> meshes = {
      {"obj", ""},
      {"obj", "nonsense"},
      {"obj", std::string(100000, '\xff')},
      {"obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"},
      {"obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3\nf 4 3 2\nf 3 2 1\nf 2 3 4\n"},
      {"obj", good + "f 1 2 999999999\n"},
      {"obj",
       "v nan nan nan\nv inf 0 0\nv 0 1e999 0\nv 0 0 1\nf 1 2 3\nf 1 2 4\nf 1 3 4\nf 2 3 4\n"},
      {"stl", stl},
      {"stl", good},
      {"glb", glb},
      {"ply",
       "ply\nformat ascii 1.0\nelement vertex 4000000000\nproperty float x\nend_header\n0\n"},
      {"ply",
       "ply\nformat binary_little_endian 1.0\nelement face 1\nproperty list uint int "
       "vertex_indices\nend_header\n\xff\xff\xff\xff"},
      {"off", "OFF\n2000000000 2000000000 0\n"},
      {"off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 99\n"}};
  for (const auto& [kind, bytes] : meshes) {
    const auto answer = send(session, kind, bytes);
    ASSERT_TRUE(answer) << kind << bytes.substr(0, 40);
    EXPECT_EQ(answer->status, 422) << kind << " " << bytes.substr(0, 40) << answer->body;
    EXPECT_FALSE(Json::parse(answer->body)["message"].get<std::string>().empty());
    EXPECT_THAT(answer->body, Not(HasSubstr(folder_.path().string())));
    EXPECT_THAT(answer->body, Not(HasSubstr("upload.")));
  }
  EXPECT_EQ(files(), before);  // the good one is still there
  EXPECT_TRUE(answers());
}

// A mesh may name other files: they are not opened, whatever they are.
TEST_F(OwnObjectTest, FilesThatAMeshNamesAreNotRead) {
  const std::string session = newSession();
  test::writeText(folder_ / "secret.mtl", "newmtl secret\nKd 1 0 0\n");
  const std::string secret = (folder_ / "secret.mtl").string();
  const std::string named = "mtllib " + secret + "\nmtllib ../../../secret.mtl\nusemtl secret\n";
  ASSERT_EQ(send(session, "obj", named + brick())->status, 200);
  const auto materials = client().Get((session + "/mesh/mesh.mtl").c_str());
  EXPECT_THAT(materials->body, Not(HasSubstr("Kd 1")));
  std::string json =
      R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":24,"uri":")" + secret +
      R"("}],"bufferViews":[{"buffer":0,"byteLength":24}],"accessors":[{"bufferView":0,)"
      R"("componentType":5126,"count":2,"type":"VEC3"}],"meshes":[{"primitives":[{"attributes":)"
      R"({"POSITION":0}}]}],"nodes":[{"mesh":0}],"scenes":[{"nodes":[0]}],"scene":0})";
  json.resize((json.size() + 3) / 4 * 4, ' ');
  const auto word = [](std::size_t value) {
    std::string bytes;
    for (int i = 0; i < 4; ++i) bytes += static_cast<char>(value >> (8 * i) & 0xff);
    return bytes;
  };
  const std::string glb =
      "glTF" + word(2) + word(20 + json.size()) + word(json.size()) + "JSON" + json;
  EXPECT_EQ(send(session, "glb", glb)->status, 422);
}

TEST_F(OwnObjectTest, NothingElseIsTaken) {
  const std::string session = newSession();
  EXPECT_EQ(make(session)->status, 404);  // there is no mesh yet
  const auto before = files();
  for (const char* kind : {"", "json", "blend", "gltf", "OBJ", "..%2fobj", "obj%00", "obj/../x"}) {
    EXPECT_EQ(send(session, kind, brick())->status, 422) << kind;
  }
  EXPECT_EQ(client().Post("/api/sessions/../mesh?kind=obj", brick(), kBytes)->status, 404);
  EXPECT_EQ(statusOf(ask(head("POST " + session + "/mesh?kind=stl",
                              fmt::format("Content-Type: {}\r\nContent-Length: {}\r\n", kBytes,
                                          kMaxMeshFile + 1)))),
            413);
  for (const char* file : {"upload", "mesh.obj", "report.json", "kind.json", "..%2fsound.wav"}) {
    EXPECT_EQ(client().Get((session + "/mesh/" + file).c_str())->status, 404) << file;
  }
  EXPECT_EQ(files(), before);
}

TEST(OwnObject, NamesTheFieldThatIsWrong) {
  const auto problem = [](const std::string& json) {
    const auto request = parseOwnObject(json);
    return request ? std::string() : request.error().message;
  };
  EXPECT_EQ(problem(kWanted), "");
  EXPECT_THAT(problem(R"({"units": "mm"})"), HasSubstr("mass is missing"));
  EXPECT_THAT(problem(R"({"units": "mm -o /x", "mass": 1})"), HasSubstr("units"));
  EXPECT_THAT(problem(R"({"units": "mm", "mass": "1"})"), HasSubstr("mass"));
  EXPECT_THAT(problem(R"({"units": "mm", "mass": 0})"), HasSubstr("mass"));
  EXPECT_THAT(problem(R"({"units": "mm", "mass": 1, "shell": 1})"), HasSubstr("shell"));
  EXPECT_THAT(problem(R"({"units": "mm", "mass": 1, "friction": -1})"), HasSubstr("friction"));
  EXPECT_THAT(problem(std::string(100000, '[')), HasSubstr("no JSON"));
  const auto request = parseOwnObject(R"({"units": "in", "mass": 0.5, "shell": true, "-o": "x"})");
  ASSERT_TRUE(request);
  const auto words = objectsArguments(*request, "folder");
  EXPECT_THAT(words, Contains("--shell"));
  EXPECT_THAT(words, Contains("folder/own-object.json"));
  EXPECT_THAT(words, Not(Contains("x")));
}

}  // namespace
}  // namespace ifa::studio
