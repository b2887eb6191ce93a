// SPDX-License-Identifier: Apache-2.0
// A mesh of a person's own: received, shown, made an object.
#pragma once

#include "studio/workshop.h"

namespace ifa::studio {

/// Receives a mesh and reads it in a process of its own; it then is the session's.
void postMesh(Workshop& workshop, Exchange& exchange);
void getMeshFile(Workshop& workshop, Exchange& exchange);
/// Makes the session's object of its mesh.
void postObject(Workshop& workshop, Exchange& exchange);

/// A session's own mesh as the page knows it; null where there is none.
[[nodiscard]] Json meshOf(const std::filesystem::path& session);
/// The library, and the session's own object where it has one.
[[nodiscard]] std::map<std::string, CatalogueEntry> objectsOf(const Workshop& workshop,
                                                              const std::filesystem::path& session);

}  // namespace ifa::studio
