#include "record/live/line_log.h"

#include <algorithm>
#include <utility>

namespace lockstep::host {

void LineLog::add(LoggedEvent event) {
  const bool is_full = event.is_full;
  push(std::make_shared<const LoggedEvent>(std::move(event)));
  if (is_full && state_) push(state_);
}

void LineLog::add_state(LoggedEvent state) {
  state_ = std::make_shared<const LoggedEvent>(std::move(state));
  push(state_);
}

void LineLog::push(std::shared_ptr<const LoggedEvent> event) {
  if (event->is_full) {
    last_full_ = end();
    since_full_ = 0;
    is_somebody_behind_ = false;
  }
  const std::size_t size = event->text.size();
  events_.push_back({std::move(event), total_});
  total_ += size;
  bytes_ += size;
  since_full_ += size;
  drop_old();
}

// The first of what stays is a full line.
void LineLog::drop_old() {
  while (bytes_ > kRoom && last_full_ && first_ < *last_full_) {
    do {
      bytes_ -= events_.front().it->text.size();
      events_.pop_front();
      ++first_;
    } while (!events_.front().it->is_full);
  }
}

bool LineLog::wants_full() const {
  constexpr std::uint64_t kEvents = 20;
  constexpr std::size_t kTimes = 4;  // as long as a full line
  if (!last_full_ || is_somebody_behind_) return true;
  return end() - *last_full_ > kEvents && since_full_ > kTimes * at(*last_full_).it->text.size();
}

LineLog::Cursor LineLog::begin(std::optional<std::uint64_t> seen) const {
  if (seen) {
    for (std::uint64_t event = end(); event-- > first_;) {
      if (at(event).it->tick == seen) return {.event = event + 1};
    }
  }
  return {.event = last_full_.value_or(first_)};
}

std::size_t LineLog::read(Cursor& cursor, std::span<char> to) {
  std::size_t count = 0;
  while (count < to.size()) {
    if (!cursor.begun) {
      catch_up(cursor);
      if (cursor.event == end()) break;
      cursor.begun = at(cursor.event).it;
    }
    const std::string& text = cursor.begun->text;
    const std::size_t fit = std::min(text.size() - cursor.offset, to.size() - count);
    std::copy_n(text.data() + cursor.offset, fit, to.data() + count);
    count += fit;
    cursor.offset += fit;
    if (cursor.offset == text.size()) cursor = {.event = cursor.event + 1};
  }
  return count;
}

bool LineLog::is_behind(const Cursor& cursor) const {
  constexpr std::size_t kFullLines = 4;
  if (cursor.event < first_) return true;
  if (cursor.event == end()) return false;
  const std::size_t most =
      is_over_ ? kMostAtEnd : std::max(kMostBehind, kFullLines * at(*last_full_).it->text.size());
  return total_ - at(cursor.event).begin > most;
}

void LineLog::catch_up(Cursor& cursor) {
  if (!last_full_ || !is_behind(cursor)) return;
  if (cursor.event < *last_full_) {
    cursor.event = *last_full_;
  } else {
    is_somebody_behind_ = true;
  }
}

}  // namespace lockstep::host
