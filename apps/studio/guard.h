// SPDX-License-Identifier: Apache-2.0
// Which requests the studio answers at all, told before a byte of their body is read
// (docs/security.md).
#pragma once

#include <cstddef>
#include <string>

#include "studio/http.h"
#include "studio/refusal.h"

namespace ifa::studio {

/// Where the studio is reached, and what is too much.
struct Gate {
  std::string host = "127.0.0.1";   ///< that it was told to listen at
  int port = 0;                     ///< that it listens at
  std::size_t maxPath = 256;        ///< bytes
  std::size_t maxBody = 64U << 20;  ///< bytes
};

/// Whether the Host header names this studio. A page of somebody else whose name was made to lead
/// here (DNS rebinding) carries that name. On a loopback address only loopback's names do; on
/// another one numeric addresses too, which cannot be rebound.
[[nodiscard]] bool isOurHost(const std::string& host, const Gate& gate);

/// Nothing where the request may be looked at. Refused are: foreign hosts and origins, requests
/// that another site's page makes, long paths, bodies without a length, too long, encoded, or of a
/// type that a page of another site could send unasked, and several ranges at once.
[[nodiscard]] std::optional<Refusal> refusalOf(const httplib::Request& request, const Gate& gate);

}  // namespace ifa::studio
