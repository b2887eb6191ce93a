// SPDX-License-Identifier: Apache-2.0
#include "studio/exchange.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <memory>

#include "studio/bounded_server.h"

namespace ifa::studio {

namespace {

constexpr std::size_t kMaxText = 1 << 20;
constexpr std::size_t kMaxParameter = 120;

std::vector<std::string> splitPath(const std::string& path) {
  std::vector<std::string> parts;
  for (std::size_t from = 1; from <= path.size();) {
    const auto slash = std::min(path.find('/', from), path.size());
    parts.push_back(path.substr(from, slash - from));
    from = slash + 1;
  }
  return parts;
}

}  // namespace

Exchange::Exchange(const httplib::Request& request, httplib::Response& response,
                   const httplib::ContentReader* reader)
    : request_(request), response_(response), reader_(reader), path_(splitPath(request.path)) {}

std::string Exchange::parameter(const char* name) const {
  return request_.get_param_value(name).substr(0, kMaxParameter);
}

std::size_t Exchange::length() const {
  return request_.get_header_value<std::uint64_t>("Content-Length");
}

Answer<std::string> Exchange::readText() const {
  if (length() > kMaxText) return refuse(413, "more than 1 MiB");
  Connection::current()->allowBody(length());
  std::string text;
  const bool whole = (*reader_)([&text](const char* bytes, std::size_t count) {
    text.append(bytes, count);
    return text.size() <= kMaxText;
  });
  if (!whole) return refuse(400, "the body broke off");
  return text;
}

bool Exchange::receiveFile(const std::filesystem::path& path) const {
  Connection::current()->allowBody(length());
  std::ofstream stream(path, std::ios::binary);
  const bool whole = (*reader_)([&stream](const char* bytes, std::size_t count) {
    return static_cast<bool>(stream.write(bytes, static_cast<std::streamsize>(count)));
  });
  stream.close();
  return whole && static_cast<bool>(stream);
}

void Exchange::throwAway() const {
  Connection::current()->allowBody(length());
  (*reader_)([](const char*, std::size_t) { return true; });
}

void Exchange::answer(const Json& json) { response_.set_content(textOf(json), "application/json"); }

void Exchange::answer(const Refusal& refusal) {
  response_.status = refusal.status;
  answer(Json{{"message", refusal.message}, {"remedy", refusal.remedy}});
}

void Exchange::answerFile(const std::filesystem::path& path, const std::string& type) {
  std::error_code code;
  const auto size = std::filesystem::file_size(path, code);
  auto stream = std::make_shared<std::ifstream>(path, std::ios::binary);
  if (code || !*stream) return answer(Refusal{404, "this file is not there", {}});
  response_.set_content_provider(
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

std::string textOf(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace ifa::studio
