// SPDX-License-Identifier: Apache-2.0
// What a page asks to be planned: read from JSON, checked to the last field, and turned into the
// arguments of `ifa sync`.
#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "signature/labels.h"
#include "studio/catalogue.h"
#include "studio/refusal.h"

namespace ifa::studio {

/// Every text in it is one of the catalogue's, the file included; no other text of a request
/// becomes an argument.
struct PlanRequest {
  std::vector<Label> marks;  ///< with weights: 1 where a person has confirmed it
  bool terminal = true;
  std::string object, surface;       ///< surface empty: the object's own
  std::filesystem::path objectFile;  ///< of an object that is none of the library's
  std::string face;                  ///< to lie on top at the end; empty: any
  /// Of the last contact, seen from the first, in the plane, m; none: anywhere.
  std::optional<std::array<double, 2>> landing;
  bool fit = false;
  int takes = 3;          ///< 1 to kMaxTakes
  std::int64_t seed = 1;  ///< 0 to 2^53
  double timeLimit = 20;  ///< s, 1 to 60
};

inline constexpr int kMaxTakes = 6;
/// Most contacts that a page may ask for.
inline constexpr std::size_t kMaxMarks = 500;
/// Farthest landing that a page may ask for, along each axis, m.
inline constexpr double kMaxLanding = 100;

/// {"marks": [{"start", "end", "weight"}], "terminal", "object", "surface", "face", "landing":
///  {"x", "y"}, "fit", "takes", "seed", "timeLimit"}; all but marks and object may be left out.
/// Refuses (422) with the field.
[[nodiscard]] Answer<PlanRequest> parsePlanRequest(
    std::string_view json, const std::map<std::string, CatalogueEntry>& catalogue);

/// The marks as the table that `ifa sync --labels` reads, with the weights that a label track has
/// no place for.
[[nodiscard]] std::string marksTable(const PlanRequest& request);

/// The landing as the table that `ifa sync --positions` reads; empty where none is asked for.
[[nodiscard]] std::string placesTable(const PlanRequest& request);

/// The files of a plan that `ifa sync` reads.
struct PlanFiles {
  std::filesystem::path sound, marks, places;
};

[[nodiscard]] std::vector<std::string> syncArguments(const PlanRequest& request,
                                                     const PlanFiles& files,
                                                     const std::filesystem::path& output);

}  // namespace ifa::studio
