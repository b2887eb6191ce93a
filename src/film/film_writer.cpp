// SPDX-License-Identifier: Apache-2.0
#include "film/film_writer.h"

namespace ifa {

struct FilmWriter::Encoder {};

bool filmsCanBeWritten() { return false; }

FilmWriter::~FilmWriter() = default;

}  // namespace ifa
