// SPDX-License-Identifier: Apache-2.0
// What things are made of, as far as it is heard.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "ifa/result.h"

namespace ifa {

/// An isotropic material. Figures: Ashby, Materials Selection in Mechanical Design; loss factors
/// within the ranges of Cremer, Heckl and Petersson, Structure-Borne Sound.
struct SoundMaterial {
  std::string name;
  double young = 0;    ///< Pa
  double poisson = 0;  ///< of transverse contraction
  double density = 0;  ///< kg/m^3
  double loss = 0;     ///< loss factor: an oscillation decays by exp(-pi f loss t)
};

/// A floor: a plate that is struck, heard from above.
struct SoundFloor {
  std::string name;
  SoundMaterial material;
  double thickness = 0;  ///< m
  double area = 0;       ///< m^2
};

/// Names that findSoundMaterial() takes, in alphabetical order.
[[nodiscard]] std::vector<std::string> soundMaterialNames();

/// Material by name, in any case. Errors: kUsage, naming those that there are.
[[nodiscard]] Result<SoundMaterial> findSoundMaterial(std::string_view name);

/// The floor that a surface of this name is; a desk for any name that is not known.
[[nodiscard]] SoundFloor soundFloor(std::string_view surface);

}  // namespace ifa
