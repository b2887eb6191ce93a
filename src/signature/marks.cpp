// SPDX-License-Identifier: Apache-2.0
#include "signature/marks.h"

#include <fstream>
#include <string>

#include "base/file.h"
#include "signature/csv.h"
#include "signature/midi.h"
#include "signature/signature.h"
#include "signature/signature_json.h"
#include "signature/text_fields.h"
#include "signature/wav_cues.h"

namespace ifa {

namespace fs = std::filesystem;

namespace {

/// Empty when the file is not there.
std::string firstBytesOf(const fs::path& path) {
  std::string bytes(12, '\0');
  std::ifstream stream(path, std::ios::binary);
  stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  bytes.resize(static_cast<std::size_t>(stream.gcount()));
  return bytes;
}

MarkFormat formatByEnding(const fs::path& path) {
  const std::string ending = lowerAscii(path.extension().string());
  if (ending == ".wav") return MarkFormat::kWav;
  if (ending == ".json") return MarkFormat::kSignature;
  if (ending == ".csv" || ending == ".tsv") return MarkFormat::kCsv;
  return ending == ".mid" || ending == ".midi" ? MarkFormat::kMidi : MarkFormat::kAudacity;
}

Result<std::vector<Label>> readCuesOf(const fs::path& path) {
  auto labels = readWavCues(path);
  if (!labels || !labels->empty()) return labels;
  return badInput("holds no cue points", path.string(),
                  "mark the contacts, or leave the labels out to have them detected");
}

}  // namespace

MarkFormat markFormatOf(const fs::path& path) {
  const std::string bytes = firstBytesOf(path);
  if (bytes.starts_with("MThd")) return MarkFormat::kMidi;
  const bool riff = bytes.starts_with("RIFF") || bytes.starts_with("RF64");
  if (riff && bytes.ends_with("WAVE")) return MarkFormat::kWav;
  return formatByEnding(path);
}

bool standsAlone(MarkFormat format) {
  return format == MarkFormat::kCsv || format == MarkFormat::kSignature ||
         format == MarkFormat::kMidi;
}

Result<std::vector<Label>> readMarks(const fs::path& path, const MidiOptions& options) {
  switch (markFormatOf(path)) {
    case MarkFormat::kWav:
      return readCuesOf(path);
    case MarkFormat::kCsv:
      return readCsv(path);
    case MarkFormat::kMidi:
      return readMidi(path, options);
    case MarkFormat::kSignature: {
      const auto signature = readSignature(path);
      if (!signature) return tl::unexpected<Error>(signature.error());
      return labelsFromSignature(*signature);
    }
    default:
      return readLabels(path);
  }
}

Result<void> writeMarks(const fs::path& path, const fs::path& source, const Sound& sound,
                        const std::vector<Label>& labels) {
  const MarkFormat format = formatByEnding(path);
  if (format == MarkFormat::kAudacity) return writeLabels(path, labels);
  if (format == MarkFormat::kWav) return writeWavWithCues(path, source, sound, labels);
  if (format == MarkFormat::kMidi) {
    return tl::unexpected<Error>({ErrorCode::kUsage, "MIDI is read, not written", path.string(),
                                  "name a file that ends in .txt, .wav, .csv or .json"});
  }
  const auto signature = signatureFromLabels(sound, labels, {}, source.string());
  if (!signature) return tl::unexpected<Error>(signature.error());
  if (format == MarkFormat::kSignature) return writeSignature(path, *signature);
  const char separator = lowerAscii(path.extension().string()) == ".tsv" ? '\t' : ',';
  return writeFileAtomically(path, formatCsv(labelsFromSignature(*signature), separator));
}

}  // namespace ifa
