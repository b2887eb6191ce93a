// SPDX-License-Identifier: Apache-2.0
#include "studio/catalogue.h"

#include "body/object_file.h"

namespace ifa::studio {

Result<std::map<std::string, CatalogueEntry>> readCatalogue() {
  const auto names = listObjects();
  if (!names) return tl::unexpected(names.error());
  std::map<std::string, CatalogueEntry> entries;
  for (const std::string& name : *names) {
    const auto path = findObjectFile(name);
    const auto object = path ? readObjectFile(*path) : tl::unexpected(path.error());
    if (!object) continue;
    CatalogueEntry& entry = entries[name];
    entry.title = object->title;
    entry.material = object->material;
    entry.defaultSurface = object->defaultSurface;
    for (const auto& surface : object->surfaces) entry.surfaces.insert(surface.first);
    for (const auto& [face, to] : object->faces) entry.faces[face] = {to.x(), to.y(), to.z()};
  }
  return entries;
}

nlohmann::json catalogueJson(const std::map<std::string, CatalogueEntry>& entries) {
  auto list = nlohmann::json::array();
  for (const auto& [name, entry] : entries) {
    list.push_back({{"name", name},
                    {"title", entry.title},
                    {"material", entry.material},
                    {"surface", entry.defaultSurface},
                    {"surfaces", entry.surfaces},
                    {"faces", entry.faces}});
  }
  return list;
}

}  // namespace ifa::studio
