// SPDX-License-Identifier: Apache-2.0
// An event database on disk, looked at through the memory map. docs/database.md.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>

#include "base/progress.h"
#include "database/format.h"

namespace ifa {

/// Which simulation an event belongs to, and its number in it.
struct EventName {
  std::uint64_t simulation = 0;  ///< in the whole database, also where the file is a shard
  std::uint64_t event = 0;
};

/// Read only; copies share the map. Thread safe. The file must not be shortened meanwhile;
/// replacing it (as a build does) is no harm.
class EventDatabase {
 public:
  /// Maps the file and checks its header, in a time that does not depend on its size. Errors:
  /// kBadInput when it is missing, foreign, older, cut off, or has a damaged header.
  [[nodiscard]] static Result<EventDatabase> open(const std::filesystem::path& path);

  /// Reads everything: checksums of all columns, and that the table of simulations makes sense.
  /// Reports as "check". Errors: kBadInput naming the column, kInterrupted.
  [[nodiscard]] Result<void> check(const Progress& progress = {}) const;

  /// Whether it was made of this very body. Errors: kBadInput that says so.
  [[nodiscard]] Result<void> checkBody(const Body& body) const;
  /// Whether it is what `wanted` says in all respects. Errors: kBadInput with the first difference.
  [[nodiscard]] Result<void> checkIdentity(const DatabaseIdentity& wanted) const;

  [[nodiscard]] const DatabaseHeader& header() const { return header_; }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] std::size_t events() const { return header_.events; }
  [[nodiscard]] std::size_t simulations() const { return header_.simulations; }
  /// Tells this database from any other, also from one that is damaged on disk but for --check.
  [[nodiscard]] std::uint64_t hash() const { return header_.checksum; }

  /// One value an event, 64-byte aligned, events in order of (simulation, event).
  /// @param column  under kFlags
  [[nodiscard]] std::span<const float> values(Column column) const;
  /// EventRecord::Flag, one byte an event.
  [[nodiscard]] std::span<const std::uint8_t> flags() const;
  /// Event `i`, all of it. @param i  under events()
  [[nodiscard]] EventRecord record(std::size_t i) const;
  /// First event of the file's simulation `k`; for k = simulations(): events(). Never beyond
  /// events(), even in a damaged file.
  [[nodiscard]] std::size_t firstEvent(std::size_t k) const;
  [[nodiscard]] EventName nameOf(std::size_t event) const;
  /// A column as it lies in the file, with or without the zeros that fill it up.
  [[nodiscard]] std::span<const std::byte> bytes(std::size_t column, bool filledUp = false) const;

 private:
  EventDatabase(std::filesystem::path path, const DatabaseHeader& header,
                std::shared_ptr<const std::byte> map)
      : path_(std::move(path)), header_(header), map_(std::move(map)) {}

  std::filesystem::path path_;
  DatabaseHeader header_;
  std::shared_ptr<const std::byte> map_;
};

}  // namespace ifa
