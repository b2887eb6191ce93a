// SPDX-License-Identifier: Apache-2.0
#include "pipeline/colour_materials.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <sstream>
#include <string>
#include <vector>

#include "base/file.h"
#include "body/object_file.h"

namespace ifa {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kMaxBytes = std::size_t{16} << 20;

/// Index of the material with the largest area; the size of the list where there is none.
std::size_t mainMaterial(const Mesh& mesh) {
  if (mesh.triangleMaterial.empty()) return mesh.materials.size();
  std::vector<double> area(mesh.materials.size(), 0.0);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto corner = [&](std::size_t k) {
      return mesh.vertices[static_cast<std::size_t>(mesh.triangles[i][k])];
    };
    const auto material = static_cast<std::size_t>(mesh.triangleMaterial[i]);
    if (material >= area.size()) continue;
    area[material] += (corner(1) - corner(0)).cross(corner(2) - corner(0)).norm();
  }
  return static_cast<std::size_t>(std::max_element(area.begin(), area.end()) - area.begin());
}

/// The text of an MTL file with that material's Kd replaced; `found` tells whether there was one.
std::string recoloured(const std::string& text, const std::string& material,
                       const std::array<double, 3>& colour, bool& found) {
  std::istringstream lines(text);
  std::string result, current;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string key, value;
    words >> key >> value;
    if (key == "newmtl") current = value;
    if (key == "Kd" && current == material) {
      line = fmt::format("Kd {} {} {}", colour[0], colour[1], colour[2]);
      found = true;
    }
    result += line + "\n";
  }
  return result;
}

}  // namespace

Result<void> colourMaterials(const fs::path& folder, const std::array<double, 3>& colour,
                             Body& body) {
  const std::size_t material = mainMaterial(body.mesh);
  bool found = false;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (material >= body.mesh.materials.size() || entry.path().extension() != ".mtl") continue;
    const auto text = readFile(entry.path(), kMaxBytes);
    if (!text) return tl::unexpected(text.error());
    const auto changed = recoloured(*text, body.mesh.materials[material].name, colour, found);
    if (auto written = writeFileAtomically(entry.path(), changed); !written) return written;
  }
  if (!found) {
    return badInput("has no material that could get a colour", body.definition.name,
                    "leave the colour out, or give its OBJ file an MTL file with Kd");
  }
  // Read again: how Kd becomes what is drawn is for the reader of meshes to say.
  auto again = loadObject((folder / (body.definition.name + ".json")).string());
  if (!again) return tl::unexpected(again.error());
  body = std::move(*again);
  return {};
}

}  // namespace ifa
