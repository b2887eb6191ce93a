// SPDX-License-Identifier: Apache-2.0
// Decision: an own writer; the JSON of one node and one animation is shorter than a library's
// set-up for it, and its bytes are ours to keep stable.
#include "export/glb.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>

#include "base/file.h"
#include "body/drawable_mesh.h"

namespace ifa {
namespace {

using Json = nlohmann::ordered_json;

static_assert(std::endian::native == std::endian::little, "glTF buffers are little-endian");

// glTF's numbers for component types and buffer targets.
constexpr int kFloat = 5126, kUnsignedInt = 5125;
constexpr int kVertexTarget = 34962, kIndexTarget = 34963;

/// World frame (z up) to glTF's (y up): x stays, y becomes -z.
template <class T>
std::array<T, 3> yUp(T x, T y, T z) {
  return {x, z, -y};
}

std::vector<std::array<float, 3>> allYUp(std::vector<std::array<float, 3>> vectors) {
  for (auto& v : vectors) v = yUp(v[0], v[1], v[2]);
  return vectors;
}

/// The one buffer and the JSON tables that say what lies where.
class Buffer {
 public:
  /// @param components  floats or indices per element. Returns the accessor's index.
  template <class T>
  int add(const std::vector<T>& items, const char* type, int componentType, int target = 0) {
    Json view = {
        {"buffer", 0}, {"byteOffset", bytes_.size()}, {"byteLength", items.size() * sizeof(T)}};
    if (target != 0) view["target"] = target;
    views_.push_back(view);
    accessors_.push_back({{"bufferView", views_.size() - 1},
                          {"componentType", componentType},
                          {"count", items.size()},
                          {"type", type}});
    bytes_.append(reinterpret_cast<const char*>(items.data()), items.size() * sizeof(T));
    return static_cast<int>(accessors_.size()) - 1;
  }
  void setRange(int accessor, const Json& low, const Json& high) {
    accessors_[static_cast<std::size_t>(accessor)]["min"] = low;
    accessors_[static_cast<std::size_t>(accessor)]["max"] = high;
  }
  void describe(Json& root) const {
    root["accessors"] = accessors_;
    root["bufferViews"] = views_;
    root["buffers"] = Json::array({{{"byteLength", bytes_.size()}}});
  }
  [[nodiscard]] const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
  Json views_ = Json::array(), accessors_ = Json::array();
};

Json materialJson(const MeshMaterial& material) {
  Json json = {{"name", material.name},
               {"pbrMetallicRoughness",
                {{"baseColorFactor", material.colour},
                 {"metallicFactor", material.metallic},
                 {"roughnessFactor", material.roughness}}}};
  if (material.colour[3] < 1) json["alphaMode"] = "BLEND";
  return json;
}

/// What is made of one body before anything is written.
struct Shown {
  const GlbBody* what;
  DrawableMesh drawable;
  std::vector<AnimationKey> keys;
};

void addMesh(const Mesh& mesh, const DrawableMesh& drawable, const std::string& name,
             Buffer& buffer, Json& root) {
  const auto positions = allYUp(drawable.positions);
  std::array<float, 3> low = positions.front(), high = low;
  for (const auto& p : positions) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], p[axis]);
      high[axis] = std::max(high[axis], p[axis]);
    }
  }
  const int position = buffer.add(positions, "VEC3", kFloat, kVertexTarget);
  buffer.setRange(position, low, high);
  const int normal = buffer.add(allYUp(drawable.normals), "VEC3", kFloat, kVertexTarget);
  Json primitives = Json::array();
  Json& materials = root["materials"];
  for (std::size_t i = 0; i < drawable.triangles.size(); ++i) {
    if (drawable.triangles[i].empty()) continue;
    const int indices = buffer.add(drawable.triangles[i], "SCALAR", kUnsignedInt, kIndexTarget);
    primitives.push_back({{"attributes", {{"POSITION", position}, {"NORMAL", normal}}},
                          {"indices", indices},
                          {"material", materials.size()}});
    materials.push_back(
        materialJson(i < mesh.materials.size() ? mesh.materials[i] : MeshMaterial{"default"}));
  }
  root["meshes"].push_back({{"name", name}, {"primitives", primitives}});
}

std::array<float, 3> translation(const Pose& pose) {
  return yUp(static_cast<float>(pose.position.x()), static_cast<float>(pose.position.y()),
             static_cast<float>(pose.position.z()));
}

/// glTF's order is x, y, z, w.
std::array<float, 4> rotation(const Pose& pose) {
  const Eigen::Quaterniond q = pose.orientation.normalized();
  const auto axis = yUp(q.x(), q.y(), q.z());
  return {static_cast<float>(axis[0]), static_cast<float>(axis[1]), static_cast<float>(axis[2]),
          static_cast<float>(q.w())};
}

void addChannel(int input, int output, const char* path, const char* interpolation,
                std::size_t node, Json& animation) {
  Json& samplers = animation["samplers"];
  animation["channels"].push_back(
      {{"sampler", samplers.size()}, {"target", {{"node", node}, {"path", path}}}});
  samplers.push_back({{"input", input}, {"interpolation", interpolation}, {"output", output}});
}

void addChannels(const std::vector<AnimationKey>& keys, std::size_t node, Buffer& buffer,
                 Json& animation) {
  std::vector<float> times;
  std::vector<std::array<float, 3>> translations;
  std::vector<std::array<float, 4>> rotations;
  for (const AnimationKey& key : keys) {
    times.push_back(key.time);
    translations.push_back(translation(key.pose));
    rotations.push_back(rotation(key.pose));
  }
  const int input = buffer.add(times, "SCALAR", kFloat);
  buffer.setRange(input, Json::array({times.front()}), Json::array({times.back()}));
  addChannel(input, buffer.add(translations, "VEC3", kFloat), "translation", "LINEAR", node,
             animation);
  addChannel(input, buffer.add(rotations, "VEC4", kFloat), "rotation", "LINEAR", node, animation);
}

/// A body that falls in while others play already is not there before, instead of hanging in the
/// air: its scale is 0 until then.
void addEntrance(const Motion& motion, std::size_t node, Buffer& buffer, Json& animation) {
  const auto begin = static_cast<float>(motion.trajectory.front().time + motion.sound.firstContact);
  if (!(begin > 0)) return;
  const int input = buffer.add(std::vector<float>{0, begin}, "SCALAR", kFloat);
  buffer.setRange(input, Json::array({0}), Json::array({begin}));
  const std::vector<std::array<float, 3>> scales = {{0, 0, 0}, {1, 1, 1}};
  addChannel(input, buffer.add(scales, "VEC3", kFloat), "scale", "STEP", node, animation);
}

/// Flat lists of numbers and texts only: importers keep those as custom properties. The seed is a
/// text because it can exceed what they hold in a number.
Json extras(const Motion& motion) {
  Json starts = Json::array(), ends = Json::array(), amplitudes = Json::array();
  for (const MotionContact& contact : motion.contacts) {
    starts.push_back(contact.time + motion.sound.firstContact);
    ends.push_back(contact.end + motion.sound.firstContact);
    amplitudes.push_back(contact.amplitude);
  }
  return {{"seed", std::to_string(motion.seed)},
          {"sound", motion.sound.file},
          {"first_contact", motion.sound.firstContact},
          {"contact_starts", starts},
          {"contact_ends", ends},
          {"contact_amplitudes", amplitudes}};
}

void addHeading(const std::string& program, Json& root) {
  root["asset"] = {{"version", "2.0"}, {"generator", "Inverse Foley " + program}};
  root["scene"] = 0;
  root["scenes"] = Json::array({{{"name", "scene"}, {"nodes", Json::array()}}});
  root["nodes"] = Json::array();
}

/// The scene's next node.
void addNode(Json node, Json& root) {
  root["scenes"][0]["nodes"].push_back(root["nodes"].size());
  root["nodes"].push_back(std::move(node));
}

void addBody(const Shown& shown, Json& root) {
  addNode({{"name", shown.what->name},
           {"mesh", root["nodes"].size()},
           {"translation", translation(shown.keys.front().pose)},
           {"rotation", rotation(shown.keys.front().pose)},
           {"extras", extras(*shown.what->motion)}},
          root);
}

/// A square at height 0, under the whole motion and ten times the largest body's size beyond it.
void addFloor(const std::vector<Shown>& all, Buffer& buffer, Json& root) {
  float size = 0;
  Eigen::AlignedBox2f ground;
  for (const Shown& shown : all) {
    for (const auto& p : shown.drawable.positions) {
      size = std::max(size, std::hypot(p[0], p[1], p[2]));
    }
    for (const AnimationKey& key : shown.keys) {
      ground.extend(key.pose.position.head<2>().cast<float>());
    }
  }
  const Eigen::Vector2f middle = ground.center();
  const float half = 0.5F * ground.sizes().maxCoeff() + 10 * size;
  std::vector<std::array<float, 3>> corners;
  for (const auto& [x, y] : {std::pair(-half, -half), {half, -half}, {half, half}, {-half, half}}) {
    corners.push_back(yUp(middle.x() + x, middle.y() + y, 0.0F));
  }
  const int position = buffer.add(corners, "VEC3", kFloat, kVertexTarget);
  buffer.setRange(position, corners[3], corners[1]);  // y becomes -z
  const std::vector<std::array<float, 3>> up(4, {0, 1, 0});
  const int normal = buffer.add(up, "VEC3", kFloat, kVertexTarget);
  const std::vector<std::uint32_t> triangles = {0, 1, 2, 0, 2, 3};
  const int indices = buffer.add(triangles, "SCALAR", kUnsignedInt, kIndexTarget);
  addNode({{"name", "floor"}, {"mesh", root["meshes"].size()}}, root);
  root["meshes"].push_back(
      {{"name", "floor"},
       {"primitives", Json::array({{{"attributes", {{"POSITION", position}, {"NORMAL", normal}}},
                                    {"indices", indices},
                                    {"material", root["materials"].size()}}})}});
  MeshMaterial material;
  material.name = "floor";
  material.colour = {0.35F, 0.35F, 0.35F, 1};
  material.roughness = 0.9F;
  root["materials"].push_back(materialJson(material));
}

/// As bright as a well-lit desk, from 60 degrees above the horizon.
void addLight(Json& root) {
  const Json light = {{"type", "directional"}, {"name", "light"}, {"intensity", 1000}};  // lux
  root["extensionsUsed"] = Json::array({"KHR_lights_punctual"});
  root["extensions"] = {{"KHR_lights_punctual", {{"lights", Json::array({light})}}}};
  addNode({{"name", "light"},
           {"rotation", {-0.5, 0, 0, 0.8660254037844386}},
           {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}},
          root);
}

void appendWord(std::string& out, std::uint32_t word) {
  char bytes[4];
  std::memcpy(bytes, &word, 4);
  out.append(bytes, 4);
}

/// The container: header, JSON padded with spaces, buffer (already a multiple of four).
std::string container(std::string json, const std::string& buffer) {
  json.append((4 - json.size() % 4) % 4, ' ');
  std::string out = "glTF";
  appendWord(out, 2);
  appendWord(out, static_cast<std::uint32_t>(12 + 8 + json.size() + 8 + buffer.size()));
  appendWord(out, static_cast<std::uint32_t>(json.size()));
  out += "JSON" + json;
  appendWord(out, static_cast<std::uint32_t>(buffer.size()));
  out.append("BIN\0", 4);
  return out + buffer;
}

tl::unexpected<Error> internalError(std::string message) {
  return tl::unexpected<Error>(Error{ErrorCode::kInternal, std::move(message), "motion.glb", {}});
}

}  // namespace

Result<std::string> formatGlb(const std::vector<GlbBody>& bodies,
                              const AnimationSettings& settings) {
  if (bodies.empty()) return internalError("there are no bodies");
  std::vector<Shown> all;
  for (const GlbBody& body : bodies) {
    if (body.motion->trajectory.empty()) return internalError("the motion has no samples");
    Shown shown{&body, drawableMesh(body.body->mesh, settings.creaseDegrees), {}};
    if (shown.drawable.positions.empty()) {
      return internalError("the mesh has no triangles with an area");
    }
    shown.keys = animationKeys(*body.motion, body.body->mesh, settings);
    all.push_back(std::move(shown));
  }
  Json root;
  Buffer buffer;
  addHeading(bodies.front().motion->program, root);
  for (const Shown& shown : all) addBody(shown, root);
  root["meshes"] = Json::array();
  root["materials"] = Json::array();
  Json animation = {{"name", "motion"}, {"channels", Json::array()}, {"samplers", Json::array()}};
  for (std::size_t i = 0; i < all.size(); ++i) {
    addMesh(all[i].what->body->mesh, all[i].drawable, all[i].what->name, buffer, root);
    addChannels(all[i].keys, i, buffer, animation);
    if (all.size() > 1) addEntrance(*all[i].what->motion, i, buffer, animation);
  }
  root["animations"] = Json::array({animation});
  if (settings.floorAndLight) {
    addFloor(all, buffer, root);
    addLight(root);
  }
  buffer.describe(root);
  const std::string json = root.dump(-1, ' ', false, Json::error_handler_t::replace);
  if (json.size() + buffer.bytes().size() > std::numeric_limits<std::uint32_t>::max() - 64) {
    return internalError("the motion does not fit into a GLB file (4 GiB)");
  }
  return container(json, buffer.bytes());
}

Result<std::string> formatGlb(const Motion& motion, const Body& body,
                              const AnimationSettings& settings) {
  const std::string& name = body.definition.name;
  return formatGlb(std::vector<GlbBody>{{&motion, &body, name.empty() ? "body" : name}}, settings);
}

Result<void> writeGlb(const std::filesystem::path& path, const std::vector<GlbBody>& bodies,
                      const AnimationSettings& settings) {
  const auto bytes = formatGlb(bodies, settings);
  if (!bytes) return tl::unexpected<Error>(bytes.error());
  return writeFileAtomically(path, *bytes);
}

Result<void> writeGlb(const std::filesystem::path& path, const Motion& motion, const Body& body,
                      const AnimationSettings& settings) {
  const auto bytes = formatGlb(motion, body, settings);
  if (!bytes) return tl::unexpected<Error>(bytes.error());
  return writeFileAtomically(path, *bytes);
}

}  // namespace ifa
