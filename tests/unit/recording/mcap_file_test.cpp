// What fits into a file of MCAP; what tools read from one is tested from outside.
#include "record/use/mcap_file.h"

#include <catch2/catch.hpp>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>

#include "base/compression/decompressed.h"

namespace lockstep::host {
namespace {

// --- a judge of files, written from the specification of MCAP (https://mcap.dev/spec), slow ---

std::uint32_t crc32(std::string_view bytes) {
  std::uint32_t sum = 0xffffffff;
  for (const char byte : bytes) {
    sum ^= static_cast<unsigned char>(byte);
    for (int bit = 0; bit < 8; ++bit) sum = sum >> 1u ^ ((sum & 1u) != 0 ? 0xedb88320u : 0u);
  }
  return ~sum;
}

template <class Number>
Number number_at(std::string_view bytes, std::size_t at) {
  Number number{};
  if (at + sizeof number > bytes.size()) throw std::out_of_range("a number");
  std::memcpy(&number, bytes.data() + at, sizeof number);
  return number;
}

std::string decompressed(std::string_view frame) {
  std::istringstream in{std::string(frame)};
  Decompressed buffer(*in.rdbuf());
  std::istream text(&buffer);
  text.exceptions(std::ios::badbit);
  return {std::istreambuf_iterator<char>(text), {}};
}

bool is_good_chunk(std::string_view content) {
  try {
    const auto size = number_at<std::uint64_t>(content, 16);
    const auto sum = number_at<std::uint32_t>(content, 24);
    if (number_at<std::uint32_t>(content, 28) != 4 || content.substr(32, 4) != "zstd") return false;
    if (number_at<std::uint64_t>(content, 36) != content.size() - 44) return false;
    const std::string records = decompressed(content.substr(44));
    return records.size() == size && crc32(records) == sum;
  } catch (const std::exception&) {  // it is too short, or cannot be decompressed
    return false;
  }
}

struct Record {
  std::size_t at = 0, size = 0;
  std::uint8_t opcode = 0;
};

// The parts of a file; the first record that is none is the last.
std::vector<Record> records_of(std::string_view file) {
  std::vector<Record> records;
  for (std::size_t at = 8; at + 9 <= file.size() - 8;) {
    const auto size = number_at<std::uint64_t>(file, at + 1);
    if (size > file.size() - 8 - 9 - at) break;
    records.push_back(
        {at, static_cast<std::size_t>(size) + 9, static_cast<std::uint8_t>(file[at])});
    at += records.back().size;
  }
  return records;
}

constexpr std::uint8_t kFooter = 0x02, kChunk = 0x06, kDataEnd = 0x0f;

// What a reader that looks at all sums reports: "": nothing is damaged.
std::string damage(std::string_view file) {
  constexpr std::string_view kMagic{"\x89MCAP0\r\n", 8};
  if (!file.starts_with(kMagic)) return "begin";
  if (!file.ends_with(kMagic)) return "end";
  const std::vector<Record> records = records_of(file);
  if (records.empty() || records.back().at + records.back().size != file.size() - 8 ||
      records.back().opcode != kFooter || records.back().size != 29) {
    return "records";
  }
  std::optional<std::size_t> data_end;
  int chunk = 0;
  for (const Record& it : records) {
    if (it.opcode == kChunk && !is_good_chunk(file.substr(it.at + 9, it.size - 9))) {
      return "chunk " + std::to_string(chunk);
    }
    if (it.opcode == kChunk) ++chunk;
    if (it.opcode == kDataEnd && it.size == 13) data_end = it.at;
  }
  if (!data_end) return "records";
  if (number_at<std::uint32_t>(file, *data_end + 9) != crc32(file.substr(0, *data_end)))
    return "data";
  const std::size_t footer = records.back().at + 9, summary = *data_end + 13;
  if (number_at<std::uint64_t>(file, footer) != summary ||
      number_at<std::uint32_t>(file, footer + 16) !=
          crc32(file.substr(summary, footer + 16 - summary))) {
    return "summary";
  }
  return "";
}

TEST_CASE("each flipped bit of a file of MCAP is found by its sums, and where it is") {
  std::string text;
  const ExportSink sink = [&](std::string_view more) {
    text += more;
    return true;
  };
  McapFile file("test", sink);
  const std::uint16_t channel = file.add_channel(file.add_schema("Number", "{}"), "/number");
  const std::uint16_t other = file.add_channel(file.add_schema("Flag", "{}"), "/flag");
  for (int chunk = 0; chunk < 3; ++chunk) {
    for (std::uint64_t i = 0; i < 4; ++i) {
      file.add(channel, 10 * chunk + i, "{\"value\":" + std::to_string(i) + "}");
    }
    file.add(other, 10 * chunk + 5, "{\"value\":true}");
    file.end_chunk();
  }
  REQUIRE(file.finish());
  REQUIRE(damage(text).empty());
  std::vector<std::string> parts(text.size(), "summary");
  int chunk = 0;
  bool is_data = true;
  for (const Record& it : records_of(text)) {
    const bool is_chunk = it.opcode == kChunk;
    const std::string part = is_chunk  ? "chunk " + std::to_string(chunk++)
                             : is_data ? "data"
                                       : "summary";
    is_data = is_data && it.opcode != kDataEnd;
    for (std::size_t at = it.at; at < it.at + it.size; ++at) {
      // What begins a record says where the next one is. A chunk's times are of the data's sum.
      const bool is_head = at < it.at + 9;
      parts[at] = is_head ? "records" : is_chunk && at < it.at + 25 ? "data" : part;
    }
  }
  std::fill_n(parts.begin(), 8, "begin");
  std::fill_n(parts.end() - 8, 8, "end");
  REQUIRE(chunk == 3);
  for (std::size_t at = 0; at < text.size(); ++at) {
    for (unsigned bit = 0; bit < 8; ++bit) {
      std::string flipped = text;
      flipped[at] = static_cast<char>(static_cast<unsigned char>(flipped[at]) ^ 1u << bit);
      const std::string found = damage(flipped);
      INFO("byte " << at << ", bit " << bit << ": " << found);
      CHECK_FALSE(found.empty());
      // Some bits of a frame do not matter for its text: then it is the sum of all data.
      const bool may_be_data = parts[at].starts_with("chunk") && found == "data";
      if (parts[at] != "records" && !may_be_data) CHECK(found == parts[at]);
    }
  }
}

TEST_CASE("a file of MCAP has up to 65 536 channels") {
  std::size_t bytes = 0;
  const ExportSink sink = [&](std::string_view more) {
    bytes += more.size();
    return true;
  };
  McapFile file("test", sink);
  const std::uint16_t schema = file.add_schema("Number", "{}");
  std::uint16_t last = 0;
  for (std::uint32_t i = 0; i <= UINT16_MAX; ++i) last = file.add_channel(schema, "/number");
  CHECK(last == UINT16_MAX);
  file.add(last, 1, "{}");
  CHECK(file.finish());
  CHECK(bytes > 0);
  CHECK_THROWS_AS(file.add_channel(schema, "/one_more"), std::runtime_error);
}

}  // namespace
}  // namespace lockstep::host
