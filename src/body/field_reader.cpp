// SPDX-License-Identifier: Apache-2.0
#include "body/field_reader.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace ifa {

using Json = nlohmann::json;

FieldReader::FieldReader(const Json& json, std::string file, std::string prefix,
                         std::optional<Error>& error)
    : json_(json), file_(std::move(file)), prefix_(std::move(prefix)), error_(error) {}

std::string FieldReader::path(const std::string& field) const {
  return prefix_.empty() || field.empty() ? prefix_ + field : prefix_ + "." + field;
}

void FieldReader::fail(const std::string& field, std::string message, std::string remedy) const {
  if (error_) return;
  error_ = Error{ErrorCode::kBadInput, std::move(message), file_ + ": " + path(field),
                 std::move(remedy)};
}

void FieldReader::expectFormat(const std::string& format, const std::string& notOne) const {
  if (text("format") != format) fail("format", fmt::format("is not \"{}\"", format), notOne);
  if (const double version = number("version", {0, 1e9}); version != 1) {
    fail("version", fmt::format("{:g} is not known to this program, only 1 is", version));
  }
}

std::string FieldReader::text(const char* field, bool required, std::size_t longest) const {
  if (!has(field)) {
    if (required) fail(field, "is missing");
    return {};
  }
  if (!json_[field].is_string()) return fail(field, "must be text in quotes"), std::string{};
  const auto value = json_[field].get<std::string>();
  if (value.size() > longest) fail(field, fmt::format("is longer than {} characters", longest));
  if (required && value.empty()) fail(field, "is empty");
  return value;
}

double FieldReader::number(const char* field, NumberRange range) const {
  if (!has(field)) return fail(field, "is missing"), range.low;
  return checked(field, json_[field], range);
}

double FieldReader::number(const char* field, NumberRange range, double otherwise) const {
  return has(field) ? checked(field, json_[field], range) : otherwise;
}

std::array<double, 2> FieldReader::interval(const char* field, NumberRange range,
                                            std::array<double, 2> otherwise) const {
  if (!has(field)) return otherwise;
  const Json& pair = json_[field];
  if (!pair.is_array() || pair.size() != 2) {
    return fail(field, "must be two numbers, smallest and largest"), otherwise;
  }
  const std::array<double, 2> value = {checked(field, pair[0], range),
                                       checked(field, pair[1], range)};
  if (value[0] > value[1]) fail(field, "has its larger number first");
  return value;
}

FieldReader FieldReader::inside(const char* field) const { return inside(field, json_[field]); }

FieldReader FieldReader::inside(const std::string& name, const Json& json) const {
  static const Json empty = Json::object();
  if (!json.is_object()) fail(name, "must be an object in braces");
  return {json.is_object() ? json : empty, file_, path(name), error_};
}

double FieldReader::checked(const char* field, const Json& value, NumberRange range) const {
  if (!value.is_number()) return fail(field, "must be a number"), range.low;
  const double number = value.get<double>();
  if (std::isfinite(number) && number >= range.low && number <= range.high) return number;
  fail(field, fmt::format("{:g} is not between {:g} and {:g}", number, range.low, range.high));
  return range.low;
}

}  // namespace ifa
