
#include "core/json.h"
#include "summary/summary.h"

namespace lockstep {
namespace {

Json json_of(const SynchronizedSummary& node) {
  Json children = Json::array();
  for (const ChildSummary& child : node.children) {
    children.push_back({{"name", child.name},
                        {"held_s", child.held_seconds},
                        {"held_ticks", child.held_ticks},
                        {"waits", child.waits}});
  }
  if (node.is_pool) {
    return {{"path", node.path}, {"samples", node.samples}, {"children", std::move(children)}};
  }
  return {{"path", node.path},
          {"kind", node.kind},
          {"samples", node.samples},
          {"progress_distance", node.distance_sum},
          {"progress_distance_mean", node.distance_mean},
          {"largest_spread", node.largest_spread},
          {"spread_bound", node.spread_bound},
          {"step_length", node.step_length},
          {"children", std::move(children)}};
}

Json json_of(const PeriodSummary& period) {
  return {{"p50_s", period.p50}, {"p99_s", period.p99}, {"max_s", period.max}};
}

Json json_of(const WorstTickSummary& worst) {
  Json json = {{"tick", worst.tick}, {"took_s", worst.took}};
  if (!worst.leaf.empty()) {
    json["leaf"] = worst.leaf;
    json["leaf_took_s"] = worst.leaf_took;
  }
  return json;
}

Json json_of(const std::vector<LeafTimingSummary>& leaves) {
  Json list = Json::array();
  for (const LeafTimingSummary& leaf : leaves) {
    list.push_back({{"leaf", leaf.path},
                    {"ticks", leaf.calls},
                    {"over_budget", leaf.over_budget},
                    {"p50_s", leaf.p50},
                    {"p99_s", leaf.p99},
                    {"max_s", leaf.max}});
  }
  return list;
}

Json json_of(const std::vector<DecidingSummary>& path) {
  Json list = Json::array();
  for (const DecidingSummary& node : path) {
    list.push_back({{"path", node.path},
                    {"kind", node.kind},
                    {"status", to_string(node.status)},
                    {"children", node.children},
                    {"agreeing", node.agreeing}});
  }
  return list;
}

}  // namespace

std::string to_json(const Summary& summary) {
  Json json = {{"result", to_string(summary.result)}, {"reason", to_string(summary.reason)}};
  if (summary.reason == StopReason::Fault) json["fault"] = summary.fault;
  if (summary.reason == StopReason::Signal) json["signal"] = summary.signal;
  json["why_failed"] = json_of(summary.why_failed);
  json["ticks"] = summary.ticks;
  json["time_s"] = summary.seconds;
  json["period"] = summary.period ? json_of(*summary.period) : Json();
  json["overruns"] = summary.overruns;
  json["skipped"] = summary.skipped;
  json["worst_tick"] = summary.worst ? json_of(*summary.worst) : Json();
  json["faults"] = summary.faults;
  json["tick_budget_s"] = summary.tick_budget;
  json["over_budget"] = json_of(summary.over_budget);
  json["synchronized_nodes"] = Json::array();
  json["pools"] = Json::array();
  for (const auto& node : summary.synchronized_nodes) {
    json[node.is_pool ? "pools" : "synchronized_nodes"].push_back(json_of(node));
  }
  json["never_reached"] = summary.never_reached;
  json["notes"] = summary.notes;
  return json.printable();
}

}  // namespace lockstep
