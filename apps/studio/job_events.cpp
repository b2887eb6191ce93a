// SPDX-License-Identifier: Apache-2.0
#include "studio/job_events.h"

#include <filesystem>
#include <utility>

#include "studio/bounded_server.h"

namespace ifa::studio {
namespace {

using Json = nlohmann::json;

std::string textOf(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string stringIn(const Json& json, const char* name) {
  const auto found = json.find(name);
  return found != json.end() && found->is_string() ? found->get<std::string>() : std::string();
}

/// The program's own line of JSON, without its type and without where files lie on this machine.
void tellLine(std::string_view line, JobEnd& end,
              const std::function<bool(const std::string&, const Json&)>& tell) {
  Json json = Json::parse(line, nullptr, false);
  if (!json.is_object()) return;
  const std::string type = stringIn(json, "type");
  if (type == "progress" || type == "log") {
    json.erase("type");
    static_cast<void>(tell(type, json));
  } else if (type == "failure") {
    const std::string place = std::filesystem::path(stringIn(json, "place")).filename().string();
    const std::string message = stringIn(json, "message");
    end.failure = {{"message", place.empty() ? message : place + ": " + message},
                   {"remedy", stringIn(json, "remedy")}};
  }
}

bool clientIsThere() {
  const Connection* connection = Connection::current();
  return connection == nullptr || connection->alive();
}

}  // namespace

JobEnd runJob(const Job& job, const JobSlots::Turn& turn,
              const std::function<bool(const std::string&, const Json&)>& tell) {
  JobEnd end;
  const auto goOn = [&job] { return job.goOn() && clientIsThere(); };
  std::size_t told = 0;
  const bool mayRun = turn.wait([&](std::size_t before) {
    if (before != std::exchange(told, before))
      static_cast<void>(tell("queued", {{"before", before}}));
    return goOn();
  });
  if (!mayRun) {
    end.child.kind = ChildEnd::Kind::kCancelled;
    return end;
  }
  end.child = runChild(job.program, job.arguments,
                       {[&](std::string_view line) { tellLine(line, end, tell); }, goOn});
  return end;
}

void answerWithEvents(httplib::Response& response, Job job, std::shared_ptr<JobSlots::Turn> turn) {
  response.set_chunked_content_provider(
      "text/event-stream",
      [job = std::move(job), turn = std::move(turn)](std::size_t, httplib::DataSink& sink) {
        const auto tell = [&sink](const std::string& name, const Json& data) {
          const std::string event = "event: " + name + "\ndata: " + textOf(data) + "\n\n";
          sink.write(event.data(), event.size());
          return true;
        };
        const JobEnd end = runJob(job, *turn, tell);
        const Json data = job.finish(end);
        static_cast<void>(tell(data.contains("message") ? "failed" : "done", data));
        sink.done();
        return true;
      });
}

Json failureOf(const JobEnd& end) {
  if (!end.failure.is_null()) return end.failure;
  switch (end.child.kind) {
    case ChildEnd::Kind::kCancelled:
      return {{"message", "cancelled"}, {"remedy", ""}};
    case ChildEnd::Kind::kNotStarted:
      return {{"message", "the job could not be started"},
              {"remedy", "is the machine out of memory?"}};
    default:
      return {{"message", "the job ended unexpectedly; the studio goes on"},
              {"remedy", "try again, or another sound"}};
  }
}

}  // namespace ifa::studio
