// SPDX-License-Identifier: Apache-2.0
// `ifa evaluate`: a set of cases, synchronised one by one, and the table of what came out
// (docs/evaluation.md).
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "ifa/progress.h"
#include "ifa/result.h"
#include "ifa/synchronize.h"

namespace ifa {

enum class Parity { kEven, kOdd };

struct EvaluateSettings {
  std::string label;             ///< what reports call these settings; empty: made of them
  std::filesystem::path folder;  ///< one folder per object in it, named NAME or NAME@SURFACE
  std::string planner = "hybrid";
  GraphOptions graph;  ///< for "graph"; a database that is named serves one object
  std::uint64_t seed = 1;
  double timeLimitSeconds = 0;  ///< per case; 0: never
  double restitutionScale = 1;  ///< plans with so many times the objects' restitution, up to 0.95
  bool fit = false;             ///< looks for the restitution (docs/fitting.md)
  std::vector<OrientationWish> orientations;  ///< of every case (docs/controls.md)
  int jobs = 1;                               ///< cases at a time; each uses all cores by itself
  std::size_t limit = 0;                      ///< cases per object folder, the first ones; 0: all
  std::optional<Parity> parity;               ///< only cases whose name ends in such a number
};

/// One case: a sound with its labels, or a signature alone.
struct EvaluationCase {
  std::string object, surface;  ///< surface empty: the object's default
  std::string name;
  std::filesystem::path sound;   ///< NAME.wav (or another sound), NAME.signature.json or .mid
  std::filesystem::path labels;  ///< NAME.txt; empty for contacts alone
  std::filesystem::path places;  ///< NAME.json with known positions; empty where there is none
};

/// A contact event that lasts: the sound's beside the motion's. Seconds, centroids after the start.
struct ContinuousContact {
  double targetDuration = 0, duration = 0;
  double targetCentroid = 0, centroid = 0;
};

/// How far a motion's contacts begin from their known places, seen from above, m (IFA, Table 2).
struct PlaceErrors {
  double mean = 0, largest = 0;
  double longestSide = 0;  ///< of the box around the known places
};

/// What came out of a case.
struct CaseOutcome {
  EvaluationCase what;
  bool solved = false;  ///< docs/method.md 4
  bool done = false;    ///< false: not begun, or cut off by an interruption
  std::string failure;  ///< why it is not solved
  int contacts = 0;     ///< n, events of the filtered signature
  double score = 0, scoreWithoutSound = 0, meanFv = 0;
  double searchSeconds = 0;                      ///< of the planner
  double wallSeconds = 0;                        ///< from reading the sound to the audited motion
  double givenRestitution = 0, restitution = 0;  ///< planned with; as fitted, if that was asked for
  double startError = 0;                         ///< largest |contact start - target|, s
  std::vector<double> bends;                     ///< of every contact
  std::vector<double> arrivalBends;              ///< likewise
  std::vector<ContactFactors> factors;           ///< likewise
  std::vector<ContinuousContact> continuous;     ///< of the contacts whose sound lasts
  std::optional<PlaceErrors> places;             ///< where they were known
  std::vector<double> orientationErrors;         ///< of each wish, rad
  std::int64_t events = -1;                      ///< in the database; negative: none was used
  double goodSeconds = -1;  ///< until Score 0.3 was reached ("graph"); negative: it was not
};

/// Rows of the table. Score, f_v, bend and search are over the solved cases, as in the paper; the
/// wall times over all.
struct EvaluationRow {
  std::string name;  ///< "d6 (desk)", or "all"
  int cases = 0, solved = 0;
  double meanContacts = 0;
  double meanSearchSeconds = 0;
  double meanScore = 0;
  double meanFv = 0;  ///< geometric, over all contacts
  double bendMedian = 0, bendShareUpToOne = 0, bendMax = 0;
  std::int64_t events = -1;          ///< in the database; negative: none was used
  int good = 0;                      ///< cases that reached Score 0.3 ("graph") ...
  double meanGoodSeconds = 0;        ///< ... and how soon, s
  double meanScoreWithoutSound = 0;  ///< eq. 13
  double arrivalBendMedian = 0, arrivalBendMax = 0;
  double wallMedian = 0, wallP95 = 0;  ///< s
};

struct Evaluation {
  EvaluateSettings settings;
  std::vector<CaseOutcome> cases;   ///< those that were done
  std::vector<EvaluationRow> rows;  ///< per object folder
  EvaluationRow total;
  bool interrupted = false;
};

/// The cases of the set, in natural order (d6 before d10). Errors: kBadInput when the folder is not
/// there, holds no case, or none that the settings choose.
[[nodiscard]] Result<std::vector<EvaluationCase>> findCases(const EvaluateSettings& settings);

/// Runs all cases. A case that fails, for whatever reason, is a row of the table and no error.
/// Stops early when asked to, with what is done.
/// @param tell  called after each case, by one thread at a time; may be empty
[[nodiscard]] Result<Evaluation> evaluate(const EvaluateSettings& settings,
                                          const Progress& progress,
                                          const std::function<void(const CaseOutcome&)>& tell = {});

/// The row that sums up `cases`.
[[nodiscard]] EvaluationRow summarize(std::string name, const std::vector<CaseOutcome>& cases);

/// The cases as an evaluation, with its rows and total. Rows of the paper's Table 1 come in its
/// order, others before them as they are.
[[nodiscard]] Evaluation sumUp(EvaluateSettings settings, std::vector<CaseOutcome> cases);

}  // namespace ifa
