#include "recording/write/recording_text.h"

#include <fmt/compile.h>
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>
#include <string_view>

namespace lockstep {
namespace {

char* put(char* to, std::string_view text) {
  return std::copy(text.begin(), text.end(), to);
}

template <class Integer>
char* put_integer(char* to, Integer number) {
  return std::to_chars(to, to + std::numeric_limits<Integer>::digits10 + 1, number).ptr;
}

char* put_seconds(char* to, Nanoseconds time) {
  constexpr std::uint64_t kSecond = 1'000'000'000;
  const auto total = static_cast<std::uint64_t>(time.count());
  to = put_integer(to, total / kSecond);
  // A digit more, so that none of the fraction's zeros is left out.
  char digits[24];
  const char* end = put_integer(digits, kSecond + total % kSecond);
  while (end[-1] == '0' && end > digits + 2) --end;
  digits[0] = '.';
  return std::copy<const char*>(digits, end, to);
}

// Of nodes that change, most have not begun, have ended, or stand where their parent does: writing
// a number takes longer than all the rest.
char* put_progress(char* to, double progress) {
  if (progress == 1.0) return put(to, "1");
  if (progress == 0.0 && !std::signbit(progress)) return put(to, "0");
  return fmt::format_to(to, FMT_COMPILE("{}"), progress);
}

void add_limits(std::string& text, std::span<const LimitChange> limits) {
  text += ",\"limits\":";
  char separator = '[';
  for (const LimitChange& it : limits) {
    text += separator;
    separator = ',';
    if (std::isinf(it.limit)) {
      fmt::format_to(std::back_inserter(text), FMT_COMPILE("[{},null]"), it.node);
    } else {
      fmt::format_to(std::back_inserter(text), FMT_COMPILE("[{},{}]"), it.node, it.limit);
    }
  }
  text += ']';
}

void add_succeeded(std::string& text, std::span<const NodeIndex> succeeded) {
  text += ",\"succeeded\":";
  char separator = '[';
  for (const NodeIndex node : succeeded) {
    text += separator;
    separator = ',';
    fmt::format_to(std::back_inserter(text), FMT_COMPILE("{}"), node);
  }
  text += ']';
}

// ,"name":[…] of what `json_of` makes of each item.
template <class Item, class JsonOf>
std::string list_text(std::string_view name, std::span<const Item> items, JsonOf json_of) {
  std::string text = fmt::format(",\"{}\":[", name);
  for (const Item& item : items) {
    if (&item != items.data()) text += ',';
    const nlohmann::json json = json_of(item);
    text += json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  }
  return text + "]";
}

std::string faults_text(std::span<const Fault> faults) {
  constexpr std::size_t kMostOfMessage = 4096;
  return list_text("faults", faults, [](const Fault& fault) {
    return nlohmann::json{fault.node, fault.message.substr(0, kMostOfMessage)};
  });
}

bool is_plain(std::string_view text) {
  return std::ranges::all_of(text, [](char letter) {
    return letter >= ' ' && letter <= '~' && letter != '"' && letter != '\\';
  });
}

void add_string(std::string& to, std::string_view text) {
  if (is_plain(text)) {
    ((to += '"') += text) += '"';
  } else {
    to += nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  }
}

void add_entries(std::string& text, std::span<const EntryChange> entries) {
  text += ",\"entries\":";
  char separator = '[';
  for (const EntryChange& it : entries) {
    text += separator;
    separator = ',';
    fmt::format_to(std::back_inserter(text), FMT_COMPILE("[{},"), it.entry);
    if (it.text != nullptr) {
      add_string(text, *it.text);
    } else {
      text += "null";
    }
    text += ']';
  }
  text += ']';
}

std::string logs_text(std::span<const RecordedLog> logs) {
  return list_text("logs", logs, [](const RecordedLog& log) {
    return nlohmann::json{log.who, log.level, log.text};
  });
}

}  // namespace

char* put_lost(char* to, std::uint64_t ticks, std::uint64_t from) {
  to = put_integer(put(to, "{\"lost\":{\"ticks\":"), ticks);
  to = put_integer(put(to, ",\"from\":"), from);
  return put(to, "}}\n");
}

char* put_tick(char* to, std::uint64_t tick, Nanoseconds time) {
  to = put_integer(put(to, "{\"tick\":"), tick);
  to = put_seconds(put(to, ",\"time_s\":"), time);
  return put(to, ",\"nodes\":[");
}

char* put_node(char* to, NodeIndex node, const RecordedState& state) {
  constexpr std::string_view kStatus[] = {",\"idle\",", ",\"running\",", ",\"success\",",
                                          ",\"failure\","};
  constexpr std::string_view kFlags[] = {",0,0]", ",0,1]", ",1,0]", ",1,1]"};
  to = put_integer(put(to, "["), node);
  to = put(to, kStatus[static_cast<unsigned>(state.status)]);
  to = put_progress(to, state.progress);
  return put(to, kFlags[2 * state.ticked + state.held]);
}

void set_tick_end(std::string& text, const TickEnd& end) {
  text = ']';
  if (!end.limits.empty()) add_limits(text, end.limits);
  if (!end.succeeded.empty()) add_succeeded(text, end.succeeded);
  if (!end.faults.empty()) text += faults_text(end.faults);
  if (!end.entries.empty()) add_entries(text, end.entries);
  if (!end.logs.empty()) text += logs_text(end.logs);
  text += "}\n";
}

}  // namespace lockstep
