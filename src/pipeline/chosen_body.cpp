// SPDX-License-Identifier: Apache-2.0
#include "pipeline/chosen_body.h"

#include <filesystem>
#include <utility>

#include "body/object_file.h"
#include "pipeline/fit.h"

namespace ifa {

namespace {

namespace fs = std::filesystem;

// The library that the settings name goes before the program's own.
Result<Body> loadBody(const SynchronizeSettings& settings) {
  const fs::path own = settings.objects / (settings.object + ".json");
  std::error_code code;
  if (!settings.objects.empty() && fs::is_regular_file(own, code)) return loadObject(own.string());
  return loadObject(settings.object);
}

Result<std::string> chooseSurface(const SynchronizeSettings& settings,
                                  const ObjectDefinition& object) {
  const auto& name = settings.surface.empty() ? object.defaultSurface : settings.surface;
  if (object.surfaces.count(name) > 0) return name;
  std::string known;
  for (const auto& [other, properties] : object.surfaces) {
    known += (known.empty() ? "" : ", ") + other;
  }
  return badInput("has no surface \"" + name + "\"", object.name, "its surfaces: " + known);
}

}  // namespace

Result<ChosenBody> loadChosenBody(const SynchronizeSettings& settings) {
  auto body = loadBody(settings);
  if (!body) return tl::unexpected(body.error());
  changeRestitution(settings, body->definition);
  auto surface = chooseSurface(settings, body->definition);
  if (!surface) return tl::unexpected(surface.error());
  return ChosenBody{std::move(*body), std::move(*surface)};
}

}  // namespace ifa
