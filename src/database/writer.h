// SPDX-License-Identifier: Apache-2.0
// Writes an event database: columns grow side by side at their places, and the file gets its name
// when it is whole.
#pragma once

#include <array>
#include <filesystem>
#include <span>
#include <vector>

#include "base/checksum.h"
#include "base/raw_file.h"
#include "database/format.h"

namespace ifa {

/// Events of simulations that follow each other.
struct EventBlock {
  std::uint64_t firstSimulation = 0;
  std::vector<std::uint32_t> counts;  ///< events of each simulation
  std::vector<EventRecord> records;
};

/// What a block holds of column `column` (under kFirstEvents), as the file has it.
[[nodiscard]] std::vector<std::byte> columnOf(const EventBlock& block, std::size_t column);

/// Writes `path`.new and renames it. The caller holds the FileLock of `path`. Unless finished, the
/// temporary is removed. Not thread safe.
class DatabaseWriter {
 public:
  /// @param header  identity and counts; the rest is filled in
  [[nodiscard]] static Result<DatabaseWriter> create(const std::filesystem::path& path,
                                                     const DatabaseHeader& header);

  DatabaseWriter(DatabaseWriter&& other) noexcept = default;
  DatabaseWriter& operator=(DatabaseWriter&&) = delete;
  ~DatabaseWriter();

  /// Appends to a column other than kFirstEvents.
  [[nodiscard]] Result<void> append(std::size_t column, std::span<const std::byte> bytes);
  /// Appends simulations to the table of their first events.
  [[nodiscard]] Result<void> appendCounts(std::span<const std::uint32_t> counts);
  /// Writes checksums and header, waits for the disk, and renames. Everything that the header
  /// counts must have been appended.
  [[nodiscard]] Result<void> finish();

 private:
  DatabaseWriter(std::filesystem::path path, const DatabaseHeader& header, RawFile file);
  [[nodiscard]] Result<void> put(std::size_t column, std::span<const std::byte> bytes);

  std::filesystem::path path_;
  DatabaseHeader header_;
  RawFile file_;
  std::array<Checksum, kColumns> checksums_;
  std::array<std::uint64_t, kColumns> written_{};  ///< bytes
  std::uint64_t nextEvent_ = 0;                    ///< first event of the next simulation
};

}  // namespace ifa
