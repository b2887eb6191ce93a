// SPDX-License-Identifier: Apache-2.0
#include "pipeline/ensemble_folder.h"

namespace ifa {

namespace fs = std::filesystem;

namespace {

fs::path fileOf(const fs::path& place) {
  std::error_code code;
  return fs::is_directory(place, code) ? place / kEnsembleName : place;
}

}  // namespace

bool isEnsemble(const fs::path& place) {
  std::error_code code;
  const fs::path file = fileOf(place);
  return file.filename() == kEnsembleName && fs::is_regular_file(file, code);
}

Result<EnsembleFolder> readEnsembleFolder(const fs::path& place) {
  EnsembleFolder folder;
  folder.file = fileOf(place);
  auto ensemble = readEnsemble(folder.file);
  if (!ensemble) return tl::unexpected(ensemble.error());
  folder.ensemble = std::move(*ensemble);
  for (const EnsembleBody& body : folder.ensemble.bodies) {
    auto motion = readMotionFolder(folder.file.parent_path() / body.motion);
    if (!motion) return tl::unexpected(motion.error());
    if (motion->motion.trajectory.empty()) {
      return badInput("has no samples", motion->file.string(), "run ifa ensemble again");
    }
    folder.bodies.push_back(std::move(*motion));
  }
  return folder;
}

Result<std::optional<Sound>> readEnsembleSound(const EnsembleFolder& folder,
                                               std::vector<std::string>& warnings) {
  const fs::path path = folder.file.parent_path() / folder.ensemble.sound;
  std::error_code code;
  if (!fs::is_regular_file(path, code)) {
    warnings.push_back("no sound beside " + folder.file.string() + "; the film is silent");
    return std::optional<Sound>();
  }
  auto sound = readSound(path);
  if (!sound) return tl::unexpected(sound.error());
  return std::optional<Sound>(std::move(*sound));
}

std::vector<LaidMotion> laidMotions(const EnsembleFolder& folder) {
  std::vector<LaidMotion> laid;
  for (std::size_t i = 0; i < folder.bodies.size(); ++i) {
    const FloorPlace& place = folder.ensemble.bodies[i].place;
    laid.push_back({&folder.bodies[i].motion, &folder.bodies[i].body, place.turn, place.shift});
  }
  return laid;
}

}  // namespace ifa
