// SPDX-License-Identifier: Apache-2.0
#include "export/glb.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "audit/analytic_motion.h"
#include "body/drawable_mesh.h"
#include "body/object_file.h"
#include "model/pose_track.h"

namespace ifa {
namespace {

using Json = nlohmann::json;
using Eigen::Quaterniond;
using Eigen::Vector3d;

const Body& box() {
  static const Body body = test::makeDrawableBox();
  return body;
}

/// A GLB taken apart again, from its bytes alone.
struct Parsed {
  Json json;
  std::string buffer;

  explicit Parsed(const std::string& bytes) {
    const auto word = [&](std::size_t at) {
      std::uint32_t value = 0;
      std::memcpy(&value, bytes.data() + at, 4);
      return value;
    };
    EXPECT_EQ(bytes.substr(0, 4), "glTF");
    EXPECT_EQ(word(8), bytes.size());
    json = Json::parse(bytes.substr(20, word(12)));
    buffer = bytes.substr(28 + word(12));
    EXPECT_EQ(word(20 + word(12)), buffer.size());
  }
  [[nodiscard]] std::vector<float> floats(int accessor, std::size_t components) const {
    const Json& table = json["accessors"][static_cast<std::size_t>(accessor)];
    const Json& view = json["bufferViews"][table["bufferView"].get<std::size_t>()];
    std::vector<float> values(table["count"].get<std::size_t>() * components);
    std::memcpy(values.data(), buffer.data() + view["byteOffset"].get<std::size_t>(),
                values.size() * 4);
    return values;
  }
  [[nodiscard]] std::vector<float> times() const {
    return floats(json["animations"][0]["samplers"][0]["input"], 1);
  }
  [[nodiscard]] std::vector<float> translations() const {
    return floats(json["animations"][0]["samplers"][0]["output"], 3);
  }
  [[nodiscard]] std::vector<float> rotations() const {
    return floats(json["animations"][0]["samplers"][1]["output"], 4);
  }
};

/// How players turn from one key to the next: along the arc as glTF says, or, as Blender does, each
/// component by itself.
enum class Turn { kArc, kChord };

/// The animation as a player sees it, turned back to z up.
class Player {
 public:
  explicit Player(const Parsed& file, Turn turn = Turn::kArc)
      : turn_(turn),
        times_(file.times()),
        positions_(file.translations()),
        rotations_(file.rotations()) {}

  [[nodiscard]] Pose at(double time) const {
    std::size_t i = 0;
    while (i + 2 < times_.size() && static_cast<double>(times_[i + 1]) < time) ++i;
    const double from = static_cast<double>(times_[i]), to = static_cast<double>(times_[i + 1]);
    const double share = std::clamp((time - from) / (to - from), 0.0, 1.0);
    const Quaterniond a = rotation(i), b = rotation(i + 1);
    const Quaterniond chord((1 - share) * a.coeffs() + share * b.coeffs());
    return {position(i) + share * (position(i + 1) - position(i)),
            turn_ == Turn::kArc ? a.slerp(share, b) : chord.normalized()};
  }
  [[nodiscard]] Quaterniond rotation(std::size_t i) const {
    const auto at = [&](std::size_t k) { return static_cast<double>(rotations_[4 * i + k]); };
    return {at(3), at(0), -at(2), at(1)};
  }
  [[nodiscard]] Vector3d position(std::size_t i) const {
    const auto at = [&](std::size_t k) { return static_cast<double>(positions_[3 * i + k]); };
    return {at(0), -at(2), at(1)};
  }

 private:
  Turn turn_;
  std::vector<float> times_, positions_, rotations_;
};

template <class Truth>
double surfaceError(const Pose& pose, const Truth& truth) {
  double worst = 0;
  for (const Vector3d& vertex : box().mesh.vertices) {
    const Vector3d there = pose.position + pose.orientation * vertex;
    worst = std::max(worst, (there - truth.position - truth.orientation * vertex).norm());
  }
  return worst;
}

void expectFollows(const Motion& motion) {
  const Parsed file(formatGlb(motion, box()).value());
  const PoseTrack track(motion);
  for (const Turn turn : {Turn::kArc, Turn::kChord}) {
    const Player player(file, turn);
    for (const MotionSample& sample : motion.trajectory) {
      const double time = sample.time + motion.sound.firstContact;
      if (time < 0) continue;
      EXPECT_LT(surfaceError(player.at(time), sample), 1e-4) << "at " << sample.time;
      const double between = sample.time + 0.5 / 240;  // the chord is furthest off between samples
      if (between > motion.trajectory.back().time) break;
      EXPECT_LT(surfaceError(player.at(between + motion.sound.firstContact), track.at(between)),
                1.1e-4)
          << "at " << between;
    }
  }
}

TEST(Glb, FollowsATumblingMotion) { expectFollows(test::makeTumblingMotion(box())); }
TEST(Glb, FollowsASlidingMotion) { expectFollows(test::makeSlidingMotion(box())); }

TEST(Glb, FollowsAFastSpin) {
  test::MotionMaker maker(box());
  MotionSample start;
  start.position = {0, 0, 1};
  start.angularVelocity = {0, 250, 0};  // about a principal axis: an arc at a constant rate
  maker.begin(start);
  maker.fly(0.2);
  maker.listContact();
  expectFollows(maker.finish());
}

TEST(Glb, FollowsImpactsInsideAnEvent) {
  Motion motion = test::makeTumblingMotion(box());
  motion.contacts[1].end = motion.contacts[3].time;
  motion.contacts.erase(motion.contacts.begin() + 2, motion.contacts.begin() + 4);
  expectFollows(motion);
}

TEST(Glb, HasKeysAtContactsAndOftenEnough) {
  const Motion motion = test::makeSlidingMotion(box());
  const auto times = Parsed(formatGlb(motion, box()).value()).times();
  EXPECT_EQ(times.front(), 0.0f);
  for (const MotionContact& contact : motion.contacts) {
    const auto time = static_cast<float>(contact.time + motion.sound.firstContact);
    EXPECT_THAT(times, testing::Contains(time));
  }
  for (std::size_t i = 1; i < times.size(); ++i) {
    EXPECT_GT(times[i], times[i - 1]);
    EXPECT_LT(times[i] - times[i - 1], 1.0f / 120 + 2.1e-4f);
  }
}

TEST(Glb, HasUnitQuaternionsOnOneSide) {
  const auto q = Parsed(formatGlb(test::makeTumblingMotion(box()), box()).value()).rotations();
  for (std::size_t i = 0; i < q.size(); i += 4) {
    float norm = 0, dot = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      norm += q[i + k] * q[i + k];
      if (i > 0) dot += q[i + k] * q[i + k - 4];
    }
    EXPECT_NEAR(norm, 1, 1e-6);
    EXPECT_GE(dot, 0);
  }
}

TEST(Glb, HoldsTheFirstPoseUntilTheMotionBegins) {
  Motion motion = test::makeTumblingMotion(box());
  motion.sound.firstContact = 1;
  const Parsed file(formatGlb(motion, box()).value());
  const MotionSample& first = motion.trajectory.front();
  EXPECT_EQ(file.times().front(), 0.0f);
  EXPECT_LT(surfaceError(Player(file).at(0.3), first), 1e-6);
  EXPECT_LT(surfaceError(Player(file).at(1 + first.time), first), 1e-6);
  const Json& node = file.json["nodes"][0];
  EXPECT_EQ(node["translation"][1].get<float>(), static_cast<float>(first.position.z()));
  EXPECT_FALSE(node.contains("matrix"));
}

TEST(Glb, CutsWhatLiesBeforeTheSound) {
  Motion motion = test::makeTumblingMotion(box());
  motion.sound.firstContact = 0.05;
  const Player player{Parsed(formatGlb(motion, box()).value())};
  const Pose start = PoseTrack(motion).at(-0.05);
  EXPECT_LT((player.position(0) - start.position).norm(), 1e-6);
}

TEST(Glb, TellsContactsSeedAndSound) {
  const Motion motion = test::makeSlidingMotion(box());
  const Json extras = Parsed(formatGlb(motion, box()).value()).json["nodes"][0]["extras"];
  EXPECT_EQ(extras["seed"], "18446744073709551615");
  EXPECT_EQ(extras["sound"], "sound.wav");
  EXPECT_EQ(extras["contact_starts"].size(), 3u);
  EXPECT_EQ(extras["contact_starts"][0], 0.25);
}

TEST(Glb, HasTheMaterials) {
  const Json json = Parsed(formatGlb(test::makeSlidingMotion(box()), box()).value()).json;
  ASSERT_EQ(json["materials"].size(), 2u);
  EXPECT_EQ(json["materials"][0]["name"], "red");
  EXPECT_EQ(json["materials"][1]["alphaMode"], "BLEND");
  EXPECT_EQ(json["meshes"][0]["primitives"].size(), 2u);
}

TEST(Glb, HasAFloorAndALightWhenAsked) {
  const Motion motion = test::makeSlidingMotion(box());
  EXPECT_FALSE(Parsed(formatGlb(motion, box()).value()).json.contains("extensionsUsed"));
  AnimationSettings settings;
  settings.floorAndLight = true;
  const Parsed file(formatGlb(motion, box(), settings).value());
  EXPECT_EQ(file.json["scenes"][0]["nodes"], Json({0, 1, 2}));
  EXPECT_EQ(file.json["nodes"][0]["name"], box().definition.name);
  EXPECT_EQ(file.json["nodes"][1]["name"], "floor");
  EXPECT_EQ(file.json["extensionsUsed"], Json({"KHR_lights_punctual"}));
  EXPECT_TRUE(file.json["nodes"][2]["extensions"].contains("KHR_lights_punctual"));
  const Json& floor = file.json["meshes"][1]["primitives"][0];
  const Json& range = file.json["accessors"][floor["attributes"]["POSITION"].get<std::size_t>()];
  EXPECT_EQ(range["min"][1], 0.0);
  EXPECT_EQ(range["max"][1], 0.0);
  for (const MotionSample& sample : motion.trajectory) {
    EXPECT_GT(sample.position.x() - 0.1, range["min"][0]);
    EXPECT_LT(sample.position.x() + 0.1, range["max"][0]);
    EXPECT_GT(-sample.position.y() - 0.1, range["min"][2]);
    EXPECT_LT(-sample.position.y() + 0.1, range["max"][2]);
  }
}

TEST(Glb, IsTheSameEveryTime) {
  const Motion motion = test::makeTumblingMotion(box());
  EXPECT_EQ(formatGlb(motion, box()).value(), formatGlb(motion, box()).value());
}

TEST(Glb, RefusesWhatCannotBeShown) {
  Motion motion = test::makeTumblingMotion(box());
  Body bare = box();
  bare.mesh.triangles.clear();
  EXPECT_EQ(formatGlb(motion, bare).error().code, ErrorCode::kInternal);
  motion.trajectory.clear();
  EXPECT_EQ(formatGlb(motion, box()).error().code, ErrorCode::kInternal);
}

TEST(Glb, PassesTheKhronosValidator) {
  const std::filesystem::path here = std::filesystem::path(IFA_SOURCE_DIR) / "tests/export";
  if (!std::filesystem::exists(here / "node_modules/gltf-validator")) {
    GTEST_SKIP() << "the validator is not installed: npm ci in tests/export";
  }
  const auto folder = std::filesystem::path(testing::TempDir()) / "ifa_glb";
  std::filesystem::create_directories(folder);
  std::string command = "node '" + (here / "validate_glb.mjs").string() + "'";
  AnimationSettings settings;
  const auto write = [&](const std::string& name, const Motion& motion, const Body& body) {
    const std::string path = (folder / (name + ".glb")).string();
    ASSERT_TRUE(writeGlb(path, motion, body, settings).has_value());
    command += " '" + path + "'";
  };
  const Motion sliding = test::makeSlidingMotion(box());
  write("tumbling", test::makeTumblingMotion(box()), box());
  write("sliding", sliding, box());
  settings.floorAndLight = true;
  write("floor_and_light", sliding, box());
  settings.floorAndLight = false;
  const auto objects = listObjects();
  ASSERT_TRUE(objects.has_value());
  for (const std::string& name : *objects) write(name, sliding, loadObject(name).value());
  EXPECT_EQ(std::system(command.c_str()), 0);
  std::filesystem::remove_all(folder);
}

TEST(DrawableMesh, KeepsABoxFlatAndACylinderRound) {
  const DrawableMesh flat = drawableMesh(box().mesh, 30);
  EXPECT_EQ(flat.positions.size(), 24u);  // three normals at each of eight corners
  Mesh tube;
  constexpr int kSides = 24;
  for (int i = 0; i < kSides; ++i) {
    const double angle = 2 * 3.14159265358979 * i / kSides;
    tube.vertices.emplace_back(std::cos(angle), std::sin(angle), 0);
    tube.vertices.emplace_back(std::cos(angle), std::sin(angle), 1);
    const int a = 2 * i, b = 2 * ((i + 1) % kSides);
    tube.triangles.push_back({a, b, b + 1});
    tube.triangles.push_back({a, b + 1, a + 1});
  }
  const DrawableMesh round = drawableMesh(tube, 30);
  EXPECT_EQ(round.positions.size(), 2u * kSides);
  for (std::size_t i = 0; i < round.normals.size(); ++i) {
    EXPECT_NEAR(round.normals[i][0], round.positions[i][0], 2e-3);
    EXPECT_NEAR(round.normals[i][2], 0, 1e-6);
  }
}

TEST(DrawableMesh, LeavesOutTrianglesWithoutArea) {
  Mesh mesh = box().mesh;
  mesh.triangles.push_back({0, 0, 1});
  mesh.triangleMaterial.push_back(0);
  EXPECT_EQ(drawableMesh(mesh, 30).triangles[0].size(), 3u * 10);
}

TEST(PoseTrack, IsExactInFlight) {
  // Half of the samples of a flight predict the other half.
  const Motion motion = test::makeTumblingMotion(box());
  Motion sparse = motion;
  sparse.trajectory.clear();
  for (std::size_t i = 0; i < 40; i += 2) sparse.trajectory.push_back(motion.trajectory[i]);
  const PoseTrack track(sparse);
  for (std::size_t i = 0; i < 38; ++i) {
    const Pose pose = track.at(motion.trajectory[i].time);
    EXPECT_LT((pose.position - motion.trajectory[i].position).norm(), 1e-12);
    EXPECT_LT(pose.orientation.angularDistance(motion.trajectory[i].orientation), 2e-6);
  }
}

}  // namespace
}  // namespace ifa
