// SPDX-License-Identifier: Apache-2.0
#include "body/symmetry.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "base/random.h"
#include "body/mass_properties.h"
#include "body/object_file.h"
#include "support/box_body.h"

namespace ifa {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Points = std::vector<Vector3d>;

constexpr double kPi = 3.14159265358979323846;
const double kGolden = (1 + std::sqrt(5.0)) / 2;

Matrix3d turn(double angle, const Vector3d& axis) {
  return Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
}

void setInertia(Body& body, const Matrix3d& inertia) {
  const PrincipalFrame frame = principalFrame(inertia);
  body.inertia = inertia;
  body.principalMoments = frame.moments;
  body.bodyFromPrincipal = frame.bodyFromPrincipal;
}

/// A body that dynamics sees as these points, with a mass in each.
Body bodyOf(const Points& points) {
  Body body;
  body.hull = points;
  Matrix3d covariance = Matrix3d::Zero();
  for (const Vector3d& p : points) {
    covariance += p * p.transpose();
    body.radius = std::max(body.radius, p.norm());
  }
  setInertia(body, Matrix3d(covariance.trace() * Matrix3d::Identity() - covariance));
  return body;
}

/// Where the maps and their products take some points: a set with at least that symmetry.
Points orbit(const std::vector<Matrix3d>& maps, Points points) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (const Matrix3d& map : maps) {
      const Vector3d image = map * points[i];
      const auto same = [&](const Vector3d& p) { return (p - image).norm() < 1e-9; };
      if (std::none_of(points.begin(), points.end(), same)) points.push_back(image);
    }
  }
  return points;
}

Points signedTriples(double x, double y, double z) {
  Points points;
  for (int s = 0; s < 8; ++s) {
    const Vector3d p((s & 1) != 0 ? x : -x, (s & 2) != 0 ? y : -y, (s & 4) != 0 ? z : -z);
    for (const Vector3d& q : {p, Vector3d(p[1], p[2], p[0]), Vector3d(p[2], p[0], p[1])}) {
      const auto same = [&](const Vector3d& other) { return (other - q).norm() < 1e-9; };
      if (std::none_of(points.begin(), points.end(), same)) points.push_back(q);
    }
  }
  return points;
}

Points tetrahedron() { return {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}}; }
Points icosahedron() { return signedTriples(0, 1, kGolden); }
Points dodecahedron() {
  Points points = signedTriples(1, 1, 1);
  for (const Vector3d& p : signedTriples(0, 1 / kGolden, kGolden)) points.push_back(p);
  return points;
}
/// A prism, or a stump where the radii differ; the centre of mass at the origin.
Points prism(int sides, double below, double above) {
  Points points;
  for (int i = 0; i < sides; ++i) {
    const double angle = 2 * kPi * i / sides;
    points.emplace_back(below * std::cos(angle), below * std::sin(angle), -0.7);
    points.emplace_back(above * std::cos(angle), above * std::sin(angle), 0.7);
  }
  return points;
}

const Matrix3d kInversion = -Matrix3d::Identity();
const Matrix3d kFloor = Vector3d(1, 1, -1).asDiagonal();
/// Places that no element of a group but the identity leaves alone.
const Points kAnywhere = {{0.9, 0.31, 0.23}, {0.5, 0.45, -0.66}, {-0.2, 0.8, 0.35}};

Points generic(const std::vector<Matrix3d>& maps) { return orbit(maps, kAnywhere); }

struct Solid {
  const char* name;
  Points points;
  std::size_t order, rotations;
};

std::vector<Solid> solids() {
  const Matrix3d x2 = turn(kPi, Vector3d::UnitX()), z2 = turn(kPi, Vector3d::UnitZ());
  const Matrix3d z3 = turn(2 * kPi / 3, Vector3d::UnitZ());
  const Matrix3d z4 = turn(kPi / 2, Vector3d::UnitZ());
  const Matrix3d d3 = turn(2 * kPi / 3, {1, 1, 1});
  const Matrix3d i5 = turn(2 * kPi / 5, {0, 1, kGolden});
  return {{"C1", {{1, 0, 0}, {0, 1.2, 0}, {0, 0.1, 1.5}, {-0.7, -0.8, -0.4}}, 1, 1},
          {"Cs", generic({kFloor}), 2, 1},
          {"Ci", generic({kInversion}), 2, 1},
          {"C2", generic({z2}), 2, 2},
          {"C3", generic({z3}), 3, 3},
          {"C2v", generic({z2, Matrix3d(Vector3d(1, -1, 1).asDiagonal())}), 4, 2},
          {"C2h", generic({z2, kFloor}), 4, 2},
          {"C3h", generic({z3, kFloor}), 6, 3},
          {"S4", generic({Matrix3d(kFloor * z4)}), 4, 2},
          {"S6", generic({z3, kInversion}), 6, 3},
          {"D2", generic({z2, x2}), 4, 4},
          {"D3", generic({z3, x2}), 6, 6},
          {"D2h", makeBoxBody({1, 2, 3}, 1).hull, 8, 4},
          {"D2d", generic({Matrix3d(kFloor * z4), x2}), 8, 4},
          {"D3d", generic({z3, x2, kInversion}), 12, 6},
          {"D4h", makeBoxBody({1, 1, 3}, 1).hull, 16, 8},
          {"C5v", prism(5, 1, 0.6), 10, 5},
          {"D7h", prism(7, 1, 1), 28, 14},
          {"C46v", prism(46, 0.5, 0.7), 92, 46},
          {"D64h", prism(64, 1, 1), 256, 128},
          {"T", generic({z2, d3}), 12, 12},
          {"Td", tetrahedron(), 24, 12},
          {"Th", generic({z2, d3, kInversion}), 24, 12},
          {"O", generic({z4, d3}), 24, 24},
          {"Oh", signedTriples(1, 1, 1), 48, 24},
          {"Oh", signedTriples(1, 0, 0), 48, 24},
          {"I", generic({z2, d3, i5}), 60, 60},
          {"Ih", icosahedron(), 120, 60},
          {"Ih", dodecahedron(), 120, 60}};
}

/// Every linear map that takes three vertices to any three others, orthogonal or not.
std::vector<Matrix3d> bruteForce(const Points& points) {
  Matrix3d from;
  std::size_t third = 2;
  do from << points[0], points[1], points[third++];
  while (std::abs(from.determinant()) < 1e-3);
  const Matrix3d inverse = from.inverse();
  std::vector<Matrix3d> found;
  for (const Vector3d& a : points) {
    for (const Vector3d& b : points) {
      for (const Vector3d& c : points) {
        Matrix3d to;
        to << a, b, c;
        const Matrix3d map = to * inverse;
        if ((map * map.transpose() - Matrix3d::Identity()).norm() > 1e-8) continue;
        const auto kept = [&](const Vector3d& p) {
          return std::any_of(points.begin(), points.end(), [&](const Vector3d& q) {
            return (map * p - q).squaredNorm() < 1e-16;
          });
        };
        if (std::all_of(points.begin(), points.end(), kept)) found.push_back(map);
      }
    }
  }
  return found;
}

double nearest(const Matrix3d& map, const std::vector<Matrix3d>& all) {
  double least = 10;
  for (const Matrix3d& other : all) least = std::min(least, (map - other).norm());
  return least;
}

TEST(Symmetry, OfKnownSolids) {
  for (const Solid& solid : solids()) {
    const SymmetryGroup group = findSymmetry(bodyOf(solid.points));
    EXPECT_EQ(group.name(), solid.name);
    EXPECT_EQ(group.order(), solid.order) << solid.name;
    EXPECT_EQ(group.rotations(), solid.rotations) << solid.name;
  }
}

TEST(Symmetry, IsWhatBruteForceFinds) {
  for (const Solid& solid : solids()) {
    if (solid.points.size() > 24) continue;
    const Body body = bodyOf(solid.points);
    const SymmetryGroup group = findSymmetry(body);
    const std::vector<Matrix3d> truth = bruteForce(solid.points);
    ASSERT_EQ(group.order(), truth.size()) << solid.name;
    for (const Matrix3d& map : group.elements()) {
      const Matrix3d inBody = body.bodyFromPrincipal * map * body.bodyFromPrincipal.transpose();
      EXPECT_LT(nearest(inBody, truth), 1e-9) << solid.name;
    }
  }
}

TEST(Symmetry, IsAGroup) {
  for (const Solid& solid : solids()) {
    const SymmetryGroup group = findSymmetry(bodyOf(solid.points));
    const auto& all = group.elements();
    EXPECT_EQ(all[0], Matrix3d::Identity());
    for (std::size_t a = 0; a < group.order(); ++a) {
      EXPECT_NEAR(all[a].determinant(), group.isRotation(a) ? 1 : -1, 1e-13);
      EXPECT_LT((all[a] * all[a].transpose() - Matrix3d::Identity()).norm(), 1e-14);
      EXPECT_EQ(group.product(a, group.inverse(a)), 0U);
      double worst = 0;
      for (std::size_t b = 0; b < group.order(); ++b)
        worst = std::max(worst, (all[a] * all[b] - all[group.product(a, b)]).norm());
      EXPECT_LT(worst, 1e-13) << solid.name;
    }
  }
}

/// However the mesh lies in its file, and with vertices in single precision.
TEST(Symmetry, IsFoundInAnyFrame) {
  RandomStream random(3, 1);
  for (const Solid& solid : solids()) {
    const Vector3d axis(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    const Matrix3d turned = turn(random.uniform(0, 3), axis);
    Points points;
    for (const Vector3d& p : solid.points)
      points.emplace_back((turned * p).cast<float>().cast<double>());
    const Body body = bodyOf(points);
    const SymmetryGroup group = findSymmetry(body);
    EXPECT_EQ(group.name(), solid.name);
    const Matrix3d moments = body.principalMoments.asDiagonal();
    for (const Matrix3d& map : group.elements())
      EXPECT_LT((map * moments * map.transpose() - moments).norm(), 3e-6 * moments.norm());
  }
}

TEST(Symmetry, AxesOfOtherMomentsAreLeftAloneToTheBit) {
  for (const std::string name : {"D2h", "C5v", "D7h"}) {
    for (const Solid& solid : solids()) {
      if (solid.name != name) continue;
      const Body body = bodyOf(solid.points);
      const SymmetryGroup group = findSymmetry(body);
      for (const Matrix3d& map : group.elements()) {
        for (int i = 0; i < 3; ++i) {
          for (int j = 0; j < 3; ++j) {
            const double apart = std::abs(body.principalMoments[i] - body.principalMoments[j]);
            if (apart > 1e-3) {
              EXPECT_EQ(map(i, j), 0) << name;
            }
          }
        }
      }
    }
  }
}

TEST(Symmetry, NeedsInertiaToo) {
  Body cube = bodyOf(signedTriples(1, 1, 1));
  setInertia(cube, Matrix3d(Vector3d(2, 3, 4).asDiagonal()));
  EXPECT_EQ(findSymmetry(cube).name(), "D2h");
  setInertia(cube, Matrix3d(Vector3d(2, 2, 3).asDiagonal()));
  EXPECT_EQ(findSymmetry(cube).name(), "D4h");
  const Matrix3d askew = turn(0.4, {1, 2, 3});
  setInertia(cube, Matrix3d(askew * Vector3d(2, 3, 4).asDiagonal() * askew.transpose()));
  EXPECT_EQ(findSymmetry(cube).name(), "Ci");
}

TEST(Symmetry, IsAboutTheCentreOfMass) {
  Points points = signedTriples(1, 1, 1);
  for (Vector3d& p : points) p.z() += 0.2;
  EXPECT_EQ(findSymmetry(bodyOf(points)).name(), "C4v");
  for (Vector3d& p : points) p += Vector3d(0.1, 0.3, 0);
  EXPECT_EQ(findSymmetry(bodyOf(points)).name(), "C1");
}

TEST(Symmetry, ToleratesSoMuchAndNoMore) {
  const auto moved = [](double by) {
    Points points = signedTriples(1, 1, 1);
    RandomStream random(8, 1);
    for (Vector3d& p : points)
      p += by * Vector3d(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    Body body = bodyOf(points);
    setInertia(body, Matrix3d(Matrix3d::Identity()));
    return findSymmetry(body);
  };
  const SymmetryGroup slightly = moved(2e-5);
  EXPECT_EQ(slightly.name(), "Oh");
  for (std::size_t a = 0; a < slightly.order(); ++a)
    for (std::size_t b = 0; b < slightly.order(); ++b)
      EXPECT_LT((slightly.elements()[a] * slightly.elements()[b] -
                 slightly.elements()[slightly.product(a, b)])
                    .norm(),
                1e-13);
  EXPECT_EQ(moved(1e-2).name(), "C1");
}

TEST(Symmetry, ManyTurnsAreNearlyARevolution) {
  EXPECT_TRUE(findSymmetry(bodyOf(prism(46, 0.5, 0.7))).nearlyOfRevolution());
  EXPECT_FALSE(findSymmetry(bodyOf(prism(6, 1, 1))).nearlyOfRevolution());
  EXPECT_FALSE(findSymmetry(bodyOf(icosahedron())).nearlyOfRevolution());
}

TEST(Symmetry, OfTheLibrary) {
  const std::vector<std::pair<std::string, std::string>> known = {
      {"d4", "Td"},  {"d6", "Oh"},   {"d8", "Oh"},       {"d10", "D5d"},    {"d12", "Ih"},
      {"d20", "Ih"}, {"Nut", "D6h"}, {"Lego2x2", "C4v"}, {"Eraser", "D2h"}, {"CoffeeCup", "Cs"}};
  for (const auto& [name, symbol] : known) {
    const auto body = loadObject(name);
    ASSERT_TRUE(body) << name;
    EXPECT_EQ(findSymmetry(*body).name(), symbol) << name;
  }
}

}  // namespace
}  // namespace ifa
