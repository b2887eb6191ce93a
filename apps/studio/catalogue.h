// SPDX-License-Identifier: Apache-2.0
// The objects that a person may choose from.
#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "ifa/result.h"

namespace ifa::studio {

struct CatalogueEntry {
  std::string title, material;
  std::string defaultSurface;
  std::set<std::string> surfaces;
  /// Unit directions in the body frame. Not Eigen's vectors: cpp-httplib brings a macro, _res, that
  /// Eigen's headers do not survive.
  std::map<std::string, std::array<double, 3>> faces;
  std::filesystem::path file = {};  ///< empty: the library's, by name
};

/// By name. Object files that cannot be read are left out. Errors: no library.
[[nodiscard]] Result<std::map<std::string, CatalogueEntry>> readCatalogue();

/// The same for the page: a list in the library's order.
[[nodiscard]] nlohmann::json catalogueJson(const std::map<std::string, CatalogueEntry>& entries);

}  // namespace ifa::studio
