#include "study/plan_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>

#include "base/json/json.h"
#include "base/json/reader.h"
#include "study/plan_check.h"
#include "study/precision.h"

namespace lockstep::host {
namespace {

constexpr int kFormat = 2;
constexpr char kGap[] = "gap";
constexpr char kUntilCi[] = "until_ci";
constexpr char kRows[] = "rows";
constexpr char kNotOurs[] = "it is not as lockstep wrote it";
constexpr std::array<const char*, 3> kKinds{"argument", "seed", "rate"};

Json pairs(const std::vector<std::pair<std::string, std::string>>& list, const char* first,
           const char* second) {
  Json array = Json::array();
  for (const auto& [a, b] : list) array.push_back({{first, a}, {second, b}});
  return array;
}

Json grid_json(const StudyPlan& plan) {
  Json grid = Json::array();
  const GridAxis* before = nullptr;
  for (const GridAxis& axis : plan.grid) {
    Json json{{"name", axis.name},
              {"is", kKinds[static_cast<std::size_t>(axis.kind)]},
              {"values", axis.values}};
    if (axis.follows && before != nullptr) json["together_with"] = before->name;
    grid.push_back(std::move(json));
    before = &axis;
  }
  return grid;
}

Json column_json(const StudyColumn& column) {
  Json json{{"measure", column.measure}, {"node", column.node}};
  if (column.is_gap) json["is"] = kGap;
  if (!column.cells.empty()) json["cells"] = column.cells;
  return json;
}

Json json_of(const StudyPlan& plan) {
  Json columns = Json::array();
  for (const StudyColumn& column : plan.columns) columns.push_back(column_json(column));
  Json json{{"lockstep_study", kFormat},
            {"version", plan.version},
            {"tree", plan.tree_file},
            {"main_tree", plan.main_tree},
            {"arguments", plan.arguments},
            {"values", plan.values},
            {"grid", grid_json(plan)},
            {"runs", plan.runs},
            {"seed", plan.seed},
            {"rate", plan.rate},
            {"max_ticks", plan.max_ticks},
            {"measures", plan.measures},
            {"columns", columns},
            {"plugins", pairs(plan.plugins, "name", "version")},
            {"files", pairs(plan.files, "path", "text")}};
  if (plan.paired) json["paired"] = true;
  if (plan.precision) json[kUntilCi] = to_text(*plan.precision);
  if (plan.rows != StudyRows::Csv) json[kRows] = kStudyRows[static_cast<std::size_t>(plan.rows)];
  if (plan.shard != StudyShard{}) {
    json["shard"] = {{"part", plan.shard.part}, {"of", plan.shard.of}};
  }
  return json;
}

// For JsonField: stores a list of two texts each, an object of texts.
auto into_pairs(std::vector<std::pair<std::string, std::string>>& list, const char* first,
                const char* second) {
  return [&list, first, second](JsonValue value) {
    value.each_item([&](JsonValue item) {
      auto& [a, b] = list.emplace_back();
      item.object().read({{first, into(a)}, {second, into(b)}});
    });
  };
}

auto into_map(std::map<std::string, std::string>& map) {
  return [&map](JsonValue value) {
    value.object().each_field(
        [&](std::string_view name, JsonValue text) { map.emplace(name, text.text()); });
  };
}

GridAxis axis_from(JsonObject json) {
  GridAxis axis;
  std::string kind;
  json.read({{"name", into(axis.name)},
             {"is", into(kind)},
             {"values", into(axis.values)},
             {"together_with",
              [&](JsonValue value) {
                value.skip();
                axis.follows = true;
              },
              kMayLack}});
  const auto found = std::ranges::find(kKinds, kind);
  if (found == kKinds.end()) throw JsonError("'is' of a grid is not known");
  axis.kind = static_cast<GridAxis::Kind>(found - kKinds.begin());
  return axis;
}

StudyColumn column_from(JsonObject json) {
  StudyColumn column;
  const auto read_cells = [&](JsonValue value) {
    value.each_item([&](JsonValue item) { column.cells.push_back(item.whole()); });
  };
  json.read({{"measure", into(column.measure)},
             {"node", into(column.node)},
             {"is", [&](JsonValue value) { column.is_gap = value.text() == kGap; }, kMayLack},
             {"cells", read_cells, kMayLack}});
  return column;
}

void check_format(JsonValue value) {
  if (value.whole() != kFormat) throw JsonError("it is from another version of lockstep");
}

void read(JsonObject json, StudyPlan& plan) {
  const auto read_grid = [&](JsonValue value) {
    value.each_item([&](JsonValue item) { plan.grid.push_back(axis_from(item.object())); });
  };
  const auto read_columns = [&](JsonValue value) {
    value.each_item([&](JsonValue item) { plan.columns.push_back(column_from(item.object())); });
  };
  const auto read_shard = [&](JsonValue value) {
    value.object().read({{"part", into(plan.shard.part)}, {"of", into(plan.shard.of)}});
  };
  const auto read_paired = [&](JsonValue value) {
    value.skip();  // there is no other value
    plan.paired = true;
  };
  const auto read_precision = [&](JsonValue value) {
    plan.precision = precision_from(value.text());
  };
  const auto read_rows = [&](JsonValue value) {
    const auto found = std::ranges::find(kStudyRows, value.text());
    if (found == kStudyRows.end()) throw JsonError("'rows' is not known");
    plan.rows = static_cast<StudyRows>(found - kStudyRows.begin());
  };
  json.read({{"lockstep_study", check_format},
             {"version", into(plan.version)},
             {"tree", into(plan.tree_file)},
             {"main_tree", into(plan.main_tree)},
             {"arguments", into_map(plan.arguments)},
             {"values", into_map(plan.values)},
             {"grid", read_grid},
             {"runs", into(plan.runs)},
             {"seed", into(plan.seed)},
             {"rate", into(plan.rate)},
             {"max_ticks", into(plan.max_ticks)},
             {"measures", into(plan.measures)},
             {"columns", read_columns},
             {"plugins", into_pairs(plan.plugins, "name", "version")},
             {"files", into_pairs(plan.files, "path", "text")},
             {"paired", read_paired, kMayLack},
             {kUntilCi, read_precision, kMayLack},
             {kRows, read_rows, kMayLack},
             {"shard", read_shard, kMayLack}});
}

}  // namespace

std::string to_json(const StudyPlan& plan) {
  // A text that is not UTF-8 was refused with the tree; a path need not be.
  return json_of(plan).text(2) + '\n';
}

Result<StudyPlan> plan_from_json(std::string text) {
  StudyPlan plan;
  std::string error;
  try {
    JsonReader().read(text, [&](JsonObject json) { read(json, plan); });
    error = check_plan(plan);
  } catch (const JsonError& bad) {
    error = bad.what();
  }
  // Keys that are not known, or are in another order.
  if (error.empty() && to_json(plan) != text) error = kNotOurs;
  if (!error.empty()) return problem(std::move(error));
  return plan;
}

std::string first_difference(const StudyPlan& one, const StudyPlan& other, bool with_shard) {
  // As they are written: a path that is not UTF-8 is something else there.
  const Json a = json_of(one);
  Json b = json_of(other);
  for (const auto& [key, value] : a.members()) {
    if (key != "shard" && b[key].text() != value.text()) return key;
  }
  if (one.paired != other.paired) return "paired";
  if (one.precision != other.precision) return kUntilCi;
  if (one.rows != other.rows) return kRows;
  return with_shard && one.shard != other.shard ? "shard" : "";
}

}  // namespace lockstep::host
