// SPDX-License-Identifier: Apache-2.0
// libFuzzer's door to the target that IFA_FUZZ_TARGET names.
#include <cstddef>
#include <cstdint>

#include "fuzz/fuzz_targets.h"

namespace {

constexpr const ifa::fuzz::Target& chosen() {
  for (const auto& target : ifa::fuzz::kTargets) {
    if (target.name == IFA_FUZZ_TARGET) return target;
  }
  throw "no such target";
}
constexpr const ifa::fuzz::Target& kTarget = chosen();

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  kTarget.run({reinterpret_cast<const char*>(data), size});
  return 0;
}
