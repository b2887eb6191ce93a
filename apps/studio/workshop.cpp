// SPDX-License-Identifier: Apache-2.0
#include "studio/workshop.h"

#include <utility>

#include "base/file.h"

namespace ifa::studio {

void Workshop::answerWithJob(Exchange& exchange, std::vector<std::string> arguments,
                             JobSlots::Turn turn, std::function<Json(const JobEnd&)> finish) const {
  Job job = {program, std::move(arguments), [this] { return !stopping; }, std::move(finish)};
  answerWithEvents(exchange.response(), std::move(job),
                   std::make_shared<JobSlots::Turn>(std::move(turn)));
}

JobEnd Workshop::runQuietly(std::vector<std::string> arguments, const JobSlots::Turn& turn) const {
  const Job job = {program, std::move(arguments), [this] { return !stopping; }, {}};
  return runJob(job, turn, [](const std::string&, const Json&) { return true; });
}

Refusal busy() { return {503, "the studio has too much to do", "wait until other jobs are done"}; }

Refusal refusalOfFailure(const JobEnd& end, const std::filesystem::path& file) {
  const Json failure = failureOf(end);
  std::string message = failure["message"];
  const std::string name = file.filename().string() + ": ";
  if (message.rfind(name, 0) == 0) message = message.substr(name.size());
  // Libraries write the whole path into what they tell.
  const std::string path = file.string();
  for (auto at = message.find(path); at != std::string::npos; at = message.find(path)) {
    message.replace(at, path.size(), "it");
  }
  return {422, message, failure["remedy"]};
}

Json readJson(const std::filesystem::path& path) {
  constexpr std::size_t kMax = 1 << 20;
  const auto text = readFile(path, kMax);
  return text ? Json::parse(*text, nullptr, false) : Json();
}

}  // namespace ifa::studio
