// SPDX-License-Identifier: Apache-2.0
// A studio that runs, with a page of its own, and who asks it.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "base/sanitized.h"
#include "raw_client.h"
#include "studio/studio.h"
#include "support/clicks.h"
#include "support/temporary_folder.h"

namespace ifa::studio {

constexpr const char* kBytes = "application/octet-stream";
constexpr const char* kJson = "application/json";

/// Of this process; 0 under sanitisers, which keep what was freed.
inline std::size_t residentBytes() {
#ifdef IFA_SANITIZED
  return 0;
#else
  std::ifstream stream("/proc/self/statm");
  std::size_t total = 0, resident = 0;
  stream >> total >> resident;
  return resident * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
#endif
}

class StudioTest : public testing::Test {
 protected:
  StudioTest() {
    limits_.headTime = std::chrono::milliseconds(700);
    limits_.lingerTime = std::chrono::milliseconds(300);
  }
  void SetUp() override {
    StudioSettings settings;
    settings.folder = folder_ / "studio";
    settings.program = IFA_PROGRAM;
    settings.pages = pages_;
    settings.limits = limits_;
    auto opened = Studio::open(std::move(settings));
    ASSERT_TRUE(opened) << opened.error().text();
    studio_ = std::move(*opened);
    thread_ = std::thread([this] { studio_->run(); });
  }
  void TearDown() override {
    if (!studio_) return;
    studio_->stop();
    thread_.join();
  }

  [[nodiscard]] int port() const { return studio_->port(); }
  [[nodiscard]] httplib::Client client() const {
    httplib::Client made("127.0.0.1", port());
    made.set_read_timeout(60);
    return made;
  }
  [[nodiscard]] std::string head(const std::string& line, const std::string& headers = {}) const {
    return fmt::format("{} HTTP/1.1\r\nHost: 127.0.0.1:{}\r\n{}\r\n", line, port(), headers);
  }
  [[nodiscard]] std::string ask(const std::string& bytes) const {
    test::RawClient raw(port());
    raw.send(bytes);
    return raw.receive();
  }
  [[nodiscard]] bool answers() const { return client().Get("/")->status == 200; }
  /// Names of all that lies in and beside the studio's folder.
  [[nodiscard]] std::vector<std::string> files() const { return folder_.names(); }

  std::string clicks() {
    test::writeClicks(folder_ / "clicks.wav", {{0.3, 1}, {0.55, 0.5}, {0.7, 0.3}}, 1.2);
    std::string bytes = test::readText(folder_ / "clicks.wav");
    std::filesystem::remove(folder_ / "clicks.wav");
    return bytes;
  }
  nlohmann::json openSound() {
    const auto answer = client().Post("/api/sounds?name=throw.wav", clicks(), kBytes);
    EXPECT_TRUE(answer && answer->status == 200) << (answer ? answer->body : "no answer");
    return answer ? nlohmann::json::parse(answer->body) : nlohmann::json();
  }

  ConnectionLimits limits_;
  Pages pages_ = {{"/", {"<!doctype html>", "text/html"}},
                  {"/assets/a.js", {"1", "text/javascript"}}};
  test::TemporaryFolder folder_;
  std::unique_ptr<Studio> studio_;
  std::thread thread_;
};

}  // namespace ifa::studio
