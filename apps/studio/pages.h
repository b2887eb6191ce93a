// SPDX-License-Identifier: Apache-2.0
// The studio's pages, read into memory once: no path of a request reaches the disk for them.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "ifa/result.h"

namespace ifa::studio {

struct PageFile {
  std::string bytes, type;  ///< type: of MIME
};

/// By path as a browser asks for it: "/" and "/assets/...".
using Pages = std::map<std::string, PageFile>;

/// Where the built pages are: `$IFA_STUDIO_PAGES`, else beside the running program, as in a build
/// or an installation.
[[nodiscard]] std::filesystem::path pagesFolder();

/// Errors: kBadInput where they are not built, with how to build them.
[[nodiscard]] Result<Pages> readPages(const std::filesystem::path& folder);

}  // namespace ifa::studio
