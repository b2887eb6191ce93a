// SPDX-License-Identifier: Apache-2.0
#include "export/usda.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <set>

#include "base/file.h"
#include "body/drawable_mesh.h"

namespace ifa {

namespace {

constexpr double kCodesPerSecond = 24;

/// A prim's name: letters, digits and underscores, the first no digit.
std::string identifier(const std::string& name) {
  std::string out = name.empty() ? "body" : name;
  for (char& c : out) {
    if (std::isalnum(static_cast<unsigned char>(c)) == 0 || static_cast<unsigned char>(c) > 127) {
      c = '_';
    }
  }
  return std::isdigit(static_cast<unsigned char>(out[0])) != 0 ? "_" + out : out;
}

/// A text in double quotes.
std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += static_cast<unsigned char>(c) < ' ' ? ' ' : c;
  }
  return out + '"';
}

class Stage {
 public:
  template <class... Args>
  void line(fmt::format_string<Args...> format, Args&&... args) {
    text_.append(4 * depth_, ' ');
    fmt::format_to(std::back_inserter(text_), format, std::forward<Args>(args)...);
    text_ += '\n';
  }
  void open() {
    line("{{");
    ++depth_;
  }
  void close() {
    --depth_;
    line("}}");
  }
  /// `name = [item(0), item(1), ...]` on one line.
  template <class Item>
  void array(const std::string& name, std::size_t count, const Item& item, const char* after = "") {
    std::string values;
    for (std::size_t i = 0; i < count; ++i) {
      if (i > 0) values += ", ";
      values += item(i);
    }
    line("{} = [{}]{}", name, values, after);
  }
  /// `name.timeSamples = {...}`, one sample a line.
  template <class Item>
  void samples(const std::string& name, const std::vector<AnimationKey>& keys, const Item& item) {
    line("{}.timeSamples = {{", name);
    ++depth_;
    for (const AnimationKey& key : keys) {
      line("{}: {},", static_cast<double>(key.time) * kCodesPerSecond, item(key.pose));
    }
    close();
  }
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  std::string text_;
  std::size_t depth_ = 0;
};

std::string triple(const std::array<float, 3>& v) {
  return fmt::format("({}, {}, {})", v[0], v[1], v[2]);
}

struct MaterialOf {
  MeshMaterial material;
  std::string name;  ///< of its prim
};

/// Names of their own for all materials of a mesh; one plain one where it has none.
std::vector<MaterialOf> materialsOf(const Mesh& mesh) {
  std::vector<MaterialOf> all;
  std::set<std::string> taken;
  for (const MeshMaterial& material : mesh.materials) {
    const std::string wanted = identifier(material.name);
    std::string name = wanted;
    for (int i = 2; !taken.insert(name).second; ++i) name = fmt::format("{}_{}", wanted, i);
    all.push_back({material, name});
  }
  if (all.empty()) all.push_back(MaterialOf{MeshMaterial(), "plain"});
  return all;
}

void addMesh(const DrawableMesh& mesh, std::size_t index, const MaterialOf& of,
             const std::string& body, Stage& stage) {
  const auto& corners = mesh.triangles[index];
  // Each mesh has its own points: those that its triangles use, in the order of their first use.
  std::vector<int> number(mesh.positions.size(), -1);
  std::vector<std::size_t> used;
  for (const std::uint32_t corner : corners) {
    if (number[corner] >= 0) continue;
    number[corner] = static_cast<int>(used.size());
    used.push_back(corner);
  }
  const auto& colour = of.material.colour;
  stage.line("def Mesh \"{}\" (", of.name);
  stage.line("    prepend apiSchemas = [\"MaterialBindingAPI\"]");
  stage.line(")");
  stage.open();
  stage.array("int[] faceVertexCounts", corners.size() / 3,
              [](std::size_t) { return std::string("3"); });
  stage.array("int[] faceVertexIndices", corners.size(),
              [&](std::size_t i) { return std::to_string(number[corners[i]]); });
  stage.array("point3f[] points", used.size(),
              [&](std::size_t i) { return triple(mesh.positions[used[i]]); });
  // The parenthesis closes on a line of its own, as OpenUSD writes it: not all readers know it
  // inline.
  stage.array(
      "normal3f[] normals", used.size(),
      [&](std::size_t i) { return triple(mesh.normals[used[i]]); }, " (");
  stage.line("    interpolation = \"vertex\"");
  stage.line(")");
  stage.line("color3f[] primvars:displayColor = [({}, {}, {})]", colour[0], colour[1], colour[2]);
  stage.line("rel material:binding = </motion/{}/materials/{}>", body, of.name);
  stage.line("uniform token subdivisionScheme = \"none\"");
  stage.close();
}

void addMaterial(const MaterialOf& of, const std::string& body, Stage& stage) {
  const auto& colour = of.material.colour;
  stage.line("def Material \"{}\"", of.name);
  stage.open();
  stage.line("token outputs:surface.connect = </motion/{}/materials/{}/shader.outputs:surface>",
             body, of.name);
  stage.line("def Shader \"shader\"");
  stage.open();
  stage.line("uniform token info:id = \"UsdPreviewSurface\"");
  stage.line("color3f inputs:diffuseColor = ({}, {}, {})", colour[0], colour[1], colour[2]);
  stage.line("float inputs:opacity = {}", colour[3]);
  stage.line("float inputs:roughness = {}", of.material.roughness);
  stage.line("float inputs:metallic = {}", of.material.metallic);
  stage.line("token outputs:surface");
  stage.close();
  stage.close();
}

void addBody(const std::vector<AnimationKey>& keys, const DrawableMesh& mesh,
             const std::vector<MaterialOf>& materials, const std::string& name, Stage& stage) {
  stage.line("def Xform \"{}\"", name);
  stage.open();
  stage.samples("double3 xformOp:translate", keys, [](const Pose& pose) {
    const Eigen::Vector3d& p = pose.position;
    return fmt::format("({}, {}, {})", p.x(), p.y(), p.z());
  });
  stage.samples("quatf xformOp:orient", keys, [](const Pose& pose) {
    const Eigen::Quaternionf q = pose.orientation.cast<float>();
    return fmt::format("({}, {}, {}, {})", q.w(), q.x(), q.y(), q.z());
  });
  stage.line("uniform token[] xformOpOrder = [\"xformOp:translate\", \"xformOp:orient\"]");
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    if (!mesh.triangles[i].empty()) addMesh(mesh, i, materials[i], name, stage);
  }
  stage.line("def Scope \"materials\"");
  stage.open();
  for (const MaterialOf& material : materials) addMaterial(material, name, stage);
  stage.close();
  stage.close();
}

void addSound(const MotionSound& sound, Stage& stage) {
  stage.line("def SpatialAudio \"sound\"");
  stage.open();
  stage.line("uniform asset filePath = @./{}@", sound.file);
  stage.line("uniform token auralMode = \"nonSpatial\"");
  // From code 0 to the sound's own end: the schema's fallback for startTime, and what this mode
  // means. Said with attributes of type timecode, it would keep TinyUSDZ from reading the stage.
  stage.line("uniform token playbackMode = \"onceFromStart\"");
  stage.close();
}

void addHeader(const Motion& motion, double last, Stage& stage) {
  stage.line("#usda 1.0");
  stage.line("(");
  stage.line("    defaultPrim = \"motion\"");
  stage.line("    doc = {}", quoted("Inverse Foley " + motion.program));
  stage.line("    startTimeCode = 0");
  stage.line("    endTimeCode = {}", last * kCodesPerSecond);
  stage.line("    framesPerSecond = {}", kCodesPerSecond);
  stage.line("    timeCodesPerSecond = {}", kCodesPerSecond);
  stage.line("    metersPerUnit = 1");
  stage.line("    upAxis = \"Z\"");
  stage.line(")");
  stage.line("");
}

tl::unexpected<Error> internalError(const char* message) {
  return tl::unexpected<Error>(Error{ErrorCode::kInternal, message, "motion.usda", {}});
}

}  // namespace

Result<std::string> formatUsda(const Motion& motion, const Body& body,
                               const AnimationSettings& settings) {
  if (motion.trajectory.empty()) return internalError("the motion has no samples");
  const DrawableMesh mesh = drawableMesh(body.mesh, settings.creaseDegrees);
  if (mesh.positions.empty()) return internalError("the mesh has no triangles with an area");
  const auto keys = animationKeys(motion, body.mesh, settings);
  Stage stage;
  const double end = std::max(static_cast<double>(keys.back().time), motion.sound.duration);
  addHeader(motion, end, stage);
  stage.line("def Xform \"motion\"");
  stage.open();
  // Beside a prim for the sound the body keeps a name of its own.
  const std::string wanted = identifier(body.definition.name);
  addBody(keys, mesh, materialsOf(body.mesh), wanted == "sound" ? "sound_" : wanted, stage);
  if (!motion.sound.file.empty()) addSound(motion.sound, stage);
  stage.close();
  return stage.text();
}

Result<void> writeUsda(const std::filesystem::path& path, const Motion& motion, const Body& body,
                       const AnimationSettings& settings) {
  const auto text = formatUsda(motion, body, settings);
  if (!text) return tl::unexpected<Error>(text.error());
  return writeFileAtomically(path, *text);
}

}  // namespace ifa
