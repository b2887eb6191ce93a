// SPDX-License-Identifier: Apache-2.0
#include "studio/session_store.h"

#include <fmt/format.h>
#include <sys/random.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <string_view>
#include <vector>

namespace ifa::studio {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kNameBytes = 16;
constexpr std::string_view kPlan = "plan-";

bool isSessionName(std::string_view name) {
  return name.size() == 2 * kNameBytes && std::all_of(name.begin(), name.end(), [](char c) {
           return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f');
         });
}

std::optional<std::string> drawName() {
  std::array<unsigned char, kNameBytes> bytes{};
  if (::getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size())) {
    return std::nullopt;
  }
  return fmt::format("{:02x}", fmt::join(bytes, ""));
}

/// Numbers of the plans in a session's folder, ascending.
std::vector<int> plansIn(const fs::path& folder) {
  std::vector<int> plans;
  std::error_code code;
  for (const auto& entry : fs::directory_iterator(folder, code)) {
    const std::string name = entry.path().filename().string();
    if (name.rfind(kPlan, 0) != 0) continue;
    if (const int plan = plainNumber(name.substr(kPlan.size())); plan > 0) plans.push_back(plan);
  }
  std::sort(plans.begin(), plans.end());
  return plans;
}

fs::path planPath(const fs::path& folder, int plan) {
  return folder / (std::string(kPlan) + std::to_string(plan));
}

void removeAll(const fs::path& path) {
  std::error_code ignored;
  fs::remove_all(path, ignored);
}

}  // namespace

int plainNumber(const std::string& text) {
  const bool digits =
      !text.empty() && text.size() <= 9 &&
      std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
  if (!digits || (text.size() > 1 && text.front() == '0')) return -1;
  return std::stoi(text);
}

Result<std::unique_ptr<SessionStore>> SessionStore::open(const fs::path& root) {
  std::error_code code;
  fs::create_directories(root, code);
  if (!code) fs::permissions(root, fs::perms::owner_all, code);
  if (code) {
    return badInput("cannot be made a folder for the studio's sessions: " + code.message(),
                    root.string(), "name another one with --folder");
  }
  return std::unique_ptr<SessionStore>(new SessionStore(root));
}

Answer<std::string> SessionStore::create() {
  const std::scoped_lock lock(mutex_);
  forgetOldest();
  std::error_code code;
  const auto name = drawName();
  if (!name || !fs::create_directory(root_ / *name, code) || code) {
    return refuse(507, "no session could be made: " + code.message(), "is the disk full?");
  }
  return *name;
}

void SessionStore::remove(const std::string& session) {
  const std::scoped_lock lock(mutex_);
  if (const auto path = folder(session)) removeAll(*path);
}

void SessionStore::forgetOldest() {
  std::multimap<fs::file_time_type, fs::path> byAge;
  std::error_code code;
  for (const auto& entry : fs::directory_iterator(root_, code)) {
    if (!isSessionName(entry.path().filename().string())) continue;
    byAge.emplace(entry.last_write_time(code), entry.path());
  }
  while (byAge.size() >= kMaxSessions) {
    removeAll(byAge.begin()->second);
    byAge.erase(byAge.begin());
  }
}

Answer<fs::path> SessionStore::folder(const std::string& session) const {
  std::error_code code;
  if (!isSessionName(session) || !fs::is_directory(root_ / session, code)) {
    return refuse(404, "this session is not there any more", "open the sound again");
  }
  return root_ / session;
}

Answer<fs::path> SessionStore::createDraft(const std::string& session) {
  const std::scoped_lock lock(mutex_);
  const auto path = folder(session);
  if (!path) return tl::unexpected(path.error());
  std::error_code code;
  const auto name = drawName();
  if (!name || !fs::create_directory(*path / ("draft-" + *name), code) || code) {
    return refuse(507, "no folder could be made", "is the disk full?");
  }
  return *path / ("draft-" + *name);
}

bool SessionStore::keepDraft(const fs::path& draft, const std::string& name) {
  const std::scoped_lock lock(mutex_);
  const fs::path kept = draft.parent_path() / name;
  removeAll(kept);
  std::error_code code;
  fs::rename(draft, kept, code);
  return !code;
}

Answer<int> SessionStore::createPlan(const std::string& session) {
  const std::scoped_lock lock(mutex_);
  const auto path = folder(session);
  if (!path) return tl::unexpected(path.error());
  const auto plans = plansIn(*path);
  const int plan = plans.empty() ? 1 : plans.back() + 1;
  std::error_code code;
  if (!fs::create_directory(planPath(*path, plan), code) || code) {
    return refuse(507, "no folder for the plan could be made", "is the disk full?");
  }
  return plan;
}

void SessionStore::removePlan(const std::string& session, int plan) {
  const std::scoped_lock lock(mutex_);
  if (const auto path = folder(session)) removeAll(planPath(*path, plan));
}

void SessionStore::keepPlansUpTo(const std::string& session, int plan) {
  const std::scoped_lock lock(mutex_);
  const auto path = folder(session);
  if (!path) return;
  for (const int other : plansIn(*path)) {
    if (other <= plan - kMaxPlans) removeAll(planPath(*path, other));
  }
}

Answer<fs::path> SessionStore::planFolder(const std::string& session,
                                          const std::string& plan) const {
  const auto path = folder(session);
  if (!path) return tl::unexpected(path.error());
  const int number = plainNumber(plan);
  std::error_code code;
  if (number < 1 || !fs::is_directory(planPath(*path, number), code)) {
    return refuse(404, "this plan is not there any more", "plan again");
  }
  return planPath(*path, number);
}

}  // namespace ifa::studio
