// SPDX-License-Identifier: Apache-2.0
#include "database/format.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstring>

#include "base/checksum.h"
#include "base/hash.h"
#include "dynamics/simulator.h"

namespace ifa {

static_assert(std::endian::native == std::endian::little);

namespace {

constexpr std::uint64_t kAlignment = 64;
/// More of either is no file of ours; keeps sums of sizes far from overflow.
constexpr std::uint64_t kMost = std::uint64_t{1} << 40;

constexpr std::array<const char*, kSettings> kSettingNames = {
    "restitution",   "friction",     "rolling friction", "spinning friction", "reference impulse",
    "audible share", "merge gap",    "sampling cone",    "least speed",       "largest speed",
    "least spin",    "largest spin", "time limit",       "ODE step"};

std::array<double, kSettings> values(const DatabaseSettings& settings) {
  return std::bit_cast<std::array<double, kSettings>>(settings);
}

std::uint64_t checksumOf(const DatabaseHeader& header) {
  const auto all = header.bytes();
  return Checksum().add(all.first(all.size() - sizeof header.checksum)).value();
}

template <class Value>
std::string told(const char* what, const Value& there, const Value& here) {
  return there == here ? std::string() : fmt::format("{} {} there, {} here", what, there, here);
}

std::string settingsDifference(const DatabaseSettings& there, const DatabaseSettings& here) {
  const auto a = values(there), b = values(here);
  for (std::size_t i = 0; i < kSettings; ++i) {
    if (a[i] != b[i]) return told(kSettingNames[i], a[i], b[i]);
  }
  return {};
}

bool samePlaces(const DatabaseHeader& a, const DatabaseHeader& b) {
  return a.fileBytes == b.fileBytes &&
         std::equal(a.columns.begin(), a.columns.end(), b.columns.begin(),
                    [](const ColumnPlace& x, const ColumnPlace& y) {
                      return x.offset == y.offset && x.bytes == y.bytes;
                    });
}

/// What is wrong with the start of a file before its header can be believed.
Error foreign(const std::array<char, 8>& magic, const std::array<char, 8>& wanted,
              std::string place) {
  if (magic == kPartMagic && wanted == kDatabaseMagic) {
    return {ErrorCode::kBadInput, "is a build that is not done", std::move(place),
            "finish it: the same ifa database build with --resume"};
  }
  return {ErrorCode::kBadInput, "is not an event database", std::move(place),
          "make one: ifa database build"};
}

std::string versionText(std::uint32_t version) {
  return fmt::format("is of {} version {} of the format, this program reads version {}",
                     version < kDatabaseVersion ? "the older" : "the newer", version,
                     kDatabaseVersion);
}

/// What is wrong with a header that is what was written; empty when nothing is.
std::string faultIn(const DatabaseHeader& header, std::uint64_t fileBytes) {
  if (header.identity.simulationVersion != kSimulationVersion) {
    return fmt::format("was simulated by version {} of the kernel, this program has version {}",
                       header.identity.simulationVersion, kSimulationVersion);
  }
  if (header.events > kMost || header.simulations > kMost) return "has impossible counts";
  DatabaseHeader expected = header;
  layOut(expected);
  if (header.magic != kDatabaseMagic) return {};
  if (!samePlaces(header, expected)) return "has columns in impossible places";
  if (fileBytes < header.fileBytes) {
    return fmt::format("is cut off: {} of {} bytes are there", fileBytes, header.fileBytes);
  }
  if (fileBytes > header.fileBytes) {
    return fmt::format("has {} bytes more than it should", fileBytes - header.fileBytes);
  }
  return {};
}

}  // namespace

std::string_view backendName(Backend backend) {
  return backend == Backend::kOde ? "ode" : "native";
}

std::uint64_t hashOf(const Body& body) {
  Hash hash;
  hash.add(body.mass);
  for (const Eigen::Vector3d& vertex : body.hull) {
    hash.add(vertex.x()).add(vertex.y()).add(vertex.z());
  }
  for (const double moment : body.principalMoments) hash.add(moment);
  for (const double entry : body.bodyFromPrincipal.reshaped()) hash.add(entry);
  return hash.value();
}

std::uint64_t hashOf(const DatabaseSettings& settings) {
  Hash hash;
  for (const double value : values(settings)) hash.add(value);
  return hash.value();
}

std::string differenceOf(const DatabaseIdentity& there, const DatabaseIdentity& here) {
  for (const std::string& text :
       {told("simulation version", there.simulationVersion, here.simulationVersion),
        told("backend", backendName(there.backend), backendName(here.backend)),
        told("object", nameIn(there.object), nameIn(here.object)),
        told("surface", nameIn(there.surface), nameIn(here.surface)),
        told("cut", cutName(cutOf(there.settings)), cutName(cutOf(here.settings))),
        settingsDifference(there.settings, here.settings), told("seed", there.seed, here.seed),
        told("number of simulations", there.allSimulations, here.allSimulations)}) {
    if (!text.empty()) return text;
  }
  return there.bodyHash == here.bodyHash ? std::string() : "shape or mass of the body";
}

std::uint64_t columnBytes(std::size_t column, std::uint64_t events, std::uint64_t simulations) {
  if (column == kFirstEvents) return sizeof(std::uint64_t) * (simulations + 1);
  return column == kFlags ? events : sizeof(float) * events;
}

void layOut(DatabaseHeader& header) {
  std::uint64_t offset = sizeof header;
  for (std::size_t i = 0; i < kColumns; ++i) {
    ColumnPlace& place = header.columns[i];
    place.offset = offset;
    place.bytes = columnBytes(i, header.events, header.simulations);
    offset += (place.bytes + kAlignment - 1) / kAlignment * kAlignment;
  }
  header.fileBytes = offset;
}

void seal(DatabaseHeader& header) { header.checksum = checksumOf(header); }

Result<DatabaseHeader> readHeader(std::span<const std::byte> bytes, std::uint64_t fileBytes,
                                  const std::array<char, 8>& magic,
                                  const std::filesystem::path& path) {
  const std::string remedy = "make it again: ifa database build";
  DatabaseHeader header;
  const std::size_t known = std::min(bytes.size(), sizeof header);
  std::memcpy(&header, bytes.data(), known);
  if (known < sizeof header.magic || header.magic != magic) {
    if (known < sizeof header.magic) header.magic = {};
    return tl::unexpected<Error>(foreign(header.magic, magic, path.string()));
  }
  if (known < sizeof header) return badInput("is cut off within its header", path.string(), remedy);
  if (header.version != kDatabaseVersion) {
    return badInput(versionText(header.version), path.string(), remedy);
  }
  if (header.checksum != checksumOf(header) || header.headerBytes != sizeof header) {
    return badInput("has a damaged header", path.string(), remedy);
  }
  if (const std::string fault = faultIn(header, fileBytes); !fault.empty()) {
    return badInput(fault, path.string(), remedy);
  }
  return header;
}

std::string_view nameIn(const std::array<char, 64>& field) {
  return {field.data(),
          static_cast<std::size_t>(std::find(field.begin(), field.end(), '\0') - field.begin())};
}

void setName(std::array<char, 64>& field, std::string_view name) {
  field = {};
  std::copy_n(name.begin(), std::min(name.size(), field.size() - 1), field.begin());
}

}  // namespace ifa
