// SPDX-License-Identifier: Apache-2.0
#include "pipeline/manifest.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/file.h"
#include "pipeline/output_files.h"

namespace ifa {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* kName = "manifest.json";

}  // namespace

Result<void> writeManifest(const fs::path& folder, const Motion& motion) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.is_regular_file() && entry.path().filename() != kName) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  Json list = Json::array();
  for (const fs::path& file : files) {
    const std::string name = file.filename().string();
    list.push_back({{"name", name}, {"role", roleOf(name)}, {"bytes", fs::file_size(file)}});
  }
  const Json manifest = {{"format", "inverse-foley-manifest"},
                         {"version", 1},
                         {"program", motion.program},
                         {"object", motion.object.name},
                         {"surface", motion.object.surface},
                         {"seed", motion.seed},
                         {"success", motion.success},
                         {"score", motion.score},
                         {"files", list}};
  return writeFileAtomically(folder / kName,
                             manifest.dump(1, ' ', false, Json::error_handler_t::replace) + "\n");
}

}  // namespace ifa
