// SPDX-License-Identifier: Apache-2.0
#include "signature/midi.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <tuple>

#include "base/file.h"
#include "signature/midi_track.h"

namespace ifa {
namespace {

constexpr std::size_t kMaxBytes = std::size_t{16} << 20;
constexpr double kMaxSeconds = 3600;
constexpr double kTopVelocity = 127;

struct MidiFile {
  int format = 0;
  int division = 0;  ///< as in the file
  std::vector<MidiTrack> tracks;
};

/// Ticks as seconds, by the tempo changes of the tracks that play together.
class Clock {
 public:
  Clock(int division, std::vector<MidiTempo> tempos) {
    std::stable_sort(
        tempos.begin(), tempos.end(),
        [](const MidiTempo& one, const MidiTempo& other) { return one.tick < other.tick; });
    if (division < 0x8000) {
      ticksPerBeat_ = division;
      for (const MidiTempo& tempo : tempos) {
        pieces_.push_back({tempo.tick, seconds(tempo.tick), tempo.microsecondsPerBeat * 1e-6});
      }
      return;
    }
    // Frames a second, as a negative number of eight bits, and ticks a frame: tempo has no say.
    const int frames = 256 - (division >> 8);
    ticksPerBeat_ = (division & 0xFF) * (frames == 29 ? 30000.0 / 1001 : frames);
    pieces_.front().secondsPerBeat = 1;
  }

  [[nodiscard]] double seconds(std::uint64_t tick) const {
    const auto after = std::upper_bound(
        pieces_.begin(), pieces_.end(), tick,
        [](std::uint64_t moment, const Piece& piece) { return moment < piece.tick; });
    const Piece& piece = *(after - 1);
    return piece.seconds +
           static_cast<double>(tick - piece.tick) * piece.secondsPerBeat / ticksPerBeat_;
  }

 private:
  /// From a tempo change to the next one.
  struct Piece {
    std::uint64_t tick = 0;
    double seconds = 0, secondsPerBeat = 0.5;  // 120 beats a minute where nothing is said
  };

  std::vector<Piece> pieces_ = std::vector<Piece>(1);
  double ticksPerBeat_ = 1;
};

Result<MidiFile> readHeader(MidiBytes& bytes) {
  MidiFile file;
  if (bytes.take(4) != "MThd") return bytes.bad("is not a Standard MIDI File");
  const auto length = bytes.number(4);
  const auto body = length ? bytes.take(*length) : std::string_view();
  if (!length || *length < 6 || body.size() < *length) return bytes.bad("the header is cut off");
  MidiBytes fields(body, bytes.place());
  file.format = static_cast<int>(*fields.number(2));
  static_cast<void>(fields.number(2));  // how many tracks; those that are there count
  file.division = static_cast<int>(*fields.number(2));
  if (file.format > 2) return bytes.bad(fmt::format("format {} is not known", file.format));
  const int frames = file.division < 0x8000 ? 25 : 256 - (file.division >> 8);
  const bool known = frames == 24 || frames == 25 || frames == 29 || frames == 30;
  if ((file.division & 0xFF) == 0 && (file.division >= 0x8000 || file.division == 0)) {
    return bytes.bad("the header says that a beat has no ticks");
  }
  if (!known) return bytes.bad(fmt::format("{} frames a second are not known", frames));
  return file;
}

Result<MidiFile> readChunks(std::string_view text, const std::string& place) {
  MidiBytes bytes(text, place);
  auto file = readHeader(bytes);
  while (file && !bytes.atEnd()) {
    const auto id = bytes.take(4);
    const auto length = bytes.number(4);
    // What is left after the last track by some programs is no chunk.
    if (!length) break;
    const std::size_t start = bytes.offset();
    const auto body = bytes.take(*length);
    if (id != "MTrk") continue;
    if (body.size() < *length) {
      return bytes.bad(fmt::format("track {} is cut off", file->tracks.size() + 1));
    }
    auto track = readMidiTrack(MidiBytes(body, place, start));
    if (!track) return tl::unexpected<Error>(track.error());
    file->tracks.push_back(std::move(*track));
  }
  return file;
}

bool isWanted(const MidiNote& note, const MidiOptions& options) {
  return options.channel == 0 || note.channel == options.channel;
}

bool hasNotes(const MidiTrack& track, const MidiOptions& options) {
  return std::any_of(track.notes.begin(), track.notes.end(),
                     [&](const MidiNote& note) { return isWanted(note, options); });
}

/// "1, 3"; empty when there are none.
std::string tracksWithNotes(const MidiFile& file, const MidiOptions& options) {
  std::string names;
  for (std::size_t i = 0; i < file.tracks.size(); ++i) {
    if (!hasNotes(file.tracks[i], options)) continue;
    names += fmt::format("{}{}", names.empty() ? "" : ", ", i + 1);
  }
  return names;
}

/// What plays together, in one track: all of the notes that are wanted, and the tempos.
Result<MidiTrack> choose(const MidiFile& file, const MidiOptions& options,
                         const std::string& place) {
  const std::string playing = tracksWithNotes(file, options);
  const bool several = playing.find(',') != std::string::npos;
  if (file.format == 2 && options.track == 0 && several) {
    return badInput("holds several tunes that do not belong together", place,
                    "choose one of the tracks " + playing + " with --midi-track");
  }
  MidiTrack chosen;
  for (std::size_t i = 0; i < file.tracks.size(); ++i) {
    const MidiTrack& track = file.tracks[i];
    const bool wanted = options.track == 0 || static_cast<std::size_t>(options.track) == i + 1;
    for (const MidiNote& note : track.notes) {
      if (wanted && isWanted(note, options)) chosen.notes.push_back(note);
    }
    // In format 2 each track has its own tempo.
    if (file.format == 2 && !(wanted && hasNotes(track, options))) continue;
    chosen.tempos.insert(chosen.tempos.end(), track.tempos.begin(), track.tempos.end());
  }
  if (!chosen.notes.empty()) return chosen;
  const bool some = options.track != 0 || options.channel != 0;
  return badInput(some ? "holds no such notes" : "holds no notes", place,
                  playing.empty() ? "" : "tracks with notes: " + playing);
}

/// One label for all notes that start together.
Result<std::vector<Label>> labelsOf(std::vector<MidiNote> notes, const Clock& clock,
                                    const MidiOptions& options, const std::string& place) {
  std::stable_sort(notes.begin(), notes.end(), [](const MidiNote& one, const MidiNote& other) {
    return one.start < other.start;
  });
  std::vector<Label> labels;
  for (std::size_t i = 0; i < notes.size();) {
    const MidiNote& first = notes[i];
    MidiNote loudest = first;
    for (; i < notes.size() && notes[i].start == first.start; ++i) {
      loudest.end = std::max(loudest.end, notes[i].end);
      loudest.velocity = std::max(loudest.velocity, notes[i].velocity);
    }
    Label label;
    label.start = label.end = clock.seconds(first.start);
    // What the next note begins is its own.
    const std::uint64_t end =
        i < notes.size() ? std::min(loudest.end, notes[i].start) : loudest.end;
    if (options.durations) label.end = clock.seconds(end);
    label.amplitude = loudest.velocity / kTopVelocity;
    if (!(label.end <= kMaxSeconds)) {
      return badInput(
          fmt::format("the note at byte {} sounds after {:g} s", first.offset, kMaxSeconds), place,
          "cut out the part that is wanted");
    }
    if (labels.size() == kMaxLabels) {
      return badInput(fmt::format("holds more than {} notes", kMaxLabels), place,
                      "choose a track or a channel");
    }
    labels.push_back(std::move(label));
  }
  return labels;
}

}  // namespace

Result<std::vector<Label>> parseMidi(std::string_view bytes, const std::string& place,
                                     const MidiOptions& options) {
  const auto file = readChunks(bytes, place);
  if (!file) return tl::unexpected<Error>(file.error());
  auto chosen = choose(*file, options, place);
  if (!chosen) return tl::unexpected<Error>(chosen.error());
  const Clock clock(file->division, std::move(chosen->tempos));
  return labelsOf(std::move(chosen->notes), clock, options, place);
}

Result<std::vector<ScoreNote>> parseMidiNotes(std::string_view bytes, const std::string& place) {
  const auto file = readChunks(bytes, place);
  if (!file) return tl::unexpected<Error>(file.error());
  if (file->format == 2) {
    return badInput("holds tunes that do not belong together (format 2)", place,
                    "save it as format 0 or 1");
  }
  const auto all = choose(*file, {}, place);
  if (!all) return tl::unexpected<Error>(all.error());
  const Clock clock(file->division, all->tempos);
  std::vector<ScoreNote> notes;
  for (std::size_t i = 0; i < file->tracks.size(); ++i) {
    for (const MidiNote& note : file->tracks[i].notes) {
      notes.push_back({clock.seconds(note.start), static_cast<int>(i) + 1, note.channel, note.key,
                       note.velocity / kTopVelocity});
      if (notes.size() > kMaxLabels || !(notes.back().time <= kMaxSeconds)) {
        return badInput(fmt::format("the note at byte {} is one too many, or after {:g} s",
                                    note.offset, kMaxSeconds),
                        place, "cut out the part that is wanted");
      }
    }
  }
  std::stable_sort(notes.begin(), notes.end(), [](const ScoreNote& one, const ScoreNote& other) {
    return std::tie(one.time, one.track, one.key) < std::tie(other.time, other.track, other.key);
  });
  return notes;
}

Result<std::vector<ScoreNote>> readMidiNotes(const std::filesystem::path& path) {
  const auto bytes = readFile(path, kMaxBytes);
  if (!bytes) return tl::unexpected<Error>(bytes.error());
  return parseMidiNotes(*bytes, path.string());
}

Result<std::vector<Label>> readMidi(const std::filesystem::path& path, const MidiOptions& options) {
  const auto bytes = readFile(path, kMaxBytes);
  if (!bytes) return tl::unexpected<Error>(bytes.error());
  return parseMidi(*bytes, path.string(), options);
}

}  // namespace ifa
