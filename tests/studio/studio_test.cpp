// SPDX-License-Identifier: Apache-2.0
// The studio attacked as an outsider would, and used as its page does (docs/security.md).
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <future>
#include <nlohmann/json.hpp>
#include <thread>

#include "raw_client.h"
#include "studio_fixture.h"
#include "support/temporary_folder.h"

namespace ifa::studio {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;
using test::RawClient;
using test::statusOf;
using testing::HasSubstr;

TEST_F(StudioTest, ServesItsPageUnderAStrictPolicy) {
  const auto page = client().Get("/");
  ASSERT_TRUE(page);
  EXPECT_EQ(page->status, 200);
  EXPECT_THAT(page->get_header_value("Content-Security-Policy"), HasSubstr("script-src 'self';"));
  EXPECT_THAT(page->get_header_value("Content-Security-Policy"),
              HasSubstr("frame-ancestors 'none'"));
  EXPECT_EQ(page->get_header_value("X-Content-Type-Options"), "nosniff");
  EXPECT_FALSE(page->has_header("Access-Control-Allow-Origin"));
  EXPECT_EQ(Json::parse(client().Get("/api/objects")->body).size() > 30, true);
}

TEST_F(StudioTest, RefusesForeignPages) {
  EXPECT_EQ(statusOf(ask("GET / HTTP/1.1\r\nHost: evil.example\r\n\r\n")), 403);
  EXPECT_EQ(statusOf(ask("GET / HTTP/1.1\r\n\r\n")), 403);
  const std::string foreign =
      "Origin: http://evil.example\r\nContent-Type: application/octet-stream\r\nContent-Length: "
      "4\r\n";
  EXPECT_EQ(statusOf(ask(head("POST /api/sounds", foreign) + "RIFF")), 403);
  EXPECT_EQ(statusOf(ask(head("OPTIONS /api/sounds", "Origin: http://evil.example\r\n"))), 403);
  EXPECT_TRUE(answers());
}

// What a refused request has for a body must not be read as the next request.
TEST_F(StudioTest, ABodyIsNeverTheNextRequest) {
  const std::string hidden = head("GET /api/objects");
  const std::string answer = ask(
      head("POST /api/sounds",
           fmt::format(
               "Origin: http://evil.example\r\nContent-Type: text/plain\r\nContent-Length: {}\r\n",
               hidden.size())) +
      hidden);
  EXPECT_EQ(statusOf(answer), 403);
  EXPECT_EQ(answer.find("HTTP/1.1", 1), std::string::npos);
}

TEST_F(StudioTest, NoPathLeadsOut) {
  test::writeText(folder_ / "secret.txt", "secret");
  const std::string session = openSound()["session"];
  for (const std::string& path :
       {std::string("/../secret.txt"), std::string("/..%2f..%2fsecret.txt"),
        std::string("/assets/../../secret.txt"), std::string("/assets/%2e%2e/%2e%2e/etc/passwd"),
        std::string("//etc/passwd"), std::string("/api/sessions/.."),
        std::string("/api/sessions/..%2f..%2fsecret.txt"),
        "/api/sessions/" + session + "/../../secret.txt",
        "/api/sessions/" + session + "/plans/1/takes/1/..%2f..%2fsound.wav",
        "/api/sessions/" + session + "/plans/..%2f/takes/1/motion.json",
        "/api/sessions/" + session + "%00/sound.wav", "/api/sessions/" + session + "/original",
        "/api/sessions/" + session + "/state.json"}) {
    const std::string answer = ask(head("GET " + path));
    EXPECT_GE(statusOf(answer), 400) << path;
    EXPECT_EQ(answer.find("secret\n"), std::string::npos) << path;
  }
  const auto before = files();
  const std::string headers = "Content-Type: application/json\r\nContent-Length: 2\r\n";
  EXPECT_EQ(statusOf(ask(head("PUT /api/sessions/..%2f..%2fx/state", headers) + "{}")), 404);
  EXPECT_EQ(statusOf(ask(head("PUT /api/sessions/../state", headers) + "{}")), 404);
  EXPECT_EQ(files(), before);
}

TEST_F(StudioTest, WhatIsTooLargeIsRefusedBeforeItIsRead) {
  const std::size_t before = residentBytes();
  const std::string headers =
      "Content-Type: application/octet-stream\r\nContent-Length: 2147483648\r\n";
  RawClient raw(port());
  raw.send(head("POST /api/sounds", headers));
  const std::string block(1 << 20, 'x');
  std::size_t sent = 0;
  while (sent < (64U << 20) && raw.send(block)) sent += block.size();
  EXPECT_LT(sent, 64U << 20);  // it has closed the connection long before
  EXPECT_LT(residentBytes(), before + (32U << 20));
  EXPECT_EQ(statusOf(ask(head("POST /api/sounds", headers))), 413);
  EXPECT_EQ(statusOf(ask(head("POST /api/labels",
                              "Content-Type: application/json\r\nContent-Length: 1048577\r\n"))),
            413);
  EXPECT_TRUE(answers());
}

TEST_F(StudioTest, EndlessHeadersAndEndlessBodiesEnd) {
  const std::size_t before = residentBytes();
  RawClient raw(port());
  raw.send(fmt::format("GET / HTTP/1.1\r\nHost: 127.0.0.1:{}\r\n", port()));
  const std::string line = "X-Much: " + std::string(1000, 'x') + "\r\n";
  std::size_t sent = 0;
  while (sent < (16U << 20) && raw.send(line)) sent += line.size();
  EXPECT_LT(sent, 16U << 20);
  EXPECT_EQ(statusOf(ask(head("POST /api/nothing",
                              "Transfer-Encoding: chunked\r\nContent-Type: application/json\r\n") +
                         "ffffff\r\n")),
            411);
  EXPECT_LT(residentBytes(), before + (16U << 20));
  EXPECT_TRUE(answers());
}

TEST_F(StudioTest, ASlowClientIsGivenUp) {
  RawClient raw(port());
  raw.send("GET / HT");
  const auto start = std::chrono::steady_clock::now();
  while (std::chrono::steady_clock::now() - start < std::chrono::milliseconds(1200)) {
    if (!raw.send("X")) break;
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  raw.receive({}, 3);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(3));
  EXPECT_TRUE(answers());
}

class SlowClientTest : public StudioTest {
 protected:
  SlowClientTest() {
    limits_.bodyTime = std::chrono::milliseconds(800);
    limits_.writeTime = std::chrono::milliseconds(500);
    pages_["/assets/large.js"] = {std::string(kLarge, ' '), "text/javascript"};
  }
  /// More than a connection holds that nobody reads.
  static constexpr std::size_t kLarge = 32U << 20;
};

TEST_F(SlowClientTest, WhoSendsABodyByBytesIsGivenUp) {
  const auto before = files();
  RawClient raw(port());
  raw.send(head("POST /api/sounds",
                "Content-Type: application/octet-stream\r\nContent-Length: 100000\r\n"));
  const auto start = std::chrono::steady_clock::now();
  while (std::chrono::steady_clock::now() - start < std::chrono::seconds(20)) {
    if (!raw.send("X")) break;
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(15));
  EXPECT_TRUE(answers());
  EXPECT_EQ(files(), before);
}

TEST_F(SlowClientTest, WhoDoesNotReadTheAnswerIsGivenUp) {
  RawClient raw(port());
  raw.send(head("GET /assets/large.js"));
  std::this_thread::sleep_for(std::chrono::milliseconds(2500));
  EXPECT_LT(raw.receive({}, 20).size(), kLarge);
  EXPECT_TRUE(answers());
}

TEST_F(StudioTest, GarbageIsNoRequest) {
  for (const std::string& bytes :
       {std::string(), std::string(1, '\0'), std::string("\r\n\r\n"), std::string("GET\r\n\r\n"),
        std::string("\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03", 11),
        std::string(10000, 'A') + "\r\n\r\n", head("BREW /coffee"),
        head("GET /" + std::string(9000, 'a')), head("GET /%zz%"),
        head("GET /", "Range: bytes=0-0,0-0,0-0,0-0\r\n"), head("GET /", "Range: bytes=-\r\n"),
        head("GET /", "Range: bytes=99999999999999999999-\r\n"),
        head("POST /api/sounds",
             "Content-Type: multipart/form-data; boundary=\r\nContent-Length: 9\r\n") +
            "--\r\n\r\n--x",
        head("POST /api/sounds", "Content-Type: multipart/form-data\r\nContent-Length: 3\r\n") +
            "abc"}) {
    RawClient raw(port());
    raw.send(bytes);
    ::testing::Test::RecordProperty("bytes", static_cast<int>(bytes.size()));
    const int status = statusOf(raw.receive({}, 3));
    EXPECT_NE(status, 200) << bytes.substr(0, 60) << " gave " << status;
  }
  EXPECT_TRUE(answers());
}

/// A WAV file with that format (1: whole numbers, 3: floating point) and these bytes as samples.
std::string wav(std::size_t format, std::size_t channels, std::size_t rate, std::size_t bits,
                const std::string& data) {
  const auto number = [](std::size_t value, int bytes) {
    std::string text;
    for (int i = 0; i < bytes; ++i) text += static_cast<char>(value >> (8 * i) & 0xff);
    return text;
  };
  const std::size_t frame = channels * bits / 8;
  return "RIFF" + number(36 + data.size(), 4) + "WAVEfmt " + number(16, 4) + number(format, 2) +
         number(channels, 2) + number(rate, 4) + number(rate * frame, 4) + number(frame, 2) +
         number(bits, 2) + "data" + number(data.size(), 4) + data;
}

TEST_F(StudioTest, SoundsThatAreNoneLeaveNothing) {
  const auto before = files();
  std::string cut = clicks().substr(0, 60);
  for (const std::string& bytes :
       {std::string("nonsense"), std::string(), std::string(1000, '\xff'), cut,
        std::string("RIFF\xff\xff\xff\xffWAVEfmt \xff\xff\xff\xff", 20),
        std::string("OggS") + std::string(100, '\0'), std::string("fLaC") + std::string(100, '\1'),
        wav(3, 1, 44100, 32, std::string(40000, '\xff')),  // none of its samples is a number
        wav(1, 1, 44100, 16, std::string(80000, '\0')),    // silence
        wav(1, 1, 44100, 16, ""), wav(1, 0, 44100, 16, std::string(1000, '\1')),
        wav(1, 60000, 44100, 16, std::string(200000, '\1')),
        wav(1, 1, 0, 16, std::string(1000, '\1')),
        wav(1, 1, 2000000000, 8, std::string(1000, '\1')),
        wav(1, 1, 1, 8, std::string(100000, '\1'))}) {
    const auto answer = client().Post("/api/sounds", bytes, kBytes);
    ASSERT_TRUE(answer);
    EXPECT_EQ(answer->status, 422) << answer->body;
    const Json told = Json::parse(answer->body);
    EXPECT_FALSE(told["message"].get<std::string>().empty());
    EXPECT_THAT(answer->body, testing::Not(HasSubstr(folder_.path().string())));
  }
  EXPECT_EQ(files(), before);
}

// A page sends no file name that could be trusted: the kind of a sound is told by its bytes.
TEST_F(StudioTest, TakesEveryKindOfSound) {
  const fs::path wav = folder_ / "kind.wav", other = folder_ / "kind.other";
  test::writeText(wav, clicks());
  for (const int format : {SF_FORMAT_FLAC | SF_FORMAT_PCM_16, SF_FORMAT_OGG | SF_FORMAT_VORBIS,
                           SF_FORMAT_MPEG | SF_FORMAT_MPEG_LAYER_III}) {
    SF_INFO info{};
    SNDFILE* from = sf_open(wav.c_str(), SFM_READ, &info);
    std::vector<float> samples(static_cast<std::size_t>(info.frames));
    sf_readf_float(from, samples.data(), info.frames);
    sf_close(from);
    info.format = format;
    SNDFILE* to = sf_open(other.c_str(), SFM_WRITE, &info);
    ASSERT_NE(to, nullptr) << format;
    sf_writef_float(to, samples.data(), static_cast<sf_count_t>(samples.size()));
    sf_close(to);
    const auto answer = client().Post("/api/sounds", test::readText(other), kBytes);
    ASSERT_TRUE(answer);
    ASSERT_EQ(answer->status, 200) << format << answer->body;
    const Json heard = Json::parse(answer->body)["heard"];
    EXPECT_GE(heard["contacts"].size(), 3U) << format;
    EXPECT_NEAR(heard["duration"].get<double>(), 1.2, 0.08) << format;
  }
}

TEST_F(StudioTest, ASessionComesBack) {
  const Json opened = openSound();
  const std::string path = "/api/sessions/" + opened["session"].get<std::string>();
  EXPECT_EQ(opened["name"], "throw.wav");
  ASSERT_EQ(opened["heard"]["contacts"].size(), 3U);
  EXPECT_NEAR(opened["heard"]["contacts"][1]["start"].get<double>(), 0.55, 0.001);
  const std::string state = R"({"version":1,"object":"d6"})";
  EXPECT_EQ(client().Put((path + "/state").c_str(), state, kJson)->status, 200);
  EXPECT_EQ(client().Put((path + "/state").c_str(), "{", kJson)->status, 400);
  const Json again = Json::parse(client().Get(path.c_str())->body);
  EXPECT_EQ(again["state"], Json::parse(state));
  EXPECT_EQ(again["heard"], opened["heard"]);
  EXPECT_EQ(client().Get((path + "/sound.wav").c_str())->body.substr(0, 4), "RIFF");
}

// Good JSON, which what writes it again would not survive.
TEST_F(StudioTest, AStateThatNestsWithoutEndIsRefused) {
  const std::string path = "/api/sessions/" + openSound()["session"].get<std::string>();
  const std::string deep = std::string(500000, '[') + std::string(500000, ']');
  EXPECT_EQ(client().Put((path + "/state").c_str(), deep, kJson)->status, 422);
  const auto session = client().Get(path.c_str());
  ASSERT_TRUE(session);
  EXPECT_TRUE(Json::parse(session->body)["state"].is_null());
}

TEST_F(StudioTest, ReadsLabelsAsTheProgramDoes) {
  const auto good = client().Post("/api/labels", "0,5\t0,5\tc1\n0.7\t0.9\tnon-terminal\n", kBytes);
  ASSERT_EQ(good->status, 200);
  EXPECT_EQ(Json::parse(good->body),
            Json::parse(
                R"({"marks":[{"start":0.5,"end":0.5},{"start":0.7,"end":0.9}],"terminal":false})"));
  const auto bad = client().Post("/api/labels", "0.5\tx\n\xff", kBytes);
  EXPECT_EQ(bad->status, 422);
}

TEST_F(StudioTest, PlansAndGivesTheFiles) {
  const std::string path = "/api/sessions/" + openSound()["session"].get<std::string>();
  const std::string wanted =
      R"({"marks":[{"start":0.3},{"start":0.55},{"start":0.7}],"object":"d6","takes":2,"terminal":false})";
  const auto planned = client().Post((path + "/plans").c_str(), wanted, kJson);
  ASSERT_TRUE(planned);
  ASSERT_EQ(planned->status, 200) << planned->body;
  EXPECT_EQ(planned->get_header_value("Content-Type"), "text/event-stream");
  EXPECT_THAT(planned->body, HasSubstr("event: progress\ndata: {"));
  ASSERT_THAT(planned->body, HasSubstr("event: done\n"));
  const std::string take = path + "/plans/1/takes/1/";
  const Json motion = Json::parse(client().Get((take + "motion.json").c_str())->body);
  EXPECT_EQ(motion["success"], true);
  EXPECT_EQ(motion["contacts"].size(), 3U);
  EXPECT_EQ(client().Get((take + "motion.glb").c_str())->body.substr(0, 4), "glTF");
  for (const char* file : {"motion.usda", "motion.csv", "sound.wav"}) {
    EXPECT_EQ(client().Get((take + file).c_str())->status, 200) << file;
  }
  EXPECT_EQ(client().Get((take + "film.mp4").c_str())->status, 404);
  EXPECT_EQ(client().Get((take + "d6.json").c_str())->status, 404);
  EXPECT_EQ(client().Get((path + "/plans/1/takes/9/motion.json").c_str())->status, 404);
}

TEST_F(StudioTest, AWrongPlanIsRefusedWithTheField) {
  const std::string path = "/api/sessions/" + openSound()["session"].get<std::string>() + "/plans";
  const auto refused =
      client().Post(path.c_str(), R"({"marks":[{"start":-1}],"object":"d6"})", kJson);
  EXPECT_EQ(refused->status, 422);
  EXPECT_THAT(refused->body, HasSubstr("contact 1: start"));
  EXPECT_EQ(client().Post(path.c_str(), std::string(500000, '['), kJson)->status, 400);
}

// A plan that would take long ends when its page goes: its folder is gone, and so is the process.
TEST_F(StudioTest, AJobEndsWithItsPage) {
  const std::string session = openSound()["session"];
  std::string marks;
  for (int i = 0; i < 50; ++i)
    marks += fmt::format(R"({}{{"start":{:.3f}}})", i > 0 ? "," : "", 0.3 + 0.017 * i);
  const std::string wanted =
      R"({"marks":[)" + marks + R"(],"object":"Mug","takes":6,"timeLimit":60})";
  {
    RawClient raw(port());
    raw.send(head("POST /api/sessions/" + session + "/plans",
                  fmt::format("Content-Type: application/json\r\nContent-Length: {}\r\n",
                              wanted.size())) +
             wanted);
    EXPECT_THAT(raw.receive("event: progress"), HasSubstr("200 OK"));
    EXPECT_TRUE(fs::exists(folder_ / ("studio/" + session + "/plan-1")));
  }
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(5);
  while (fs::exists(folder_ / ("studio/" + session + "/plan-1")) &&
         std::chrono::steady_clock::now() < end) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  EXPECT_FALSE(fs::exists(folder_ / ("studio/" + session + "/plan-1")));
}

TEST_F(StudioTest, HundredsOfRequestsAtOnce) {
  const std::size_t before = residentBytes();
  std::vector<std::unique_ptr<RawClient>> many;
  for (int i = 0; i < 300; ++i) {
    many.push_back(std::make_unique<RawClient>(port()));
    // Every third one stops in the middle.
    many.back()->send(i % 3 == 0 ? "GET / HTTP/1.1\r\nHost: " : head("GET /api/objects"));
  }
  int good = 0;
  for (int i = 0; i < 300; ++i) {
    if (i % 3 != 0)
      good += statusOf(many[static_cast<std::size_t>(i)]->receive("HTTP/1.1 ", 20)) == 200 ? 1 : 0;
  }
  EXPECT_EQ(good, 200);
  EXPECT_LT(residentBytes(), before + (64U << 20));
  many.clear();
  EXPECT_TRUE(answers());
}

TEST_F(StudioTest, TooManyJobsAreRefusedAndTheOthersGoOn) {
  const std::string sound = clicks();
  std::vector<std::future<int>> uploads;
  for (int i = 0; i < 30; ++i) {
    uploads.push_back(std::async(std::launch::async, [this, &sound] {
      const auto answer = client().Post("/api/sounds", sound, kBytes);
      return answer ? answer->status : 0;
    }));
  }
  int good = 0, refused = 0;
  for (auto& upload : uploads) {
    const int status = upload.get();
    good += status == 200 ? 1 : 0;
    refused += status == 503 ? 1 : 0;
  }
  EXPECT_EQ(good + refused, 30);
  EXPECT_GE(good, 18);  // that run or wait
}

}  // namespace
}  // namespace ifa::studio
