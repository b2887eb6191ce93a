// SPDX-License-Identifier: Apache-2.0
#include "database/journal.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <numeric>
#include <system_error>

namespace ifa {

namespace fs = std::filesystem;

/// Before each block. The checksum is of the fields before it and of the block.
struct Journal::BlockHead {
  std::uint64_t simulations = 0, events = 0, firstSimulation = 0, checksum = 0;

  [[nodiscard]] std::uint64_t bytes() const {
    return simulations * sizeof(std::uint32_t) + events * sizeof(EventRecord);
  }
  [[nodiscard]] std::uint64_t checksumWith(std::span<const std::byte> block) const {
    const std::array fields = {simulations, events, firstSimulation};
    return Checksum().add(std::as_bytes(std::span(fields))).add(block).value();
  }
};

namespace {

/// More simulations than a block ever has.
constexpr std::uint64_t kMostSimulations = 1 << 20;

std::vector<std::byte> bytesOf(const EventBlock& block) {
  const auto counts = std::as_bytes(std::span(block.counts));
  const auto records = std::as_bytes(std::span(block.records));
  std::vector<std::byte> bytes(counts.begin(), counts.end());
  bytes.insert(bytes.end(), records.begin(), records.end());
  return bytes;
}

/// The header that a part file of this build begins with.
DatabaseHeader startOf(const DatabaseHeader& header) {
  DatabaseHeader start;
  start.magic = kPartMagic;
  start.identity = header.identity;
  start.firstSimulation = header.firstSimulation;
  start.simulations = header.simulations;
  seal(start);
  return start;
}

std::string rangeText(const DatabaseHeader& header) {
  return std::to_string(header.firstSimulation) + " to " +
         std::to_string(header.firstSimulation + header.simulations - 1);
}

std::string difference(const DatabaseHeader& there, const DatabaseHeader& here) {
  const std::string text = differenceOf(there.identity, here.identity);
  if (!text.empty()) return text;
  if (there.firstSimulation == here.firstSimulation && there.simulations == here.simulations) {
    return {};
  }
  return "simulations " + rangeText(there) + " there, " + rangeText(here) + " here";
}

}  // namespace

fs::path journalPath(const fs::path& database) { return database.string() + ".part"; }

Result<Journal> Journal::create(const fs::path& database, const DatabaseHeader& header) {
  auto file = RawFile::open(journalPath(database), RawFile::Mode::kReplace);
  if (!file) return tl::unexpected(file.error());
  DatabaseHeader start = startOf(header);
  if (auto written = file->write(start.bytes(), 0); !written) {
    return tl::unexpected(written.error());
  }
  start.simulations = 0;
  return Journal(start, std::move(*file));
}

Result<std::optional<Journal>> Journal::resume(const fs::path& database,
                                               const DatabaseHeader& header) {
  const fs::path path = journalPath(database);
  std::error_code code;
  const auto known = fs::file_size(path, code);
  // Killed before its header was whole, it holds nothing.
  if (code || known < sizeof(DatabaseHeader)) return std::nullopt;
  auto file = RawFile::open(path, RawFile::Mode::kUpdate);
  if (!file) return tl::unexpected(file.error());
  std::array<std::byte, sizeof(DatabaseHeader)> bytes{};
  if (auto read = file->read(bytes, 0); !read) return tl::unexpected(read.error());
  auto start = readHeader(bytes, known, kPartMagic, path);
  if (!start) {
    start.error().remedy = "remove it, and build anew";
    return tl::unexpected(start.error());
  }
  if (const std::string text = difference(*start, startOf(header)); !text.empty()) {
    return badInput("is of another build: " + text, path.string(),
                    "build with what that one was made with, or remove it");
  }
  start->simulations = start->events = 0;
  Journal journal(*start, std::move(*file));
  if (auto found = journal.findEnd(); !found) return tl::unexpected(found.error());
  return journal;
}

/// Walks over the whole blocks and cuts off what is behind.
Result<void> Journal::findEnd() {
  const auto fileBytes = file_.size();
  if (!fileBytes) return tl::unexpected(fileBytes.error());
  while (true) {
    const auto block = readBlock(end_, *fileBytes, header_.simulations);
    if (!block) return tl::unexpected(block.error());
    if (!*block) return end_ < *fileBytes ? file_.resize(end_) : Result<void>();
    header_.simulations += (*block)->counts.size();
    header_.events += (*block)->records.size();
    end_ += sizeof(BlockHead) + bytesOf(**block).size();
  }
}

/// The block at `offset`, or nothing where it is not whole or not the one that comes next.
Result<std::optional<EventBlock>> Journal::readBlock(std::uint64_t offset, std::uint64_t fileBytes,
                                                     std::uint64_t simulations) const {
  std::array<BlockHead, 1> heads{};
  const BlockHead& head = heads[0];
  if (fileBytes - offset < sizeof head) return std::nullopt;
  if (auto read = file_.read(std::as_writable_bytes(std::span(heads)), offset); !read) {
    return tl::unexpected(read.error());
  }
  const std::uint64_t room = fileBytes - offset - sizeof head;
  if (head.simulations == 0 || head.simulations > kMostSimulations ||
      head.events > room / sizeof(EventRecord) || head.bytes() > room ||
      head.firstSimulation != header_.firstSimulation + simulations) {
    return std::nullopt;
  }
  std::vector<std::byte> bytes(head.bytes());
  if (auto read = file_.read(bytes, offset + sizeof head); !read) {
    return tl::unexpected(read.error());
  }
  if (head.checksumWith(bytes) != head.checksum) return std::nullopt;
  EventBlock block;
  block.firstSimulation = head.firstSimulation;
  block.counts.resize(head.simulations);
  block.records.resize(head.events);
  const std::size_t cut = head.simulations * sizeof(std::uint32_t);
  std::memcpy(block.counts.data(), bytes.data(), cut);
  // No events is no memory to copy to.
  if (head.events > 0) std::memcpy(block.records.data(), bytes.data() + cut, bytes.size() - cut);
  return block;
}

Result<void> Journal::append(const EventBlock& block) {
  const std::vector<std::byte> bytes = bytesOf(block);
  std::array<BlockHead, 1> heads = {
      BlockHead{block.counts.size(), block.records.size(), block.firstSimulation, 0}};
  heads[0].checksum = heads[0].checksumWith(bytes);
  auto written = file_.write(std::as_bytes(std::span(heads)), end_);
  if (written) written = file_.write(bytes, end_ + sizeof(BlockHead));
  if (!written) {
    (void)file_.resize(end_);
    return written;
  }
  end_ += sizeof(BlockHead) + bytes.size();
  header_.simulations += block.counts.size();
  header_.events += block.records.size();
  return {};
}

Result<void> Journal::assemble(const fs::path& database,
                               const std::function<void(double)>& report) const {
  auto writer = DatabaseWriter::create(database, header_);
  if (!writer) return tl::unexpected(writer.error());
  std::uint64_t simulations = 0;
  for (std::uint64_t offset = sizeof(DatabaseHeader); offset < end_;) {
    const auto block = readBlock(offset, end_, simulations);
    if (!block) return tl::unexpected(block.error());
    if (!*block) return badInput("was changed while it was read", file_.path().string());
    for (std::size_t column = 0; column < kFirstEvents; ++column) {
      if (auto put = writer->append(column, columnOf(**block, column)); !put) return put;
    }
    if (auto put = writer->appendCounts((*block)->counts); !put) return put;
    simulations += (*block)->counts.size();
    offset += sizeof(BlockHead) + bytesOf(**block).size();
    report(static_cast<double>(offset) / static_cast<double>(end_));
  }
  return writer->finish();
}

void Journal::remove() {
  std::error_code ignored;
  fs::remove(file_.path(), ignored);
}

}  // namespace ifa
