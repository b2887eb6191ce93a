// SPDX-License-Identifier: Apache-2.0
// What a build has simulated so far: blocks of simulations, each with its checksum, in the file
// `database`.part. A build that was killed goes on after the last whole block.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>

#include "base/raw_file.h"
#include "database/format.h"
#include "database/writer.h"

namespace ifa {

/// The part file of a database.
[[nodiscard]] std::filesystem::path journalPath(const std::filesystem::path& database);

/// Not thread safe; the caller holds the FileLock of the database.
class Journal {
 public:
  /// Starts an empty one, whatever is there.
  /// @param header  identity and range of simulations
  [[nodiscard]] static Result<Journal> create(const std::filesystem::path& database,
                                              const DatabaseHeader& header);
  /// Takes up the one that is there, cut back to its last whole block; nothing where there is
  /// none, or only the torn beginning of one. Errors: kBadInput when it is foreign or of another
  /// build, with the difference.
  [[nodiscard]] static Result<std::optional<Journal>> resume(const std::filesystem::path& database,
                                                             const DatabaseHeader& header);

  /// The next simulations. On an error the file is cut back to what was whole.
  [[nodiscard]] Result<void> append(const EventBlock& block);
  /// Simulations so far, the first ones of the range.
  [[nodiscard]] std::uint64_t simulations() const { return header_.simulations; }
  [[nodiscard]] std::uint64_t events() const { return header_.events; }

  /// Makes the database of what is here: header and columns, then the rename.
  /// @param report  told the share that is done
  [[nodiscard]] Result<void> assemble(const std::filesystem::path& database,
                                      const std::function<void(double)>& report) const;
  /// Removes the file.
  void remove();

 private:
  struct BlockHead;

  Journal(const DatabaseHeader& header, RawFile file)
      : header_(header), file_(std::move(file)), end_(sizeof header) {}
  [[nodiscard]] Result<void> findEnd();
  [[nodiscard]] Result<std::optional<EventBlock>> readBlock(std::uint64_t offset,
                                                            std::uint64_t fileBytes,
                                                            std::uint64_t simulations) const;

  DatabaseHeader header_;  ///< counts what is here
  RawFile file_;
  std::uint64_t end_;  ///< of the last whole block, bytes
};

}  // namespace ifa
