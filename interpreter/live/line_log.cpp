#include "live/line_log.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

namespace lockstep {
namespace {

constexpr std::string_view kData = "data: ";

}  // namespace

// Of {"tick":7,…
std::optional<std::uint64_t> tick_of_line(std::string_view line) {
  constexpr std::string_view kTick = "{\"tick\":";
  if (!line.starts_with(kTick)) return std::nullopt;
  std::uint64_t tick = 0;
  const auto read = std::from_chars(line.data() + kTick.size(), line.data() + line.size(), tick);
  return read.ec == std::errc() ? std::optional(tick) : std::nullopt;
}

void LineLog::add_header(std::string_view line) {
  header_ = fmt::format("{}{}\n", kData, line);
}

void LineLog::add(std::string_view line) {
  const auto tick = tick_of_line(line);
  const bool is_full = line.ends_with(",\"full\":true}\n");
  std::string text = tick ? fmt::format("id: {}\n", *tick) : std::string();
  text += kData;
  const std::size_t begin = text.size();
  (text += line) += '\n';
  push({.text = std::make_shared<const std::string>(std::move(text)),
        .line = begin,
        .tick = tick,
        .is_full = is_full});
  if (is_full && state_) push({.text = state_});
}

void LineLog::add_event(std::string_view name, std::string_view json) {
  auto text =
      std::make_shared<const std::string>(fmt::format("event: {}\n{}{}\n\n", name, kData, json));
  if (name == "state") state_ = text;
  push({.text = std::move(text)});
}

void LineLog::push(Event event) {
  if (event.is_full) {
    last_full_ = end();
    since_full_ = 0;
    is_somebody_behind_ = false;
  }
  event.begin = total_;
  total_ += event.text->size();
  bytes_ += event.text->size();
  since_full_ += event.text->size();
  events_.push_back(std::move(event));
  drop_old();
}

// The first of what stays is a full line.
void LineLog::drop_old() {
  while (bytes_ > kRoom && last_full_ && first_ < *last_full_) {
    do {
      bytes_ -= events_.front().text->size();
      events_.pop_front();
      ++first_;
    } while (!events_.front().is_full);
  }
}

bool LineLog::wants_full() const {
  constexpr std::uint64_t kEvents = 20;
  constexpr std::size_t kTimes = 4;  // as long as a full line
  if (!last_full_ || is_somebody_behind_) return true;
  return end() - *last_full_ > kEvents && since_full_ > kTimes * at(*last_full_).text->size();
}

LineLog::Place LineLog::begin(std::optional<std::uint64_t> seen) const {
  if (seen) {
    for (std::uint64_t event = end(); event-- > first_;) {
      if (at(event).tick == seen) return {.event = event + 1};
    }
  }
  return {.event = last_full_.value_or(first_)};
}

std::size_t LineLog::read(Place& place, std::span<char> to) {
  std::size_t count = 0;
  while (count < to.size()) {
    if (!place.text) {
      catch_up(place);
      if (place.event == end()) break;
      place.text = at(place.event).text;
    }
    const std::string& text = *place.text;
    const std::size_t fit = std::min(text.size() - place.offset, to.size() - count);
    std::copy_n(text.data() + place.offset, fit, to.data() + count);
    count += fit;
    place.offset += fit;
    if (place.offset == text.size()) place = {.event = place.event + 1};
  }
  return count;
}

bool LineLog::is_behind(const Place& place) const {
  constexpr std::size_t kFullLines = 4;
  if (place.event < first_) return true;
  if (place.event == end()) return false;
  const std::size_t most =
      is_over_ ? kMostAtEnd : std::max(kMostBehind, kFullLines * at(*last_full_).text->size());
  return total_ - at(place.event).begin > most;
}

void LineLog::catch_up(Place& place) {
  if (!last_full_ || !is_behind(place)) return;
  if (place.event < *last_full_) {
    place.event = *last_full_;
  } else {
    is_somebody_behind_ = true;
  }
}

std::string_view LineLog::header_line() const {
  return std::string_view(header_).substr(kData.size(), header_.size() - kData.size() - 1);
}

std::string_view LineLog::line(std::uint64_t event) const {
  const Event& it = at(event);
  if (it.line == 0) return {};
  return std::string_view(*it.text).substr(it.line, it.text->size() - it.line - 1);
}

}  // namespace lockstep
