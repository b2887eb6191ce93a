// SPDX-License-Identifier: Apache-2.0
// `ifa studio`: the local web studio. And `ifa studio-hear` and `ifa studio-mesh`, which the studio
// runs for each sound and mesh that it is given.
#include <fmt/core.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <memory>
#include <thread>

#include "base/paths.h"
#include "command.h"
#include "studio/hear_sound.h"
#include "studio/pages.h"
#include "studio/read_mesh.h"
#include "studio/studio.h"

namespace ifa::cli {

namespace fs = std::filesystem;

namespace {

constexpr int kUsualPort = 4610;

struct StudioOptions {
  std::string host = "127.0.0.1";
  int port = -1;
  bool open = false;
  fs::path folder;
};

struct JobOptions {
  fs::path file, folder;
};

// The desktop's own browser; where there is none, the address that was printed has to do.
void openBrowser(const std::string& address) {
  const pid_t child = ::fork();
  if (child != 0) return;
  ::execlp("xdg-open", "xdg-open", address.c_str(), static_cast<char*>(nullptr));
  ::_exit(127);
}

Result<std::unique_ptr<studio::Studio>> openStudio(const StudioOptions& options) {
  auto pages = studio::readPages(studio::pagesFolder());
  if (!pages) return tl::unexpected(pages.error());
  studio::StudioSettings settings;
  settings.host = options.host;
  settings.folder = options.folder.empty() ? cacheFolder() / "studio" : options.folder;
  settings.pages = std::move(*pages);
  settings.port = options.port < 0 ? kUsualPort : options.port;
  auto opened = studio::Studio::open(settings);
  if (opened || options.port >= 0) return opened;
  settings.port = 0;  // nobody asked for the usual one
  return studio::Studio::open(settings);
}

std::string addressOf(const std::string& host, int port) {
  const bool six = host.find(':') != std::string::npos;
  return fmt::format("http://{}:{}/", six ? "[" + host + "]" : host, port);
}

bool isLoopback(const std::string& host) {
  return host == "localhost" || host == "::1" || host.rfind("127.", 0) == 0;
}

int runStudio(const StudioOptions& options, CommandContext& context) {
  auto opened = openStudio(options);
  if (!opened) return context.fail(opened.error());
  studio::Studio& server = **opened;
  if (!isLoopback(options.host)) {
    context.console.warn("whoever reaches this machine's port " + std::to_string(server.port()) +
                         " can use the studio; nothing is encrypted");
  }
  const std::string address = addressOf(options.host, server.port());
  context.console.result("The studio is at " + address + " (Ctrl+C ends it)");
  ::signal(SIGPIPE, SIG_IGN);
  if (options.open) openBrowser(address);
  std::thread watcher([&] {
    while (!context.progress.stopRequested()) {
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
    server.stop();
  });
  server.run();
  watcher.join();
  return context.succeed();
}

/// A job of the studio's own, which is not in the help.
void addJob(CLI::App& app, CommandContext& context, const char* name, const char* what,
            Result<void> (*work)(const fs::path& file, const fs::path& folder)) {
  auto options = std::make_shared<JobOptions>();
  CLI::App* job = app.add_subcommand(name, what);
  job->group("");
  job->add_option("FILE", options->file)->required();
  job->add_option("FOLDER", options->folder)->required();
  job->callback([options, work, &context] {
    context.action = [options, work, &context] {
      const auto done = work(options->file, options->folder);
      return done ? context.succeed() : context.fail(done.error());
    };
  });
}

}  // namespace

void addStudioCommands(CLI::App& app, CommandContext& context) {
  auto options = std::make_shared<StudioOptions>();
  CLI::App* command = app.add_subcommand("studio", "mark, plan and watch in a browser");
  command->add_option("--port", options->port, "port to listen at; 0: any (default: 4610)")
      ->check(CLI::Range(0, 65535));
  command->add_option("--host", options->host, "address to listen at")->capture_default_str();
  command->add_flag("--open", options->open, "open it in the browser");
  command->add_option("--folder", options->folder,
                      "where sounds and motions are kept (default: in the cache)");
  command->callback([options, &context] {
    context.action = [options, &context] { return runStudio(*options, context); };
  });
  addJob(app, context, "studio-hear", "a sound for the studio's page", studio::hearSound);
  addJob(app, context, "studio-mesh", "a mesh for the studio's page", studio::readMesh);
}

}  // namespace ifa::cli
