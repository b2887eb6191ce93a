// SPDX-License-Identifier: Apache-2.0
#include "pipeline/motion_folder.h"

#include "body/object_file.h"
#include "export/motion_json.h"

namespace ifa {

namespace fs = std::filesystem;

namespace {

bool isPlainName(const std::string& name) {
  return !name.empty() && fs::path(name).filename() == name;
}

Result<Body> loadObjectOf(MotionFolder& folder, const std::string& object) {
  if (!object.empty()) return loadObject(object);
  const std::string& name = folder.motion.object.name;
  if (!isPlainName(name)) {
    return badInput("names an object that cannot be looked for", folder.file.string(),
                    "name the object file with --object");
  }
  const fs::path copy = folder.file.parent_path() / (name + ".json");
  std::error_code code;
  if (fs::is_regular_file(copy, code)) return loadObject(copy.string());
  folder.warnings.push_back("no " + name + ".json beside the motion; taking the library's");
  return loadObject(name);
}

}  // namespace

Result<MotionFolder> readMotionFolder(const fs::path& place, const std::string& object) {
  MotionFolder folder;
  std::error_code code;
  folder.file = fs::is_directory(place, code) ? place / "motion.json" : place;
  auto motion = readMotionJson(folder.file);
  if (!motion) return tl::unexpected(motion.error());
  folder.motion = std::move(*motion);
  auto body = loadObjectOf(folder, object);
  if (!body) return tl::unexpected(body.error());
  folder.body = std::move(*body);
  return folder;
}

Result<std::optional<Sound>> readSoundBeside(MotionFolder& folder) {
  const std::string& name = folder.motion.sound.file;
  if (name.empty()) {
    folder.warnings.push_back("the motion has no sound; the film is silent");
    return std::optional<Sound>();
  }
  const fs::path path = folder.file.parent_path() / name;
  std::error_code code;
  if (!isPlainName(name) || !fs::is_regular_file(path, code)) {
    folder.warnings.push_back("no " + name + " beside the motion; the film is silent");
    return std::optional<Sound>();
  }
  auto sound = readSound(path);
  if (!sound) return tl::unexpected(sound.error());
  return std::optional<Sound>(std::move(*sound));
}

}  // namespace ifa
