// Reads a recording line by line and keeps the state of every node after the last read line. A file
// that ends early, as after a kill, is read up to its last whole line; any other damage is an error
// with its line.
#pragma once

#include <istream>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "record/read/line_reader.h"
#include "record/read/recording_parts.h"
#include "record/read/since_cut.h"
#include "record/recording.h"

namespace lockstep::host {

class RecordingJson;

// The findings after a recording has been read; "" if there is nothing to report.
struct RecordingOutcome {
  std::string error, gaps, cut;    // as RecordingReader reports them
  std::optional<RecordedEnd> end;  // the closing line
};

class RecordingReader {
 public:
  // A longer line is refused, before it needs more memory.
  struct Limits {
    std::size_t line = std::size_t{1} << 30u;  // bytes; the header of the largest tree has fewer
  };

  // `in` must outlive the reader; errors call it `name`. Reads the header: check error().
  RecordingReader(std::istream& in, std::string name) : RecordingReader(in, std::move(name), {}) {}
  RecordingReader(std::istream& in, std::string name, Limits limits);
  ~RecordingReader();

  // The next tick, or nothing at the end or after an error. What it points to is valid until the
  // next call.
  std::optional<RecordedTick> next();

  // Where the reader stands after a tick.
  struct Position {
    LineReader::Position lines;
    std::uint64_t next_tick = 0;
    double time = 0;
  };
  Position position() const { return {lines_.position(), next_tick_, last_time_}; }
  // Goes back to an earlier position of this reader; `states` are those of that position. The next
  // tick is the one after it. The file must be seekable and unchanged before that position. Returns
  // false otherwise.
  bool go_to(const Position& position, std::span<const RecordedState> states);

  // Before the first next(): leaves out what is not needed to know this tick. The next tick is the
  // last one before it, or it, whose line has the whole state; else the first of all. In a file
  // that cannot be sought, nothing is left out.
  void skip_to(std::uint64_t tick);

  // "" if there is no error, else "run.jsonl:12: no node 99, expected 0 to 4". Of a recording in
  // several files, it is the file and its line.
  const std::string& error() const { return error_; }
  const RecordingHeader& header() const { return header_; }
  // The closing line, once it has been read.
  const std::optional<RecordedEnd>& end() const { return end_; }
  // The gaps in the lines read so far: "" when no tick is lost, else "2 ticks are missing, the
  // first is 7: the disk was too slow".
  std::string gaps() const;
  // "" if the recording is complete, or not read to its end, else how it ends. A part is complete
  // that says that the run goes on in another one.
  std::string cut() const;
  // It is a part, and the run goes on in the next one.
  bool goes_on() const { return is_part_over_; }
  // After which cuts the run continued, of the lines read so far.
  struct Resume {
    std::uint64_t first_tick = 0;
    double after = 0;       // seconds since the state was saved
    std::uint64_t run = 0;  // RecordingHeader::run, of the process that continued
  };
  const std::vector<Resume>& resumes() const { return resumes_; }
  RecordingOutcome outcome() const { return {error_, gaps(), cut(), end_}; }

 private:
  std::optional<std::uint64_t> end_of_ticks(std::uint64_t first, std::uint64_t size,
                                            std::uint64_t tick);
  struct Whole {
    std::uint64_t tick = 0;
    std::uint64_t line = 0;  // its first byte
  };
  std::optional<Whole> last_whole(std::uint64_t from, std::uint64_t to, std::uint64_t tick);
  void begin_with(const Whole& whole);
  bool next_line();  // false at the end, and after an error
  template <class Read>
  void read_line(Read read);
  std::optional<RecordedTick> read_further();
  void take(const RecordedTick& tick);
  void take(const RecordedGap& gap);
  void take(const RecordedPartEnd& end);
  void begin_part();
  void begin_with_whole(RecordedTick& tick);
  void take(RecordedEnd end);
  void pass_ticks(std::uint64_t first, std::uint64_t count);
  std::optional<TextOfFiles::Place> place() const;
  void fail(const std::string& message);

  LineReader lines_;
  TextOfFiles* const files_;  // which have the text; null: it is of one
  std::unique_ptr<RecordingJson> format_;
  std::string name_;
  std::string error_;
  bool is_read_ = false;  // to its end
  bool is_cut_ = false;   // within the last line
  bool has_skipped_ = false;
  bool is_part_over_ = false;  // the next line is a header
  bool begins_here_ = false;   // with the next line, which has the whole state
  RecordingHeader header_;
  std::optional<RecordedEnd> end_;
  std::vector<RecordedState> states_;
  std::uint64_t next_tick_ = 0;
  double last_time_ = 0;  // of a tick
  std::optional<std::uint64_t> first_lost_;
  std::uint64_t lost_ = 0;
  std::uint64_t lost_in_cuts_ = 0;  // ticks before a cut that did not get to the disk
  std::vector<Resume> resumes_;
  SinceCut since_cut_;
  // By the first tick after a cut. A reader that goes back does not know the entries before it.
  std::map<std::uint64_t, std::vector<RecordedEntry>> changed_in_cuts_;
  bool is_after_cut_ = false;     // the next line is the first one of a run that continues
  std::uint64_t read_until_ = 0;  // the highest next_tick_
  std::uint64_t last_gap_ = 0;    // ticks, if it was in the last line
};

}  // namespace lockstep::host
