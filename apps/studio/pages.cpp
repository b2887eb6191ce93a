// SPDX-License-Identifier: Apache-2.0
#include "studio/pages.h"

#include <cstdlib>

#include "base/file.h"
#include "studio/child_program.h"

namespace ifa::studio {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kMaxPage = 32 << 20;

std::string typeOf(const fs::path& path) {
  static const std::map<std::string, std::string> kTypes = {
      {".html", "text/html; charset=utf-8"},
      {".js", "text/javascript; charset=utf-8"},
      {".css", "text/css; charset=utf-8"},
      {".svg", "image/svg+xml"},
      {".png", "image/png"},
      {".wav", "audio/wav"}};
  const auto found = kTypes.find(path.extension().string());
  return found == kTypes.end() ? "application/octet-stream" : found->second;
}

}  // namespace

fs::path pagesFolder() {
  if (const char* chosen = std::getenv("IFA_STUDIO_PAGES"); chosen != nullptr) return chosen;
  return fs::path(thisProgram()).parent_path().parent_path() / IFA_INSTALL_STUDIO;
}

Result<Pages> readPages(const fs::path& folder) {
  Pages pages;
  std::error_code code;
  for (const auto& entry : fs::recursive_directory_iterator(folder, code)) {
    if (!entry.is_regular_file()) continue;
    auto bytes = readFile(entry.path(), kMaxPage);
    if (!bytes) return tl::unexpected(bytes.error());
    const std::string name = "/" + fs::relative(entry.path(), folder).generic_string();
    pages[name == "/index.html" ? "/" : name] = {std::move(*bytes), typeOf(entry.path())};
  }
  if (pages.count("/") == 0) {
    return badInput("the studio's pages are not built", folder.string(),
                    "scripts/studio.sh builds them, and needs npm");
  }
  return pages;
}

}  // namespace ifa::studio
