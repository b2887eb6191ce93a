// SPDX-License-Identifier: Apache-2.0
// What all routes work with: the sessions' folders, the library of objects, and who does the jobs.
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "studio/catalogue.h"
#include "studio/exchange.h"
#include "studio/job_events.h"
#include "studio/job_slots.h"
#include "studio/session_store.h"

namespace ifa::studio {

struct Workshop {
  std::unique_ptr<SessionStore> store;
  std::map<std::string, CatalogueEntry> catalogue;
  std::string program;  ///< that does the jobs
  JobSlots slots;
  std::atomic<bool> stopping{false};  ///< jobs end then

  /// A job whose progress the page follows: the answer is its stream of events.
  void answerWithJob(Exchange& exchange, std::vector<std::string> arguments, JobSlots::Turn turn,
                     std::function<Json(const JobEnd&)> finish) const;
  /// A job whose progress nobody is told.
  [[nodiscard]] JobEnd runQuietly(std::vector<std::string> arguments,
                                  const JobSlots::Turn& turn) const;
};

/// Where no more jobs may wait.
[[nodiscard]] Refusal busy();

/// A job's failure for a person, to whom the file's name and place here mean nothing.
[[nodiscard]] Refusal refusalOfFailure(const JobEnd& end, const std::filesystem::path& file);

/// What the studio itself has written; null where that is not there.
[[nodiscard]] Json readJson(const std::filesystem::path& path);

}  // namespace ifa::studio
