// SPDX-License-Identifier: Apache-2.0
// Writing cue points: the samples stay where they are, the marks are put behind them.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <span>
#include <string>
#include <system_error>

#include "base/raw_file.h"
#include "signature/cue_note.h"
#include "signature/wav_cues.h"
#include "sound/wav_chunks.h"

namespace ifa {

namespace fs = std::filesystem;

namespace {

constexpr std::uint64_t kMostBytes = 0xFFFFFFFF;

bool holdsMarks(const WavChunk& chunk) { return chunk.id == "cue " || chunk.list == "adtl"; }

/// Of chunks that all lie whole in a plain RIFF file, so that some more can be put behind them.
Result<bool> canBeExtended(const fs::path& source) {
  const auto file = RawFile::open(source, RawFile::Mode::kRead);
  if (!file) return tl::unexpected<Error>(file.error());
  const auto chunks = listWavChunks(*file);
  if (!chunks) return tl::unexpected<Error>(chunks.error());
  const auto isNamed = [&](const char* id) {
    return std::any_of(chunks->begin(), chunks->end(),
                       [&](const WavChunk& chunk) { return chunk.id == id; });
  };
  return isNamed("fmt ") && isNamed("data") && !isNamed("ds64") &&
         std::all_of(chunks->begin(), chunks->end(),
                     [](const WavChunk& chunk) { return chunk.whole; });
}

std::string chunk(const std::string& id, const std::string& body) {
  return id + littleEndianBytes(body.size(), 4) + body + std::string(body.size() % 2, '\0');
}

/// The chunks "cue " and "LIST" of kind adtl.
std::string marks(const std::vector<Label>& labels, double rate) {
  std::string cues = littleEndianBytes(labels.size(), 4), list = "adtl";
  for (std::size_t i = 0; i < labels.size(); ++i) {
    const Label& label = labels[i];
    const std::string id = littleEndianBytes(i + 1, 4);
    const std::string sample = littleEndianBytes(samplesAt(label.start, rate), 4);
    cues += id + sample + "data" + std::string(8, '\0') + sample;
    const std::string zero(1, '\0');
    const CueNote note{label.start, label.end - label.start};
    list += chunk("labl", id + label.text + zero) + chunk("note", id + formatCueNote(note) + zero);
    if (label.isPoint()) continue;
    const std::string length = littleEndianBytes(samplesAt(note.duration, rate), 4);
    list += chunk("ltxt", id + length + "rgn " + std::string(8, '\0'));
  }
  return chunk("cue ", cues) + chunk("LIST", list);
}

Result<void> put(RawFile& file, std::string_view bytes, std::uint64_t offset) {
  return file.write(std::as_bytes(std::span(bytes)), offset);
}

/// Old marks at the end are cut off, others become junk, as the samples behind them must not move.
Result<void> replaceMarks(const fs::path& path, const std::vector<Label>& labels, double rate) {
  auto file = RawFile::open(path, RawFile::Mode::kUpdate);
  if (!file) return tl::unexpected<Error>(file.error());
  auto chunks = listWavChunks(*file);
  if (!chunks) return tl::unexpected<Error>(chunks.error());
  while (!chunks->empty() && holdsMarks(chunks->back())) chunks->pop_back();
  for (const WavChunk& old : *chunks) {
    if (!holdsMarks(old)) continue;
    if (auto good = put(*file, "JUNK", old.offset - 8); !good) return good;
  }
  const std::uint64_t end = chunks->empty() ? 12 : chunks->back().end();
  const std::string added = marks(labels, rate);
  if (end + added.size() > kMostBytes) {
    return badInput("the sound does not fit into a WAV file (4 GiB)", path.string(),
                    "cut out the part with the contacts");
  }
  if (auto good = file->resize(end); !good) return good;
  if (auto good = put(*file, added, end); !good) return good;
  return put(*file, littleEndianBytes(end + added.size() - 8, 4), 4);
}

Result<void> writeSound(const fs::path& path, const fs::path& source, const Sound& sound) {
  const auto extended = canBeExtended(source);
  if (!extended) return tl::unexpected<Error>(extended.error());
  if (!*extended) return writeWav(path, sound);
  std::error_code code;
  fs::copy_file(source, path, code);
  if (!code) fs::permissions(path, fs::perms::owner_write, fs::perm_options::add, code);
  if (!code) return {};
  return badInput("cannot be written: " + code.message(), path.string(),
                  "check that the folder exists, is writable and has space left");
}

}  // namespace

Result<void> writeWavWithCues(const fs::path& path, const fs::path& source, const Sound& sound,
                              const std::vector<Label>& labels) {
  const fs::path temporary = path.string() + fmt::format(".{}.part", ::getpid());
  auto good = writeSound(temporary, source, sound);
  if (good) good = replaceMarks(temporary, labels, sound.rate);
  std::error_code code;
  if (good) fs::rename(temporary, path, code);
  if (good && !code) return good;
  if (good) good = badInput("cannot be written: " + code.message(), path.string());
  fs::remove(temporary, code);
  // The reader knows nothing of the temporary file.
  if (good.error().place == temporary.string()) good.error().place = path.string();
  return good;
}

}  // namespace ifa
