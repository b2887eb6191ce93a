// SPDX-License-Identifier: Apache-2.0
#include "signature/wav_cues.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "base/raw_file.h"
#include "signature/cue_note.h"
#include "signature/text_fields.h"
#include "sound/wav_chunks.h"

namespace ifa {
namespace {

constexpr std::size_t kCueBytes = 24;
constexpr const char* kExport = "export the sound with its marks again, or give label files";

/// One point of the chunk "cue ".
struct Cue {
  std::uint32_t id = 0;
  std::uint64_t sample = 0;
};

/// What the list "adtl" says of one point.
struct Notes {
  std::string label, text, note;  ///< of labl, ltxt and note
  std::uint64_t length = 0;       ///< samples; 0: a point
};

/// Decision: where a program filled in dwPosition alone, that counts.
Result<std::vector<Cue>> parseCues(std::string_view chunk, const std::string& place) {
  const std::uint64_t count = littleEndian(chunk, 0, 4);
  const std::size_t there = chunk.size() < 4 ? 0 : (chunk.size() - 4) / kCueBytes;
  if (count > there) {
    return badInput(fmt::format("promises {} cue points and holds {}", count, there), place,
                    kExport);
  }
  if (count > kMaxLabels) {
    return badInput(fmt::format("holds more than {} cue points", kMaxLabels), place, kExport);
  }
  std::vector<Cue> cues;
  std::uint64_t largest = 0;
  for (std::size_t at = 4; cues.size() < count; at += kCueBytes) {
    cues.push_back(
        {static_cast<std::uint32_t>(littleEndian(chunk, at, 4)), littleEndian(chunk, at + 20, 4)});
    largest = std::max(largest, cues.back().sample);
  }
  for (std::size_t i = 0; largest == 0 && i < cues.size(); ++i) {
    cues[i].sample = littleEndian(chunk, 4 + i * kCueBytes + 4, 4);
  }
  return cues;
}

/// Up to the first zero byte, in UTF-8 and on one line.
std::string textOf(std::string_view bytes) {
  bytes = bytes.substr(0, bytes.find('\0'));
  std::string text;
  const bool latin = !isUtf8(bytes);
  for (const char c : bytes) {
    const auto value = static_cast<unsigned char>(c);
    if (latin && value >= 0x80) {
      text += static_cast<char>(0xC0 | value >> 6);
      text += static_cast<char>(0x80 | (value & 0x3F));
    } else {
      text += value < 0x20 ? ' ' : c;
    }
  }
  return text;
}

/// What does not fit into the list, or belongs to no point, says nothing.
void parseNotes(std::string_view list, std::map<std::uint32_t, Notes>& notes) {
  for (std::size_t at = 4; at + 12 <= list.size();) {
    const std::string_view id = list.substr(at, 4);
    const std::uint64_t size = littleEndian(list, at + 4, 4);
    const auto body = list.substr(at + 8, static_cast<std::size_t>(size));
    at += 8 + body.size() + body.size() % 2;
    if (body.size() < 4) continue;
    Notes& target = notes[static_cast<std::uint32_t>(littleEndian(body, 0, 4))];
    if (id == "labl") target.label = textOf(body.substr(4));
    if (id == "note") target.note = textOf(body.substr(4));
    if (id != "ltxt" || body.size() < 20) continue;
    target.length = littleEndian(body, 4, 4);
    target.text = textOf(body.substr(20));
  }
}

Label labelOf(const Cue& cue, const Notes& notes, double rate) {
  Label label;
  const auto exact = parseCueNote(notes.note);
  label.text = !notes.label.empty() || exact ? notes.label
               : !notes.text.empty()         ? notes.text
                                             : notes.note;
  label.start = static_cast<double>(cue.sample) / rate;
  label.end = static_cast<double>(cue.sample + notes.length) / rate;
  if (!exact) return label;
  // Somebody who moves a point in an editor leaves our note as it was.
  if (isAtSample(exact->start, cue.sample, rate)) label.start = exact->start;
  const bool sameLength = isAtSample(exact->duration, notes.length, rate);
  label.end = label.start + (sameLength ? exact->duration : label.end - label.start);
  return label;
}

std::vector<Label> labelsOf(const std::vector<Cue>& cues, std::map<std::uint32_t, Notes>& notes,
                            double rate) {
  std::vector<Label> labels;
  for (const Cue& cue : cues) {
    Label label = labelOf(cue, notes[cue.id], rate);
    label.end = std::max(label.start, label.end);
    labels.push_back(std::move(label));
  }
  std::stable_sort(labels.begin(), labels.end(),
                   [](const Label& one, const Label& other) { return one.start < other.start; });
  return labels;
}

}  // namespace

Result<std::vector<Label>> readWavCues(const std::filesystem::path& path) {
  const auto file = RawFile::open(path, RawFile::Mode::kRead);
  if (!file) return tl::unexpected<Error>(file.error());
  const auto chunks = listWavChunks(*file);
  if (!chunks) return tl::unexpected<Error>(chunks.error());
  double rate = 0;
  std::vector<Cue> cues;
  std::map<std::uint32_t, Notes> notes;
  for (const WavChunk& chunk : *chunks) {
    if (chunk.id != "fmt " && chunk.id != "cue " && chunk.list != "adtl") continue;
    const auto body = readWavChunk(*file, chunk);
    if (!body) return tl::unexpected<Error>(body.error());
    if (chunk.id == "fmt ") rate = static_cast<double>(littleEndian(*body, 4, 4));
    if (chunk.list == "adtl") parseNotes(*body, notes);
    if (chunk.id != "cue ") continue;
    auto some = parseCues(*body, fmt::format("{}, byte {}", path.string(), chunk.offset));
    if (!some) return tl::unexpected<Error>(some.error());
    cues = std::move(*some);
  }
  if (rate <= 0) return std::vector<Label>();
  return labelsOf(cues, notes, rate);
}

}  // namespace ifa
