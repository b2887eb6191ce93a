// SPDX-License-Identifier: Apache-2.0
// The main job as a library: a sound and an object in, synchronised motions out.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "ifa/contact_signature.h"
#include "ifa/event_cut.h"
#include "ifa/film.h"
#include "ifa/midi_options.h"
#include "ifa/motion.h"
#include "ifa/progress.h"
#include "ifa/result.h"

namespace ifa {

/// Most motions that can be asked for at once.
inline constexpr int kMaxTakes = 32;

/// For planner "graph" (IFA section 5, docs/branch-and-bound.md), and what else uses a database.
struct GraphOptions {
  std::filesystem::path database;     ///< event database of object and surface; empty: the cache's
  std::uint64_t simulations = 40000;  ///< of the cache's database, which is made where it is not
  /// Of the cache's database: audible where it is not set. A database that is named has its own,
  /// and is refused where that is not the one set.
  std::optional<EventCut> cut;
  bool printedVelocity = false;  ///< eq. 3 compares v_blend with v_j+, as printed, not v_i+
  bool timeWarp = false;         ///< flights are blended, then shown at another pace (5.3.2)
  double earlyExit = 0.3;        ///< a motion of this Score ends the search, 0 to 1
  /// The time limit, and the time to Score 0.3, are of the processor that searches, not the
  /// clock's: for measurements on a machine that does other work too.
  bool processorTime = false;
  bool symmetry = true;  ///< events also stand for their images (docs/symmetry.md)
};

/// That a direction of the body points some way at a contact (IFA section 6).
struct OrientationWish {
  int contact = 0;   ///< from 1, judged where it begins; 0: the last, judged where the body rests
  std::string face;  ///< of the object file; empty: `body` tells the direction
  Eigen::Vector3d body = Eigen::Vector3d::UnitZ();   ///< body frame: the mesh's axes
  Eigen::Vector3d world = Eigen::Vector3d::UnitZ();  ///< z is up
};

/// Where the centre of mass is to be, seen from above, when a contact begins (IFA section 6).
struct PositionWish {
  int contact = 1;                                  ///< from 1; 0: the last
  Eigen::Vector2d place = Eigen::Vector2d::Zero();  ///< m
};

/// What is to be synchronised, and how. The defaults are those of `ifa sync`.
struct SynchronizeSettings {
  std::filesystem::path sound;  ///< sound file; or contacts alone: signature JSON, CSV, MIDI
  /// Audacity labels, WAV with cue points, CSV, signature JSON, MIDI; empty: the sound's own cue
  /// points, or where it has none the contacts are detected.
  std::filesystem::path labels;
  bool ignoreCues = false;  ///< the sound's cue points are no contacts
  MidiOptions midi;         ///< of a MIDI file, as sound or as labels
  /// Name in the library, or path of an object file; several with commas, or "auto" for the whole
  /// library: the one that explains the sound best (docs/choosing.md).
  std::string object;
  std::string surface;                ///< empty: the object's default
  std::optional<double> restitution;  ///< 0 to 0.95, instead of the surface's
  double restitutionScale = 1;  ///< times the surface's, at most 0.95: to plan with wrong ones
  /// Also looks for the restitution, and where none is named the surface, that suit the sound best
  /// (docs/fitting.md). Not with "graph".
  bool fit = false;
  std::string planner = "hybrid";  ///< or "shoot", "graph"
  GraphOptions graph;              ///< for "graph"; database and symmetry also for "hybrid"
  std::filesystem::path objects;   ///< folder of the library; empty: the program's own
  std::uint64_t seed = 1;
  int takes = 1;                ///< different motions wanted, 1 to kMaxTakes
  double timeLimitSeconds = 0;  ///< cuts the search off; 0: never
  double energyGain = 0;        ///< share of energy that a contact may add; 0 in nature
  std::vector<OrientationWish> orientations;  ///< docs/controls.md
  std::vector<PositionWish> positions;        ///< likewise; in any order
  std::optional<bool> terminal;  ///< overrides what labels or signature say of the ending
  double preRollSeconds = 0.5;   ///< flight shown before the first contact
};

/// How well one object explains a sound, where several were tried.
struct ObjectRank {
  std::string object;
  bool planned = false;  ///< whether a motion was looked for: not where others are likelier by far
  bool solved = false;
  double score = 0;        ///< of its best motion, eq. 12; 0 where none is acceptable
  double probability = 0;  ///< by the rhythm, among the objects tried
  std::string reason;      ///< one line about its motion, or why there is none
};

/// The motions found for one sound, best first; where none is acceptable, the best partial one,
/// with `success` false and `failure` saying why.
struct Synchronization {
  ContactSignature signature;         ///< the targets
  std::vector<Motion> takes;          ///< at least one
  bool interrupted = false;           ///< asked to stop before all takes, or their films, were done
  std::vector<std::string> warnings;  ///< what the user should know of the files; mostly empty
  std::vector<ObjectRank> ranking = {};  ///< of the objects tried, best first; of one alone empty
};

/// Files of one motion; motion.json is always among them.
enum class OutputFormat {
  kJson,  ///< motion.json
  kGlb,   ///< motion.glb
  kCsv,   ///< motion.csv and contacts.csv
  kUsda,  ///< motion.usda
  kMp4,   ///< motion.mp4
};

/// Which files are written, and how.
struct OutputSettings {
  std::set<OutputFormat> formats = {OutputFormat::kJson, OutputFormat::kGlb, OutputFormat::kMp4};
  FilmOptions film;     ///< of motion.mp4
  bool glbSet = false;  ///< a floor and a light in motion.glb
};

/// Finds motions whose contacts fall on the contacts of the sound (docs/method.md).
/// Errors: kBadInput for anything in the settings that cannot be used; kInterrupted when asked to
/// stop before a motion was found. A search that finds nothing acceptable is no error here.
[[nodiscard]] Result<Synchronization> synchronize(const SynchronizeSettings& settings,
                                                  const Progress& progress = {});

/// The same, written to `folder` (docs/file-formats.md): motion.json, sound.wav, timeline.svg, the
/// object with its mesh, and what `output` names; when several takes are wanted, each goes to
/// take-1/, take-2/ and so on. Files appear only when all is done; those of an earlier run are
/// replaced. Errors: as above, and kBadInput when the folder cannot be written (told before the
/// search).
[[nodiscard]] Result<Synchronization> synchronizeToFolder(const SynchronizeSettings& settings,
                                                          const std::filesystem::path& folder,
                                                          const OutputSettings& output,
                                                          const Progress& progress = {});

}  // namespace ifa
