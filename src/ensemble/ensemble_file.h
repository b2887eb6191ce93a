// SPDX-License-Identifier: Apache-2.0
// ensemble.json: which motions share a floor and a sound, and where each is laid
// (docs/file-formats.md).
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "ifa/result.h"
#include "model/floor_place.h"

namespace ifa {

struct EnsembleBody {
  std::string name, part;
  std::string motion;  ///< motion.json, relative to ensemble.json, without ".." in it
  FloorPlace place;
};

struct Ensemble {
  std::string program;
  std::string sound;  ///< beside ensemble.json
  std::uint64_t seed = 0;
  double clearance = 0;  ///< m that was kept between bodies
  std::vector<EnsembleBody> bodies;
};

[[nodiscard]] std::string formatEnsemble(const Ensemble& ensemble);

/// @param place  named in errors together with the field
/// Errors: kBadInput for what is no such file, a missing or absurd value, no bodies or more than
/// 64, a path that leads out of the folder.
[[nodiscard]] Result<Ensemble> parseEnsemble(std::string_view json, const std::string& place);
[[nodiscard]] Result<Ensemble> readEnsemble(const std::filesystem::path& path);

}  // namespace ifa
