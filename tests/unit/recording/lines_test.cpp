// One table says what the lines of a recording have: what is made from it is not stale, and writer
// and reader know each of its keys.
#include "record/lines.h"

#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "base/core/progress.h"
#include "base/core/status.h"
#include "record/json_lines.h"
#include "record/live/event_counts.h"
#include "record/read/recording_reader.h"
#include "support/generated_file.h"

namespace lockstep::host {
namespace {

using lines::Field;
using lines::Tuple;
using nlohmann::ordered_json;

template <class Rows>
auto row_of(const Rows& rows, std::string_view name) {
  const auto found = std::ranges::find_if(rows, [&](const auto& it) { return it.name == name; });
  return found == std::end(rows) ? nullptr : &*found;
}

std::vector<Tuple::Part> parts(const Tuple& tuple) {
  std::vector<Tuple::Part> parts;
  for (const Tuple::Part& it : tuple.parts) {
    if (!it.name.empty()) parts.push_back(it);
  }
  return parts;
}

bool cut(std::string_view& text, std::string_view end) {
  if (!text.ends_with(end)) return false;
  text.remove_suffix(end.size());
  return true;
}

// --- the types of the page ---------------------------------------------------------------------

std::string typescript(std::string_view type) {
  if (cut(type, " | null")) return typescript(type) + " | null";
  if (cut(type, "[]")) return typescript(type) + "[]";
  const auto* value = row_of(lines::kValues, type);
  return std::string(value != nullptr ? value->typescript : type);
}

std::string page_types() {
  std::string text =
      "// The lines of a recording, as docs/recording.md describes them. Made by `./dev generate` "
      "from\n// interpreter/record/lines.h, base/core/status.h and base/core/progress.h.\n\nexport "
      "const "
      "STATUSES = [";
  std::string numbers;
  for (const StatusRow& row : kStatuses) {
    const char* separator = row.status == kStatuses.front().status ? "" : ", ";
    text += fmt::format("{}\"{}\"", separator, row.name);
    numbers += separator;
    for (const char letter : row.name) numbers += static_cast<char>(std::toupper(letter));
    numbers += fmt::format(" = {}", index_of(row.status));
  }
  text += "] as const;\nexport type StatusName = (typeof STATUSES)[number];\nexport const ";
  text += numbers + ";\n\n// Progress that differs by no more is the same.\n";
  text += fmt::format("export const PROGRESS_EPSILON = {};\n\n", kProgressEpsilon);
  for (const Tuple& it : lines::kTuples) {
    std::string list;
    for (const Tuple::Part& part : parts(it)) {
      list += fmt::format("{}{}: {}", list.empty() ? "" : ", ", part.name, typescript(part.type));
    }
    text += fmt::format("export type {} = [{}];\n", it.name, list);
  }
  for (const lines::Object& it : lines::kObjects) {
    text += fmt::format("\nexport interface {} {{\n", it.name);
    for (const Field& field : it.fields) {
      const char* sign = field.has == lines::kMaybe ? "?" : "";
      text += fmt::format("  {}{}: {};\n", field.key, sign, typescript(field.type));
    }
    text += "}\n";
  }
  text += "\nexport type Line =";
  for (const lines::Object& it : std::span(lines::kObjects).first(lines::kKinds)) {
    text += fmt::format("{} {}", it.name == lines::kObjects[0].name ? "" : " |", it.name);
  }
  return text + ";\n";
}

// --- the JSON Schema ---------------------------------------------------------------------------

ordered_json schema(std::string_view type) {
  if (cut(type, " | null")) return {{"anyOf", {schema(type), {{"type", "null"}}}}};
  if (cut(type, "[]")) return {{"type", "array"}, {"items", schema(type)}};
  const auto* value = row_of(lines::kValues, type);
  if (value != nullptr) return ordered_json::parse("{" + std::string(value->schema) + "}");
  return {{"$ref", fmt::format("#/definitions/{}", type)}};
}

ordered_json schema(const Tuple& tuple) {
  ordered_json items;
  for (const Tuple::Part& it : parts(tuple)) items.push_back(schema(it.type));
  const std::size_t count = items.size();
  return {{"type", "array"}, {"items", items}, {"minItems", count}, {"maxItems", count}};
}

ordered_json schema(const lines::Object& object) {
  ordered_json required, properties;
  for (const Field& it : object.fields) {
    if (it.has == lines::kAlways) required.push_back(it.key);
    properties[std::string(it.key)] = schema(it.type);
  }
  return {{"type", "object"}, {"required", required}, {"properties", properties}};
}

// Each definition on a line.
std::string whole_schema() {
  ordered_json kinds, names, definitions;
  for (const lines::Object& it : std::span(lines::kObjects).first(lines::kKinds)) {
    kinds.push_back(schema(it.name));
  }
  for (const StatusRow& row : kStatuses) names.push_back(row.name);
  definitions["StatusName"] = {{"enum", names}};
  for (const Tuple& it : lines::kTuples) definitions[std::string(it.name)] = schema(it);
  for (const lines::Object& it : lines::kObjects) definitions[std::string(it.name)] = schema(it);
  std::string text;
  for (const auto& it : definitions.items()) {
    text += fmt::format("{}\n    \"{}\": {}", text.empty() ? "" : ",", it.key(), it.value().dump());
  }
  return fmt::format(
      "{{\n  \"$schema\": \"http://json-schema.org/draft-07/schema#\",\n"
      "  \"title\": \"A line of a recording. docs/recording.md\",\n"
      "  \"anyOf\": {},\n  \"definitions\": {{{}\n  }}\n}}\n",
      kinds.dump(), text);
}

// --- the tables of docs/recording.md -----------------------------------------------------------

std::string notation(std::string_view type) {
  std::string text = "`[";
  cut(type, "[]");
  for (const Tuple::Part& it : parts(*row_of(lines::kTuples, type))) {
    text += fmt::format("{}{}", text.size() > 2 ? ", " : "", it.name);
  }
  return text + "]`";
}

std::string markdown_table(const lines::Object& object) {
  std::string text = "| Key | Meaning |\n|---|---|\n";
  for (const Field& it : object.fields) {
    std::string meaning(it.meaning);
    const auto place = meaning.find("{}");
    if (place != std::string::npos) meaning.replace(place, 2, notation(it.type));
    text += fmt::format("| `{}` | {} |\n", it.key, meaning);
  }
  return text;
}

// Between <!-- lines: NAME --> and <!-- /lines -->, each on a line.
std::string with_tables(std::string text) {
  for (const lines::Object& it : {lines::kHeader, lines::kHeaderNode, lines::kHeaderEntry,
                                  lines::kTick, lines::kLost, lines::kContinued, lines::kEnd}) {
    const std::string begin = fmt::format("<!-- lines: {} -->\n", it.name);
    const auto at = text.find(begin);
    const auto end = text.find("<!-- /lines -->", at);
    INFO(begin);
    REQUIRE(end != std::string::npos);
    const std::size_t from = at + begin.size();
    text.replace(from, end - from, markdown_table(it));
  }
  return text;
}

// --- a recording that has everything -----------------------------------------------------------

void fill(std::string& text) {
  text = "T";
}
void fill(std::uint64_t& number) {
  number = 1;
}
void fill(std::optional<std::uint64_t>& number) {
  number = 2;
}
void fill(double& number) {
  number = 0.5;
}
void fill(std::vector<std::string>& texts) {
  texts = {"note"};
}
void fill(std::vector<LeafLine>& logs) {
  logs = {{"T/a", "info", "text"}};
}
void fill(std::map<std::string, std::string, std::less<>>& texts) {
  texts["x"] = "1";
}
void fill(std::optional<double>& number) {
  number = 0.5;
}
void fill(std::vector<ShapeNode>&) {}  // sample_header
void fill(std::vector<ShapeEntry>&) {}

template <class Record>
Record filled(const lines::Object& object) {
  Record record;
  lines::each_member(object, record, [](const Field&, auto& value) { fill(value); });
  return record;
}

std::string sample_header(std::uint64_t first_tick) {
  auto header = filled<RecordingHeader>(lines::kHeader);
  header.clock = "virtual";
  header.first_tick = first_tick;
  if (first_tick > 0) header.resumed_after.reset();  // the line behind it has not the whole state
  header.entries = {{.key = "k", .type = "number", .writers = {2}, .typing = Typing::Strict}};
  const auto add = [&](const char* path, std::optional<NodeIndex> parent) -> ShapeNode& {
    ShapeNode& node = header.nodes.emplace_back();
    node.path = node.kind = node.name = path;
    node.parent = parent;
    return node;
  };
  ShapeNode& root = add("p", std::nullopt);
  root.synchronization = Synchronization::Absolute;
  root.barriers = {0.5};
  root.paces = true;
  ShapeNode& inner = add("q", 0);
  inner.synchronization = Synchronization::Relative;
  inner.delta = 0.25;
  ShapeNode& leaf = add("a", 1);
  leaf.is_guard = true;
  leaf.question = std::make_shared<const NodeQuestion>(
      NodeQuestion{.options = {"yes", "no"}, .fallback = "no", .timeout = 3, .severity = "info"});
  leaf.condition = "k > 1";
  leaf.reads = {"k"};
  using Texts = decltype(RecordingHeader::arguments);
  leaf.ports = std::make_shared<const Texts>(Texts{{"k", "{k}"}});
  ShapeNode& group = add("g", std::nullopt);
  group.synchronization = Synchronization::Absolute;
  group.barriers = {0.5};
  group.members = {2};
  group.ignores_idle = true;
  ShapeNode& pool = add("r", std::nullopt);
  pool.synchronization = Synchronization::Resources;
  pool.resources = {"arm"};
  pool.members = {2};
  return json_lines::header(header);
}

std::string sample_tick(std::uint64_t tick, bool is_full) {
  const std::string value = "1";
  const NodeChange node{.progress = 0.5, .node = 2, .state = 1};
  const LimitChange limit{.node = 0, .limit = 0.5};
  const RoundChange round{.node = 1, .round = {1, 2}};
  const FactorChange factor{.node = 1, .factor = 0.5};
  const ReasonChange reason{.node = 2, .text = "no object"};
  const Heard heard{.node = 2, .run = 1, .word = 1, .time = Nanoseconds(0)};
  const GivenAnswer answer{.node = 2, .answer = "yes", .who = "terminal"};
  const NodeIndex succeeded = 1;
  const Fault fault{.node = 2, .message = "threw"};
  const EntryChange entry{
      .entry = 0, .text = &value, .is_set = true, .is_written_again = true, .given = &value};
  const LeafLine log{"T/a", "info", "text"};
  const TickMoment moment{.times = 3, .changes = 1};
  const MomentChange of_moment{
      .node = 2, .before = NodeState::of(Activity::Success, true), .after = {}};
  const LeafProgress progress{.moment = 0, .node = 2, .progress = 0.5};
  const NodeTotals more{.node = 1, .after = {}, .counts = {1, 2, 3, 4, 5}};
  char room[json_lines::kMostAtOnce];
  std::string text(room, json_lines::put_tick(room, tick, Nanoseconds(0)));
  text.append(room, json_lines::put_nodes(room, {&node, 1}, true).end);
  std::string end;
  json_lines::set_tick_end(end, {.limits = {&limit, 1},
                                 .rounds = {&round, 1},
                                 .factors = {&factor, 1},
                                 .reasons = {&reason, 1},
                                 .answers = {&answer, 1},
                                 .heard = {&heard, 1},
                                 .succeeded = {&succeeded, 1},
                                 .moments = {.first = {},
                                             .moments = {&moment, 1},
                                             .changes = {&of_moment, 1},
                                             .rest = {&more, 1},
                                             .progress = {&progress, 1}},
                                 .faults = {&fault, 1},
                                 .entries = {&entry, 1},
                                 .logs = {&log, 1},
                                 .is_full = is_full,
                                 .whole = std::span(&entry, 1)});
  if (!is_full) return text + end;
  EventCounts counts;
  counts.take_fault(2);
  counts.take_entry(0, "1");
  const std::string_view full_end = json_lines::kFullEnd;
  return text + end.insert(end.size() - full_end.size(), counts_json(counts, tick));
}

std::vector<ordered_json> sample() {
  char room[json_lines::kMostAtOnce];
  auto end = filled<RecordedEnd>(lines::kEnd);
  end.ticks = 8;
  const std::string text = sample_header(5) + sample_tick(5, false) +
                           std::string(room, json_lines::put_lost(room, 1, 6)) +
                           sample_tick(7, true) + json_lines::part_end(8) +
                           json_lines::part_header(sample_header(0), 8) + json_lines::end(end);
  std::vector<ordered_json> all;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) all.push_back(ordered_json::parse(line));
  return all;
}

std::string error_of(const std::vector<ordered_json>& all) {
  std::stringstream text;
  for (const ordered_json& line : all) text << line.dump() << "\n";
  RecordingReader reader(text, "r");
  while (reader.next()) {
  }
  return reader.error();
}

// Each object of the sample, with its row of the table.
template <class Visit>
void each_object(std::vector<ordered_json>& all, Visit visit) {
  visit(lines::kHeader, all[0]);
  for (ordered_json& node : all[0]["nodes"]) visit(lines::kHeaderNode, node);
  for (ordered_json& entry : all[0]["entries"]) visit(lines::kHeaderEntry, entry);
  visit(lines::kTick, all[1]);
  visit(lines::kLostLine, all[2]);
  visit(lines::kLost, all[2]["lost"]);
  visit(lines::kTick, all[3]);
  visit(lines::kContinuedLine, all[4]);
  visit(lines::kContinued, all[4]["continued"]);
  visit(lines::kHeader, all[5]);
  visit(lines::kEndLine, all[6]);
  visit(lines::kEnd, all[6]["end"]);
}

TEST_CASE("record/lines.h: what is made from the table is not stale") {
  test::check_generated("interpreter/show/web/page/src/model/recording.ts", page_types());
  test::check_generated("schema/recording.schema.json", whole_schema());
  const std::string docs = "docs/recording.md";
  test::check_generated(docs, with_tables(test::project_file(docs)));
}

TEST_CASE("record/lines.h: the writer writes each key of the table") {
  std::vector<ordered_json> all = sample();
  std::set<std::string> missing, written;
  for (const lines::Object& object : lines::kObjects) {
    for (const Field& it : object.fields) missing.insert(fmt::format("{}.{}", object.name, it.key));
  }
  each_object(all, [&](const lines::Object& object, const ordered_json& value) {
    for (const Field& it : object.fields) {
      INFO(object.name << "." << it.key);
      CHECK((it.has == lines::kMaybe || value.contains(std::string(it.key))));
    }
    for (const auto& member : value.items()) {
      const std::string name = fmt::format("{}.{}", object.name, member.key());
      INFO(name << " is not in the table");
      CHECK((written.contains(name) || missing.erase(name) == 1));
      written.insert(name);
    }
  });
  INFO("not written: " << ordered_json(missing).dump());
  CHECK(missing.empty());
}

TEST_CASE("record/lines.h: the reader checks each key of the table") {
  // What only the page reads.
  const std::set<std::string_view> passed_over{"full", "counts", "written", "writers"};
  std::vector<ordered_json> all = sample();
  REQUIRE(error_of(all) == "");
  const ordered_json wrong = ordered_json::array({ordered_json::object()});
  each_object(all, [&](const lines::Object& object, ordered_json& value) {
    for (const Field& it : object.fields) {
      const std::string key(it.key);
      if (!value.contains(key) || passed_over.contains(it.key)) continue;
      INFO(object.name << "." << key << " may be anything");
      const ordered_json right = std::exchange(value[key], wrong);
      CHECK(error_of(all) != "");
      value[key] = right;
    }
  });
}

}  // namespace
}  // namespace lockstep::host
