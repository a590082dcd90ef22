#include "record/use/mcap_file.h"

#include <zlib.h>

#include <stdexcept>
#include <utility>

#include "base/compression/whole_frame.h"

namespace lockstep::host {
namespace {

// The section "Opcodes" of the specification has them.
enum class Opcode : std::uint8_t {
  Header = 0x01,
  Footer = 0x02,
  Schema = 0x03,
  Channel = 0x04,
  Message = 0x05,
  Chunk = 0x06,
  MessageIndex = 0x07,
  ChunkIndex = 0x08,
  Statistics = 0x0B,
  SummaryOffset = 0x0E,
  DataEnd = 0x0F,
};

constexpr std::string_view kMagic{"\x89MCAP0\r\n", 8};

// Continues the sum of the bytes before them; 0: there are none.
std::uint32_t crc32_of(std::string_view bytes, std::uint32_t before = 0) {
  return static_cast<std::uint32_t>(
      crc32_z(before, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

// Little-endian, as all numbers.
template <class Number>
void put_number(std::string& to, Number number) {
  for (std::size_t i = 0; i < sizeof number; ++i) {
    to += static_cast<char>(static_cast<std::uint64_t>(number) >> (8 * i));
  }
}

void put_text(std::string& to, std::string_view text) {
  put_number(to, static_cast<std::uint32_t>(text.size()));
  to += text;
}

std::string record(Opcode opcode, std::string_view content) {
  std::string bytes(1, static_cast<char>(opcode));
  put_number(bytes, static_cast<std::uint64_t>(content.size()));
  return bytes += content;
}

// A map or a list: how many bytes, then the bytes.
void put_list(std::string& to, std::string_view items) {
  put_text(to, items);
}

}  // namespace

McapFile::McapFile(std::string_view library, const ExportSink& write) : write_(write) {
  std::string header;
  put_text(header, "");  // profile: none
  put_text(header, library);
  put(std::string(kMagic) + record(Opcode::Header, header));
}

std::uint16_t McapFile::add_schema(std::string_view name, std::string_view json_schema) {
  const auto number = static_cast<std::uint16_t>(schemas_.size() + 1);  // 0 is none
  std::string content;
  put_number(content, number);
  put_text(content, name);
  put_text(content, "jsonschema");
  put_text(content, json_schema);
  schemas_.push_back(record(Opcode::Schema, content));
  return number;
}

std::uint16_t McapFile::add_channel(std::uint16_t schema, std::string_view topic) {
  if (channels_.size() > UINT16_MAX) throw std::runtime_error("more channels than MCAP can have");
  const auto number = static_cast<std::uint16_t>(channels_.size());
  std::string content;
  put_number(content, number);
  put_number(content, schema);
  put_text(content, topic);
  put_text(content, "json");
  put_list(content, "");  // metadata
  channels_.push_back({.schema = schema, .record = record(Opcode::Channel, content)});
  return number;
}

void McapFile::add(std::uint16_t channel, std::uint64_t time, std::string_view json) {
  Channel& it = channels_[channel];
  if (chunk_.empty()) open_ = {.begin = time};
  if (!std::exchange(it.is_in_chunk, true)) chunk_ += schemas_[it.schema - 1u] + it.record;
  it.index.emplace_back(time, chunk_.size());
  std::string content;
  put_number(content, channel);
  put_number(content, it.messages++);
  put_number(content, time);  // when it was logged, and published
  put_number(content, time);
  content += json;
  chunk_ += record(Opcode::Message, content);
  if (!std::exchange(has_messages_, true)) first_time_ = time;
  last_time_ = open_.end = time;
  if (chunk_.size() >= kChunk) end_chunk();
}

void McapFile::end_chunk() {
  if (chunk_.empty()) return;
  const std::string frame = zstd_frame(chunk_);
  std::string content;
  put_number(content, open_.begin);
  put_number(content, open_.end);
  put_number(content, static_cast<std::uint64_t>(chunk_.size()));
  put_number(content, crc32_of(chunk_));
  put_text(content, "zstd");
  put_number(content, static_cast<std::uint64_t>(frame.size()));
  content += frame;
  open_.offset = position_;
  open_.compressed = frame.size();
  open_.size = chunk_.size();
  put(record(Opcode::Chunk, content));
  open_.length = position_ - open_.offset;
  for (std::size_t number = 0; number < channels_.size(); ++number) {
    Channel& it = channels_[number];
    it.is_in_chunk = false;
    if (it.index.empty()) continue;
    open_.indexes[static_cast<std::uint16_t>(number)] = position_;
    std::string entries, index;
    for (const auto& [time, offset] : it.index) {
      put_number(entries, time);
      put_number(entries, offset);
    }
    it.index.clear();
    put_number(index, static_cast<std::uint16_t>(number));
    put_list(index, entries);
    put(record(Opcode::MessageIndex, index));
  }
  open_.index_length = position_ - open_.offset - open_.length;
  chunks_.push_back(std::move(open_));
  chunk_.clear();
}

std::string McapFile::statistics() const {
  std::uint64_t messages = 0;
  std::string counts, content;
  for (std::size_t number = 0; number < channels_.size(); ++number) {
    messages += channels_[number].messages;
    if (channels_[number].messages == 0) continue;
    put_number(counts, static_cast<std::uint16_t>(number));
    put_number(counts, static_cast<std::uint64_t>(channels_[number].messages));
  }
  put_number(content, messages);
  put_number(content, static_cast<std::uint16_t>(schemas_.size()));
  put_number(content, static_cast<std::uint32_t>(channels_.size()));
  put_number(content, std::uint32_t{0});  // attachments
  put_number(content, std::uint32_t{0});  // metadata
  put_number(content, static_cast<std::uint32_t>(chunks_.size()));
  put_number(content, first_time_);
  put_number(content, last_time_);
  put_list(content, counts);
  return record(Opcode::Statistics, content);
}

// A reader reads this first; `offsets` say where its groups are.
std::string McapFile::summary(std::string& offsets) const {
  std::string text;
  const auto add_group = [&](Opcode opcode, const std::string& records) {
    if (records.empty()) return;
    std::string content(1, static_cast<char>(opcode));
    put_number(content, position_ + text.size());
    put_number(content, static_cast<std::uint64_t>(records.size()));
    offsets += record(Opcode::SummaryOffset, content);
    text += records;
  };
  std::string schemas, channels, chunks;
  for (const std::string& it : schemas_) schemas += it;
  for (const Channel& it : channels_) channels += it.record;
  for (const Chunk& it : chunks_) {
    std::string content, indexes;
    put_number(content, it.begin);
    put_number(content, it.end);
    put_number(content, it.offset);
    put_number(content, it.length);
    for (const auto& [channel, offset] : it.indexes) {
      put_number(indexes, channel);
      put_number(indexes, offset);
    }
    put_list(content, indexes);
    put_number(content, it.index_length);
    put_text(content, "zstd");
    put_number(content, it.compressed);
    put_number(content, it.size);
    chunks += record(Opcode::ChunkIndex, content);
  }
  add_group(Opcode::Schema, schemas);
  add_group(Opcode::Channel, channels);
  add_group(Opcode::Statistics, statistics());
  add_group(Opcode::ChunkIndex, chunks);
  return text;
}

bool McapFile::finish() {
  end_chunk();
  std::string end;
  put_number(end, sum_);
  put(record(Opcode::DataEnd, end));
  const std::uint64_t begin = position_;
  std::string offsets, footer;
  const std::string text = summary(offsets);
  put_number(footer, begin);
  put_number(footer, begin + text.size());
  // The sum is of all before it, so of its own record's beginning, too.
  const std::string before = record(Opcode::Footer, footer + std::string(sizeof sum_, '\0'));
  const std::size_t own = before.size() - sizeof sum_;
  put_number(footer, crc32_of(text + offsets + before.substr(0, own)));
  put(text + offsets + record(Opcode::Footer, footer) + std::string(kMagic));
  return !is_stopped_;
}

void McapFile::put(std::string_view bytes) {
  position_ += bytes.size();
  sum_ = crc32_of(bytes, sum_);
  if (!is_stopped_) is_stopped_ = !write_(bytes);
}

}  // namespace lockstep::host
