// SPDX-License-Identifier: Apache-2.0
#include "studio/guard.h"

#include <arpa/inet.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <string_view>

namespace ifa::studio {
namespace {

/// "name:port" or "[address]:port" in two; an absent port is 80.
std::optional<std::pair<std::string, int>> nameAndPort(const std::string& host) {
  const auto colon = host.rfind(':');
  const auto bracket = host.rfind(']');
  const bool hasPort =
      colon != std::string::npos && (bracket == std::string::npos || bracket < colon);
  std::string name = hasPort ? host.substr(0, colon) : host;
  int port = 80;
  if (hasPort) {
    const char* end = host.data() + host.size();
    const auto read = std::from_chars(host.data() + colon + 1, end, port);
    if (read.ec != std::errc() || read.ptr != end) return std::nullopt;
  }
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return std::pair(std::move(name), port);
}

bool isNumeric(const std::string& name) {
  std::array<unsigned char, sizeof(in6_addr)> address{};
  if (::inet_pton(AF_INET, name.c_str(), address.data()) == 1) return true;
  return name.size() > 2 && name.front() == '[' && name.back() == ']' &&
         ::inet_pton(AF_INET6, name.substr(1, name.size() - 2).c_str(), address.data()) == 1;
}

bool isLoopback(const std::string& name) {
  return name == "127.0.0.1" || name == "localhost" || name == "[::1]" || name == "::1";
}

bool hasBody(const httplib::Request& request) {
  return request.method != "GET" && request.method != "HEAD" && request.method != "OPTIONS";
}

std::optional<Refusal> refusalOfOrigin(const httplib::Request& request, const Gate& gate) {
  const std::string host = request.get_header_value("Host");
  if (request.get_header_value_count("Host") != 1 || !isOurHost(host, gate)) {
    return Refusal{403, "this is not the studio's address",
                   "open the address that ifa studio printed"};
  }
  for (std::size_t i = 0; i < request.get_header_value_count("Origin"); ++i) {
    if (request.get_header_value("Origin", i) != "http://" + host) {
      return Refusal{403, "the request comes from a page of another site", {}};
    }
  }
  const std::string site = request.get_header_value("Sec-Fetch-Site");
  const bool navigation =
      request.path == "/" && request.get_header_value("Sec-Fetch-Mode") == "navigate";
  if (!site.empty() && site != "same-origin" && site != "none" && !navigation) {
    return Refusal{403, "the request comes from a page of another site", {}};
  }
  return std::nullopt;
}

std::optional<Refusal> refusalOfBody(const httplib::Request& request, const Gate& gate) {
  if (request.has_header("Transfer-Encoding")) {
    return Refusal{411, "a body without a length is not taken", {}};
  }
  if (request.has_header("Content-Encoding")) {
    return Refusal{415, "an encoded body is not taken", {}};
  }
  const std::string length = request.get_header_value("Content-Length");
  std::size_t bytes = 0;
  const char* end = length.data() + length.size();
  const auto read = std::from_chars(length.data(), end, bytes);
  if (request.get_header_value_count("Content-Length") > 1 || read.ec != std::errc() ||
      read.ptr != end) {
    return length.empty() && !hasBody(request)
               ? std::nullopt
               : std::optional(Refusal{411, "the length of the body is not told", {}});
  }
  if (bytes > gate.maxBody) {
    return Refusal{413, "the file is larger than 64 MiB", "cut out the part that is to be seen"};
  }
  const std::string type = request.get_header_value("Content-Type");
  if (hasBody(request) && type != "application/json" && type != "application/octet-stream") {
    return Refusal{415, "the body is neither application/json nor application/octet-stream", {}};
  }
  if (!hasBody(request) && bytes > 0) return Refusal{400, "no body belongs here", {}};
  return std::nullopt;
}

}  // namespace

bool isOurHost(const std::string& host, const Gate& gate) {
  const auto parts = nameAndPort(host);
  if (!parts || parts->second != gate.port) return false;
  const std::string& name = parts->first;
  if (isLoopback(name) || name == gate.host) return true;
  return !isLoopback(gate.host) && isNumeric(name);
}

std::optional<Refusal> refusalOf(const httplib::Request& request, const Gate& gate) {
  if (auto refusal = refusalOfOrigin(request, gate)) return refusal;
  if (request.path.size() > gate.maxPath) return Refusal{414, "the path is too long", {}};
  // Each range is answered with bytes of its own.
  if (request.ranges.size() > 1) return Refusal{416, "one range at a time", {}};
  return refusalOfBody(request, gate);
}

}  // namespace ifa::studio
