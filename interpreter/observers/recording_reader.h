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

class RecordingReader {
 public:
  // `in` must outlive the reader; `name` is how errors call it. Reads the header: check error().
  RecordingReader(std::istream& in, std::string name);

  // The next tick, or nothing at the end or after an error. Valid until the next call.
  std::optional<RecordedTick> next();

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

 private:
  std::optional<std::string> next_line();
  bool read_further(const nlohmann::json& json);
  void in_order(std::uint64_t first, std::uint64_t last);
  void fail(const std::string& message);
  template <class Read>
  void read_line(const std::string& line, Read read);

  std::istream& in_;
  std::string name_;
  std::string error_;
  std::size_t line_ = 0;
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
