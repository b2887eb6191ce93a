// SPDX-License-Identifier: Apache-2.0
#include "studio/studio.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <vector>

#include "studio/catalogue.h"
#include "studio/exchange.h"
#include "studio/guard.h"
#include "studio/mesh_routes.h"
#include "studio/plan_routes.h"
#include "studio/session_routes.h"
#include "studio/workshop.h"

namespace ifa::studio {

namespace {

using httplib::ContentReader;
using httplib::Request;
using httplib::Response;

/// What a page may load: itself. Styles are set by script on elements, hence 'unsafe-inline' there.
constexpr const char* kContentPolicy =
    "default-src 'none'; script-src 'self'; style-src 'self' 'unsafe-inline'; img-src 'self' blob: "
    "data:; media-src 'self' blob:; connect-src 'self' blob:; font-src 'self'; base-uri 'none'; "
    "form-action 'none'; frame-ancestors 'none'";

void getObjects(Workshop& workshop, Exchange& exchange) {
  exchange.answer(catalogueJson(workshop.catalogue));
}

struct Route {
  std::string_view method;
  std::vector<std::string_view> pattern;  ///< its parts "*" take anything
  void (*handle)(Workshop&, Exchange&);
};

const std::vector<Route>& routes() {
  static const std::vector<Route> kRoutes = {
      {"GET", {"api", "objects"}, getObjects},
      {"POST", {"api", "sounds"}, postSound},
      {"POST", {"api", "labels"}, postLabels},
      {"GET", {"api", "sessions", "*"}, getSession},
      {"GET", {"api", "sessions", "*", "sound.wav"}, getSound},
      {"PUT", {"api", "sessions", "*", "state"}, putState},
      {"POST", {"api", "sessions", "*", "mesh"}, postMesh},
      {"GET", {"api", "sessions", "*", "mesh", "*"}, getMeshFile},
      {"POST", {"api", "sessions", "*", "object"}, postObject},
      {"POST", {"api", "sessions", "*", "plans"}, postPlan},
      {"POST", {"api", "sessions", "*", "plans", "*", "takes", "*", "film"}, postFilm},
      {"GET", {"api", "sessions", "*", "plans", "*", "takes", "*", "*"}, getTakeFile}};
  return kRoutes;
}

bool leads(const Route& route, const Exchange& exchange) {
  const auto& path = exchange.path();
  // HEAD asks for the head of what GET gives.
  const std::string_view asked = exchange.method();
  const std::string_view method = asked == "HEAD" ? "GET" : asked;
  return route.method == method &&
         std::equal(path.begin(), path.end(), route.pattern.begin(), route.pattern.end(),
                    [](const std::string& part, std::string_view wanted) {
                      return wanted == "*" || part == wanted;
                    });
}

}  // namespace

class Studio::Server {
 public:
  Server(StudioSettings settings, std::unique_ptr<SessionStore> store,
         std::map<std::string, CatalogueEntry> catalogue)
      : settings_(std::move(settings)),
        workshop_{std::move(store), std::move(catalogue), settings_.program,
                  JobSlots(settings_.jobs, settings_.waitingJobs)},
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
    workshop_.stopping = true;
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
      Exchange(request, response, nullptr).answer(*refusal);
      return httplib::Server::HandlerResponse::Handled;
    });
    server_.set_exception_handler([](const Request& request, Response& response, auto&&...) {
      Exchange(request, response, nullptr).answer(Refusal{500, "the studio made a mistake", {}});
    });
    server_.Get(".*", [this](const Request& request, Response& response) {
      if (!answerWithPage(request, response)) answer(Exchange(request, response, nullptr));
    });
    const auto write = [this](const Request& request, Response& response,
                              const ContentReader& reader) {
      answer(Exchange(request, response, &reader));
    };
    server_.Post(".*", write).Put(".*", write).Patch(".*", write).Delete(".*", write);
  }

  bool answerWithPage(const Request& request, Response& response) const {
    const auto page = settings_.pages.find(request.path);
    if (page == settings_.pages.end()) return false;
    // What Vite names by content never changes.
    if (request.path.rfind("/assets/", 0) == 0) {
      response.headers.erase("Cache-Control");
      response.set_header("Cache-Control", "public, max-age=31536000, immutable");
    }
    response.set_content(page->second.bytes, page->second.type);
    return true;
  }

  void answer(Exchange exchange) {
    const auto route = std::find_if(routes().begin(), routes().end(),
                                    [&](const Route& one) { return leads(one, exchange); });
    if (route == routes().end()) return exchange.answer(Refusal{404, "there is nothing here", {}});
    route->handle(workshop_, exchange);
  }

  StudioSettings settings_;
  Workshop workshop_;
  Gate gate_;
  BoundedServer server_;
};

Studio::Studio(std::unique_ptr<Server> server) : server_(std::move(server)) {}
Studio::~Studio() = default;

Result<std::unique_ptr<Studio>> Studio::open(StudioSettings settings) {
  auto store = SessionStore::open(settings.folder);
  if (!store) return tl::unexpected(store.error());
  auto catalogue = readCatalogue();
  if (!catalogue) return tl::unexpected(catalogue.error());
  const std::string place = fmt::format("{}:{}", settings.host, settings.port);
  auto server =
      std::make_unique<Server>(std::move(settings), std::move(*store), std::move(*catalogue));
  if (!server->bind()) {
    return badInput("cannot be listened at; another program may have the port", place,
                    "choose another one with --port");
  }
  return std::unique_ptr<Studio>(new Studio(std::move(server)));
}

int Studio::port() const { return server_->port(); }
void Studio::run() { server_->run(); }
void Studio::stop() { server_->stop(); }

}  // namespace ifa::studio
