#include "record/use/mcap_messages.h"

#include <fmt/format.h>

#include <cmath>
#include <string>
#include <utility>

#include "base/core/value.h"
#include "base/json/json.h"

namespace lockstep::host {
namespace {

constexpr std::string_view kStatus =
    R"({"title":"lockstep.Status","type":"object","properties":{"tick":{"type":"integer"},)"
    R"("times":{"type":"integer"},)"
    R"("changes":{"type":"array","items":{"type":"object","properties":{"path":{"type":"string"},)"
    R"("status":{"type":"string"},"progress":{"type":"number"},"ticked":{"type":"boolean"},)"
    R"("held":{"type":"boolean"}}}}}})";
constexpr std::string_view kProgress =
    R"({"title":"lockstep.Progress","type":"object","properties":{"tick":{"type":"integer"},)"
    R"("limit":{"type":["number","null"]},"progress":{"type":"object","additionalProperties":)"
    R"({"type":"number"}},"held":{"type":"object","additionalProperties":{"type":"boolean"}},)"
    R"("factor":{"type":"object","additionalProperties":{"type":"number"}}}})";
constexpr std::string_view kEntry =
    R"({"title":"lockstep.Entry","type":"object","properties":{"tick":{"type":"integer"},)"
    R"("value":{"type":["string","number","boolean","null"]}}})";
// As Foxglove has it.
constexpr std::string_view kLog =
    R"({"title":"foxglove.Log","type":"object","properties":{"timestamp":{"type":"object",)"
    R"("title":"time","properties":{"sec":{"type":"integer"},"nsec":{"type":"integer"}}},)"
    R"("level":{"type":"integer"},"message":{"type":"string"},"name":{"type":"string"},)"
    R"("file":{"type":"string"},"line":{"type":"integer"}}})";

constexpr std::uint64_t kSecond = 1'000'000'000;

int level_number(std::string_view level) {
  return level == "debug" ? 1 : level == "info" ? 2 : level == "warning" ? 3 : 4;
}

// A number or a truth value where the type of the entry is one.
Json value_of(const ShapeEntry& key, const std::optional<std::string>& text) {
  if (!text) return nullptr;
  if (key.type == "bool") return *text == "true";
  const bool is_number = key.type == "int" || key.type == "double";
  const auto number = is_number ? parse_double(*text) : std::nullopt;
  return number && std::isfinite(*number) ? Json(*number) : Json(*text);
}

std::uint64_t in_nanoseconds(double seconds) {
  return static_cast<std::uint64_t>(std::llround(seconds * double{kSecond}));
}

}  // namespace

McapMessages::McapMessages(const RecordingHeader& header, double start_time,
                           const ExportSink& write)
    : header_(header),
      start_(static_cast<std::uint64_t>(std::llround(start_time * double{kSecond}))),
      file_("lockstep " + header.version, write),
      status_(file_.add_channel(file_.add_schema("lockstep.Status", kStatus), "/lockstep/status")),
      log_(file_.add_channel(file_.add_schema("foxglove.Log", kLog), "/lockstep/log")),
      entry_schema_(file_.add_schema("lockstep.Entry", kEntry)),
      before_(header.nodes.size()) {
  const auto schema = file_.add_schema("lockstep.Progress", kProgress);
  for (auto& it : compared_children(header)) {
    const auto topic = "/lockstep/progress/" + header.nodes[it.node].path;
    compared_.push_back({std::move(it), file_.add_channel(schema, topic)});
  }
}

bool McapMessages::take(const RecordedTick& tick) {
  const std::uint64_t time = start_ + in_nanoseconds(tick.time);
  add_statuses(tick, time);
  for (const Compared& it : compared_) {
    if (tick.nodes[it.of.node].ticked) add_progress(it, tick, time);
  }
  for (const RecordedEntry& it : tick.entries) {
    const Json message{{"tick", tick.tick},
                       {"value", value_of(header_.entries[it.entry], it.value)}};
    file_.add(channel_of(it.entry), time, message.text());
  }
  for (const RecordedFault& it : tick.faults) {
    add_log({header_.nodes[it.node].path, "error", it.message}, time);
  }
  for (const LeafLine& it : tick.logs) add_log(it, time);
  return !file_.is_stopped();
}

bool McapMessages::finish(const std::optional<RecordedEnd>& end) {
  if (end) {
    const std::uint64_t time = start_ + in_nanoseconds(end->time);
    for (const LeafLine& it : end->logs) add_log(it, time);
    const bool is_good = end->result == "success";
    add_log({header_.id, is_good ? "info" : "warning",
             "run ended: " + end->result + " (" + end->reason + ")"},
            time);
  }
  return file_.finish();
}

// Of a tick with several moments, a message each: what the state after the tick does not show.
void McapMessages::add_statuses(const RecordedTick& tick, std::uint64_t time) {
  tick.moments.each(moment_, [&](std::span<const NodeState> now, const TickMoment& it, bool) {
    begin_statuses(tick, it.times);
    for (NodeIndex node = 0; node < before_.size(); ++node) {
      RecordedState state = tick.nodes[node];
      state.status = now[node].status();
      state.ticked = now[node].ticked();
      state.held = now[node].held();
      add_status(node, state);
    }
    end_statuses(time);
  });
  begin_statuses(tick, 1);
  for (NodeIndex node = 0; node < before_.size(); ++node) add_status(node, tick.nodes[node]);
  end_statuses(time);
}

// As text at once: in most ticks this is nearly all that there is to write.
void McapMessages::begin_statuses(const RecordedTick& tick, std::uint64_t times) {
  text_ = fmt::format(R"({{"tick":{},)", tick.tick);
  if (times > 1) text_ += fmt::format(R"("times":{},)", times);
  text_ += R"("changes":[)";
}

void McapMessages::add_status(NodeIndex node, const RecordedState& state) {
  if (state == std::exchange(before_[node], state)) return;
  if (text_.back() != '[') text_ += ',';
  append_json(text_ += R"({"path":)", header_.nodes[node].path);
  (text_ += R"(,"status":")") += to_string(state.status);
  append_json(text_ += R"(","progress":)", state.progress);
  text_ += state.ticked ? R"(,"ticked":true)" : R"(,"ticked":false)";
  text_ += state.held ? R"(,"held":true})" : R"(,"held":false})";
}

void McapMessages::end_statuses(std::uint64_t time) {
  if (text_.back() != '[') file_.add(status_, time, text_ += "]}");
}

void McapMessages::add_progress(const Compared& compared, const RecordedTick& tick,
                                std::uint64_t time) {
  Json progress = Json::object(), held = Json::object(), factor = Json::object();
  for (std::size_t i = 0; i < compared.of.children.size(); ++i) {
    const NodeIndex child = compared.of.children[i];
    const std::string& name = compared.of.names[i];
    progress[name] = tick.nodes[child].progress;
    held[name] = tick.nodes[child].held;
    factor[name] = tick.nodes[child].factor;
  }
  Json message{{"tick", tick.tick},
               {"limit", tick.nodes[compared.of.node].limit},  // null: no barrier is left
               {"progress", std::move(progress)},
               {"held", std::move(held)}};
  if (header_.nodes[compared.of.node].paces) message["factor"] = std::move(factor);
  file_.add(compared.channel, time, message.text());
}

void McapMessages::add_log(const LeafLine& line, std::uint64_t time) {
  const Json message{{"timestamp", {{"sec", time / kSecond}, {"nsec", time % kSecond}}},
                     {"level", level_number(line.level)},
                     {"message", line.text},
                     {"name", line.who},
                     {"file", ""},
                     {"line", 0}};
  file_.add(log_, time, message.text());
}

// An entry without a value has none.
std::uint16_t McapMessages::channel_of(std::uint32_t entry) {
  const auto found = entries_.find(entry);
  if (found != entries_.end()) return found->second;
  const auto channel =
      file_.add_channel(entry_schema_, "/lockstep/entries/" + header_.entries[entry].key);
  return entries_[entry] = channel;
}

}  // namespace lockstep::host
