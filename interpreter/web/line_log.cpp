#include "web/line_log.h"

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
  Event event{
      .text = {}, .tick = tick_of_line(line), .is_full = line.ends_with(",\"full\":true}\n")};
  if (event.tick) event.text = fmt::format("id: {}\n", *event.tick);
  event.text += kData;
  event.line = event.text.size();
  (event.text += line) += '\n';
  const bool is_full = event.is_full;
  push(std::move(event));
  if (is_full && !state_.empty()) push({.text = state_});
}

void LineLog::add_event(std::string_view name, std::string_view json) {
  std::string text = fmt::format("event: {}\n{}{}\n\n", name, kData, json);
  if (name == "state") state_ = text;
  push({.text = std::move(text)});
}

void LineLog::push(Event event) {
  if (event.is_full) {
    last_full_ = end();
    since_full_ = 0;
    is_somebody_behind_ = false;
  }
  bytes_ += event.text.size();
  since_full_ += event.text.size();
  events_.push_back(std::move(event));
  drop_old();
}

// The first of what stays is a full line.
void LineLog::drop_old() {
  while (bytes_ > kRoom && last_full_ && first_ < *last_full_) {
    do {
      bytes_ -= events_.front().text.size();
      events_.pop_front();
      ++first_;
    } while (!events_.front().is_full);
  }
}

bool LineLog::wants_full() const {
  constexpr std::uint64_t kEvents = 20;
  constexpr std::size_t kTimes = 4;  // as long as a full line
  if (!last_full_ || is_somebody_behind_) return true;
  return end() - *last_full_ > kEvents && since_full_ > kTimes * at(*last_full_).text.size();
}

LineLog::Place LineLog::begin(std::optional<std::uint64_t> seen) const {
  if (seen) {
    for (std::uint64_t event = end(); event-- > first_;) {
      if (at(event).tick == seen) return {.event = event + 1};
    }
  }
  return {.event = last_full_.value_or(first_)};
}

std::optional<std::size_t> LineLog::read(Place& place, std::span<char> to) {
  if (place.event < first_ && place.offset > 0) return std::nullopt;
  std::size_t count = 0;
  while (count < to.size()) {
    if (place.offset == 0) catch_up(place);
    if (place.event == end()) break;
    const std::string& text = at(place.event).text;
    const std::size_t fit = std::min(text.size() - place.offset, to.size() - count);
    std::copy_n(text.data() + place.offset, fit, to.data() + count);
    count += fit;
    place.offset += fit;
    if (place.offset == text.size()) place = {.event = place.event + 1};
  }
  return count;
}

void LineLog::catch_up(Place& place) {
  const bool is_behind = end() - place.event > kMostBehind || place.event < first_;
  if (!is_behind || !last_full_) return;
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
  return std::string_view(it.text).substr(it.line, it.text.size() - it.line - 1);
}

}  // namespace lockstep
