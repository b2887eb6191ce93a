// SPDX-License-Identifier: Apache-2.0
// Fields of a request's JSON object, each checked.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

namespace ifa::studio {

/// Reads fields and keeps the first complaint.
class JsonFields {
 public:
  JsonFields(const nlohmann::json& json, std::string where)
      : json_(json), where_(std::move(where)) {}

  double number(const char* name, double fallback, double low, double high) {
    const nlohmann::json* value = find(name);
    if (value == nullptr) return fallback;
    const double number = value->is_number() ? value->get<double>() : NAN;
    if (number >= low && number <= high) return number;
    complain(name, fmt::format("is not a number from {:g} to {:g}", low, high));
    return fallback;
  }
  bool flag(const char* name, bool fallback) {
    const nlohmann::json* value = find(name);
    if (value == nullptr) return fallback;
    if (value->is_boolean()) return value->get<bool>();
    complain(name, "is neither true nor false");
    return fallback;
  }
  /// One of `choices`, or empty where that may be.
  template <class Choices>
  std::string choice(const char* name, const Choices& choices, bool mayBeEmpty) {
    const nlohmann::json* value = find(name);
    std::string text = value != nullptr && value->is_string() ? value->get<std::string>() : "";
    if (text.empty() && mayBeEmpty) return text;
    if (choices.find(text) != choices.end()) return text;
    complain(name, "is none that there is");
    return {};
  }
  [[nodiscard]] const nlohmann::json* find(const char* name) const {
    const auto found = json_.find(name);
    return found == json_.end() || found->is_null() ? nullptr : &*found;
  }
  void complain(const std::string& name, const std::string& what) {
    if (problem_.empty()) problem_ = where_ + name + " " + what;
  }
  [[nodiscard]] const std::string& problem() const { return problem_; }

 private:
  const nlohmann::json& json_;
  std::string where_, problem_;
};

}  // namespace ifa::studio
