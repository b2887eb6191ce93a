// SPDX-License-Identifier: Apache-2.0
#include "studio/guard.h"

#include <gtest/gtest.h>

namespace ifa::studio {
namespace {

Gate localGate() {
  Gate gate;
  gate.port = 4610;
  return gate;
}

httplib::Request request(const std::string& method, const httplib::Headers& headers) {
  httplib::Request made;
  made.method = method;
  made.path = "/api/sounds";
  made.headers = headers;
  if (made.headers.count("Host") == 0) made.headers.emplace("Host", "127.0.0.1:4610");
  return made;
}

int statusOf(const httplib::Request& made) {
  const auto refusal = refusalOf(made, localGate());
  return refusal ? refusal->status : 200;
}

httplib::Headers upload(const std::string& length = "10") {
  return {{"Content-Type", "application/octet-stream"}, {"Content-Length", length}};
}

TEST(Guard, KnowsItsOwnNames) {
  for (const char* host : {"127.0.0.1:4610", "localhost:4610", "LocalHost:4610", "[::1]:4610"}) {
    EXPECT_TRUE(isOurHost(host, localGate())) << host;
  }
}

TEST(Guard, KnowsNoOtherName) {
  for (const char* host :
       {"", "127.0.0.1", "127.0.0.1:80", "evil.example:4610", "127.0.0.1.evil.example:4610",
        "192.168.1.2:4610", "localhost:4610x", "localhost:", "[::1]4610", "127.1:4610",
        "localhost:99999999999999999999", "user@localhost:4610"}) {
    EXPECT_FALSE(isOurHost(host, localGate())) << host;
  }
}

TEST(Guard, OnANetworkNumbersAreKnownButNamesAreNot) {
  Gate gate = localGate();
  gate.host = "0.0.0.0";
  EXPECT_TRUE(isOurHost("192.168.1.2:4610", gate));
  EXPECT_FALSE(isOurHost("evil.example:4610", gate));
  gate.host = "workshop";
  EXPECT_TRUE(isOurHost("workshop:4610", gate));
}

TEST(Guard, LetsItsOwnPageThrough) {
  EXPECT_EQ(statusOf(request("GET", {})), 200);
  auto headers = upload();
  headers.emplace("Origin", "http://127.0.0.1:4610");
  headers.emplace("Sec-Fetch-Site", "same-origin");
  EXPECT_EQ(statusOf(request("POST", headers)), 200);
}

TEST(Guard, RefusesForeignHostsAndOrigins) {
  EXPECT_EQ(statusOf(request("GET", {{"Host", "evil.example:4610"}})), 403);
  EXPECT_EQ(statusOf(request("GET", {{"Host", "127.0.0.1:4610"}, {"Host", "evil.example:4610"}})),
            403);
  for (const char* origin : {"http://evil.example", "null", "https://127.0.0.1:4610",
                             "http://127.0.0.1:4611", "http://localhost:4610"}) {
    auto headers = upload();
    headers.emplace("Origin", origin);
    EXPECT_EQ(statusOf(request("POST", headers)), 403) << origin;
  }
  EXPECT_EQ(statusOf(request("GET", {{"Sec-Fetch-Site", "cross-site"}})), 403);
  EXPECT_EQ(statusOf(request("GET", {{"Sec-Fetch-Site", "same-site"}})), 403);
}

TEST(Guard, ALinkFromElsewhereOpensThePageAndNothingElse) {
  auto link = request("GET", {{"Sec-Fetch-Site", "cross-site"}, {"Sec-Fetch-Mode", "navigate"}});
  EXPECT_EQ(statusOf(link), 403);
  link.path = "/";
  EXPECT_EQ(statusOf(link), 200);
}

TEST(Guard, RefusesBodiesThatItCannotBound) {
  EXPECT_EQ(statusOf(request("POST", upload("67108864"))), 200);
  EXPECT_EQ(statusOf(request("POST", upload("67108865"))), 413);
  EXPECT_EQ(statusOf(request("POST", upload("2147483648"))), 413);
  EXPECT_EQ(statusOf(request("POST", upload("99999999999999999999999"))), 411);
  EXPECT_EQ(statusOf(request("POST", upload("-1"))), 411);
  EXPECT_EQ(statusOf(request("POST", upload("1 "))), 411);
  EXPECT_EQ(statusOf(request("POST", {{"Content-Type", "application/json"}})), 411);
  auto twice = upload();
  twice.emplace("Content-Length", "11");
  EXPECT_EQ(statusOf(request("POST", twice)), 411);
  auto chunked = upload();
  chunked.emplace("Transfer-Encoding", "chunked");
  EXPECT_EQ(statusOf(request("POST", chunked)), 411);
  auto packed = upload();
  packed.emplace("Content-Encoding", "gzip");
  EXPECT_EQ(statusOf(request("POST", packed)), 415);
  EXPECT_EQ(statusOf(request("GET", {{"Content-Length", "5"}})), 400);
}

TEST(Guard, RefusesWhatAForeignFormCanSend) {
  for (const char* type :
       {"text/plain", "application/x-www-form-urlencoded", "multipart/form-data; boundary=x",
        "application/json; charset=utf-8", ""}) {
    EXPECT_EQ(statusOf(request("POST", {{"Content-Type", type}, {"Content-Length", "10"}})), 415)
        << type;
  }
}

TEST(Guard, RefusesLongPathsAndManyRanges) {
  auto made = request("GET", {});
  made.path = "/" + std::string(300, 'a');
  EXPECT_EQ(statusOf(made), 414);
  made.path = "/";
  made.ranges = {{0, 1}, {0, 1}};
  EXPECT_EQ(statusOf(made), 416);
}

}  // namespace
}  // namespace ifa::studio
