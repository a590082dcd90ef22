// Reads a recording line by line and keeps the state of every node as of the line read last. A file
// that ends early, as after a kill, is read up to its last whole line; anything else that is wrong
// is an error with its line.
#pragma once

#include <istream>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "observers/recording.h"

namespace lockstep {

// What is known of a recording once it has been read; each "" when there is nothing to tell.
struct RecordingOutcome {
  std::string error, gaps, cut;    // as RecordingReader tells them
  std::optional<RecordedEnd> end;  // the closing line
};

class RecordingReader {
 public:
  // A line that is longer is refused, before it takes more memory.
  struct Limits {
    std::size_t line = std::size_t{1} << 30u;  // bytes; the header of the largest tree has fewer
  };

  // `in` must outlive the reader; `name` is how errors call it. Reads the header: check error().
  RecordingReader(std::istream& in, std::string name) : RecordingReader(in, std::move(name), {}) {}
  RecordingReader(std::istream& in, std::string name, Limits limits);

  // The next tick, or nothing at the end or after an error. Its nodes are valid until the next
  // call.
  std::optional<RecordedTick> next();

  // Where the reader stands, after a tick: all it needs to go on from there.
  struct Place {
    std::uint64_t bytes = 0;  // of the file, that have been read
    std::size_t lines = 0;    // the same
    RecordedTick tick;
    std::vector<RecordedState> states;
    std::optional<RecordedGap> first_gap;
    std::uint64_t lost = 0;
  };
  Place place() const;
  std::uint64_t bytes_read() const { return bytes_; }
  // To where this reader once stood: next() gives the tick after place.tick. The file must not have
  // been changed before `bytes`, and be one that can seek. False when it is not.
  bool go_to(const Place& place);

  // "" while all is well, else "run.jsonl:12: no node 99, expected 0 to 4".
  const std::string& error() const { return error_; }
  const RecordingHeader& header() const { return header_; }
  // The closing line, once it has been read.
  const std::optional<RecordedEnd>& end() const { return end_; }
  // Of the lines read so far: the first gap, and the number of ticks in all of them.
  const std::optional<RecordedGap>& first_gap() const { return first_gap_; }
  std::uint64_t lost() const { return lost_; }
  // "" when there is no gap, else "2 ticks are missing, the first is 7: the disk was too slow".
  std::string gaps() const;
  // After the last tick: "" when the recording is whole, else how it ends.
  std::string cut() const;
  RecordingOutcome outcome() const { return {error_, gaps(), cut(), end_}; }

 private:
  bool next_line();  // false at the end, and after an error
  bool read_further(const nlohmann::json& json);
  void in_order(std::uint64_t first, std::uint64_t last);
  void fail(const std::string& message);
  template <class Read>
  void read_line(Read read);

  std::istream& in_;
  std::string name_;
  Limits limits_;
  std::string text_;  // of the line
  std::string error_;
  std::size_t line_ = 0;
  std::uint64_t bytes_ = 0;
  bool last_line_cut_ = false;
  RecordingHeader header_;
  std::optional<RecordedEnd> end_;
  std::vector<RecordedState> states_;
  RecordedTick tick_;
  std::optional<std::uint64_t> last_;  // tick that was read or lost
  std::optional<RecordedGap> first_gap_;
  std::uint64_t lost_ = 0;
};

}  // namespace lockstep
