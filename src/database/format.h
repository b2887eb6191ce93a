// SPDX-License-Identifier: Apache-2.0
// Layout of an event database file (docs/database.md): a header of 4096 bytes, then columns.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "body/body.h"
#include "ifa/event_cut.h"
#include "ifa/result.h"
#include "model/event_record.h"

namespace ifa {

/// Raised with every change of the layout.
inline constexpr std::uint32_t kDatabaseVersion = 1;

/// Who simulated.
enum class Backend : std::uint32_t { kNative = 0, kOde = 1 };
/// "native" or "ode".
[[nodiscard]] std::string_view backendName(Backend backend);

/// What the simulations depend on besides the body. Doubles only: a change of any is another file.
struct DatabaseSettings {
  double restitution = 0, friction = 0, rollingFriction = 0, spinningFriction = 0;
  double referenceImpulse = 0;    ///< J_ref, N s
  double audibleShare = 0;        ///< of J_ref; 0: the paper's cut
  double mergeGap = 0;            ///< s
  double coneDegrees = 0;         ///< of the sampled velocities
  std::array<double, 2> speed{};  ///< sampled, m/s
  std::array<double, 2> spin{};   ///< sampled, rad/s
  double timeLimit = 0;           ///< of a simulation, s
  double odeStep = 0;             ///< s; 0: native
};
/// What its events are.
[[nodiscard]] constexpr EventCut cutOf(const DatabaseSettings& settings) {
  return settings.audibleShare > 0 ? EventCut::kAudible : EventCut::kPaper;
}
inline constexpr std::size_t kSettings = sizeof(DatabaseSettings) / sizeof(double);

/// The columns: first what EventRecord's floats are, in its order, then flags and the table of
/// simulations.
inline constexpr std::size_t kColumns = EventRecord::kFloats + 2;
enum Column : std::size_t {
  kBeforeHeight,
  kBeforeW,
  kBeforeX,
  kBeforeY,
  kBeforeZ,
  kBeforeVelocityX,
  kBeforeVelocityY,
  kBeforeVelocityZ,
  kBeforeSpinX,
  kBeforeSpinY,
  kBeforeSpinZ,
  kAfterHeight,
  kAfterW,
  kAfterX,
  kAfterY,
  kAfterZ,
  kAfterVelocityX,
  kAfterVelocityY,
  kAfterVelocityZ,
  kAfterSpinX,
  kAfterSpinY,
  kAfterSpinZ,
  kShiftX,
  kShiftY,
  kDuration,
  kAmplitude,
  kCentroid,
  kGap,
  kNextX,
  kNextY,
  kFlags,       ///< one byte an event
  kFirstEvents  ///< 8 bytes a simulation: number of its first event; one more at the end
};
static_assert(kFlags == EventRecord::kFloats && kFirstEvents + 1 == kColumns);

/// Where a column lies in the file.
struct ColumnPlace {
  std::uint64_t offset = 0;    ///< bytes from the file's start, a multiple of 64
  std::uint64_t bytes = 0;     ///< without the zeros that fill it up to a multiple of 64
  std::uint64_t checksum = 0;  ///< of the bytes and those zeros
};

/// What two files must agree in to be shards of one database.
struct DatabaseIdentity {
  std::uint32_t simulationVersion = 0;
  Backend backend = Backend::kNative;
  std::uint64_t seed = 0;
  std::uint64_t allSimulations = 0;  ///< of the whole database, 0 to this - 1
  std::uint64_t bodyHash = 0, settingsHash = 0;
  DatabaseSettings settings;
  std::array<char, 64> object{}, surface{};  ///< names, for people; cut to 63 bytes
};

/// The first 4096 bytes of a file, little-endian.
struct DatabaseHeader {
  std::array<char, 8> magic{};
  std::uint32_t version = kDatabaseVersion;
  std::uint32_t headerBytes = 4096;
  DatabaseIdentity identity;
  std::uint64_t firstSimulation = 0;  ///< the file holds this ...
  std::uint64_t simulations = 0;      ///< ... and so many that follow
  std::uint64_t events = 0;
  std::uint64_t fileBytes = 0;
  std::array<ColumnPlace, kColumns> columns{};
  std::array<std::byte, 2992> zeros{};
  std::uint64_t checksum = 0;  ///< of all before it

  [[nodiscard]] std::span<const std::byte> bytes() const {
    return std::as_bytes(std::span(this, 1));
  }
};
static_assert(sizeof(DatabaseHeader) == 4096);

inline constexpr std::array<char, 8> kDatabaseMagic = {'I', 'F', 'A', 'E', 'V', 'E', 'N', 'T'};
/// Of a build that is not done.
inline constexpr std::array<char, 8> kPartMagic = {'I', 'F', 'A', 'P', 'A', 'R', 'T', '\0'};

/// Hash of what physics sees of a body.
[[nodiscard]] std::uint64_t hashOf(const Body& body);
[[nodiscard]] std::uint64_t hashOf(const DatabaseSettings& settings);

/// The first difference, told for people ("seed 1 there, 2 here"); empty when there is none.
[[nodiscard]] std::string differenceOf(const DatabaseIdentity& there, const DatabaseIdentity& here);

/// Bytes of column `column` with so many events and simulations, without what fills it up.
[[nodiscard]] std::uint64_t columnBytes(std::size_t column, std::uint64_t events,
                                        std::uint64_t simulations);
/// Sets the columns' places and fileBytes from the counts. Leaves the checksums.
void layOut(DatabaseHeader& header);
/// Sets the header's checksum.
void seal(DatabaseHeader& header);

/// Reads the header at `bytes` (at least 4096) of a file of `fileBytes` bytes. Errors tell a
/// foreign, older, newer, damaged file and a finished or unfinished one where the other is wanted;
/// columns are sure to lie in the file.
[[nodiscard]] Result<DatabaseHeader> readHeader(std::span<const std::byte> bytes,
                                                std::uint64_t fileBytes,
                                                const std::array<char, 8>& magic,
                                                const std::filesystem::path& path);

/// What the name fields hold.
[[nodiscard]] std::string_view nameIn(const std::array<char, 64>& field);
void setName(std::array<char, 64>& field, std::string_view name);

}  // namespace ifa
