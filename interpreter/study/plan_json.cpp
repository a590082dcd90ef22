#include "study/plan_json.h"

#include <fmt/format.h>

#include <array>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "study/plan_check.h"

namespace lockstep {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kFormat = 2;
constexpr char kGap[] = "gap";
constexpr char kNotOurs[] = "it is not as lockstep has written it";
constexpr std::array<const char*, 3> kKinds{"argument", "seed", "rate"};

Json pairs(const std::vector<std::pair<std::string, std::string>>& list, const char* first,
           const char* second) {
  Json array = Json::array();
  for (const auto& [a, b] : list) array.push_back({{first, a}, {second, b}});
  return array;
}

std::vector<std::pair<std::string, std::string>> pairs(const Json& array, const char* first,
                                                       const char* second) {
  std::vector<std::pair<std::string, std::string>> list;
  for (const Json& it : array) list.emplace_back(it.at(first), it.at(second));
  return list;
}

Json grid_json(const StudyPlan& plan) {
  Json grid = Json::array();
  for (const GridAxis& axis : plan.grid) {
    grid.push_back({{"name", axis.name},
                    {"is", kKinds[static_cast<std::size_t>(axis.kind)]},
                    {"values", axis.values}});
  }
  return grid;
}

GridAxis axis_from(const Json& json) {
  const std::string kind = json.at("is");
  const auto found = std::ranges::find(kKinds, kind);
  if (found == kKinds.end()) throw std::runtime_error("'is' of a grid is not known");
  return {static_cast<GridAxis::Kind>(found - kKinds.begin()), json.at("name"), json.at("values")};
}

Json column_json(const StudyColumn& column) {
  Json json{{"measure", column.measure}, {"node", column.node}};
  if (column.is_gap) json["is"] = kGap;
  if (!column.cells.empty()) json["cells"] = column.cells;
  return json;
}

StudyColumn column_from(const Json& json) {
  StudyColumn column{json.at("measure"), json.at("node")};
  column.is_gap = json.contains("is") && json["is"] == kGap;
  if (json.contains("cells")) json["cells"].get_to(column.cells);
  return column;
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
  if (plan.shard != StudyShard{}) {
    json["shard"] = {{"part", plan.shard.part}, {"of", plan.shard.of}};
  }
  return json;
}

// The library would convert -1, 1.5 or 2^64 in silence.
std::uint64_t count(const Json& json, const char* key) {
  const Json& value = json.at(key);
  if (value.is_number_unsigned()) return value;
  throw std::runtime_error(fmt::format("'{}' is {}, expected a whole number from 0 to {}", key,
                                       value.is_number() ? value.dump() : "not a number",
                                       std::numeric_limits<std::uint64_t>::max()));
}

StudyPlan plan_of(const Json& json) {
  if (json.at("lockstep_study") != kFormat) {
    throw std::runtime_error("it is of another version of lockstep");
  }
  StudyPlan plan;
  plan.version = json.at("version");
  plan.tree_file = json.at("tree");
  plan.main_tree = json.at("main_tree");
  plan.arguments = json.at("arguments");
  plan.values = json.at("values");
  for (const Json& axis : json.at("grid")) plan.grid.push_back(axis_from(axis));
  plan.runs = count(json, "runs");
  plan.seed = count(json, "seed");
  plan.rate = json.at("rate");
  plan.max_ticks = count(json, "max_ticks");
  plan.measures = json.at("measures");
  for (const Json& column : json.at("columns")) plan.columns.push_back(column_from(column));
  plan.plugins = pairs(json.at("plugins"), "name", "version");
  plan.files = pairs(json.at("files"), "path", "text");
  if (json.contains("shard")) {
    plan.shard = {count(json["shard"], "part"), count(json["shard"], "of")};
  }
  return plan;
}

}  // namespace

std::string to_json(const StudyPlan& plan) {
  // A text that is not UTF-8 was refused with the tree; a path need not be.
  return json_of(plan).dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

std::optional<StudyPlan> plan_from_json(const std::string& text, std::string& error) {
  try {
    StudyPlan plan = plan_of(Json::parse(text));
    error = check_plan(plan);
    // Keys that are not known, are there twice or in another order.
    if (error.empty() && to_json(plan) != text) error = kNotOurs;
    if (error.empty()) return plan;
  } catch (const Json::exception&) {
    error = kNotOurs;
  } catch (const std::runtime_error& exception) {
    error = exception.what();
  }
  return std::nullopt;
}

std::string first_difference(const StudyPlan& one, const StudyPlan& other, bool with_shard) {
  const Json a = Json::parse(to_json(one)), b = Json::parse(to_json(other));
  for (const auto& [key, value] : a.items()) {
    if (key != "shard" && b.at(key) != value) return key;
  }
  return with_shard && one.shard != other.shard ? "shard" : "";
}

}  // namespace lockstep
