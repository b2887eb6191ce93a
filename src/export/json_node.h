// SPDX-License-Identifier: Apache-2.0
// Reading of checked fields from JSON that nobody vouches for. Only for .cpp files: slow to
// compile.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

namespace ifa {

/// One JSON value with its path. The first thing that is wrong is kept; what follows reads as zero,
/// so that the code that reads stays a list of fields.
class JsonNode {
 public:
  static constexpr double kLargest = 1e12;  ///< no quantity of ours is larger
  static constexpr std::size_t kLongestText = 1 << 16;
  static constexpr double kUnitTolerance = 1e-6;  ///< of a quaternion's norm

  /// @param problem  what is wrong first ("'contacts[2].time' is missing"); shared by all nodes
  JsonNode(const nlohmann::json* json, std::string path, std::string* problem)
      : json_(json), path_(std::move(path)), problem_(problem) {}

  [[nodiscard]] JsonNode member(const char* name) const {
    const std::string path = path_.empty() ? name : path_ + "." + name;
    if (json_ == nullptr) return {nullptr, path, problem_};
    if (!json_->is_object()) return reject("is not an object");
    const auto found = json_->find(name);
    if (found == json_->end()) return JsonNode(nullptr, path, problem_).reject("is missing");
    return {&*found, path, problem_};
  }
  [[nodiscard]] JsonNode item(std::size_t index) const {
    return {json_ == nullptr ? nullptr : &(*json_)[index],
            path_ + "[" + std::to_string(index) + "]", problem_};
  }
  [[nodiscard]] bool has(const char* name) const {
    return json_ != nullptr && json_->is_object() && json_->contains(name) &&
           !(*json_)[name].is_null();
  }
  /// Number of items; `exactly` where it is known beforehand.
  [[nodiscard]] std::size_t count(std::size_t exactly = SIZE_MAX) const {
    if (json_ == nullptr) return 0;
    if (!json_->is_array()) return reject("is not an array"), std::size_t{0};
    if (exactly != SIZE_MAX && json_->size() != exactly) {
      reject("has " + std::to_string(json_->size()) + " items where " + std::to_string(exactly) +
             " belong");
      return 0;
    }
    return json_->size();
  }
  [[nodiscard]] double number(double low = -kLargest, double high = kLargest) const {
    if (json_ == nullptr) return 0;
    if (!json_->is_number()) return reject("is not a number"), 0;
    const double value = json_->get<double>();
    if (!(value >= low && value <= high)) return reject("is out of range"), 0;
    return value;
  }
  template <class Integer>
  [[nodiscard]] Integer integer() const {
    if (json_ == nullptr) return 0;
    if (!json_->is_number_integer()) return reject("is not a whole number"), Integer{0};
    if (json_->is_number_unsigned()) {
      const auto value = json_->get<std::uint64_t>();
      if (value <= static_cast<std::uint64_t>(std::numeric_limits<Integer>::max())) {
        return static_cast<Integer>(value);
      }
    } else if (std::numeric_limits<Integer>::is_signed) {
      const auto value = json_->get<std::int64_t>();
      if (value >= static_cast<std::int64_t>(std::numeric_limits<Integer>::min())) {
        return static_cast<Integer>(value);
      }
    }
    return reject("is out of range"), Integer{0};
  }
  [[nodiscard]] bool flag() const {
    if (json_ == nullptr) return false;
    if (!json_->is_boolean()) return reject("is neither true nor false"), false;
    return json_->get<bool>();
  }
  [[nodiscard]] std::string text() const {
    if (json_ == nullptr) return {};
    if (!json_->is_string()) return reject("is not a text"), std::string{};
    if (json_->get_ref<const std::string&>().size() > kLongestText) {
      return reject("is too long"), std::string{};
    }
    return json_->get<std::string>();
  }
  [[nodiscard]] Eigen::Vector3d vector() const {
    if (count(3) == 0) return Eigen::Vector3d::Zero();
    return {item(0).number(), item(1).number(), item(2).number()};
  }
  [[nodiscard]] Eigen::Quaterniond rotation() const {
    if (count(4) == 0) return Eigen::Quaterniond::Identity();
    const Eigen::Quaterniond q(item(0).number(-2, 2), item(1).number(-2, 2), item(2).number(-2, 2),
                               item(3).number(-2, 2));
    if (!(std::abs(q.norm() - 1) <= kUnitTolerance)) reject("is not a unit quaternion");
    return q;
  }
  /// Notes what is wrong here. Returns a node that reads as zero.
  JsonNode reject(const std::string& what) const {
    if (problem_->empty()) *problem_ = "'" + (path_.empty() ? "the file" : path_) + "' " + what;
    return {nullptr, path_, problem_};
  }

 private:
  const nlohmann::json* json_;
  std::string path_;
  std::string* problem_;
};

}  // namespace ifa
