// SPDX-License-Identifier: Apache-2.0
// The stages of `ifa ensemble`.
#include <algorithm>
#include <cmath>
#include <system_error>

#include "audit/separation.h"
#include "base/file.h"
#include "base/staged_folder.h"
#include "base/stopwatch.h"
#include "base/version.h"
#include "ensemble/ensemble_file.h"
#include "ensemble/place_bodies.h"
#include "ensemble/voices.h"
#include "export/glb.h"
#include "export/motion_json.h"
#include "ifa/ensemble.h"
#include "pipeline/chosen_body.h"
#include "pipeline/colour_materials.h"
#include "pipeline/copy_object.h"
#include "pipeline/ensemble_folder.h"
#include "pipeline/manifest.h"
#include "pipeline/mix_voices.h"
#include "pipeline/output.h"
#include "pipeline/plan_voice.h"
#include "pipeline/write_film.h"
#include "render/timeline.h"
#include "signature/marks.h"
#include "sonify/sound_material.h"

namespace ifa {

namespace fs = std::filesystem;

namespace {

constexpr double kRoom = 0.25;  // s of echo in the sound of the whole
constexpr const char* kBodies = "bodies";

struct Piece {
  Score score;
  std::vector<Voice> voices;
};

/// What can be wrong with a part is told before anything is planned.
Result<void> checkParts(const Score& score, const std::string& planner) {
  if (planner != "hybrid" && planner != "shoot") {
    return tl::unexpected<Error>({ErrorCode::kUsage, "\"" + planner + "\" plays no music",
                                  "--planner", "choose from hybrid, shoot"});
  }
  for (const ScorePart& part : score.parts) {
    if (auto body = loadChosenBody(settingsOf(part, score.seed, planner)); !body) {
      return tl::unexpected(body.error());
    }
    if (part.sound.empty()) continue;
    if (const auto material = findSoundMaterial(part.sound); !material) {
      return badInput(material.error().message, "part \"" + part.name + "\": sound",
                      material.error().remedy);
    }
  }
  return {};
}

Result<Piece> readPiece(const EnsembleSettings& settings) {
  const bool isMidi = markFormatOf(settings.score) == MarkFormat::kMidi;
  if (isMidi == settings.object.empty()) {
    return tl::unexpected<Error>(
        {ErrorCode::kUsage, isMidi ? "a MIDI file names no objects" : "a score names its objects",
         "--object", isMidi ? "name one, such as --object d6" : "leave it out"});
  }
  Piece piece;
  if (!isMidi) {
    auto score = readScore(settings.score);
    if (!score) return tl::unexpected(score.error());
    piece.score = std::move(*score);
  }
  const fs::path midi = isMidi ? settings.score : piece.score.midi;
  const auto notes = readMidiNotes(midi);
  if (!notes) return tl::unexpected(notes.error());
  if (isMidi) piece.score = scoreOfNotes(midi, *notes, settings.object);
  if (settings.seed) piece.score.seed = *settings.seed;
  if (auto good = checkParts(piece.score, settings.planner); !good) {
    return tl::unexpected(good.error());
  }
  auto voices = dealVoices(piece.score, *notes, midi.string());
  if (!voices) return tl::unexpected(voices.error());
  piece.voices = std::move(*voices);
  return piece;
}

Result<fs::path> makeFolder(const fs::path& folder) {
  std::error_code code;
  fs::create_directories(folder, code);
  if (code) return badInput("cannot be made: " + code.message(), folder.string());
  return folder;
}

/// The search's progress as its share of all bodies'.
Progress progressOf(std::size_t index, std::size_t count, const Progress& whole) {
  Progress own;
  own.stop = whole.stop;
  own.report = [index, count, &whole](std::string_view stage, double share) {
    if (stage != "search") return;
    whole("plan", (static_cast<double>(index) + share) / static_cast<double>(count));
  };
  return own;
}

Result<std::vector<PlannedVoice>> planAll(const Piece& piece, const std::string& planner,
                                          const fs::path& folder, const Progress& progress) {
  std::vector<PlannedVoice> planned;
  for (const Voice& voice : piece.voices) {
    const auto own = makeFolder(folder / kBodies / voice.name);
    if (!own) return tl::unexpected(own.error());
    // Bodies with the same rhythm shall not move alike.
    const std::uint64_t seed = piece.score.seed + planned.size();
    auto found = planVoice(voice, piece.score.parts[voice.part], seed, planner, *own,
                           progressOf(planned.size(), piece.voices.size(), progress));
    if (!found) return tl::unexpected(found.error());
    planned.push_back(std::move(*found));
  }
  return planned;
}

double worstContactOf(const std::vector<PlannedVoice>& voices) {
  double worst = 0;
  for (const PlannedVoice& voice : voices) {
    for (const MotionContact& contact : voice.player.motion.contacts) {
      worst = std::max(worst, std::abs(contact.time - contact.targetTime));
    }
  }
  return worst;
}

double clearanceOf(const Score& score, const std::vector<PlannedVoice>& voices) {
  if (score.clearance > 0) return score.clearance;
  double least = voices.front().body.size;
  for (const PlannedVoice& voice : voices) least = std::min(least, voice.body.size);
  return 0.5 * least;
}

Result<Ensemble> lay(const Score& score, const std::vector<PlannedVoice>& voices,
                     const Progress& progress) {
  Ensemble ensemble;
  ensemble.program = programVersion();
  ensemble.sound = "sound.wav";
  ensemble.seed = score.seed;
  ensemble.clearance = clearanceOf(score, voices);
  std::vector<EnsembleMember> members;
  for (const PlannedVoice& voice : voices) members.push_back({&voice.player.motion, &voice.body});
  const auto places = placeBodies(members, {ensemble.clearance, score.seed}, progress);
  if (!places) return tl::unexpected(places.error());
  for (std::size_t i = 0; i < voices.size(); ++i) {
    const EnsemblePlayer& player = voices[i].player;
    const std::string motion = (fs::path(kBodies) / player.name / "motion.json").generic_string();
    ensemble.bodies.push_back({player.name, player.part, motion, (*places)[i]});
  }
  return ensemble;
}

/// By code that shares nothing with the placing. Bodies too near are a bug of ours.
Result<void> auditPlaces(const Ensemble& ensemble, const std::vector<PlannedVoice>& voices,
                         EnsembleResult& result) {
  std::vector<LaidMotion> laid;
  for (std::size_t i = 0; i < voices.size(); ++i) {
    const FloorPlace& place = ensemble.bodies[i].place;
    laid.push_back({&voices[i].player.motion, &voices[i].body, place.turn, place.shift});
  }
  const Separation found = leastSeparation(laid);
  if (!found.known) return {};
  result.leastDistance = found.least;
  result.leastOf = voices[found.one].player.name + " and " + voices[found.other].player.name;
  result.leastTime = found.time;
  if (found.least > 0) return {};
  return tl::unexpected<Error>({ErrorCode::kNoMotion, "the audit finds that bodies meet",
                                result.leastOf, "try another --seed, and please report this"});
}

Result<void> writeVoice(const fs::path& folder, const Score& score, PlannedVoice& voice,
                        const Sound* sound) {
  const auto part = std::find_if(score.parts.begin(), score.parts.end(),
                                 [&](const ScorePart& p) { return p.name == voice.player.part; });
  const Motion& motion = voice.player.motion;
  auto written = copyObject(voice.body.definition, folder);
  if (written && part->colour) written = colourMaterials(folder, *part->colour, voice.body);
  if (written && sound != nullptr) written = writeWav(folder / "sound.wav", *sound);
  if (written) written = writeTimeline(folder / "timeline.svg", motion, sound ? *sound : Sound{});
  if (written) written = writeMotionJson(folder / "motion.json", motion);
  return written ? writeManifest(folder, motion) : written;
}

Result<void> writeVoices(const fs::path& folder, const Score& score,
                         std::vector<PlannedVoice>& voices, const VoiceMix* mix) {
  for (std::size_t i = 0; i < voices.size(); ++i) {
    const Sound* sound = mix != nullptr ? &mix->voices[i] : nullptr;
    const fs::path own = folder / kBodies / voices[i].player.name;
    if (auto written = writeVoice(own, score, voices[i], sound); !written) return written;
  }
  return {};
}

Result<void> writeWhole(const fs::path& folder, const Ensemble& ensemble,
                        const std::vector<PlannedVoice>& voices, const VoiceMix& mix,
                        const OutputSettings& output, const Progress& progress,
                        EnsembleResult& result) {
  std::vector<Motion> motions;
  for (std::size_t i = 0; i < voices.size(); ++i) {
    motions.push_back(ensemble.bodies[i].place.apply(voices[i].player.motion));
  }
  std::vector<GlbBody> shown;
  std::vector<FilmPart> parts;
  for (std::size_t i = 0; i < voices.size(); ++i) {
    const std::string& name = voices[i].player.name;
    shown.push_back({&motions[i], &voices[i].body, name});
    parts.push_back({&motions[i], &voices[i].body, name, motions[i].sound.firstContact});
  }
  auto written = writeWav(folder / ensemble.sound, mix.whole);
  if (written && output.formats.count(OutputFormat::kGlb) > 0) {
    AnimationSettings settings;
    settings.floorAndLight = output.glbSet;
    written = writeGlb(folder / "ensemble.glb", shown, settings);
  }
  if (written) written = writeFileAtomically(folder / kEnsembleName, formatEnsemble(ensemble));
  if (!written || output.formats.count(OutputFormat::kMp4) == 0) return written;
  const auto told = writeFilm(folder / "ensemble.mp4", parts, &mix.whole, output.film, progress);
  result.interrupted = !told && told.error().code == ErrorCode::kInterrupted;
  if (!told && !result.interrupted) return tl::unexpected(told.error());
  if (told && !told->empty()) result.warnings.push_back(*told);
  return {};
}

/// Everything of an earlier run that this one may not replace.
std::vector<fs::path> superseded(const fs::path& folder) {
  std::vector<fs::path> names = {kEnsembleName, "ensemble.glb", "ensemble.mp4"};
  // Only what is known to be ours: somebody's folder may have this name.
  if (isEnsemble(folder)) names.emplace_back(kBodies);
  return names;
}

void keepPlayers(std::vector<PlannedVoice>& voices, EnsembleResult& result) {
  result.worstContact = worstContactOf(voices);
  for (PlannedVoice& voice : voices) result.players.push_back(std::move(voice.player));
}

Result<EnsembleResult> writeFailed(const StagedFolder& staged, const Score& score,
                                   std::vector<PlannedVoice>& voices) {
  EnsembleResult result;
  if (auto written = writeVoices(staged.path(), score, voices, nullptr); !written) {
    return tl::unexpected(written.error());
  }
  keepPlayers(voices, result);
  return result;
}

Result<EnsembleResult> layAndWrite(const StagedFolder& staged, const Score& score,
                                   std::vector<PlannedVoice>& voices, const OutputSettings& output,
                                   const Progress& progress) {
  EnsembleResult result;
  const Stopwatch watch;
  const auto ensemble = lay(score, voices, progress);
  if (!ensemble) return tl::unexpected(ensemble.error());
  result.placing = watch.seconds();
  if (auto good = auditPlaces(*ensemble, voices, result); !good) {
    return tl::unexpected(good.error());
  }
  const auto mix = mixVoices(voices, score, kRoom);
  if (!mix) return tl::unexpected(mix.error());
  placeInMix(*mix, voices);
  auto written = writeVoices(staged.path(), score, voices, &*mix);
  if (written) {
    written = writeWhole(staged.path(), *ensemble, voices, *mix, output, progress, result);
  }
  if (!written) return tl::unexpected(written.error());
  keepPlayers(voices, result);
  return result;
}

}  // namespace

const EnsemblePlayer* EnsembleResult::failed() const {
  const auto found = std::find_if(players.begin(), players.end(),
                                  [](const EnsemblePlayer& p) { return !p.motion.success; });
  return found == players.end() ? nullptr : &*found;
}

Result<EnsembleResult> performToFolder(const EnsembleSettings& settings, const fs::path& folder,
                                       const OutputSettings& output, const Progress& progress) {
  const auto piece = readPiece(settings);
  if (!piece) return tl::unexpected(piece.error());
  if (auto good = checkOutput(output); !good) return tl::unexpected(good.error());
  auto staged = StagedFolder::open(folder);
  if (!staged) return tl::unexpected(staged.error());
  auto voices = planAll(*piece, settings.planner, staged->path(), progress);
  if (!voices) return tl::unexpected(voices.error());
  const bool solved = std::all_of(voices->begin(), voices->end(), [](const PlannedVoice& voice) {
    return voice.player.motion.success;
  });
  auto result = solved ? layAndWrite(*staged, piece->score, *voices, output, progress)
                       : writeFailed(*staged, piece->score, *voices);
  if (!result) return result;
  if (auto good = staged->commit(kEnsembleName, superseded(folder)); !good) {
    return tl::unexpected(good.error());
  }
  return result;
}

}  // namespace ifa
