#include "record/json_lines.h"

#include <fmt/compile.h>
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <limits>
#include <string_view>
#include <utility>

#include "base/json/json.h"
#include "record/lines.h"
#include "run/shape_of.h"

namespace lockstep::host {
namespace {

// --- header and closing line
// -----------------------------------------------------------------------

Json json_of(const std::map<std::string, std::string, std::less<>>& texts) {
  Json json = Json::object();
  for (const auto& [name, text] : texts) json[name] = text;
  return json;
}

Json json_of(const ShapeNode& node, std::size_t index) {
  Json json = {{lines::kHeaderNode["index"], index},
               {lines::kHeaderNode["path"], node.path},
               {lines::kHeaderNode["kind"], node.kind},
               {lines::kHeaderNode["name"], node.name}};
  json[lines::kHeaderNode["parent"]] = node.parent;
  if (node.synchronization == Synchronization::Absolute) {
    json[lines::kHeaderNode["barriers"]] = node.barriers;
  } else if (node.synchronization == Synchronization::Relative) {
    json[lines::kHeaderNode["delta"]] = node.delta;
  }
  if (!node.resources.empty()) json[lines::kHeaderNode["resources"]] = node.resources;
  if (!node.members.empty()) json[lines::kHeaderNode["members"]] = node.members;
  if (node.ignores_idle) json[lines::kHeaderNode["idle"]] = "ignore";
  if (node.paces) json[lines::kHeaderNode["pace"]] = true;
  if (!node.condition.empty()) json[lines::kHeaderNode["condition"]] = node.condition;
  if (!node.reads.empty()) json[lines::kHeaderNode["reads"]] = node.reads;
  if (node.ports) json[lines::kHeaderNode["ports"]] = json_of(*node.ports);
  if (node.question) {
    json[lines::kHeaderNode["options"]] = node.question->options;
    const NodeQuestion& it = *node.question;
    if (!it.fallback.empty()) json[lines::kHeaderNode["default"]] = it.fallback;
    if (it.timeout) json[lines::kHeaderNode["timeout_s"]] = *it.timeout;
    if (!it.severity.empty()) json[lines::kHeaderNode["severity"]] = it.severity;
  }
  if (node.is_guard) json[lines::kHeaderNode["guard"]] = true;
  return json;
}

Json json_of(const ShapeEntry& entry) {
  Json json = {{lines::kHeaderEntry["key"], entry.key}, {lines::kHeaderEntry["type"], entry.type}};
  if (entry.typing == Typing::Strict) json[lines::kHeaderEntry["strict"]] = true;
  if (!entry.writers.empty()) json[lines::kHeaderEntry["writers"]] = entry.writers;
  return json;
}

Json json_of(const LeafLine& log) {
  return Json::array({log.who, log.level, log.text});
}

Json json_of(const std::optional<double>& value) {
  return value ? Json(*value) : Json();
}

template <class Value>
Json json_of(const Value& value) {
  return value;
}

template <class Item>
Json json_of(const std::vector<Item>& items) {
  Json list = Json::array();
  for (const Item& item : items) list.push_back(json_of(item));
  return list;
}

Json json_of(const std::vector<ShapeNode>& nodes) {
  Json list = Json::array();
  for (std::size_t index = 0; index < nodes.size(); ++index) {
    list.push_back(json_of(nodes[index], index));
  }
  return list;
}

// It may be left out.
template <class Value>
bool is_nothing(const Value& value) {
  if constexpr (requires { value.empty(); }) {
    return value.empty();
  } else {
    return value == Value();
  }
}

template <class Record>
void add_members(Json& json, const lines::Object& object, const Record& record) {
  lines::each_member(object, record, [&](const lines::Field& field, const auto& value) {
    const bool is_absent = field.has == lines::kMaybe && is_nothing(value);
    if (!is_absent) json[field.key] = json_of(value);
  });
}

// --- pieces of a tick
// ------------------------------------------------------------------------------

char* put(char* to, std::string_view text) {
  return std::copy(text.begin(), text.end(), to);
}

// {"key": or ,"key":
char* put_key(char* to, char before, std::string_view key) {
  *to++ = before;
  *to++ = '"';
  return put(put(to, key), "\":");
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

// Most nodes that change have not begun, have ended, or stand where their parent does: writing a
// number takes longer than all the rest.
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

void add_factor(std::string& text, const FactorChange& it) {
  add_number(text += '[', it.node);
  add_number(text += ',', it.factor);
  text += ']';
}

void add_reason(std::string& text, const ReasonChange& it) {
  add_number(text += '[', it.node);
  append_json(text += ',', it.text);
  text += ']';
}

void add_answer(std::string& text, const GivenAnswer& it) {
  add_number(text += '[', it.node);
  append_json(text += ',', it.answer);
  append_json(text += ',', it.who);
  text += ']';
}

void add_heard(std::string& text, const Heard& it) {
  add_number(text += '[', it.node);
  add_number(text += ',', it.run);
  add_number(text += ',', it.word);
  text += ']';
}

void add_round(std::string& text, const RoundChange& it) {
  add_number(text += '[', it.node);
  add_number(text += ',', it.round.number);
  add_number(text += ',', it.round.of);
  text += ']';
}

void add_fault(std::string& text, const Fault& fault) {
  constexpr std::size_t kMostOfMessage = 4096;
  add_number(text += '[', fault.node);
  text += ',';
  append_json(text, std::string_view(fault.message).substr(0, kMostOfMessage));
  text += ']';
}

void add_value(std::string& text, std::uint32_t entry, const std::string* value) {
  add_number(text += '[', entry);
  text += ',';
  if (value != nullptr) {
    append_json(text, *value);
  } else {
    text += "null";
  }
  text += ']';
}

void add_entry(std::string& text, const EntryChange& it) {
  add_value(text, it.entry, it.text);
}

void add_log(std::string& text, const LeafLine& log) {
  text += '[';
  append_json(text, log.who);
  text += ',';
  append_json(text, log.level);
  text += ',';
  append_json(text, log.text);
  text += ']';
}

void add_set(std::string& text, std::span<const EntryChange> entries) {
  const char* separator = nullptr;
  for (const EntryChange& it : entries) {
    if (!it.is_set) continue;
    if (separator == nullptr) ((text += ",\"") += lines::kTick["set"]) += "\":[";
    add_number(text += separator == nullptr ? "" : separator, it.entry);
    separator = ",";
  }
  if (separator != nullptr) text += ']';
}

void add_given(std::string& text, std::span<const EntryChange> entries) {
  const char* separator = nullptr;
  for (const EntryChange& it : entries) {
    if (!it.is_written_again) continue;
    if (separator == nullptr) ((text += ",\"") += lines::kTick["given"]) += "\":[";
    add_value(text += separator == nullptr ? "" : separator, it.entry, it.given);
    separator = ",";
  }
  if (separator != nullptr) text += ']';
}

// Longer than [4294967295,"success",1,0] and a comma; than [,[]] and a count; than most counts.
constexpr std::size_t kMostOfMomentNode = 32, kMostOfMoment = 28, kUsualTotals = 32;
constexpr std::size_t kMostOfLeafProgress = 48;  // [255,4294967295,0.00012345678901234567] likewise

void add_moment_node(std::string& text, const MomentChange& it) {
  add_number(text += '[', it.node);
  ((text += ",\"") += to_string(it.before.status())) += "\",";
  text += it.before.ticked() ? '1' : '0';
  text += it.before.held() ? ",1]" : ",0]";
}

// Each node that differs from the moment after it.
void add_moments(std::string& text, const MomentsView& view) {
  if (view.empty()) return;
  ((text += ",\"") += lines::kTick["moments"]) += "\":";
  for (std::size_t i = 0; i < view.moments.size(); ++i) {
    add_number(text += i == 0 ? "[[" : ",[", view.moments[i].times);
    text += ",[";
    bool is_first = true;
    for (const MomentChange& it : view.changes_of(i)) {
      if (!std::exchange(is_first, false)) text += ',';
      add_moment_node(text, it);
    }
    text += "]]";
  }
  text += ']';
}

void add_leaf_progress(std::string& text, const LeafProgress& it) {
  add_number(text += '[', it.moment);
  add_number(text += ',', it.node);
  add_number(text += ',', it.progress);
  text += ']';
}

void add_totals(std::string& text, const NodeTotals& it) {
  add_number(text += '[', it.node);
  for (const std::uint64_t count : it.counts) add_number(text += ',', count);
  text += ",0]";  // faults have their own list
}

// Also when no entry has a value.
void add_whole(std::string& text, std::span<const EntryChange> entries) {
  if (!entries.empty()) return add_list(text, lines::kTick["whole"], entries, add_entry);
  ((text += ",\"") += lines::kTick["whole"]) += "\":[]";
}

// Longer than [4294967295,"success",0.00012345678901234567,1,0] and a comma.
constexpr std::size_t kMostOfNode = 64;
static_assert(json_lines::kFullEnd.substr(2, 4) == lines::kTick["full"]);
static_assert(kMostOfNode <= json_lines::kMostAtOnce);
static_assert(std::ranges::all_of(kStatuses, [](const StatusRow& row) {
  return row.name.size() <= std::string_view("success").size();
}));

// The last progress that was written, as its text: a node often has the progress of the one above.
class ProgressText {
 public:
  char* put(char* to, double progress) {
    if (begin_ == nullptr || progress != number_ ||
        std::signbit(progress) != std::signbit(number_)) {
      char* const end = put_progress(to, progress);
      begin_ = to, end_ = end, number_ = progress;
      return end;
    }
    return std::copy(begin_, end_, to);
  }

 private:
  const char *begin_ = nullptr, *end_ = nullptr;  // in what is written
  double number_ = 0;
};

char* put_node(char* to, const NodeChange& change, ProgressText& text) {
  constexpr std::string_view kFlags[] = {",0,0]", ",0,1]", ",1,0]", ",1,1]"};
  const Activity activity = change.activity();
  to = put_integer(put(to, "["), change.node);
  to = put(put(put(to, ",\""), to_string(status_of(activity))), "\",");
  to = text.put(to, change.progress);
  return put(to, kFlags[2 * change.ticked() + (activity == Activity::Paused)]);
}

}  // namespace

std::string json_lines::header(const RecordingHeader& header) {
  Json json = {{lines::kHeader["lockstep_recording"], kRecordingVersion}};
  add_members(json, lines::kHeader, header);
  return json.text() + '\n';
}

std::string json_lines::end(const RecordedEnd& end) {
  Json json = {{lines::kEndLine["end"], Json::object()}};
  add_members(json[lines::kEndLine["end"]], lines::kEnd, end);
  return json.text() + '\n';
}

// ]} or ],"limits":[[1,0.5]],"rounds":[[2,3,8]],"succeeded":[1],"faults":[[3,"threw …"],…],… }
// and a newline; of a long message only the beginning.
void json_lines::set_tick_end(std::string& text, const TickEnd& end) {
  text = ']';
  add_list(text, lines::kTick["limits"], end.limits, add_limit);
  add_list(text, lines::kTick["rounds"], end.rounds, add_round);
  add_list(text, lines::kTick["factors"], end.factors, add_factor);
  add_list(text, lines::kTick["reasons"], end.reasons, add_reason);
  add_list(text, lines::kTick["answers"], end.answers, add_answer);
  add_list(text, lines::kTick["heard"], end.heard, add_heard);
  add_list(text, lines::kTick["succeeded"], end.succeeded, add_number<NodeIndex>);
  add_moments(text, end.moments);
  add_list(text, lines::kTick["leaf_progress"], end.moments.progress, add_leaf_progress);
  add_list(text, lines::kTick["more"], end.moments.rest, add_totals);
  add_list(text, lines::kTick["faults"], end.faults, add_fault);
  add_list(text, lines::kTick["entries"], end.entries, add_entry);
  add_set(text, end.entries);
  add_given(text, end.entries);
  add_list(text, lines::kTick["logs"], end.logs, add_log);
  if (end.whole) add_whole(text, *end.whole);
  text += end.is_full ? kFullEnd : "}\n";
}

std::size_t json_lines::most_of_tick_end(std::size_t nodes, std::size_t limits,
                                         std::size_t entries) {
  const MostWithin most = most_within(nodes);
  const std::size_t moments = kMostOfMoment * most.moments + kMostOfMomentNode * most.changes +
                              kMostOfLeafProgress * most.progress + kUsualTotals * nodes;
  return 80 + 64 * (limits + entries) + moments;
}

// {"lost":{"ticks":2,"from":7}} and the end of the line.
char* json_lines::put_lost(char* to, std::uint64_t ticks, std::uint64_t from) {
  to = put_key(put_key(to, '{', lines::kLostLine["lost"]), '{', lines::kLost["ticks"]);
  to = put_key(put_integer(to, ticks), ',', lines::kLost["from"]);
  return put(put_integer(to, from), "}}\n");
}

// {"tick":3,"time_s":0.03,"nodes":[ with the exact time, where a double would say
// 0.030000000000000002.
char* json_lines::put_tick(char* to, std::uint64_t tick, Nanoseconds time) {
  to = put_integer(put_key(to, '{', lines::kTick["tick"]), tick);
  to = put_seconds(put_key(to, ',', lines::kTick["time_s"]), time);
  return put(put_key(to, ',', lines::kTick["nodes"]), "[");
}

// [3,"running",0.25,1,0],[4,…
json_lines::Put json_lines::put_nodes(std::span<char> room, std::span<const NodeChange> nodes,
                                      bool first) {
  const std::size_t count = std::min(nodes.size(), room.size() / kMostOfNode);
  char* to = room.data();
  ProgressText text;
  for (const NodeChange& change : nodes.first(count)) {
    if (!first) *to++ = ',';
    first = false;
    to = put_node(to, change, text);
  }
  return {to, count};
}

// Behind the first key.
std::string json_lines::part_header(std::string_view header, std::uint64_t first_tick) {
  static_assert(lines::kHeaderFields[0].key == lines::kHeader["lockstep_recording"]);
  const auto place = header.find(',') + 1;
  return fmt::format("{}\"{}\":{},{}", header.substr(0, place), lines::kHeader["first_tick"],
                     first_tick, header.substr(place));
}

std::string json_lines::part_end(std::uint64_t ticks) {
  const Json json = {{lines::kContinuedLine["continued"], {{lines::kContinued["ticks"], ticks}}}};
  return json.text() + '\n';
}

// The line begins as {"tick":7,…
std::optional<std::uint64_t> json_lines::tick_of(std::string_view line) {
  constexpr std::string_view kTick = "{\"tick\":";
  static_assert(kTick.substr(2, kTick.size() - 4) == lines::kTick["tick"]);
  if (!line.starts_with(kTick)) return std::nullopt;
  std::uint64_t tick = 0;
  const auto read = std::from_chars(line.data() + kTick.size(), line.data() + line.size(), tick);
  return read.ec == std::errc() ? std::optional(tick) : std::nullopt;
}

std::optional<std::uint64_t> json_lines::next_tick_of(std::string_view line) {
  if (const auto tick = tick_of(line)) return *tick + 1;
  constexpr std::string_view kGap = "{\"lost\":{\"ticks\":", kFrom = ",\"from\":";
  if (!line.starts_with(kGap)) return std::nullopt;
  const char* const end = line.data() + line.size();
  std::uint64_t ticks = 0, from = 0;
  const auto read = std::from_chars(line.data() + kGap.size(), end, ticks);
  if (!std::string_view(read.ptr, end).starts_with(kFrom)) return std::nullopt;
  return std::from_chars(read.ptr + kFrom.size(), end, from).ec == std::errc()
             ? std::optional(from + ticks)
             : std::nullopt;
}

std::string json_lines::lost(std::uint64_t ticks, std::uint64_t from) {
  std::string line(128, '\0');
  line.resize(static_cast<std::size_t>(put_lost(line.data(), ticks, from) - line.data()));
  return line;
}

bool json_lines::is_last(std::string_view line) {
  constexpr std::string_view kEnd = "{\"end\"";
  static_assert(kEnd.substr(2, kEnd.size() - 3) == lines::kEndLine["end"]);
  return line.starts_with(kEnd);
}

}  // namespace lockstep::host
