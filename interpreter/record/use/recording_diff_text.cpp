#include <fmt/format.h>

#include <cmath>

#include "base/core/diagnostics.h"
#include "base/core/wording.h"
#include "base/json/json.h"
#include "base/terminal/style.h"
#include "record/use/recording_diff.h"

namespace lockstep::host {
namespace {

class Text {
 public:
  explicit Text(bool color) : color_(color) {}

  void files(const std::string& a, const std::string& b) {
    line("--- " + a, Style::Strong);
    line("+++ " + b, Style::Strong);
  }
  void section(const std::string& name) { line("@@ " + name + " @@", Style::Active); }
  void plain(const std::string& text) { line(" " + text, Style::Plain); }
  void removed(const std::string& text) { line("-" + text, Style::Bad); }
  void added(const std::string& text) { line("+" + text, Style::Good); }
  void pair(const std::string& a, const std::string& b) {
    removed(a);
    added(b);
  }
  void values(const std::string& name, const std::vector<ValueDifference>& values) {
    if (!values.empty()) section(name);
    for (const ValueDifference& value : values) {
      if (value.a) removed(fmt::format("{} {}", value.what, *value.a));
      if (value.b) added(fmt::format("{} {}", value.what, *value.b));
    }
  }
  std::string take() { return std::move(text_); }

 private:
  void line(const std::string& text, Style style) {
    text_ += styled(printable(text), style, color_) + "\n";
  }

  bool color_;
  std::string text_;
};

std::string describe(const RecordedState& state) {
  std::string text = fmt::format("  {}, progress {}{}{}", to_string(state.status), state.progress,
                                 state.ticked ? ", ticked" : "", state.held ? ", held" : "");
  if (state.limit != 0) text += fmt::format(", limit {}", state.limit);
  return text;
}

void add_tick(Text& text, const TickDifference& tick) {
  text.section(fmt::format("tick {}", tick.tick));
  if (tick.missing != TickDifference::Missing::None) {
    const std::string there = "recorded", missing = tick.lost ? "lost" : "not there";
    const bool in_a = tick.missing == TickDifference::Missing::InA;
    return text.pair(in_a ? missing : there, in_a ? there : missing);
  }
  if (tick.time_a != tick.time_b) {
    text.pair(fmt::format("time_s {}", tick.time_a), fmt::format("time_s {}", tick.time_b));
  }
  for (const NodeDifference& node : tick.nodes) {
    text.plain(node.path);
    text.pair(describe(node.a), describe(node.b));
  }
  for (const std::string& moments : tick.moments_a) text.removed("results " + moments);
  for (const std::string& moments : tick.moments_b) text.added("results " + moments);
  for (const std::string& fault : tick.faults_a) text.removed("fault " + fault);
  for (const std::string& fault : tick.faults_b) text.added("fault " + fault);
  for (const std::string& entry : tick.entries_a) text.removed("entry " + entry);
  for (const std::string& entry : tick.entries_b) text.added("entry " + entry);
}

Json json_of(const std::vector<ValueDifference>& values) {
  Json json = Json::array();
  for (const ValueDifference& value : values) {
    json.push_back({{"what", value.what}, {"a", value.a}, {"b", value.b}});
  }
  return json;
}

Json json_of(const RecordedState& state, bool has_limit) {
  Json json = {{"status", to_string(state.status)},
               {"progress", state.progress},
               {"ticked", state.ticked},
               {"held", state.held}};
  if (has_limit) json["limit"] = std::isinf(state.limit) ? Json() : Json(state.limit);
  return json;
}

Json json_of(const TickDifference& tick) {
  Json json = {{"tick", tick.tick}};
  if (tick.missing != TickDifference::Missing::None) {
    json["missing_in"] = tick.missing == TickDifference::Missing::InA ? "a" : "b";
    json["lost"] = tick.lost;
    return json;
  }
  if (tick.time_a != tick.time_b) json["time_s"] = {{"a", tick.time_a}, {"b", tick.time_b}};
  json["nodes"] = Json::array();
  for (const NodeDifference& node : tick.nodes) {
    const bool has_limit = node.a.limit != 0 || node.b.limit != 0;
    json["nodes"].push_back({{"path", node.path},
                             {"a", json_of(node.a, has_limit)},
                             {"b", json_of(node.b, has_limit)}});
  }
  if (!tick.moments_a.empty() || !tick.moments_b.empty()) {
    json["results"] = {{"a", tick.moments_a}, {"b", tick.moments_b}};
  }
  if (!tick.faults_a.empty() || !tick.faults_b.empty()) {
    json["faults"] = {{"a", tick.faults_a}, {"b", tick.faults_b}};
  }
  if (!tick.entries_a.empty() || !tick.entries_b.empty()) {
    json["entries"] = {{"a", tick.entries_a}, {"b", tick.entries_b}};
  }
  return json;
}

}  // namespace

std::string to_text(const RecordingDiff& diff, const std::string& a, const std::string& b,
                    bool color) {
  if (diff.same()) return {};
  Text text(color);
  text.files(a, b);
  for (const std::string& note : diff.notes) text.plain("note: " + note);
  text.values("header", diff.header);
  if (!diff.has_common_nodes) {
    text.plain("the trees have no node in common: their ticks are not compared");
  }
  if (diff.tick) add_tick(text, *diff.tick);
  if (diff.ticks_a != diff.ticks_b) {
    text.section("length");
    text.pair(counted(diff.ticks_a, "tick"), counted(diff.ticks_b, "tick"));
  }
  text.values("end", diff.end);
  return text.take();
}

std::string to_json(const RecordingDiff& diff) {
  const Json json = {{"same", diff.same()},
                     {"header", json_of(diff.header)},
                     {"first_tick", diff.tick ? json_of(*diff.tick) : Json()},
                     {"ticks", {{"a", diff.ticks_a}, {"b", diff.ticks_b}}},
                     {"end", json_of(diff.end)},
                     {"notes", diff.notes}};
  return json.printable();
}

}  // namespace lockstep::host
