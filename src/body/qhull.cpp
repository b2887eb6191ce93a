// SPDX-License-Identifier: Apache-2.0
#include "body/qhull.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>

extern "C" {
#include <libqhull_r/qhull_ra.h>
}

namespace ifa {

using Eigen::Vector3d;

namespace {

/// Owns qhull's state, which is plain C, and the stream that catches its messages. The state points
/// into itself: it stays where it is.
class Qhull {
 public:
  Qhull(const std::vector<Vector3d>& points, std::string options)
      : errors_(open_memstream(&text_, &length_)) {
    coordinates_.reserve(points.size() * 3);
    for (const Vector3d& point : points) {
      const Vector3d p = point - points.front();  // no digits lost far from the origin
      coordinates_.insert(coordinates_.end(), {p.x(), p.y(), p.z()});
    }
    qh_zero(&qh_, errors_);
    failed_ = qh_new_qhull(&qh_, 3, static_cast<int>(points.size()), coordinates_.data(), False,
                           options.data(), nullptr, errors_) != 0;
  }
  ~Qhull() {
    qh_freeqhull(&qh_, !qh_ALL);
    int longBlocks = 0, longBytes = 0;
    qh_memfreeshort(&qh_, &longBlocks, &longBytes);
    std::fclose(errors_);
    std::free(text_);
  }
  Qhull(const Qhull&) = delete;
  Qhull& operator=(const Qhull&) = delete;

  [[nodiscard]] bool failed() const { return failed_; }
  [[nodiscard]] std::vector<HullCorner> corners();
  [[nodiscard]] std::vector<HullTriangle> triangles();

 private:
  qhT qh_ = {};
  std::vector<double> coordinates_;
  char* text_ = nullptr;
  std::size_t length_ = 0;
  std::FILE* errors_;
  bool failed_ = false;
};

std::vector<HullCorner> Qhull::corners() {
  std::vector<HullCorner> all;
  qhT* qh = &qh_;
  qh_vertexneighbors(qh);
  vertexT* vertex = nullptr;
  FORALLvertices {
    HullCorner corner;
    corner.point = qh_pointid(qh, vertex->point);
    facetT *neighbor = nullptr, **neighborp = nullptr;
    FOREACHneighbor_(vertex) {
      corner.outward += Vector3d(neighbor->normal[0], neighbor->normal[1], neighbor->normal[2]);
      vertexT *other = nullptr, **otherp = nullptr;
      FOREACHsetelement_(vertexT, neighbor->vertices, other) {
        if (other != vertex) corner.neighbours.push_back(qh_pointid(qh, other->point));
      }
    }
    std::sort(corner.neighbours.begin(), corner.neighbours.end());
    corner.neighbours.erase(std::unique(corner.neighbours.begin(), corner.neighbours.end()),
                            corner.neighbours.end());
    all.push_back(std::move(corner));
  }
  std::sort(all.begin(), all.end(),
            [](const HullCorner& a, const HullCorner& b) { return a.point < b.point; });
  return all;
}

std::vector<HullTriangle> Qhull::triangles() {
  std::vector<HullTriangle> all;
  qhT* qh = &qh_;
  facetT* facet = nullptr;
  FORALLfacets {
    HullTriangle triangle;
    triangle.outward = Vector3d(facet->normal[0], facet->normal[1], facet->normal[2]);
    std::size_t count = 0;
    vertexT *vertex = nullptr, **vertexp = nullptr;
    FOREACHvertex_(facet->vertices) {
      if (count < 3) triangle.points[count++] = qh_pointid(qh, vertex->point);
    }
    if (count == 3) all.push_back(triangle);
  }
  return all;
}

}  // namespace

std::optional<std::vector<HullCorner>> hullCorners(const std::vector<Vector3d>& points) {
  Qhull qhull(points, "qhull");
  if (qhull.failed()) return std::nullopt;
  return qhull.corners();
}

std::optional<std::vector<HullTriangle>> hullTriangles(const std::vector<Vector3d>& points) {
  Qhull qhull(points, "qhull Qt");
  if (qhull.failed()) return std::nullopt;
  return qhull.triangles();
}

}  // namespace ifa
