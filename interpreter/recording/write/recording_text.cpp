#include "recording/write/recording_text.h"

#include <fmt/compile.h>
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <limits>
#include <string_view>

#include "core/json.h"

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

template <class Number>
void add_number(std::string& text, Number number) {
  fmt::format_to(std::back_inserter(text), FMT_COMPILE("{}"), number);
}

// ,"name":[…] with what `add_item` adds for each, or nothing when there is none.
template <class Item, class AddItem>
void add_list(std::string& text, std::string_view name, std::span<const Item> items,
              AddItem add_item) {
  if (items.empty()) return;
  ((text += ",\"") += name) += "\":";
  char separator = '[';
  for (const Item& item : items) {
    text += separator;
    separator = ',';
    add_item(text, item);
  }
  text += ']';
}

void add_limit(std::string& text, const LimitChange& it) {
  add_number(text += '[', it.node);
  text += ',';
  if (std::isinf(it.limit)) {
    text += "null";
  } else {
    add_number(text, it.limit);
  }
  text += ']';
}

void add_fault(std::string& text, const Fault& fault) {
  constexpr std::size_t kMostOfMessage = 4096;
  add_number(text += '[', fault.node);
  text += ',';
  append_json(text, std::string_view(fault.message).substr(0, kMostOfMessage));
  text += ']';
}

void add_entry(std::string& text, const EntryChange& it) {
  add_number(text += '[', it.entry);
  text += ',';
  if (it.text != nullptr) {
    append_json(text, *it.text);
  } else {
    text += "null";
  }
  text += ']';
}

void add_log(std::string& text, const RecordedLog& log) {
  text += '[';
  append_json(text, log.who);
  text += ',';
  append_json(text, log.level);
  text += ',';
  append_json(text, log.text);
  text += ']';
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
  add_list(text, "limits", end.limits, add_limit);
  add_list(text, "succeeded", end.succeeded, add_number<NodeIndex>);
  add_list(text, "faults", end.faults, add_fault);
  add_list(text, "entries", end.entries, add_entry);
  add_list(text, "logs", end.logs, add_log);
  text += "}\n";
}

}  // namespace lockstep
