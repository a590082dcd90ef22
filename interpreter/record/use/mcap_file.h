// Writes a file of the format MCAP (https://mcap.dev/spec), version 0: messages of channels in
// chunks that are compressed with zstd, an index of them, a summary, each with a CRC-32. Knows no
// recording. Memory: a chunk, and the index of all chunks.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "record/use/export_sink.h"

namespace lockstep::host {

class McapFile {
 public:
  static constexpr std::size_t kChunk = 1u << 20;  // bytes of records, then the chunk is written

  McapFile(std::string_view library, const ExportSink& write);

  // The number of a schema: JSON Schema.
  std::uint16_t add_schema(std::string_view name, std::string_view json_schema);
  // The number of a channel of JSON messages. Throws a std::runtime_error if there are too many.
  std::uint16_t add_channel(std::uint16_t schema, std::string_view topic);
  // `time` in nanoseconds; it must not fall.
  void add(std::uint16_t channel, std::uint64_t time, std::string_view json);
  // Writes what has been added as a chunk.
  void end_chunk();
  // Chunk, index and summary. False: the sink stopped it.
  bool finish();
  bool is_stopped() const { return is_stopped_; }

 private:
  struct Channel {
    std::uint16_t schema = 0;
    std::string record;
    std::uint32_t messages = 0;
    bool is_in_chunk = false;  // a chunk has its record, so that it can be read alone
    std::vector<std::pair<std::uint64_t, std::uint64_t>> index = {};  // of this chunk: time, offset
  };
  struct Chunk {
    std::uint64_t begin = 0, end = 0;  // times
    std::uint64_t offset = 0, length = 0, index_length = 0, compressed = 0, size = 0;
    std::map<std::uint16_t, std::uint64_t> indexes = {};
  };

  void put(std::string_view bytes);
  std::string summary(std::string& offsets) const;
  std::string statistics() const;

  const ExportSink& write_;
  std::vector<std::string> schemas_;  // records
  std::vector<Channel> channels_;
  std::vector<Chunk> chunks_;
  std::string chunk_;  // records
  Chunk open_;
  bool has_messages_ = false;
  std::uint32_t sum_ = 0;  // CRC-32 of all bytes
  std::uint64_t position_ = 0, first_time_ = 0, last_time_ = 0;
  bool is_stopped_ = false;
};

}  // namespace lockstep::host
