// SPDX-License-Identifier: Apache-2.0
// The film writer of a build without libav: it says so.
#ifndef IFA_WITH_FILM
#include "film/film_writer.h"

namespace ifa {

namespace {

Error missing() {
  return {ErrorCode::kUsage, "this build writes no films", "film",
          "build with -DIFA_WITH_FILM=ON and the libav packages of scripts/packages.txt"};
}

}  // namespace

struct FilmWriter::Encoder {};

bool filmsCanBeWritten() { return false; }

Result<FilmWriter> FilmWriter::open(const std::filesystem::path& /*path*/,
                                    const FilmSettings& /*settings*/, const Sound* /*sound*/) {
  return tl::unexpected(missing());
}

FilmWriter::FilmWriter(std::unique_ptr<Encoder> encoder) : encoder_(std::move(encoder)) {}
FilmWriter::FilmWriter(FilmWriter&&) noexcept = default;
FilmWriter::~FilmWriter() = default;

Result<void> FilmWriter::add(const Image& /*frame*/) { return tl::unexpected(missing()); }
Result<void> FilmWriter::finish() { return tl::unexpected(missing()); }

const std::string& FilmWriter::warning() const {
  static const std::string kNone;
  return kNone;
}

}  // namespace ifa
#endif
