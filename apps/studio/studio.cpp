// SPDX-License-Identifier: Apache-2.0
#include "studio/studio.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <string_view>
#include <vector>

#include "base/file.h"
#include "signature/labels.h"
#include "studio/catalogue.h"
#include "studio/guard.h"
#include "studio/job_events.h"
#include "studio/own_object.h"
#include "studio/plan_request.h"
#include "studio/session_store.h"

namespace ifa::studio {

namespace fs = std::filesystem;

namespace {

using httplib::ContentReader;
using httplib::Request;
using httplib::Response;
using Json = nlohmann::json;
using Path = std::vector<std::string>;

constexpr std::size_t kMaxJson = 1 << 20;
constexpr std::size_t kMaxName = 120;
constexpr int kMaxTakesShown = 6;

/// What a page may load: itself. Styles are set by script on elements, hence 'unsafe-inline' there.
constexpr const char* kContentPolicy =
    "default-src 'none'; script-src 'self'; style-src 'self' 'unsafe-inline'; img-src 'self' blob: "
    "data:; media-src 'self' blob:; connect-src 'self' blob:; font-src 'self'; base-uri 'none'; "
    "form-action 'none'; frame-ancestors 'none'";

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

/// Of a session's own mesh, as they can be had, with their types.
const std::map<std::string, std::string>& meshFiles() {
  static const std::map<std::string, std::string> kFiles = {{"mesh.obj", "text/plain"},
                                                            {"mesh.mtl", "text/plain"},
                                                            {"upload", "application/octet-stream"}};
  return kFiles;
}

void answer(Response& response, const Json& json) {
  response.set_content(json.dump(-1, ' ', false, Json::error_handler_t::replace),
                       "application/json");
}

void answer(Response& response, const Refusal& refusal) {
  response.status = refusal.status;
  answer(response, Json{{"message", refusal.message}, {"remedy", refusal.remedy}});
}

/// Block by block, so that a large file takes no memory.
void answerFile(Response& response, const fs::path& path, const std::string& type) {
  std::error_code code;
  const auto size = fs::file_size(path, code);
  auto stream = std::make_shared<std::ifstream>(path, std::ios::binary);
  if (code || !*stream) return answer(response, Refusal{404, "this file is not there", {}});
  response.set_content_provider(
      size, type, [stream](std::size_t offset, std::size_t length, httplib::DataSink& sink) {
        std::array<char, 1 << 16> block{};
        stream->clear();
        stream->seekg(static_cast<std::streamoff>(offset));
        stream->read(block.data(), static_cast<std::streamsize>(std::min(length, block.size())));
        const auto count = static_cast<std::size_t>(stream->gcount());
        if (count > 0) sink.write(block.data(), count);
        return count > 0;
      });
}

Path splitPath(const std::string& path) {
  Path parts;
  for (std::size_t from = 1; from <= path.size();) {
    const auto slash = std::min(path.find('/', from), path.size());
    parts.push_back(path.substr(from, slash - from));
    from = slash + 1;
  }
  return parts;
}

/// Whether the path is like the pattern; its parts "*" take anything.
bool isLike(const Path& path, const std::vector<std::string_view>& pattern) {
  return std::equal(path.begin(), path.end(), pattern.begin(), pattern.end(),
                    [](const std::string& part, std::string_view wanted) {
                      return wanted == "*" || part == wanted;
                    });
}

/// The announced length of the body, which refusalOf has checked.
std::size_t lengthOf(const Request& request) {
  return request.get_header_value<std::uint64_t>("Content-Length");
}

Answer<std::string> readText(const Request& request, const ContentReader& reader) {
  if (lengthOf(request) > kMaxJson) return refuse(413, "more than 1 MiB", {});
  Connection::current()->allowBody(lengthOf(request));
  std::string text;
  const bool whole = reader([&text](const char* bytes, std::size_t count) {
    text.append(bytes, count);
    return text.size() <= kMaxJson;
  });
  if (!whole) return refuse(400, "the body broke off", {});
  return text;
}

bool receiveFile(const Request& request, const ContentReader& reader, const fs::path& path) {
  Connection::current()->allowBody(lengthOf(request));
  std::ofstream stream(path, std::ios::binary);
  const bool whole = reader([&stream](const char* bytes, std::size_t count) {
    return static_cast<bool>(stream.write(bytes, static_cast<std::streamsize>(count)));
  });
  stream.close();
  return whole && static_cast<bool>(stream);
}

/// A client that may not send what it sends reads the answer only when it has sent it.
void throwAway(const Request& request, const ContentReader& reader) {
  Connection::current()->allowBody(lengthOf(request));
  reader([](const char*, std::size_t) { return true; });
}

Json readJson(const fs::path& path) {
  const auto text = readFile(path, kMaxJson);
  return text ? Json::parse(*text, nullptr, false) : Json();
}

/// What a job's failure is, for a person to whom the file's name and place here mean nothing.
Refusal refusalOfFailure(const JobEnd& end, const fs::path& file) {
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

/// A session's own mesh as the page knows it; null where there is none.
Json meshOf(const fs::path& session) {
  const Json kind = readJson(session / "mesh" / "kind.json");
  if (!kind.is_object()) return {};
  return {{"name", kind.value("name", "")},
          {"kind", kind.value("kind", "")},
          {"report", readJson(session / "mesh" / "report.json")}};
}

/// The folder of a take. `ifa sync` makes none where there is only one.
fs::path takeFolder(const fs::path& plan, int take) {
  const fs::path folder = plan / "out";
  std::error_code code;
  const fs::path own = folder / fmt::format("take-{}", take);
  return take > 1 || fs::is_directory(own, code) ? own : folder;
}

int countTakes(const fs::path& plan) {
  int takes = 0;
  std::error_code code;
  while (takes < kMaxTakesShown && fs::exists(takeFolder(plan, takes + 1) / "motion.json", code)) {
    ++takes;
  }
  return takes;
}

}  // namespace

class Studio::Routes {
 public:
  Routes(StudioSettings settings, std::unique_ptr<SessionStore> store,
         std::map<std::string, CatalogueEntry> catalogue)
      : settings_(std::move(settings)),
        store_(std::move(store)),
        catalogue_(std::move(catalogue)),
        slots_(settings_.jobs, settings_.waitingJobs),
        server_(settings_.limits) {
    gate_.host = settings_.host;
    setUp();
  }

  bool bind() {
    gate_.port = settings_.port == 0 ? server_.bind_to_any_port(settings_.host)
                 : server_.bind_to_port(settings_.host, settings_.port) ? settings_.port
                                                                        : -1;
    if (gate_.port > 0) server_.queueConnections();
    return gate_.port > 0;
  }
  [[nodiscard]] int port() const { return gate_.port; }
  void run() { server_.listen_after_bind(); }
  void stop() {
    stopping_ = true;
    server_.stop();
  }

 private:
  void setUp() {
    server_.new_task_queue = [this] { return new httplib::ThreadPool(settings_.connections); };
    server_.set_default_headers({{"Content-Security-Policy", kContentPolicy},
                                 {"X-Content-Type-Options", "nosniff"},
                                 {"Cross-Origin-Opener-Policy", "same-origin"},
                                 {"Cross-Origin-Resource-Policy", "same-origin"},
                                 {"Referrer-Policy", "no-referrer"},
                                 {"Cache-Control", "no-store"}});
    server_.set_pre_routing_handler([this](const Request& request, Response& response) {
      const auto refusal = refusalOf(request, gate_);
      if (!refusal) return httplib::Server::HandlerResponse::Unhandled;
      answer(response, *refusal);
      return httplib::Server::HandlerResponse::Handled;
    });
    server_.set_exception_handler([](const Request&, Response& response, auto&&...) {
      answer(response, Refusal{500, "the studio made a mistake", {}});
    });
    const auto read = [this](const Request& request, Response& response) {
      get(request, response);
    };
    server_.Get(".*", read);
    const auto write = [this](const Request& request, Response& response,
                              const ContentReader& reader) { take(request, response, reader); };
    server_.Post(".*", write).Put(".*", write).Patch(".*", write).Delete(".*", write);
  }

  void get(const Request& request, Response& response) {
    const auto page = settings_.pages.find(request.path);
    if (page != settings_.pages.end()) {
      // What Vite names by content never changes.
      if (request.path.rfind("/assets/", 0) == 0) {
        response.headers.erase("Cache-Control");
        response.set_header("Cache-Control", "public, max-age=31536000, immutable");
      }
      return response.set_content(page->second.bytes, page->second.type);
    }
    const Path path = splitPath(request.path);
    if (isLike(path, {"api", "objects"})) return answer(response, catalogueJson(catalogue_));
    if (isLike(path, {"api", "sessions", "*"})) return getSession(path[2], response);
    if (isLike(path, {"api", "sessions", "*", "sound.wav"})) return getSound(path[2], response);
    if (isLike(path, {"api", "sessions", "*", "plans", "*", "takes", "*", "*"})) {
      return getTakeFile(path, response);
    }
    if (isLike(path, {"api", "sessions", "*", "mesh", "*"})) return getMeshFile(path, response);
    answer(response, Refusal{404, "there is no such page", {}});
  }

  void take(const Request& request, Response& response, const ContentReader& reader) {
    const Path path = splitPath(request.path);
    const bool post = request.method == "POST";
    if (post && isLike(path, {"api", "sounds"})) return postSound(request, response, reader);
    if (post && isLike(path, {"api", "labels"})) return postLabels(request, response, reader);
    if (request.method == "PUT" && isLike(path, {"api", "sessions", "*", "state"})) {
      return putState(path[2], request, response, reader);
    }
    if (post && isLike(path, {"api", "sessions", "*", "plans"})) {
      return postPlan(path[2], request, response, reader);
    }
    if (post && isLike(path, {"api", "sessions", "*", "plans", "*", "takes", "*", "film"})) {
      return postFilm(path, request, response, reader);
    }
    if (post && isLike(path, {"api", "sessions", "*", "mesh"})) {
      return postMesh(path[2], request, response, reader);
    }
    if (post && isLike(path, {"api", "sessions", "*", "object"})) {
      return postObject(path[2], request, response, reader);
    }
    answer(response, Refusal{404, "there is nothing to send this to", {}});
  }

  void getSession(const std::string& session, Response& response) {
    const auto folder = store_->folder(session);
    if (!folder) return answer(response, folder.error());
    const Json heard = readJson(*folder / "heard.json");
    if (!heard.is_object()) return answer(response, Refusal{404, "this session is not whole", {}});
    answer(response, Json{{"session", session},
                          {"name", readJson(*folder / "name.json")},
                          {"heard", heard},
                          {"mesh", meshOf(*folder)},
                          {"state", readJson(*folder / "state.json")}});
  }

  void getSound(const std::string& session, Response& response) {
    const auto folder = store_->folder(session);
    if (!folder) return answer(response, folder.error());
    answerFile(response, *folder / "sound.wav", "audio/wav");
  }

  void getTakeFile(const Path& path, Response& response) {
    const auto plan = store_->planFolder(path[2], path[4]);
    if (!plan) return answer(response, plan.error());
    const int number = plainNumber(path[6]);
    const auto file = takeFiles().find(path[7]);
    if (number < 1 || number > kMaxTakesShown || file == takeFiles().end()) {
      return answer(response, Refusal{404, "there is no such file", {}});
    }
    const fs::path where = file->first == "film.mp4" ? *plan / fmt::format("film-{}.mp4", number)
                                                     : takeFolder(*plan, number) / file->first;
    answerFile(response, where, file->second);
  }

  void postSound(const Request& request, Response& response, const ContentReader& reader) {
    auto turn = slots_.enter();
    if (!turn.queued()) {
      throwAway(request, reader);
      return answer(response, busy());
    }
    const auto session = store_->create();
    if (!session) return answer(response, session.error());
    const fs::path folder = *store_->folder(*session);
    const fs::path original = folder / "original";
    if (!receiveFile(request, reader, original)) {
      store_->remove(*session);
      return answer(response, Refusal{400, "the sound broke off on its way", "try again"});
    }
    const JobEnd end =
        runQuietly({"studio-hear", original.string(), folder.string(), "--json-progress"}, turn);
    const Json name = request.get_param_value("name").substr(0, kMaxName);
    const bool heard = end.child.code == 0;
    if (!heard || !writeFileAtomically(folder / "name.json", textOf(name))) {
      store_->remove(*session);
      return answer(response, refusalOfFailure(end, original));
    }
    getSession(*session, response);
  }

  /// A job whose progress nobody is told.
  JobEnd runQuietly(std::vector<std::string> arguments, const JobSlots::Turn& turn) {
    const Job job = {settings_.program, std::move(arguments), [this] { return !stopping_; }, {}};
    return runJob(job, turn, [](const std::string&, const Json&) { return true; });
  }

  void getMeshFile(const Path& path, Response& response) {
    const auto folder = store_->folder(path[2]);
    if (!folder) return answer(response, folder.error());
    const auto file = meshFiles().find(path[4]);
    const Json mesh = meshOf(*folder);
    if (file == meshFiles().end() || mesh.is_null()) {
      return answer(response, Refusal{404, "there is no such file", {}});
    }
    const auto kind = meshKind(mesh["kind"]);
    const std::string name = file->first == "upload" ? "upload." + kind.value_or("") : file->first;
    answerFile(response, *folder / "mesh" / name, file->second);
  }

  void postMesh(const std::string& session, const Request& request, Response& response,
                const ContentReader& reader) {
    const auto kind = meshKind(request.get_param_value("kind"));
    if (!kind) return answer(response, Refusal{422, "this is no kind of mesh that is read", {}});
    if (lengthOf(request) > kMaxMeshFile) {
      return answer(response, Refusal{413, "the mesh is larger than 32 MiB", "simplify it"});
    }
    auto turn = slots_.enter();
    if (!turn.queued()) {
      throwAway(request, reader);
      return answer(response, busy());
    }
    const auto draft = store_->createDraft(session);
    if (!draft) return answer(response, draft.error());
    if (const auto refusal = readInto(*draft, *kind, request, reader, turn)) {
      std::error_code ignored;
      fs::remove_all(*draft, ignored);
      return answer(response, *refusal);
    }
    answer(response, meshOf(draft->parent_path()));
  }

  /// Reads the body as a mesh into the draft, which then is the session's mesh.
  std::optional<Refusal> readInto(const fs::path& draft, const std::string& kind,
                                  const Request& request, const ContentReader& reader,
                                  const JobSlots::Turn& turn) {
    const std::string name = "upload." + kind;
    if (!receiveFile(request, reader, draft / name)) {
      return Refusal{400, "the mesh broke off on its way", "try again"};
    }
    const JobEnd end = runQuietly(
        {"studio-mesh", (draft / name).string(), draft.string(), "--json-progress"}, turn);
    if (end.child.code != 0) return refusalOfFailure(end, draft / name);
    const Json told = {{"name", request.get_param_value("name").substr(0, kMaxName)},
                       {"kind", kind}};
    if (writeFileAtomically(draft / "kind.json", textOf(told)) &&
        store_->keepDraft(draft, "mesh")) {
      return std::nullopt;
    }
    return Refusal{507, "the mesh cannot be written", "is the disk full?"};
  }

  void postObject(const std::string& session, const Request& request, Response& response,
                  const ContentReader& reader) {
    const auto folder = store_->folder(session);
    if (!folder) return answer(response, folder.error());
    const auto text = readText(request, reader);
    if (!text) return answer(response, text.error());
    const auto wanted = parseOwnObject(*text);
    if (!wanted) return answer(response, wanted.error());
    if (meshOf(*folder).is_null()) {
      return answer(response, Refusal{404, "there is no mesh", "drop one first"});
    }
    auto turn = slots_.enter();
    if (!turn.queued()) return answer(response, busy());
    const JobEnd end = runQuietly(objectsArguments(*wanted, *folder / "mesh"), turn);
    if (end.child.code != 0)
      return answer(response, refusalOfFailure(end, *folder / "mesh" / "mesh.obj"));
    answer(response, Json::object());
  }

  /// The library, and the session's own object where it has one.
  [[nodiscard]] std::map<std::string, CatalogueEntry> objectsOf(const fs::path& session) const {
    auto objects = catalogue_;
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

  static void postLabels(const Request& request, Response& response, const ContentReader& reader) {
    const auto text = readText(request, reader);
    if (!text) return answer(response, text.error());
    const auto labels = parseLabels(*text, "line");
    if (!labels) {
      const Error& error = labels.error();
      return answer(response, Refusal{422, error.place + ": " + error.message, error.remedy});
    }
    auto marks = Json::array();
    for (const Label& label : *labels)
      marks.push_back({{"start", label.start}, {"end", label.end}});
    answer(response, Json{{"marks", marks}, {"terminal", labelsAreTerminal(*labels)}});
  }

  void putState(const std::string& session, const Request& request, Response& response,
                const ContentReader& reader) {
    const auto folder = store_->folder(session);
    if (!folder) return answer(response, folder.error());
    const auto text = readText(request, reader);
    if (!text) return answer(response, text.error());
    if (!Json::accept(*text)) return answer(response, Refusal{400, "this is no JSON", {}});
    if (const auto written = writeFileAtomically(*folder / "state.json", *text); !written) {
      return answer(response, Refusal{507, "the state cannot be written", "is the disk full?"});
    }
    answer(response, Json::object());
  }

  void postPlan(const std::string& session, const Request& request, Response& response,
                const ContentReader& reader) {
    const auto folder = store_->folder(session);
    if (!folder) return answer(response, folder.error());
    const auto text = readText(request, reader);
    if (!text) return answer(response, text.error());
    const auto wanted = parsePlanRequest(*text, objectsOf(*folder));
    if (!wanted) return answer(response, wanted.error());
    auto turn = std::make_shared<JobSlots::Turn>(slots_.enter());
    if (!turn->queued()) return answer(response, busy());
    const auto plan = store_->createPlan(session);
    if (!plan) return answer(response, plan.error());
    const fs::path where = *store_->planFolder(session, std::to_string(*plan));
    if (!writeFileAtomically(where / "marks.csv", marksTable(*wanted))) {
      return answer(response, Refusal{507, "the marks cannot be written", "is the disk full?"});
    }
    Job job;
    job.program = settings_.program;
    job.arguments =
        syncArguments(*wanted, *folder / "sound.wav", where / "marks.csv", where / "out");
    job.goOn = [this] { return !stopping_; };
    job.finish = [this, session, where, number = *plan](const JobEnd& end) {
      return finishPlan(session, where, number, end);
    };
    answerWithEvents(response, std::move(job), std::move(turn));
  }

  Json finishPlan(const std::string& session, const fs::path& where, int plan, const JobEnd& end) {
    const bool ended =
        end.child.kind == ChildEnd::Kind::kExited &&
        (end.child.code == 0 || end.child.code == static_cast<int>(ErrorCode::kNoMotion));
    const int takes = ended ? countTakes(where) : 0;
    if (takes == 0) {
      store_->removePlan(session, plan);
      return failureOf(end);
    }
    store_->keepPlansUpTo(session, plan);
    return {{"plan", plan}, {"takes", takes}, {"failure", end.failure}};
  }

  void postFilm(const Path& path, const Request& request, Response& response,
                const ContentReader& reader) {
    const auto plan = store_->planFolder(path[2], path[4]);
    if (!plan) return answer(response, plan.error());
    const auto text = readText(request, reader);
    if (!text) return answer(response, text.error());
    const Json json = Json::parse(*text, nullptr, false);
    const int number = plainNumber(path[6]);
    if (!json.is_object() || number < 1 || number > countTakes(*plan)) {
      return answer(response, Refusal{404, "there is no such take", {}});
    }
    auto turn = std::make_shared<JobSlots::Turn>(slots_.enter());
    if (!turn->queued()) return answer(response, busy());
    Job job;
    job.program = settings_.program;
    job.arguments = {"render",
                     takeFolder(*plan, number).string(),
                     "--json-progress",
                     "--quality",
                     json.value("final", Json()) == true ? "final" : "draft",
                     "-o",
                     (*plan / fmt::format("film-{}.mp4", number)).string()};
    if (json.value("overlay", Json()) == true) job.arguments.emplace_back("--overlay");
    job.goOn = [this] { return !stopping_; };
    job.finish = [](const JobEnd& end) {
      return end.child.code == 0 ? Json::object() : failureOf(end);
    };
    answerWithEvents(response, std::move(job), std::move(turn));
  }

  static std::string textOf(const Json& json) {
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
  }
  static Refusal busy() {
    return {503, "the studio has too much to do", "wait until other jobs are done"};
  }

  StudioSettings settings_;
  std::unique_ptr<SessionStore> store_;
  std::map<std::string, CatalogueEntry> catalogue_;
  JobSlots slots_;
  Gate gate_;
  std::atomic<bool> stopping_{false};
  BoundedServer server_;
};

Studio::Studio(std::unique_ptr<Routes> routes) : routes_(std::move(routes)) {}
Studio::~Studio() = default;

Result<std::unique_ptr<Studio>> Studio::open(StudioSettings settings) {
  auto store = SessionStore::open(settings.folder);
  if (!store) return tl::unexpected(store.error());
  auto catalogue = readCatalogue();
  if (!catalogue) return tl::unexpected(catalogue.error());
  const std::string place = fmt::format("{}:{}", settings.host, settings.port);
  auto routes =
      std::make_unique<Routes>(std::move(settings), std::move(*store), std::move(*catalogue));
  if (!routes->bind()) {
    return badInput("cannot be listened at; another program may have the port", place,
                    "choose another one with --port");
  }
  return std::unique_ptr<Studio>(new Studio(std::move(routes)));
}

int Studio::port() const { return routes_->port(); }
void Studio::run() { routes_->run(); }
void Studio::stop() { routes_->stop(); }

}  // namespace ifa::studio
