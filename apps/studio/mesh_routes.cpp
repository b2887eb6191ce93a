// SPDX-License-Identifier: Apache-2.0
#include "studio/mesh_routes.h"

#include "base/file.h"
#include "studio/own_object.h"

namespace ifa::studio {

namespace fs = std::filesystem;

namespace {

/// That can be had, with their types.
const std::map<std::string, std::string>& meshFiles() {
  static const std::map<std::string, std::string> kFiles = {{"mesh.obj", "text/plain"},
                                                            {"mesh.mtl", "text/plain"},
                                                            {"upload", "application/octet-stream"}};
  return kFiles;
}

/// Reads the body as a mesh into the draft, which then is the session's mesh.
std::optional<Refusal> readInto(Workshop& workshop, const fs::path& draft, const std::string& kind,
                                const Exchange& exchange, const JobSlots::Turn& turn) {
  const fs::path upload = draft / ("upload." + kind);
  if (!exchange.receiveFile(upload)) {
    return Refusal{400, "the mesh broke off on its way", "try again"};
  }
  const JobEnd end = workshop.runQuietly(
      {"studio-mesh", upload.string(), draft.string(), "--json-progress"}, turn);
  if (end.child.code != 0) return refusalOfFailure(end, upload);
  const Json told = {{"name", exchange.parameter("name")}, {"kind", kind}};
  if (writeFileAtomically(draft / "kind.json", textOf(told)) &&
      workshop.store->keepDraft(draft, "mesh")) {
    return std::nullopt;
  }
  return Refusal{507, "the mesh cannot be written", "is the disk full?"};
}

}  // namespace

void postMesh(Workshop& workshop, Exchange& exchange) {
  const auto kind = meshKind(exchange.parameter("kind"));
  if (!kind) return exchange.answer(Refusal{422, "this is no kind of mesh that is read", {}});
  if (exchange.length() > kMaxMeshFile) {
    return exchange.answer(Refusal{413, "the mesh is larger than 32 MiB", "simplify it"});
  }
  const auto turn = workshop.slots.enter();
  if (!turn.queued()) {
    exchange.throwAway();
    return exchange.answer(busy());
  }
  const auto draft = workshop.store->createDraft(exchange.part(2));
  if (!draft) return exchange.answer(draft.error());
  if (const auto refusal = readInto(workshop, *draft, *kind, exchange, turn)) {
    std::error_code ignored;
    fs::remove_all(*draft, ignored);
    return exchange.answer(*refusal);
  }
  exchange.answer(meshOf(draft->parent_path()));
}

void getMeshFile(Workshop& workshop, Exchange& exchange) {
  const auto folder = workshop.store->folder(exchange.part(2));
  if (!folder) return exchange.answer(folder.error());
  const auto file = meshFiles().find(exchange.part(4));
  const Json mesh = meshOf(*folder);
  if (file == meshFiles().end() || mesh.is_null()) {
    return exchange.answer(Refusal{404, "there is no such file", {}});
  }
  const auto kind = meshKind(mesh["kind"]);
  const std::string name = file->first == "upload" ? "upload." + kind.value_or("") : file->first;
  exchange.answerFile(*folder / "mesh" / name, file->second);
}

void postObject(Workshop& workshop, Exchange& exchange) {
  const auto folder = workshop.store->folder(exchange.part(2));
  if (!folder) return exchange.answer(folder.error());
  const auto text = exchange.readText();
  if (!text) return exchange.answer(text.error());
  const auto wanted = parseOwnObject(*text);
  if (!wanted) return exchange.answer(wanted.error());
  if (meshOf(*folder).is_null()) {
    return exchange.answer(Refusal{404, "there is no mesh", "drop one first"});
  }
  const auto turn = workshop.slots.enter();
  if (!turn.queued()) return exchange.answer(busy());
  const fs::path mesh = *folder / "mesh";
  const JobEnd end = workshop.runQuietly(objectsArguments(*wanted, mesh), turn);
  if (end.child.code != 0) return exchange.answer(refusalOfFailure(end, mesh / "mesh.obj"));
  exchange.answer(Json::object());
}

Json meshOf(const fs::path& session) {
  const Json kind = readJson(session / "mesh" / "kind.json");
  if (!kind.is_object()) return {};
  return {{"name", kind.value("name", "")},
          {"kind", kind.value("kind", "")},
          {"report", readJson(session / "mesh" / "report.json")}};
}

std::map<std::string, CatalogueEntry> objectsOf(const Workshop& workshop, const fs::path& session) {
  auto objects = workshop.catalogue;
  const fs::path own = session / "mesh" / (std::string(kOwnObject) + ".json");
  std::error_code code;
  if (fs::exists(own, code)) {
    CatalogueEntry& entry = objects[kOwnObject];
    entry = {};
    entry.defaultSurface = "desk";
    entry.surfaces = {"desk"};
    entry.file = own;
  }
  return objects;
}

}  // namespace ifa::studio
