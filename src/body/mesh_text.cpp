// SPDX-License-Identifier: Apache-2.0
#include "body/mesh_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace ifa {

namespace {

double srgbFromLinear(double c) {
  return c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1 / 2.4) - 0.055;
}

// Names are numbered, so that two of the same name stay apart, and hold no blanks.
std::string materialName(const Mesh& mesh, std::size_t index) {
  std::string name = mesh.materials[index].name;
  for (char& c : name) {
    const bool plain = (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
                       c == '_' || c == '-';
    if (!plain) c = '_';
  }
  return fmt::format("m{}_{}", index, name);
}

bool hasMaterials(const Mesh& mesh) {
  return !mesh.materials.empty() && mesh.triangleMaterial.size() == mesh.triangles.size();
}

}  // namespace

std::string objText(const Mesh& mesh, const std::string& mtlFile) {
  fmt::memory_buffer text;
  const auto out = std::back_inserter(text);
  if (!mtlFile.empty()) fmt::format_to(out, "mtllib {}\n", mtlFile);
  for (const auto& v : mesh.vertices) {
    fmt::format_to(out, "v {:.9g} {:.9g} {:.9g}\n", v.x(), v.y(), v.z());
  }
  int current = -1;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const int material = hasMaterials(mesh) ? mesh.triangleMaterial[i] : current;
    if (material != current) {
      current = material;
      fmt::format_to(out, "usemtl {}\n", materialName(mesh, static_cast<std::size_t>(current)));
    }
    const auto& t = mesh.triangles[i];
    fmt::format_to(out, "f {} {} {}\n", t[0] + 1, t[1] + 1, t[2] + 1);
  }
  return fmt::to_string(text);
}

std::string mtlText(const Mesh& mesh) {
  std::string text;
  for (std::size_t i = 0; i < mesh.materials.size(); ++i) {
    const MeshMaterial& m = mesh.materials[i];
    const double roughness = std::max(m.roughness, 0.03);
    text += fmt::format(
        "newmtl {}\nKd {:.4g} {:.4g} {:.4g}\nd {:.4g}\nNs {:.4g}\nPr {:.4g}\nPm {:.4g}\n",
        materialName(mesh, i), srgbFromLinear(m.colour[0]), srgbFromLinear(m.colour[1]),
        srgbFromLinear(m.colour[2]), m.colour[3], std::max(0.0, 2 / (roughness * roughness) - 2),
        m.roughness, m.metallic);
  }
  return text;
}

}  // namespace ifa
