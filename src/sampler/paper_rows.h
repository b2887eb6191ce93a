// SPDX-License-Identifier: Apache-2.0
// What the paper publishes about each object and surface (Table 1, docs/objects.md).
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

namespace ifa {

/// One row of Table 1.
struct PaperRow {
  std::string_view object, surface;
  double eventsPerSimulation;
  double meanContacts;   ///< mean n of the paper's sounds
  std::int64_t nodes;    ///< events in the database of 400,000 simulations
  int solved, sounds;    ///< of so many
  double searchMinutes;  ///< mean
  double score;          ///< mean
};

/// In the paper's order. Of an object with two surfaces the first is the object file's default.
inline constexpr std::array<PaperRow, 31> kPaperRows = {
    {{"AdjustableWrench", "desk", 6.39, 5.5, 2556981, 13, 13, 0.9, 0.43},
     {"BeerCanCrushed", "wood", 3.66, 2.9, 1462089, 15, 15, 0.6, 0.35},
     {"Bolt", "desk", 6.51, 5.6, 2604880, 7, 7, 14.5, 0.25},
     {"Carton", "desk", 3.21, 4.1, 1282526, 25, 29, 1.3, 0.32},
     {"CoatHanger", "desk", 11.90, 6.4, 4759056, 18, 19, 9.3, 0.46},
     {"CoffeeCup", "desk", 14.28, 7.1, 5710615, 15, 16, 38.2, 0.24},
     {"CreditCard", "desk", 4.91, 4.4, 1965526, 22, 23, 6.8, 0.44},
     {"d4", "desk", 9.38, 15.7, 3750746, 6, 10, 62.7, 0.17},
     {"d6", "desk", 16.88, 20.4, 6751058, 13, 14, 12.1, 0.41},
     {"d8", "desk", 12.17, 22.0, 4867818, 6, 12, 53.9, 0.27},
     {"d10", "desk", 19.06, 25.7, 7623610, 11, 14, 18.6, 0.38},
     {"d12", "desk", 24.84, 26.0, 9934621, 4, 7, 24.2, 0.39},
     {"d20", "desk", 23.57, 26.8, 9427739, 9, 10, 37.7, 0.31},
     {"Dustpan", "wood", 11.30, 6.7, 4520601, 6, 6, 21.9, 0.37},
     {"Dustpan", "carpet", 6.57, 2.5, 2629017, 4, 6, 6.5, 0.21},
     {"Eraser", "desk", 5.01, 4.6, 2003606, 47, 48, 2.1, 0.50},
     {"FruitBasket", "wood", 4.24, 4.6, 1697917, 7, 7, 0.3, 0.45},
     {"FruitBasket", "carpet", 4.26, 4.0, 1705726, 7, 10, 0.4, 0.43},
     {"Garlic", "wood", 2.19, 4.5, 876191, 6, 6, 2.6, 0.24},
     {"Keyboard", "carpet", 5.92, 5.9, 2366495, 8, 9, 11.4, 0.30},
     {"Lego2x2", "desk", 10.16, 9.3, 4065133, 9, 9, 16.3, 0.36},
     {"Lego2x4", "desk", 9.99, 8.0, 3994256, 23, 23, 8.8, 0.41},
     {"MetalCup", "desk", 10.63, 12.8, 4252157, 6, 6, 22.1, 0.32},
     {"MetalCup", "carpet", 5.95, 3.4, 2378823, 9, 10, 3.3, 0.26},
     {"Nut", "desk", 9.48, 8.3, 3790909, 9, 10, 12.1, 0.33},
     {"PaperBall", "desk", 7.90, 4.6, 3160375, 16, 20, 5.9, 0.24},
     {"PlasticContainer", "desk", 4.49, 4.8, 1797494, 18, 22, 2.4, 0.32},
     {"PlasticSpoon", "desk", 2.79, 4.6, 1115891, 10, 15, 2.6, 0.38},
     {"TapeDispenser", "wood", 6.82, 6.4, 2726872, 10, 10, 1.8, 0.41},
     {"TapeDispenser", "desk", 8.90, 7.9, 3561017, 17, 17, 10.8, 0.36},
     {"Wrench", "desk", 12.16, 15.7, 4862720, 9, 11, 47.8, 0.17}}};

/// The row of an object; nullptr where the paper has none.
/// @param surface  empty: the object's default
[[nodiscard]] inline const PaperRow* paperRow(std::string_view object, std::string_view surface) {
  const auto row = std::find_if(kPaperRows.begin(), kPaperRows.end(), [&](const PaperRow& r) {
    return r.object == object && (surface.empty() || r.surface == surface);
  });
  return row == kPaperRows.end() ? nullptr : &*row;
}

/// Likewise by a name as the paper writes it, "d6 (desk)", or "d6".
[[nodiscard]] inline const PaperRow* paperRowNamed(std::string_view name) {
  const std::size_t bracket = name.find(" (");
  if (bracket == std::string_view::npos || !name.ends_with(')')) return paperRow(name, {});
  return paperRow(name.substr(0, bracket), name.substr(bracket + 2, name.size() - bracket - 3));
}

/// One row of Table 2: position constraints. Errors in m.
struct PaperPlaces {
  std::string_view motion;
  double largest, relativeLargest, mean, relativeMean;  ///< relative to `longestSide`
  double longestSide;                                   ///< of the motion's bounding box, m
};

inline constexpr std::array<PaperPlaces, 8> kPaperPlaces = {
    {{"Lego2x4 1", 0.060, 0.28, 0.037, 0.18, 0.213},
     {"Lego2x4 2", 0.074, 0.18, 0.041, 0.10, 0.411},
     {"Lego2x4 3", 0.028, 0.12, 0.019, 0.08, 0.240},
     {"Garlic 1", 0.083, 0.09, 0.044, 0.05, 0.968},
     {"Garlic 2", 0.041, 0.04, 0.024, 0.03, 0.967},
     {"TapeDispenser 1", 0.086, 0.12, 0.045, 0.06, 0.715},
     {"TapeDispenser 2", 0.100, 0.15, 0.058, 0.09, 0.648},
     {"TapeDispenser 3", 0.071, 0.18, 0.049, 0.12, 0.396}}};

/// The ten objects of the evaluation set and of the statistical tests.
inline const std::vector<std::string_view>& evaluationObjects() {
  static const std::vector<std::string_view> names = {
      "d4", "d6", "d8", "d10", "d12", "d20", "Eraser", "CoffeeCup", "Nut", "Lego2x2"};
  return names;
}

}  // namespace ifa
