// SPDX-License-Identifier: Apache-2.0
// An object of a person's own: what a page tells of it beside its mesh, checked to the last field,
// and turned into the arguments of `ifa objects`.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "studio/refusal.h"

namespace ifa::studio {

/// Its name where a plan asks for it, and its file's.
inline constexpr const char* kOwnObject = "own-object";

/// Largest mesh file that is taken, bytes.
inline constexpr std::size_t kMaxMeshFile = 32U << 20;

/// The kinds of mesh files that are taken, as their names end: of a fixed list, or nothing.
[[nodiscard]] std::optional<std::string> meshKind(const std::string& kind);

struct OwnObjectRequest {
  std::string units;  ///< m, cm, mm or in
  bool shell = false;
  double mass = 0;         ///< kg
  double restitution = 0;  ///< 0 to 0.95
  double friction = 0;     ///< 0 to 2
};

/// {"units", "shell", "mass", "restitution", "friction"}. Refuses (422) with the field.
[[nodiscard]] Answer<OwnObjectRequest> parseOwnObject(std::string_view json);

/// Makes `folder`/own-object.json of `folder`/mesh.obj.
[[nodiscard]] std::vector<std::string> objectsArguments(const OwnObjectRequest& request,
                                                        const std::filesystem::path& folder);

}  // namespace ifa::studio
