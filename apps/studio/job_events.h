// SPDX-License-Identifier: Apache-2.0
// A job whose progress a page follows: the answer to the request is a stream of events, and when
// the page goes, so does the job.
#pragma once

#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "studio/child_program.h"
#include "studio/http.h"
#include "studio/job_slots.h"

namespace ifa::studio {

/// How the job ended, for the page.
struct JobEnd {
  ChildEnd child;
  nlohmann::json failure;  ///< {"message", "remedy"} as the program told it; null where it did not
};

struct Job {
  std::string program;                 ///< the file to run
  std::vector<std::string> arguments;  ///< --json-progress is among them
  std::function<bool()> goOn;          ///< false when the studio ends
  /// Called when the child has ended, in the connection's thread; what it returns is the data of
  /// the event "done", or of "failed" where it has a message and nothing else was made.
  std::function<nlohmann::json(const JobEnd&)> finish;
};

/// Runs the job to its end in the calling thread. @param tell  an event's name and data; false
/// where nobody listens any more
[[nodiscard]] JobEnd runJob(
    const Job& job, const JobSlots::Turn& turn,
    const std::function<bool(const std::string&, const nlohmann::json&)>& tell);

/// Answers with the events "queued" {"before"}, "progress" {"stage", "value"}, "log" {"level",
/// "message"}, and at last "done" or "failed".
void answerWithEvents(httplib::Response& response, Job job, std::shared_ptr<JobSlots::Turn> turn);

/// What to tell a person about a job that did not end well.
[[nodiscard]] nlohmann::json failureOf(const JobEnd& end);

}  // namespace ifa::studio
