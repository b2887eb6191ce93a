// SPDX-License-Identifier: Apache-2.0
// What the paper publishes about each object and surface (Table 1, docs/objects.md).
#pragma once

#include <string_view>
#include <vector>

namespace ifa {

/// One row of Table 1.
struct PaperRow {
  std::string_view object, surface;
  double eventsPerSimulation;
  double meanContacts;  ///< mean n of the paper's sounds
};

inline const std::vector<PaperRow>& paperRows() {
  static const std::vector<PaperRow> rows = {{"AdjustableWrench", "desk", 6.39, 5.5},
                                             {"BeerCanCrushed", "wood", 3.66, 2.9},
                                             {"Bolt", "desk", 6.51, 5.6},
                                             {"Carton", "desk", 3.21, 4.1},
                                             {"CoatHanger", "desk", 11.90, 6.4},
                                             {"CoffeeCup", "desk", 14.28, 7.1},
                                             {"CreditCard", "desk", 4.91, 4.4},
                                             {"d4", "desk", 9.38, 15.7},
                                             {"d6", "desk", 16.88, 20.4},
                                             {"d8", "desk", 12.17, 22.0},
                                             {"d10", "desk", 19.06, 25.7},
                                             {"d12", "desk", 24.84, 26.0},
                                             {"d20", "desk", 23.57, 26.8},
                                             {"Dustpan", "wood", 11.30, 6.7},
                                             {"Dustpan", "carpet", 6.57, 2.5},
                                             {"Eraser", "desk", 5.01, 4.6},
                                             {"FruitBasket", "wood", 4.24, 4.6},
                                             {"FruitBasket", "carpet", 4.26, 4.0},
                                             {"Garlic", "wood", 2.19, 4.5},
                                             {"Keyboard", "carpet", 5.92, 5.9},
                                             {"Lego2x2", "desk", 10.16, 9.3},
                                             {"Lego2x4", "desk", 9.99, 8.0},
                                             {"MetalCup", "desk", 10.63, 12.8},
                                             {"MetalCup", "carpet", 5.95, 3.4},
                                             {"Nut", "desk", 9.48, 8.3},
                                             {"PaperBall", "desk", 7.90, 4.6},
                                             {"PlasticContainer", "desk", 4.49, 4.8},
                                             {"PlasticSpoon", "desk", 2.79, 4.6},
                                             {"TapeDispenser", "wood", 6.82, 6.4},
                                             {"TapeDispenser", "desk", 8.90, 7.9},
                                             {"Wrench", "desk", 12.16, 15.7}};
  return rows;
}

/// The ten objects of the evaluation set and of the statistical tests.
inline const std::vector<std::string_view>& evaluationObjects() {
  static const std::vector<std::string_view> names = {
      "d4", "d6", "d8", "d10", "d12", "d20", "Eraser", "CoffeeCup", "Nut", "Lego2x2"};
  return names;
}

}  // namespace ifa
