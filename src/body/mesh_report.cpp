// SPDX-License-Identifier: Apache-2.0
#include "body/mesh_report.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "body/mass_properties.h"

namespace ifa {

using Eigen::Vector3d;

namespace {

constexpr double kLargestLikelySize = 2.0;     // m
constexpr double kSmallestLikelySize = 0.001;  // m

/// A directed edge of a triangle as an undirected key and the way it runs.
struct Edge {
  std::uint64_t key = 0;
  int direction = 0;
};

std::vector<Edge> sortedEdges(const Mesh& mesh) {
  std::vector<Edge> edges;
  edges.reserve(mesh.triangles.size() * 3);
  for (const auto& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto from = static_cast<std::uint32_t>(t[k]);
      const auto to = static_cast<std::uint32_t>(t[(k + 1) % 3]);
      const auto low = std::min(from, to), high = std::max(from, to);
      edges.push_back({std::uint64_t{low} << 32 | high, from < to ? 1 : -1});
    }
  }
  std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) { return a.key < b.key; });
  return edges;
}

void countEdges(const Mesh& mesh, MeshReport& report) {
  const std::vector<Edge> edges = sortedEdges(mesh);
  for (std::size_t first = 0; first < edges.size();) {
    std::size_t last = first;
    int balance = 0;
    while (last < edges.size() && edges[last].key == edges[first].key) {
      balance += edges[last++].direction;
    }
    if ((last - first) % 2 == 1) {
      ++report.openEdges;
    } else if (balance != 0) {
      ++report.inconsistentEdges;
    }
    first = last;
  }
}

void measure(const Mesh& mesh, MeshReport& report) {
  report.vertices = mesh.vertices.size();
  report.triangles = mesh.triangles.size();
  Eigen::AlignedBox3d box;
  for (const Vector3d& vertex : mesh.vertices) box.extend(vertex);
  if (!box.isEmpty()) report.extent = box.sizes();
  report.area = shellProperties(mesh).mass;
  report.volume = solidProperties(mesh).mass;
  const double size = report.extent.maxCoeff();
  for (const auto& t : mesh.triangles) {
    const Vector3d& a = mesh.vertices[static_cast<std::size_t>(t[0])];
    const Vector3d ab = mesh.vertices[static_cast<std::size_t>(t[1])] - a;
    const Vector3d ac = mesh.vertices[static_cast<std::size_t>(t[2])] - a;
    if (ab.cross(ac).norm() / 2 < 1e-12 * size * size) ++report.degenerateTriangles;
  }
}

class ProblemList {
 public:
  explicit ProblemList(MeshReport& report) : report_(report) {}

  void shape() {
    const double size = report_.extent.maxCoeff();
    if (report_.triangles == 0) {
      add(ProblemSeverity::kUnusable, "it has no triangles", "export the mesh again");
    } else if (report_.triangles < 4) {
      add(ProblemSeverity::kUnusable,
          fmt::format("it has only {} triangle{}", report_.triangles,
                      report_.triangles == 1 ? "" : "s"),
          "a body needs at least four");
    } else if (!(report_.extent.minCoeff() > 1e-6 * size)) {
      add(ProblemSeverity::kUnusable, "it is flat: all vertices lie in one plane",
          "give it a thickness");
    }
    if (report_.triangles > kMaxTriangles) {
      add(ProblemSeverity::kUnusable,
          fmt::format("it has {} triangles, more than {}", report_.triangles, kMaxTriangles),
          "simplify it");
    }
  }

  void closedness() {
    const double size = report_.extent.maxCoeff();
    if (report_.openEdges > 0) {
      add(ProblemSeverity::kNotSolid,
          fmt::format("it is not closed: {} open edge{}", report_.openEdges,
                      report_.openEdges == 1 ? "" : "s"),
          "close the holes, or treat it as a thin shell (--shell)");
    }
    if (report_.inconsistentEdges > 0) {
      add(ProblemSeverity::kNotSolid,
          fmt::format("its triangles are not consistently oriented: at {} edge{} two neighbours "
                      "face opposite sides",
                      report_.inconsistentEdges, report_.inconsistentEdges == 1 ? "" : "s"),
          "recalculate the normals in a modeller, or treat it as a thin shell (--shell)");
    }
    if (report_.openEdges > 0 || report_.inconsistentEdges > 0) return;
    if (std::abs(report_.volume) < 1e-7 * size * size * size) {
      add(ProblemSeverity::kNotSolid, "it encloses no volume",
          "give it a thickness, or treat it as a thin shell (--shell)");
    } else if (report_.volume < 0) {
      add(ProblemSeverity::kNote, "it is flipped: its triangles face inwards",
          "they are turned on import");
    }
  }

  void details() {
    const double size = report_.extent.maxCoeff();
    if (report_.degenerateTriangles > 0) {
      add(ProblemSeverity::kNote,
          fmt::format("{} degenerate triangle{}, without area", report_.degenerateTriangles,
                      report_.degenerateTriangles == 1 ? "" : "s"),
          "they do no harm to the physics");
    }
    if (size > kLargestLikelySize) {
      add(ProblemSeverity::kNote,
          fmt::format("it is {:.3g} m long: in millimetres by the look of it", size),
          "state the file's units: --units mm");
    } else if (size < kSmallestLikelySize && size > 0) {
      add(ProblemSeverity::kNote,
          fmt::format("it is only {:.3g} mm long: in metres by the look of it", size * 1e3),
          "state the file's units: --units m");
    }
  }

 private:
  void add(ProblemSeverity severity, std::string message, std::string remedy) {
    report_.problems.push_back({severity, std::move(message), std::move(remedy)});
  }

  MeshReport& report_;
};

bool noneAtLeast(const std::vector<MeshProblem>& problems, ProblemSeverity severity) {
  return std::none_of(problems.begin(), problems.end(),
                      [&](const MeshProblem& problem) { return problem.severity >= severity; });
}

}  // namespace

bool MeshReport::solid() const { return noneAtLeast(problems, ProblemSeverity::kNotSolid); }
bool MeshReport::usable() const { return noneAtLeast(problems, ProblemSeverity::kUnusable); }

MeshReport inspectMesh(const Mesh& mesh) {
  MeshReport report;
  countEdges(mesh, report);
  measure(mesh, report);
  ProblemList problems(report);
  problems.shape();
  problems.closedness();
  problems.details();
  std::stable_sort(
      report.problems.begin(), report.problems.end(),
      [](const MeshProblem& a, const MeshProblem& b) { return a.severity > b.severity; });
  return report;
}

}  // namespace ifa
