// The last lines of a run, for any number of listeners: each reads on from its cursor, at its pace,
// and keeps nothing else, so the hundredth listener costs the run no memory.
//
// A slow listener must neither make the run wait nor the log grow. One that is more than
// kMostBehind bytes behind continues at the last line that has the whole state, with what was
// counted until then. Example: a browser takes 50 kB/s of a run that makes 200 kB/s. After some
// seconds it leaves out ticks; its tree and its counts of results are still right. The log has
// bounded size and begins with such a line.
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

namespace lockstep::host {

// An event for listeners: a line, or something beside the lines.
struct LoggedEvent {
  std::string text;                  // as it is sent
  std::size_t line = 0, length = 0;  // where in it the line is; no length: it has none
  std::optional<std::uint64_t> tick = {};
  bool is_full = false;  // the line has the whole state
};

class LineLog {
 public:
  static constexpr std::size_t kRoom = 4u << 20;  // bytes, or what a few of the longest lines take
  static constexpr std::size_t kMostBehind = 1u << 20;  // bytes, likewise
  static constexpr std::size_t kMostAtEnd = 64u << 10;  // bytes, when there is little time left

  // Where a listener is.
  struct Cursor {
    std::uint64_t event = 0;  // its number, counted from the first of all
    // It, once it was begun: it is read to its end, also when the log has dropped it.
    std::shared_ptr<const LoggedEvent> begun = {};
    std::size_t offset = 0;  // bytes of it that were read
  };

  // All listeners get the first line first.
  void set_header(LoggedEvent header) { header_ = std::move(header); }
  void add(LoggedEvent event);
  // The last of these is repeated after each line that has the whole state.
  void add_state(LoggedEvent state);

  // Nothing follows.
  void close() { is_over_ = true; }
  bool is_over() const { return is_over_; }

  // A line with the whole state is needed, so that listeners can begin and catch up.
  bool wants_full() const;

  std::string_view header() const { return header_.text; }
  // Where a listener begins that has seen the ticks up to this one, or none.
  Cursor begin(std::optional<std::uint64_t> seen) const;
  // Copies what comes next and moves on. 0: nothing yet.
  std::size_t read(Cursor& cursor, std::span<char> to);

  // As lines: the header and the rest of the log.
  std::string_view header_line() const { return line_of(header_); }
  // The number of the event behind the last.
  std::uint64_t end() const { return first_ + events_.size(); }
  std::uint64_t first() const { return first_; }
  // The last line with the whole state.
  std::optional<std::uint64_t> last_full() const { return last_full_; }
  std::optional<std::uint64_t> tick(std::uint64_t event) const { return at(event).it->tick; }
  // "" if it is no line.
  std::string_view line(std::uint64_t event) const { return line_of(*at(event).it); }

 private:
  struct Event {
    std::shared_ptr<const LoggedEvent> it;
    std::uint64_t begin = 0;  // bytes of all events before it
  };

  static std::string_view line_of(const LoggedEvent& it) {
    return std::string_view(it.text).substr(it.line, it.length);
  }
  void push(std::shared_ptr<const LoggedEvent> event);
  void drop_old();
  const Event& at(std::uint64_t event) const { return events_[event - first_]; }
  bool is_behind(const Cursor& cursor) const;
  void catch_up(Cursor& cursor);

  LoggedEvent header_;
  std::shared_ptr<const LoggedEvent> state_;  // the last
  std::deque<Event> events_;
  std::uint64_t first_ = 0;                      // number of the first event that is kept
  std::optional<std::uint64_t> last_full_ = {};  // likewise
  std::size_t bytes_ = 0;                        // of what is kept
  std::uint64_t total_ = 0;                      // bytes of all events so far
  std::size_t since_full_ = 0;                   // bytes
  bool is_over_ = false;
  bool is_somebody_behind_ = false;  // with no full line to go on at
};

}  // namespace lockstep::host
