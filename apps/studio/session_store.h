// SPDX-License-Identifier: Apache-2.0
// Where the studio keeps what belongs to a sound: one folder a session, named by the studio.
#pragma once

#include <filesystem>
#include <memory>
#include <mutex>
#include <string>

#include "ifa/result.h"
#include "studio/refusal.h"

namespace ifa::studio {

/// Thread safe. Names that come from requests never become part of a path: a session's name is 32
/// hexadecimal digits that were drawn here, a plan's a number.
class SessionStore {
 public:
  /// Most sessions that are kept; the one that was used least recently goes first.
  static constexpr std::size_t kMaxSessions = 100;
  /// Most plans of a session that are kept; the oldest goes first.
  static constexpr int kMaxPlans = 3;

  /// Makes `root`, for this user's eyes only. Errors: kBadInput when that fails.
  [[nodiscard]] static Result<std::unique_ptr<SessionStore>> open(
      const std::filesystem::path& root);

  /// A new session's name; its folder is there.
  [[nodiscard]] Answer<std::string> create();
  void remove(const std::string& session);

  /// The folder of a session that exists. Refuses (404) anything else.
  [[nodiscard]] Answer<std::filesystem::path> folder(const std::string& session) const;

  /// A new folder in the session's, for what is not sure to be kept.
  [[nodiscard]] Answer<std::filesystem::path> createDraft(const std::string& session);
  /// Makes a draft the session's folder `name`, in place of the one before.
  [[nodiscard]] bool keepDraft(const std::filesystem::path& draft, const std::string& name);

  /// The number of a new plan, whose folder is there.
  [[nodiscard]] Answer<int> createPlan(const std::string& session);
  void removePlan(const std::string& session, int plan);
  /// Removes all plans but the newest ones up to `plan`.
  void keepPlansUpTo(const std::string& session, int plan);
  [[nodiscard]] Answer<std::filesystem::path> planFolder(const std::string& session,
                                                         const std::string& plan) const;

 private:
  explicit SessionStore(std::filesystem::path root) : root_(std::move(root)) {}
  void forgetOldest();

  std::filesystem::path root_;
  std::mutex mutex_;  ///< of what makes and removes folders
};

/// A whole number of at most 9 digits, without signs, blanks or leading zeros; -1 for anything
/// else.
[[nodiscard]] int plainNumber(const std::string& text);

}  // namespace ifa::studio
