// SPDX-License-Identifier: Apache-2.0
// One request and its answer, as routes see them.
#pragma once

#include <cstddef>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "studio/http.h"
#include "studio/refusal.h"

namespace ifa::studio {

using Json = nlohmann::json;

class Exchange {
 public:
  /// @param reader  of the request's body; null where it has none to read
  Exchange(const httplib::Request& request, httplib::Response& response,
           const httplib::ContentReader* reader);

  /// Of the path: "api" is part 0 of "/api/objects". Never beyond what the route's pattern has.
  [[nodiscard]] const std::string& part(std::size_t i) const { return path_[i]; }
  [[nodiscard]] const std::vector<std::string>& path() const { return path_; }
  [[nodiscard]] const std::string& method() const { return request_.method; }
  /// Of the query; at most 120 bytes, empty where it has none of that name.
  [[nodiscard]] std::string parameter(const char* name) const;

  /// The announced length of the body, which refusalOf has checked, bytes.
  [[nodiscard]] std::size_t length() const;
  /// The body, at most 1 MiB. Refuses what is longer or breaks off.
  [[nodiscard]] Answer<std::string> readText() const;
  /// Writes the body to a file as it comes. @return false where it broke off or the disk is full
  [[nodiscard]] bool receiveFile(const std::filesystem::path& path) const;
  /// A client that may not send what it sends reads the answer only when it has sent it.
  void throwAway() const;

  void answer(const Json& json);
  void answer(const Refusal& refusal);
  /// Block by block, so that a large file takes no memory. 404 where it is not there.
  void answerFile(const std::filesystem::path& path, const std::string& type);
  [[nodiscard]] httplib::Response& response() { return response_; }

 private:
  const httplib::Request& request_;
  httplib::Response& response_;
  const httplib::ContentReader* reader_;
  std::vector<std::string> path_;
};

/// Its text, whatever bytes its strings have.
[[nodiscard]] std::string textOf(const Json& json);

}  // namespace ifa::studio
