#include "record/read/recording_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>
#include <utility>

#include "record/read/recording_json.h"

namespace lockstep::host {

RecordingReader::RecordingReader(std::istream& in, std::string name, Limits limits)
    : lines_(in, limits.line),
      files_(dynamic_cast<TextOfFiles*>(in.rdbuf())),
      format_(std::make_unique<RecordingJson>()),
      name_(std::move(name)) {
  if (!next_line()) {
    if (error_.empty()) error_ = name_ + ":1: the file is empty, expected a recording";
    return;
  }
  if (lines_.text().starts_with("\x89MCAP")) {
    fail(
        "it is an MCAP file, which lockstep writes and does not read; `run --record FILE.jsonl` "
        "records for log and replay, and `log export` makes MCAP of that");
    return;
  }
  read_line([this] { header_ = format_->header(lines_.text()); });
  states_.resize(header_.nodes.size());
  next_tick_ = header_.first_tick;
  begins_here_ = has_skipped_ = header_.first_tick > 0;
  if (header_.resumed_after) resumes_.push_back({next_tick_, *header_.resumed_after, header_.run});
  if (is_cut_) fail("the header is cut");
}

RecordingReader::~RecordingReader() = default;

std::optional<RecordedTick> RecordingReader::next() {
  // Also after the closing line: nothing must come there, and only reading on finds that.
  while (error_.empty() && next_line()) {
    std::optional<RecordedTick> tick;
    read_line([&] { tick = read_further(); });
    if (tick || is_cut_) return tick;
  }
  return std::nullopt;
}

bool RecordingReader::go_to(const Position& position, std::span<const RecordedState> states) {
  if (!lines_.go_to(position.lines)) return false;
  states_.assign(states.begin(), states.end());
  since_cut_.forget_limits();
  next_tick_ = position.next_tick;
  last_time_ = position.time;
  // A tick is neither behind the closing line nor behind an error.
  end_.reset();
  is_part_over_ = begins_here_ = is_after_cut_ = false;
  error_.clear();
  is_cut_ = is_read_ = false;
  return true;
}

// Any line but the header: its tick, if it is of one.
std::optional<RecordedTick> RecordingReader::read_further() {
  if (end_) throw JsonError("a line after the closing line");
  if (std::exchange(is_part_over_, false)) {
    begin_part();
    return std::nullopt;
  }
  since_cut_.withdraw_limits(states_);
  auto line = format_->line(lines_.text(), states_);
  since_cut_.restore_limits(states_);
  std::visit([this](auto& it) { take(std::move(it)); }, line);
  auto* tick = std::get_if<RecordedTick>(&line);
  // Ticks before it may be lost.
  const bool is_gap = std::holds_alternative<RecordedGap>(line);
  if (begins_here_ && !is_gap) {
    // A run that continues may be cut again before its first tick.
    if (tick == nullptr && !resumes_.empty()) return std::nullopt;
    begins_here_ = false;
    if (tick == nullptr || !tick->whole) throw JsonError("'whole' is missing");
    begin_with_whole(*tick);
  }
  if (tick == nullptr) return std::nullopt;
  since_cut_.take(*tick);
  return *tick;
}

void RecordingReader::begin_with_whole(RecordedTick& tick) {
  tick.entries = *tick.whole;
  if (!std::exchange(is_after_cut_, false)) return;
  const auto it = changed_in_cuts_.try_emplace(tick.tick, since_cut_.changed_entries(tick)).first;
  tick.entries = it->second;
  since_cut_.complete(tick);
}

void RecordingReader::take(const RecordedTick& tick) {
  pass_ticks(tick.tick, 1);
  last_gap_ = 0;
  if (tick.time < last_time_)
    throw JsonError(fmt::format("time_s {} comes after {}", tick.time, last_time_));
  last_time_ = tick.time;
}

void RecordingReader::take(const RecordedGap& gap) {
  pass_ticks(gap.from, gap.ticks);
  if (!first_lost_) first_lost_ = gap.from;
  lost_ += last_gap_ = gap.ticks;
}

void RecordingReader::take(const RecordedPartEnd& end) {
  if (end.ticks != next_tick_)
    throw JsonError(fmt::format("'ticks' is {}, but the run had {}", end.ticks, next_tick_));
  is_part_over_ = true;
}

// Files of one run, one behind the other.
void RecordingReader::begin_part() {
  const RecordingHeader header = format_->header(lines_.text());
  const auto tree_of = [](const RecordingHeader& it) {
    return std::tuple(it.nodes.size(), std::tie(it.id, it.rate_hz, it.tick));
  };
  const auto run_of = [](const RecordingHeader& it) {
    return std::tie(it.file, it.version, it.clock, it.seed, it.arguments);
  };
  // After a cut, another process may name its file otherwise and have another seed.
  const bool is_resumed = header.resumed_after.has_value();
  if (tree_of(header) != tree_of(header_) || (!is_resumed && run_of(header) != run_of(header_))) {
    throw JsonError("the next part is of another run");
  }
  if (!std::ranges::equal(header.entries, header_.entries, {}, &ShapeEntry::key,
                          &ShapeEntry::key)) {
    throw JsonError("the next part has other blackboard entries, as with another --record-entries");
  }
  if (header.first_tick != next_tick_) {
    throw JsonError(fmt::format("the next part begins with tick {}, expected {}", header.first_tick,
                                next_tick_));
  }
  if (!is_resumed) return;
  begins_here_ = is_after_cut_ = has_skipped_ = true;  // its last line counts its own lost ticks
  since_cut_.cut(states_, header_);
  if (next_tick_ < read_until_) return;  // it has gone back
  // A gap directly before a cut is not the disk's: the process ended before it was written.
  lost_in_cuts_ += last_gap_;
  lost_ -= std::exchange(last_gap_, 0);
  resumes_.push_back({next_tick_, *header.resumed_after, header.run});
}

void RecordingReader::take(RecordedEnd end) {
  if (end.ticks != next_tick_)
    throw JsonError(fmt::format("'ticks' is {}, but the run had {}", end.ticks, next_tick_));
  if (end.lost != lost_ && !has_skipped_)
    throw JsonError(fmt::format("'lost' is {}, but {} ticks have no line", end.lost, lost_));
  end_ = std::move(end);
}

// A line has only what has changed: without the one before it, it says nothing.
void RecordingReader::pass_ticks(std::uint64_t first, std::uint64_t count) {
  if (first != next_tick_) {
    throw JsonError(next_tick_ == header_.first_tick
                        ? fmt::format("the first tick is {}, expected {}", first, next_tick_)
                        : fmt::format("tick {} comes after tick {}", first, next_tick_ - 1));
  }
  next_tick_ += count;
  read_until_ = std::max(read_until_, next_tick_);
}

std::string RecordingReader::gaps() const {
  const auto missing = [](std::uint64_t ticks) {
    return fmt::format("{} tick{} missing", ticks, ticks == 1 ? " is" : "s are");
  };
  std::string text;
  if (lost_ > 0)
    text = fmt::format("{}, the first is {}: the disk was too slow", missing(lost_), *first_lost_);
  if (lost_in_cuts_ > 0) {
    text += fmt::format("{}{}: cut off before they were written", text.empty() ? "" : "; ",
                        missing(lost_in_cuts_));
  }
  return text;
}

std::string RecordingReader::cut() const {
  if (!is_read_ || end_ || is_part_over_ || !error_.empty()) return {};
  if (const auto of_part = place(); of_part && of_part->line > 0) {
    const std::string of_file = fmt::format("line {} of '{}'", of_part->line, of_part->file);
    return is_cut_ ? of_file + " is cut, the run did not end there"
                   : fmt::format("it ends after {} without a closing line", of_file);
  }
  const std::uint64_t line = lines_.position().lines;
  if (!lines_.position().knows_lines) {
    return is_cut_ ? "its last line is cut, the run did not end there"
                   : "it ends without a closing line";
  }
  if (is_cut_) return fmt::format("line {} is cut, the run did not end there", line);
  return fmt::format("it ends after line {} without a closing line", line);
}

bool RecordingReader::next_line() {
  if (lines_.next()) return true;
  is_read_ = true;
  if (!lines_.damage().empty())
    fail(fmt::format("{}; tick {} and later ones cannot be read", lines_.damage(), next_tick_));
  if (lines_.is_too_long()) fail(fmt::format("the line is longer than {} bytes", lines_.longest()));
  return false;
}

// Only the last line can lack its end, and only there is broken JSON a sign of a kill.
template <class Read>
void RecordingReader::read_line(Read read) {
  try {
    read();
  } catch (const NotJson& bad) {
    is_read_ = is_cut_ = !lines_.has_end();
    if (!is_cut_) fail(bad.what());
  } catch (const JsonError& bad) {
    fail(bad.what());
  }
}

// A line of a recording of several files is one of one of them.
std::optional<TextOfFiles::Place> RecordingReader::place() const {
  if (files_ == nullptr) return std::nullopt;
  return files_->place_of(lines_.begin_of_line());
}

void RecordingReader::fail(const std::string& message) {
  const LineReader::Position& at = lines_.position();
  if (const auto of_part = place()) {
    error_ = of_part->line == 0 ? fmt::format("{}: {}", of_part->file, message)
                                : fmt::format("{}:{}: {}", of_part->file, of_part->line, message);
    return;
  }
  error_ = at.knows_lines
               ? fmt::format("{}:{}: {}", name_, std::max<std::uint64_t>(at.lines, 1), message)
               : fmt::format("{}: before byte {}: {}", name_, at.bytes, message);
}

}  // namespace lockstep::host
