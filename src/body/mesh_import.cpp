// SPDX-License-Identifier: Apache-2.0
#include "body/mesh_import.h"

#include <assimp/DefaultIOSystem.h>
#include <assimp/config.h>
#include <assimp/material.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <assimp/Importer.hpp>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <system_error>
#include <utility>

#include "base/child_process.h"
#include "body/mesh_bytes.h"
#include "body/mesh_report.h"

namespace ifa {

using Eigen::Vector3d;

namespace {

constexpr std::uintmax_t kMaxMeshBytes = std::uintmax_t{1} << 29;
constexpr double kWeldRelative = 1e-6;
constexpr std::size_t kMaxMaterials = 256;

double linearFromSrgb(double c) {
  return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

// Files other than glTF state colours as they look on a screen.
std::array<double, 4> linearColour(const aiColor4D& colour, bool isLinear) {
  const auto channel = [&](double c) {
    const double bounded = std::isfinite(c) ? std::min(std::max(c, 0.0), 1.0) : 0.8;
    return isLinear ? bounded : linearFromSrgb(bounded);
  };
  const double alpha = static_cast<double>(colour.a);
  return {channel(static_cast<double>(colour.r)), channel(static_cast<double>(colour.g)),
          channel(static_cast<double>(colour.b)),
          std::isfinite(alpha) ? std::min(std::max(alpha, 0.0), 1.0) : 1.0};
}

// glTF states roughness, MTL files a Phong exponent.
double roughnessOf(const aiMaterial& material) {
  ai_real value = 0;
  if (material.Get(AI_MATKEY_ROUGHNESS_FACTOR, value) == aiReturn_SUCCESS) {
    return std::min(std::max(static_cast<double>(value), 0.0), 1.0);
  }
  if (material.Get(AI_MATKEY_SHININESS, value) == aiReturn_SUCCESS && value > 0) {
    return std::min(1.0, std::sqrt(2 / (static_cast<double>(value) + 2)));
  }
  return MeshMaterial{}.roughness;
}

MeshMaterial materialOf(const aiMaterial& material, bool isLinear) {
  MeshMaterial result;
  aiString name;
  if (material.Get(AI_MATKEY_NAME, name) == aiReturn_SUCCESS) result.name = name.C_Str();
  aiColor4D colour(0.8f, 0.8f, 0.8f, 1.0f);
  if (material.Get(AI_MATKEY_BASE_COLOR, colour) == aiReturn_SUCCESS ||
      material.Get(AI_MATKEY_COLOR_DIFFUSE, colour) == aiReturn_SUCCESS) {
    result.colour = linearColour(colour, isLinear);
  }
  result.roughness = roughnessOf(material);
  ai_real metallic = 0;
  if (material.Get(AI_MATKEY_METALLIC_FACTOR, metallic) == aiReturn_SUCCESS) {
    result.metallic = std::min(std::max(static_cast<double>(metallic), 0.0), 1.0);
  }
  return result;
}

/// Gathers a scene's meshes, node by node, in one mesh.
class SceneGatherer {
 public:
  SceneGatherer(const aiScene& scene, double scale, bool isLinear)
      : scene_(scene), scale_(scale), isLinear_(isLinear) {
    for (unsigned i = 0; i < scene.mNumMaterials; ++i) {
      mesh.materials.push_back(materialOf(*scene.mMaterials[i], isLinear));
    }
    if (mesh.materials.empty()) mesh.materials.emplace_back();
  }

  /// False when there are more than kMaxTriangles.
  bool gather() {
    std::vector<std::pair<const aiNode*, aiMatrix4x4>> pending = {{scene_.mRootNode, {}}};
    while (!pending.empty()) {
      const auto [node, worldFromParent] = pending.back();
      pending.pop_back();
      if (node == nullptr) continue;
      const aiMatrix4x4 worldFromNode = worldFromParent * node->mTransformation;
      for (unsigned i = 0; i < node->mNumMeshes; ++i) {
        if (!add(*scene_.mMeshes[node->mMeshes[i]], worldFromNode)) return false;
      }
      for (unsigned i = node->mNumChildren; i > 0; --i) {
        pending.emplace_back(node->mChildren[i - 1], worldFromNode);
      }
    }
    return true;
  }

  Mesh mesh;

 private:
  bool add(const aiMesh& part, const aiMatrix4x4& worldFromMesh) {
    if (mesh.triangles.size() + part.mNumFaces > kMaxTriangles) return false;
    const auto base = static_cast<int>(mesh.vertices.size());
    for (unsigned i = 0; i < part.mNumVertices; ++i) {
      const aiVector3D p = worldFromMesh * part.mVertices[i];
      mesh.vertices.push_back(scale_ * Vector3d(static_cast<double>(p.x), static_cast<double>(p.y),
                                                static_cast<double>(p.z)));
    }
    // A mirroring node turns its triangles inside out.
    const bool mirrored = worldFromMesh.Determinant() < 0;
    for (unsigned i = 0; i < part.mNumFaces; ++i) {
      const aiFace& face = part.mFaces[i];
      if (face.mNumIndices != 3) continue;
      std::array<int, 3> triangle = {};
      for (unsigned k = 0; k < 3; ++k) triangle[k] = base + static_cast<int>(face.mIndices[k]);
      if (mirrored) std::swap(triangle[1], triangle[2]);
      mesh.triangles.push_back(triangle);
      mesh.triangleMaterial.push_back(materialOfFace(part, face));
    }
    return true;
  }

  int materialOfFace(const aiMesh& part, const aiFace& face) {
    if (!part.HasVertexColors(0)) {
      return std::min(static_cast<int>(part.mMaterialIndex),
                      static_cast<int>(mesh.materials.size()) - 1);
    }
    aiColor4D mean(0, 0, 0, 0);
    for (unsigned k = 0; k < 3; ++k) mean = mean + part.mColors[0][face.mIndices[k]];
    return colourMaterial(linearColour(mean / 3.0f, isLinear_));
  }

  // One material per colour to five bits a channel; past kMaxMaterials the first is used.
  int colourMaterial(const std::array<double, 4>& colour) {
    std::array<int, 4> key = {};
    for (std::size_t i = 0; i < 4; ++i) key[i] = static_cast<int>(std::lround(31 * colour[i]));
    const auto found = colours_.find(key);
    if (found != colours_.end()) return found->second;
    if (mesh.materials.size() >= kMaxMaterials) return 0;
    MeshMaterial material;
    material.name = "colour" + std::to_string(colours_.size() + 1);
    material.colour = colour;
    mesh.materials.push_back(material);
    return colours_[key] = static_cast<int>(mesh.materials.size()) - 1;
  }

  const aiScene& scene_;
  double scale_;
  bool isLinear_;
  std::map<std::array<int, 4>, int> colours_;
};

tl::unexpected<Error> tooManyTriangles(const std::string& place) {
  return badInput("has more than " + std::to_string(kMaxTriangles) + " triangles", place,
                  "simplify the mesh; a few thousand triangles are enough");
}

Result<void> checkFile(const std::filesystem::path& path) {
  std::error_code code;
  const auto status = std::filesystem::status(path, code);
  if (!std::filesystem::exists(status)) return badInput("no such mesh file", path.string());
  if (!std::filesystem::is_regular_file(status)) return badInput("is not a file", path.string());
  const std::uintmax_t bytes = std::filesystem::file_size(path, code);
  if (code) return badInput("cannot be read: " + code.message(), path.string());
  if (bytes == 0) return badInput("is empty", path.string());
  if (bytes > kMaxMeshBytes) return tooManyTriangles(path.string());
  return {};
}

// Importers add a default material even where no triangle has it.
void dropUnusedMaterials(Mesh& mesh) {
  std::vector<int> newIndex(mesh.materials.size(), -1);
  std::vector<MeshMaterial> used;
  for (int& material : mesh.triangleMaterial) {
    int& index = newIndex[static_cast<std::size_t>(material)];
    if (index < 0) {
      index = static_cast<int>(used.size());
      used.push_back(mesh.materials[static_cast<std::size_t>(material)]);
    }
    material = index;
  }
  mesh.materials = std::move(used);
}

void configure(Assimp::Importer& importer) {
  importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE,
                              aiPrimitiveType_POINT | aiPrimitiveType_LINE);
  importer.SetPropertyInteger(AI_CONFIG_PP_RVC_FLAGS,
                              aiComponent_NORMALS | aiComponent_TANGENTS_AND_BITANGENTS |
                                  aiComponent_TEXCOORDS | aiComponent_BONEWEIGHTS |
                                  aiComponent_ANIMATIONS | aiComponent_TEXTURES |
                                  aiComponent_LIGHTS | aiComponent_CAMERAS);
}

}  // namespace

namespace {

/// Processor time that a file of so many bytes may take, s; those over which assimp does not come
/// to an end are small. A large one takes a second for some megabytes.
double mostSeconds(const std::filesystem::path& path) {
  std::error_code code;
  const std::uintmax_t bytes = std::filesystem::file_size(path, code);
  return 1 + (code ? 0 : static_cast<double>(bytes) * 1e-5);
}

constexpr const char* kOtherFormat =
    "use OBJ, STL, PLY, glTF, 3MF, FBX or another format that assimp reads";

/// Shows assimp one file, as if there were no other.
class OneFileOnly : public Assimp::DefaultIOSystem {
 public:
  explicit OneFileOnly(std::string path) : path_(std::move(path)) {}
  bool Exists(const char* path) const override {
    return path == path_ && DefaultIOSystem::Exists(path);
  }
  Assimp::IOStream* Open(const char* path, const char* mode) override {
    return path == path_ ? DefaultIOSystem::Open(path, mode) : nullptr;
  }

 private:
  std::string path_;
};

/// As the file has it, triangles without area included.
Result<Mesh> readScene(const std::filesystem::path& path, double metresPerUnit, OtherFiles others) {
  const std::string place = path.string();
  Assimp::Importer importer;
  if (others == OtherFiles::kIgnored) importer.SetIOHandler(new OneFileOnly(place));
  configure(importer);
  const aiScene* scene = importer.ReadFile(
      place, aiProcess_RemoveComponent | aiProcess_Triangulate | aiProcess_SortByPType);
  if (scene == nullptr || scene->mNumMeshes == 0) {
    const std::string why = importer.GetErrorString();
    return badInput("is not a mesh that can be read" + (why.empty() ? "" : ": " + why), place,
                    kOtherFormat);
  }
  const std::string extension = path.extension().string();
  SceneGatherer gatherer(*scene, metresPerUnit, extension == ".gltf" || extension == ".glb");
  if (!gatherer.gather()) return tooManyTriangles(place);
  return std::move(gatherer.mesh);
}

}  // namespace

Result<Mesh> importMesh(const std::filesystem::path& path, double metresPerUnit,
                        OtherFiles others) {
  const std::string place = path.string();
  if (const auto good = checkFile(path); !good) return tl::unexpected(good.error());
  // assimp ends the program over some damaged files, and never ends over others.
  const auto bytes = callInChild([&] { return meshBytes(readScene(path, metresPerUnit, others)); },
                                 mostSeconds(path));
  if (!bytes) {
    return badInput("is not a mesh that can be read: assimp fails over it", place,
                    "export it again, or in another format");
  }
  auto mesh = meshFromBytes(*bytes);
  if (!mesh) {
    if (mesh.error().place.empty()) mesh.error().place = place;
    return mesh;
  }
  Eigen::AlignedBox3d box;
  for (const Vector3d& vertex : mesh->vertices) {
    if (!vertex.allFinite()) return badInput("a vertex is not a finite number", place);
    box.extend(vertex);
  }
  if (mesh->triangles.empty()) return badInput("holds no triangles", place);
  dropUnusedMaterials(*mesh);
  return weldVertices(*mesh, kWeldRelative * box.sizes().maxCoeff());
}

}  // namespace ifa
