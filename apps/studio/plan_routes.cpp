// SPDX-License-Identifier: Apache-2.0
#include "studio/plan_routes.h"

#include <fmt/format.h>

#include "base/file.h"
#include "studio/mesh_routes.h"
#include "studio/plan_request.h"

namespace ifa::studio {

namespace fs = std::filesystem;

namespace {

/// Files of a take that can be had, with their types.
const std::map<std::string, std::string>& takeFiles() {
  static const std::map<std::string, std::string> kFiles = {{"motion.json", "application/json"},
                                                            {"motion.glb", "model/gltf-binary"},
                                                            {"motion.usda", "text/plain"},
                                                            {"motion.csv", "text/csv"},
                                                            {"contacts.csv", "text/csv"},
                                                            {"sound.wav", "audio/wav"},
                                                            {"film.mp4", "video/mp4"}};
  return kFiles;
}

/// The folder of a take. `ifa sync` makes none where there is only one.
fs::path takeFolder(const fs::path& plan, int take) {
  const fs::path folder = plan / "out";
  std::error_code code;
  const fs::path own = folder / fmt::format("take-{}", take);
  return take > 1 || fs::is_directory(own, code) ? own : folder;
}

fs::path filmOf(const fs::path& plan, int take) { return plan / fmt::format("film-{}.mp4", take); }

int countTakes(const fs::path& plan) {
  int takes = 0;
  std::error_code code;
  while (takes < kMaxTakes && fs::exists(takeFolder(plan, takes + 1) / "motion.json", code)) {
    ++takes;
  }
  return takes;
}

bool writeInputs(const PlanRequest& wanted, const PlanFiles& files) {
  return writeFileAtomically(files.marks, marksTable(wanted)) &&
         (!wanted.landing || writeFileAtomically(files.places, placesTable(wanted)));
}

Json finishPlan(SessionStore& store, const std::string& session, int plan, const JobEnd& end) {
  const bool ended =
      end.child.kind == ChildEnd::Kind::kExited &&
      (end.child.code == 0 || end.child.code == static_cast<int>(ErrorCode::kNoMotion));
  const auto folder = store.planFolder(session, std::to_string(plan));
  const int takes = ended && folder ? countTakes(*folder) : 0;
  if (takes == 0) {
    store.removePlan(session, plan);
    return failureOf(end);
  }
  store.keepPlansUpTo(session, plan);
  return {{"plan", plan}, {"takes", takes}, {"failure", end.failure}};
}

}  // namespace

void postPlan(Workshop& workshop, Exchange& exchange) {
  const std::string& session = exchange.part(2);
  const auto folder = workshop.store->folder(session);
  if (!folder) return exchange.answer(folder.error());
  const auto text = exchange.readText();
  if (!text) return exchange.answer(text.error());
  const auto wanted = parsePlanRequest(*text, objectsOf(workshop, *folder));
  if (!wanted) return exchange.answer(wanted.error());
  auto turn = workshop.slots.enter();
  if (!turn.queued()) return exchange.answer(busy());
  const auto plan = workshop.store->createPlan(session);
  if (!plan) return exchange.answer(plan.error());
  const fs::path where = *workshop.store->planFolder(session, std::to_string(*plan));
  const PlanFiles files = {*folder / "sound.wav", where / "marks.csv", where / "places.tsv"};
  if (!writeInputs(*wanted, files)) {
    return exchange.answer(Refusal{507, "the marks cannot be written", "is the disk full?"});
  }
  workshop.answerWithJob(
      exchange, syncArguments(*wanted, files, where / "out"), std::move(turn),
      [store = workshop.store.get(), session, number = *plan](const JobEnd& end) {
        return finishPlan(*store, session, number, end);
      });
}

void getTakeFile(Workshop& workshop, Exchange& exchange) {
  const auto plan = workshop.store->planFolder(exchange.part(2), exchange.part(4));
  if (!plan) return exchange.answer(plan.error());
  const int take = plainNumber(exchange.part(6));
  const auto file = takeFiles().find(exchange.part(7));
  if (take < 1 || take > kMaxTakes || file == takeFiles().end()) {
    return exchange.answer(Refusal{404, "there is no such file", {}});
  }
  const fs::path where =
      file->first == "film.mp4" ? filmOf(*plan, take) : takeFolder(*plan, take) / file->first;
  exchange.answerFile(where, file->second);
}

void postFilm(Workshop& workshop, Exchange& exchange) {
  const auto plan = workshop.store->planFolder(exchange.part(2), exchange.part(4));
  if (!plan) return exchange.answer(plan.error());
  const auto text = exchange.readText();
  if (!text) return exchange.answer(text.error());
  const Json json = Json::parse(*text, nullptr, false);
  const int take = plainNumber(exchange.part(6));
  if (!json.is_object() || take < 1 || take > countTakes(*plan)) {
    return exchange.answer(Refusal{404, "there is no such take", {}});
  }
  auto turn = workshop.slots.enter();
  if (!turn.queued()) return exchange.answer(busy());
  std::vector<std::string> words = {"render",
                                    takeFolder(*plan, take).string(),
                                    "--json-progress",
                                    "--quality",
                                    json.value("final", Json()) == true ? "final" : "draft",
                                    "-o",
                                    filmOf(*plan, take).string()};
  if (json.value("overlay", Json()) == true) words.emplace_back("--overlay");
  workshop.answerWithJob(exchange, std::move(words), std::move(turn), [](const JobEnd& end) {
    return end.child.code == 0 ? Json::object() : failureOf(end);
  });
}

}  // namespace ifa::studio
