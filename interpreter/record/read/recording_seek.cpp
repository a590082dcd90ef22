// Where in a recording a reader begins that wants to know one tick: ticks rise from line to line,
// so that place is found by halving, and the whole state is in a line not far before it.
#include <algorithm>

#include "record/read/recording_json.h"
#include "record/read/recording_reader.h"

namespace lockstep::host {
namespace {

constexpr std::uint64_t kNear = 64u << 10;  // bytes: read rather than halved

}  // namespace

void RecordingReader::skip_to(std::uint64_t tick) {
  const LineReader::Position first = lines_.position();
  const auto size = error_.empty() ? lines_.size() : std::nullopt;
  std::optional<Whole> whole;
  if (size) {
    const auto end = end_of_ticks(first.bytes, *size, tick);
    // The whole state is written after so and so many bytes.
    for (std::uint64_t back = 16 * kNear; end && !whole; back *= 4) {
      const std::uint64_t from = *end > first.bytes + back ? *end - back : first.bytes;
      whole = last_whole(from, *end, tick);
      if (from == first.bytes) break;
    }
  }
  if (whole) return begin_with(*whole);
  if (size && !lines_.go_to(first)) fail("the file cannot be read a second time");
}

// A byte behind the beginning of the last line of a tick that is not after `tick`, not far behind
// it. None: the lines are damaged.
std::optional<std::uint64_t> RecordingReader::end_of_ticks(std::uint64_t first, std::uint64_t size,
                                                           std::uint64_t tick) {
  std::uint64_t low = first, high = size;
  while (high - low > kNear) {
    const std::uint64_t middle = low + (high - low) / 2;
    if (!lines_.go_to_line(middle)) return std::nullopt;
    std::optional<std::uint64_t> found;
    std::uint64_t begin = lines_.position().bytes;
    while (!found && begin < high && lines_.next()) {
      found = RecordingJson::tick_of(lines_.text());
      if (!found) begin = lines_.position().bytes;
    }
    if (found && *found <= tick) {
      low = begin;
    } else {
      high = middle;
    }
  }
  return std::min(size, high + 1);
}

// The last one of the lines that begin in this range.
std::optional<RecordingReader::Whole> RecordingReader::last_whole(std::uint64_t from,
                                                                  std::uint64_t to,
                                                                  std::uint64_t tick) {
  std::optional<Whole> last;
  if (!lines_.go_to_line(from)) return last;
  for (std::uint64_t begin = lines_.position().bytes; begin < to && lines_.next();
       begin = lines_.position().bytes) {
    const auto found = RecordingJson::tick_of(lines_.text());
    if (found && *found > tick) break;
    if (found && RecordingJson::may_be_whole(lines_.text())) last = {*found, begin};
  }
  return last;
}

void RecordingReader::begin_with(const Whole& whole) {
  if (!lines_.go_to({.bytes = whole.line, .knows_lines = false})) return fail("it cannot be read");
  std::ranges::fill(states_, RecordedState());
  next_tick_ = whole.tick;
  has_skipped_ = begins_here_ = true;
}

}  // namespace lockstep::host
