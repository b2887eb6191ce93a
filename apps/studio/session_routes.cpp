// SPDX-License-Identifier: Apache-2.0
#include "studio/session_routes.h"

#include <optional>

#include "base/file.h"
#include "signature/labels.h"
#include "studio/mesh_routes.h"

namespace ifa::studio {

namespace fs = std::filesystem;

namespace {

void answerSession(Workshop& workshop, Exchange& exchange, const std::string& session) {
  const auto folder = workshop.store->folder(session);
  if (!folder) return exchange.answer(folder.error());
  const Json heard = readJson(*folder / "heard.json");
  if (!heard.is_object()) return exchange.answer(Refusal{404, "this session is not whole", {}});
  exchange.answer(Json{{"session", session},
                       {"name", readJson(*folder / "name.json")},
                       {"heard", heard},
                       {"mesh", meshOf(*folder)},
                       {"state", readJson(*folder / "state.json")}});
}

/// Nothing where the text is JSON that can be written again: that recurses, whereas reading does
/// not.
std::optional<Refusal> refusalOfState(const std::string& text) {
  constexpr int kDeepest = 32;
  bool deep = false;
  const auto look = [&deep](int depth, Json::parse_event_t, const Json&) {
    deep = deep || depth > kDeepest;
    return depth <= kDeepest;
  };
  if (Json::parse(text, look, false).is_discarded()) return Refusal{400, "this is no JSON", {}};
  if (deep) return Refusal{422, "this nests too deep", {}};
  return std::nullopt;
}

}  // namespace

void postSound(Workshop& workshop, Exchange& exchange) {
  const auto turn = workshop.slots.enter();
  if (!turn.queued()) {
    exchange.throwAway();
    return exchange.answer(busy());
  }
  const auto session = workshop.store->create();
  if (!session) return exchange.answer(session.error());
  const fs::path folder = *workshop.store->folder(*session);
  const fs::path original = folder / "original";
  if (!exchange.receiveFile(original)) {
    workshop.store->remove(*session);
    return exchange.answer(Refusal{400, "the sound broke off on its way", "try again"});
  }
  const JobEnd end = workshop.runQuietly(
      {"studio-hear", original.string(), folder.string(), "--json-progress"}, turn);
  const Json name = exchange.parameter("name");
  if (end.child.code != 0 || !writeFileAtomically(folder / "name.json", textOf(name))) {
    workshop.store->remove(*session);
    return exchange.answer(refusalOfFailure(end, original));
  }
  answerSession(workshop, exchange, *session);
}

void getSession(Workshop& workshop, Exchange& exchange) {
  answerSession(workshop, exchange, exchange.part(2));
}

void getSound(Workshop& workshop, Exchange& exchange) {
  const auto folder = workshop.store->folder(exchange.part(2));
  if (!folder) return exchange.answer(folder.error());
  exchange.answerFile(*folder / "sound.wav", "audio/wav");
}

void putState(Workshop& workshop, Exchange& exchange) {
  const auto folder = workshop.store->folder(exchange.part(2));
  if (!folder) return exchange.answer(folder.error());
  const auto text = exchange.readText();
  if (!text) return exchange.answer(text.error());
  if (const auto refusal = refusalOfState(*text)) return exchange.answer(*refusal);
  if (!writeFileAtomically(*folder / "state.json", *text)) {
    return exchange.answer(Refusal{507, "the state cannot be written", "is the disk full?"});
  }
  exchange.answer(Json::object());
}

void postLabels(Workshop& /*workshop*/, Exchange& exchange) {
  const auto text = exchange.readText();
  if (!text) return exchange.answer(text.error());
  const auto labels = parseLabels(*text, "line");
  if (!labels) {
    const Error& error = labels.error();
    return exchange.answer(Refusal{422, error.place + ": " + error.message, error.remedy});
  }
  auto marks = Json::array();
  for (const Label& label : *labels) marks.push_back({{"start", label.start}, {"end", label.end}});
  exchange.answer(Json{{"marks", marks}, {"terminal", labelsAreTerminal(*labels)}});
}

}  // namespace ifa::studio
