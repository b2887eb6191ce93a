// SPDX-License-Identifier: Apache-2.0
// What the objects of the library are stated to be (docs/objects.md).
#pragma once

#include <array>
#include <cstddef>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "body/body.h"

namespace ifa::test {

struct Expected {
  std::string name;
  double mass;                 // kg
  std::array<double, 3> size;  // m, sides of the mesh's box, 0: not stated there
  std::size_t fewest, most;    // hull vertices
  std::size_t faces;
  double tolerance = 1e-6;  // of the size, m
  BodyKind kind = BodyKind::kSolid;
  double lightest = 900, heaviest = 8000;  // kg/m^3; of a shell g/m^2
  std::vector<std::string> surfaces = {"desk"};
  double depth = 0.0005;  // at least, of the centre of mass below the hull, m

  [[nodiscard]] Expected within(double value) const {
    Expected other = *this;
    other.tolerance = value;
    return other;
  }
  [[nodiscard]] Expected dense(double low, double high) const {
    Expected other = *this;
    other.lightest = low;
    other.heaviest = high;
    return other;
  }
  [[nodiscard]] Expected shell(double low, double high) const {
    Expected other = dense(low, high);
    other.kind = BodyKind::kShell;
    return other;
  }
  [[nodiscard]] Expected on(std::vector<std::string> names) const {
    Expected other = *this;
    other.surfaces = std::move(names);
    return other;
  }
  [[nodiscard]] Expected thin(double value) const {
    Expected other = *this;
    other.depth = value;
    return other;
  }
};

inline void PrintTo(const Expected& expected, std::ostream* stream) { *stream << expected.name; }

inline std::vector<Expected> expectedObjects() {
  using E = Expected;
  constexpr double kFine = 1e-4, kRough = 0.003;  // what is left of curves, what is not even
  return {
      E{"d4", 0.0008, {}, 4, 4, 4},
      E{"d6", 0.0049, {0.016, 0.016, 0.016}, 8, 8, 6},
      E{"d8", 0.0019, {}, 6, 6, 8},
      E{"d10", 0.0035, {}, 12, 12, 10},
      E{"d12", 0.005, {}, 20, 20, 12},
      E{"d20", 0.006, {}, 12, 12, 20},
      E{"Eraser", 0.020, {0.060, 0.022, 0.012}, 8, 8, 0},
      E{"CoffeeCup", 0.320, {0, 0.082, 0.095}, 80, 100, 1},
      E{"Nut", 0.011, {0, 0.017, 0.008}, 24, 24, 0},
      E{"Lego2x2", 0.00115, {0.0158, 0.0158, 0.0114}, 20, 40, 1},
      E{"Lego2x4", 0.0023, {0.0318, 0.0158, 0.0114}, 20, 40, 1},
      E{"AdjustableWrench", 0.27, {0.2, 0.052, 0.012}, 60, 150, 0}.within(kRough),
      E{"Bolt", 0.04, {0, 0.017, 0.0564}, 50, 100, 1},
      E{"CoatHanger", 0.05, {0.42, 0.22, 0.006}, 60, 150, 1}.within(kRough),
      E{"CreditCard", 0.005, {0.0856, 0.054, 0.00076}, 40, 100, 2}.within(kFine).thin(0.0003),
      E{"Garlic", 0.05, {0.055, 0.055, 0.05}, 100, 300, 1}.within(kRough).on({"wood"}),
      E{"Keyboard", 0.6, {0.45, 0.15, 0.025}, 40, 150, 1}.within(kRough).dense(400, 700).on(
          {"carpet"}),
      E{"TapeDispenser", 0.25, {0.13, 0.06, 0.065}, 60, 150, 1}.within(kRough).on({"wood", "desk"}),
      E{"Wrench", 0.12, {0.17, 0.035, 0.007}, 60, 150, 0}.within(kRough),
      E{"BeerCanCrushed", 0.013, {0.066, 0.066, 0.07}, 60, 300, 1}
          .within(kRough)
          .shell(300, 700)
          .on({"wood"}),
      E{"Carton", 0.035, {0.095, 0.095, 0.2}, 12, 60, 1}.shell(300, 600),
      E{"Dustpan", 0.2, {0.31, 0.23, 0.08}, 40, 120, 2}.within(0.006).shell(500, 2500).on(
          {"wood", "carpet"}),
      E{"FruitBasket", 0.35, {0.28, 0.28, 0.11}, 100, 400, 1}.within(kRough).shell(300, 2500).on(
          {"wood", "carpet"}),
      E{"MetalCup", 0.12, {0, 0.08, 0.085}, 80, 220, 1}
          .within(kFine)
          .shell(1000, 4000)
          .on({"desk", "carpet"}),
      E{"PaperBall", 0.005, {0.07, 0.07, 0.07}, 60, 250, 0}.within(0.005).shell(100, 500),
      E{"PlasticContainer", 0.03, {0.11, 0.11, 0.06}, 40, 120, 1}.shell(300, 1500),
      E{"PlasticSpoon", 0.0035, {0.032, 0.15, 0.012}, 40, 130, 1}.within(kRough).shell(200, 1000),
      E{"Book", 0.42, {0.134, 0.2, 0.024}, 20, 60, 2}.within(kRough).dense(500, 900),
      E{"BottleCap", 0.0022, {0.032, 0.032, 0.006}, 80, 300, 1}.within(kRough).shell(500, 2000),
      E{"Coin", 0.0075, {0.024, 0.024, 0.002}, 100, 160, 2}.within(kFine).dense(7000, 9000),
      E{"Key", 0.0118, {0.057, 0.023, 0.0022}, 60, 120, 0}.within(kRough).dense(7000, 9000),
      E{"Marble", 0.0052, {0.016, 0.016, 0.016}, 200, 400, 0}.within(kFine),
      E{"Mug", 0.335, {0, 0.096, 0.088}, 80, 220, 1}.within(kFine),
      E{"Pencil", 0.005, {0.175, 0.0074, 0.0074}, 60, 200, 1}.within(kRough).dense(500, 900),
      E{"PingPongBall", 0.0027, {0.04, 0.04, 0.04}, 200, 400, 0}.within(kFine).shell(300, 700),
      E{"WoodenBlock", 0.04, {0.04, 0.04, 0.04}, 8, 8, 6}.dense(500, 800),
  };
}

/// Table 1 of the paper: an object and a surface a row.
inline std::vector<std::pair<std::string, std::string>> paperTableRows() {
  return {{"AdjustableWrench", "desk"},
          {"BeerCanCrushed", "wood"},
          {"Bolt", "desk"},
          {"Carton", "desk"},
          {"CoatHanger", "desk"},
          {"CoffeeCup", "desk"},
          {"CreditCard", "desk"},
          {"d4", "desk"},
          {"d6", "desk"},
          {"d8", "desk"},
          {"d10", "desk"},
          {"d12", "desk"},
          {"d20", "desk"},
          {"Dustpan", "wood"},
          {"Dustpan", "carpet"},
          {"Eraser", "desk"},
          {"FruitBasket", "wood"},
          {"FruitBasket", "carpet"},
          {"Garlic", "wood"},
          {"Keyboard", "carpet"},
          {"Lego2x2", "desk"},
          {"Lego2x4", "desk"},
          {"MetalCup", "desk"},
          {"MetalCup", "carpet"},
          {"Nut", "desk"},
          {"PaperBall", "desk"},
          {"PlasticContainer", "desk"},
          {"PlasticSpoon", "desk"},
          {"TapeDispenser", "wood"},
          {"TapeDispenser", "desk"},
          {"Wrench", "desk"}};
}

}  // namespace ifa::test
