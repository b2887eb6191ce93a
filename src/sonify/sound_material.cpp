// SPDX-License-Identifier: Apache-2.0
#include "sonify/sound_material.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <iterator>

namespace ifa {
namespace {

const std::array<SoundMaterial, 11>& materials() {
  static const std::array<SoundMaterial, 11> kMaterials = {{{"ABS", 2.3e9, 0.39, 1050, 0.03},
                                                            {"acrylic", 3.2e9, 0.37, 1180, 0.04},
                                                            {"aluminium", 70e9, 0.33, 2700, 2e-3},
                                                            {"brass", 105e9, 0.34, 8500, 2e-3},
                                                            {"ceramic", 70e9, 0.22, 2400, 3e-3},
                                                            {"glass", 70e9, 0.23, 2500, 2e-3},
                                                            {"rubber", 5e6, 0.49, 1200, 0.3},
                                                            {"steel", 205e9, 0.29, 7850, 1e-3},
                                                            {"stone", 50e9, 0.25, 2600, 0.01},
                                                            {"vinyl", 2e7, 0.48, 1400, 0.2},
                                                            {"wood", 11e9, 0.35, 650, 0.02}}};
  return kMaterials;
}

bool sameWord(std::string_view a, std::string_view b) {
  const auto lower = [](char c) { return std::tolower(static_cast<unsigned char>(c)); };
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [&](char x, char y) { return lower(x) == lower(y); });
}

}  // namespace

std::vector<std::string> soundMaterialNames() {
  std::vector<std::string> names;
  std::transform(materials().begin(), materials().end(), std::back_inserter(names),
                 [](const SoundMaterial& material) { return material.name; });
  return names;
}

Result<SoundMaterial> findSoundMaterial(std::string_view name) {
  const auto found =
      std::find_if(materials().begin(), materials().end(),
                   [&](const SoundMaterial& material) { return sameWord(material.name, name); });
  if (found != materials().end()) return *found;
  std::string known;
  for (const std::string& other : soundMaterialNames())
    known += (known.empty() ? "" : ", ") + other;
  return tl::unexpected<Error>({ErrorCode::kUsage,
                                "no sound is known of \"" + std::string(name) + "\"", "material",
                                "choose one of " + known});
}

SoundFloor soundFloor(std::string_view surface) {
  // Losses of a board that lies on its frame, with what it radiates; carpet lies on concrete.
  if (sameWord(surface, "carpet")) return {"carpet", {"felt", 1e6, 0.2, 300, 0.5}, 0.1, 4};
  if (sameWord(surface, "stone")) return {"stone", {"stone", 50e9, 0.25, 2600, 0.03}, 0.03, 1};
  if (sameWord(surface, "wood")) return {"wood", {"wood", 11e9, 0.35, 650, 0.05}, 0.02, 1};
  return {"desk", {"board", 3.5e9, 0.3, 750, 0.05}, 0.025, 1};
}

}  // namespace ifa
