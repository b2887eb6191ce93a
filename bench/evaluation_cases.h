// SPDX-License-Identifier: Apache-2.0
// Cases of the fixed evaluation set for benchmarks.
#pragma once

#include <fmt/format.h>

#include <string>
#include <vector>

#include "signature/signature_json.h"

namespace ifa::bench {

/// One signature of an object, by its number from 0.
inline Result<ContactSignature> caseOf(const std::string& object, int number) {
  return readSignature(fmt::format("{}/tests/evaluation/{}/{}-{:02d}.signature.json",
                                   IFA_SOURCE_DIR, object, object, number));
}

/// The first `count` odd-numbered signatures of an object; fewer where there are no more.
inline std::vector<ContactSignature> casesOf(const std::string& object, int count) {
  std::vector<ContactSignature> all;
  for (int i = 0; i < count; ++i) {
    const auto signature = caseOf(object, 2 * i + 1);
    if (signature) all.push_back(*signature);
  }
  return all;
}

}  // namespace ifa::bench
