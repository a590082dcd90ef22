#include "observers/recording_reader.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <utility>

#include "observers/recording_json.h"

namespace lockstep {

RecordingReader::RecordingReader(std::istream& in, std::string name, Limits limits)
    : in_(in), name_(std::move(name)), limits_(limits) {
  if (!next_line()) {
    if (!error_.empty()) return;
    line_ = 1;
    fail("the file is empty, expected a recording");
    return;
  }
  read_line([this](const nlohmann::json& json) {
    header_ = header_from(json);
    states_.resize(header_.nodes.size());
  });
  if (last_line_cut_) fail("the header is cut");
}

std::optional<RecordedTick> RecordingReader::next() {
  // Also after the closing line: nothing must come there, and only reading on finds that.
  while (error_.empty()) {
    if (!next_line()) return std::nullopt;
    bool is_tick = false;
    read_line([&](const nlohmann::json& json) { is_tick = read_further(json); });
    if (!error_.empty() || last_line_cut_) return std::nullopt;
    if (is_tick) return tick_;
  }
  return std::nullopt;
}

RecordingReader::Place RecordingReader::place() const {
  return {.bytes = bytes_,
          .lines = line_,
          .tick = tick_,
          .states = states_,
          .first_gap = first_gap_,
          .lost = lost_};
}

bool RecordingReader::go_to(const Place& place) {
  in_.clear();
  if (!in_.seekg(static_cast<std::streamoff>(place.bytes))) return false;
  bytes_ = place.bytes;
  line_ = place.lines;
  tick_ = place.tick;
  states_ = place.states;
  tick_.nodes = states_;
  last_ = tick_.tick;
  first_gap_ = place.first_gap;
  lost_ = place.lost;
  // A tick is neither behind the closing line nor behind an error.
  end_.reset();
  error_.clear();
  last_line_cut_ = false;
  return true;
}

// Any line but the header. True: of a tick.
bool RecordingReader::read_further(const nlohmann::json& json) {
  if (end_) throw BadLine("a line after the closing line");
  if (json.is_object() && json.contains("end")) {
    end_ = end_from(json);
    return false;
  }
  if (json.is_object() && json.contains("lost")) {
    const RecordedGap gap = gap_from(json);
    in_order(gap.from, gap.from + (gap.ticks - 1));
    if (!first_gap_) first_gap_ = gap;
    lost_ += gap.ticks;
    return false;
  }
  tick_ = tick_from(json, states_);
  in_order(tick_.tick, tick_.tick);
  return true;
}

void RecordingReader::in_order(std::uint64_t first, std::uint64_t last) {
  if (last_ && first <= *last_) {
    throw BadLine(fmt::format("tick {} comes after tick {}", first, *last_));
  }
  last_ = last;
}

std::string RecordingReader::gaps() const {
  if (!first_gap_) return {};
  return fmt::format("{} tick{} missing, the first is {}: the disk was too slow", lost_,
                     lost_ == 1 ? " is" : "s are", first_gap_->from);
}

std::string RecordingReader::cut() const {
  if (end_ || !error_.empty()) return {};
  if (last_line_cut_) return fmt::format("line {} is cut, the run did not end there", line_);
  return fmt::format("it ends after line {} without a closing line", line_);
}

bool RecordingReader::next_line() {
  text_.clear();
  char part[1u << 12u];
  while (true) {
    in_.getline(part, sizeof part);
    const auto count = static_cast<std::size_t>(in_.gcount());
    const bool goes_on = in_.fail() && !in_.eof() && count > 0;
    const bool has_end = in_.good();  // gcount() counts it
    if (count == 0 && text_.empty()) return false;
    text_.append(part, has_end ? count - 1 : count);
    if (!goes_on) break;
    in_.clear();
    if (text_.size() > limits_.line) break;
  }
  ++line_;
  bytes_ += text_.size() + 1;
  if (text_.size() <= limits_.line) return true;
  fail(fmt::format("the line is longer than {} bytes", limits_.line));
  return false;
}

// Only the last line can lack its newline, and only there is broken JSON a sign of a kill.
template <class Read>
void RecordingReader::read_line(Read read) {
  const auto json = nlohmann::json::parse(text_, nullptr, false);
  if (json.is_discarded()) {
    last_line_cut_ = in_.eof();
    if (!last_line_cut_) fail("not JSON");
    return;
  }
  try {
    read(json);
  } catch (const BadLine& bad) {
    fail(bad.what());
  }
}

void RecordingReader::fail(const std::string& message) {
  error_ = fmt::format("{}:{}: {}", name_, line_, message);
}

}  // namespace lockstep
