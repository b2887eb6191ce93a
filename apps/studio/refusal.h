// SPDX-License-Identifier: Apache-2.0
// Why a request is not answered.
#pragma once

#include <optional>
#include <string>
#include <tl/expected.hpp>
#include <utility>

namespace ifa::studio {

struct Refusal {
  int status = 400;     ///< of HTTP
  std::string message;  ///< for a person, without a full stop
  std::string remedy;   ///< may be empty
};

template <class T>
using Answer = tl::expected<T, Refusal>;

/// Shorthand for `return refuse(...)` in functions that return an Answer.
[[nodiscard]] inline tl::unexpected<Refusal> refuse(int status, std::string message,
                                                    std::string remedy = {}) {
  return tl::unexpected<Refusal>(Refusal{status, std::move(message), std::move(remedy)});
}

}  // namespace ifa::studio
