// SPDX-License-Identifier: Apache-2.0
#include "studio/read_mesh.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "base/file.h"
#include "body/mesh_import.h"
#include "body/mesh_report.h"
#include "body/mesh_text.h"
#include "body/simple_hull.h"

namespace ifa::studio {

Result<void> readMesh(const std::filesystem::path& path, const std::filesystem::path& folder) {
  const auto mesh = importMesh(path, 1, OtherFiles::kIgnored);
  if (!mesh) return tl::unexpected(mesh.error());
  const MeshReport report = inspectMesh(*mesh);
  if (!report.usable()) {
    const MeshProblem& worst = report.problems.front();
    return badInput("nothing can be made of it: " + worst.message, path.string(), worst.remedy);
  }
  if (auto hull = hullForPhysics(mesh->vertices); !hull) {
    hull.error().place = path.string();
    return tl::unexpected(hull.error());
  }
  const nlohmann::json json = {
      {"triangles", report.triangles},
      {"vertices", report.vertices},
      {"openEdges", report.openEdges},
      {"inconsistentEdges", report.inconsistentEdges},
      {"degenerateTriangles", report.degenerateTriangles},
      {"area", report.area},
      {"volume", std::abs(report.volume)},
      {"extent", {report.extent.x(), report.extent.y(), report.extent.z()}},
      {"solid", report.solid()}};
  for (const auto& [name, text] :
       {std::pair{"mesh.mtl", mtlText(*mesh)}, std::pair{"mesh.obj", objText(*mesh, "mesh.mtl")},
        std::pair{"report.json", json.dump()}}) {
    if (auto written = writeFileAtomically(folder / name, text); !written) return written;
  }
  return {};
}

}  // namespace ifa::studio
