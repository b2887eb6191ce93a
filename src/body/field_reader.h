// SPDX-License-Identifier: Apache-2.0
// Takes fields out of JSON, each checked.
#pragma once

#include <array>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "ifa/result.h"

namespace ifa {

/// Smallest and largest value that a number may have.
struct NumberRange {
  double low, high;
};

/// Takes fields out of one JSON object. The first thing that is wrong is kept in `error`, its place
/// being "file: field", and everything after it gives defaults, so that whoever reads a file can be
/// one straight list of fields.
class FieldReader {
 public:
  /// @param prefix  path of the object inside the file; empty for the file itself
  FieldReader(const nlohmann::json& json, std::string file, std::string prefix,
              std::optional<Error>& error);

  void fail(const std::string& field, std::string message, std::string remedy = {}) const;
  /// Fails unless "format" is `format` and "version" is 1.
  /// @param notOne  what is said of a file of another format: "this is not a score"
  void expectFormat(const std::string& format, const std::string& notOne) const;

  [[nodiscard]] bool has(const char* field) const { return json_.contains(field); }
  [[nodiscard]] std::string text(const char* field, bool required = true,
                                 std::size_t longest = 200) const;
  [[nodiscard]] double number(const char* field, NumberRange range) const;
  [[nodiscard]] double number(const char* field, NumberRange range, double otherwise) const;
  [[nodiscard]] std::array<double, 2> interval(const char* field, NumberRange range,
                                               std::array<double, 2> otherwise) const;

  /// A reader of the object inside `field`.
  [[nodiscard]] FieldReader inside(const char* field) const;
  /// A reader of `json`, which stands in this object under `name`.
  [[nodiscard]] FieldReader inside(const std::string& name, const nlohmann::json& json) const;
  [[nodiscard]] const nlohmann::json& json() const { return json_; }

 private:
  [[nodiscard]] double checked(const char* field, const nlohmann::json& value,
                               NumberRange range) const;
  [[nodiscard]] std::string path(const std::string& field) const;

  const nlohmann::json& json_;
  std::string file_, prefix_;
  std::optional<Error>& error_;
};

}  // namespace ifa
