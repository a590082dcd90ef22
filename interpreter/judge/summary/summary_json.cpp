
#include "base/core/wording.h"
#include "base/json/json.h"
#include "judge/summary/standstill_text.h"
#include "judge/summary/summary.h"

namespace lockstep::host {
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

Json json_of(const LatenessSummary& lateness) {
  Json ticks = Json::array();
  for (std::size_t digits = 0; digits < lateness.ticks.size(); ++digits) {
    if (lateness.ticks[digits] == 0) continue;
    const double limit = std::ldexp(1e-9, static_cast<int>(digits));
    ticks.push_back({{"below_s", limit}, {"ticks", lateness.ticks[digits]}});
  }
  return {{"p50_s", lateness.p50},
          {"p99_s", lateness.p99},
          {"max_s", lateness.max},
          {"histogram", std::move(ticks)}};
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
    if (leaf.is_sampled) list.back()["sampled"] = true;
  }
  return list;
}

Json json_of(const std::vector<WhySummary::Attempt>& attempts) {
  Json list = Json::array();
  for (const WhySummary::Attempt& it : attempts) {
    list.push_back({{"tick", it.tick}, {"path", it.path}});
    if (!it.reason.empty()) list.back()["reason"] = it.reason;
    if (it.times > 1) list.back()["times"] = it.times;
  }
  return list;
}

Json json_of(const WhySummary& node) {
  Json json = {{"path", node.path},
               {"kind", node.kind},
               {"status", to_string(node.status)},
               {"children", node.children},
               {"agreeing", node.agreeing}};
  if (!node.reason.empty()) json["reason"] = node.reason;
  if (node.is_held) json["held"] = true;
  if (node.stood_still) json["stood_still"] = true;
  if (!node.others.empty()) json["others"] = json_of(node.others);
  if (node.failed_attempts == 0) return json;
  json["failed_attempts"] = node.failed_attempts;
  json["attempts"] = json_of(node.attempts);
  if (node.attempts_since) json["attempts_since"] = *node.attempts_since;
  return json;
}

Json json_of(const StandstillLinkSummary& link) {
  Json json = {{"node", link.node},
               {"kind", link.kind},
               {"waiting", link.waiting},
               {"waiting_at", link.waiting_at},
               {"awaited", link.awaited},
               {"awaited_at", link.awaited_at},
               {"awaited_status", to_string(link.awaited_status)}};
  if (!link.resources.empty()) json["resources"] = link.resources;
  return json;
}

Json json_of(const std::vector<StandstillSummary>& standstills) {
  Json list = Json::array();
  for (const StandstillSummary& it : standstills) {
    Json links = Json::array();
    for (const StandstillLinkSummary& link : it.links) links.push_back(json_of(link));
    list.push_back({{"cause", to_string(it.cause)},
                    {"since_s", it.since},
                    {"time_s", it.reported},
                    {"links", std::move(links)}});
    if (it.failed.empty()) continue;
    list.back()["failed"] = it.failed;
    list.back()["failed_s"] = it.failed_at;
  }
  return list;
}

// The notes of the run, and what stood still.
std::vector<std::string> all_notes(const Summary& summary) {
  std::vector<std::string> notes = summary.notes;
  for (const auto& lines : standstill_notes(summary)) notes.push_back(joined(lines, "; "));
  return notes;
}

}  // namespace

Json json_of(const std::vector<PropertySummary>& properties) {
  Json list = Json::array();
  for (const PropertySummary& it : properties) {
    list.push_back({{"name", it.name},
                    {"property", it.text},
                    {"verdict", to_string(it.verdict)},
                    {"tick", it.tick}});
  }
  return list;
}

Json json_of_links(std::span<const WhySummary> links) {
  Json list = Json::array();
  for (const WhySummary& it : links) list.push_back(json_of(it));
  return list;
}

std::string to_json(const Summary& summary) {
  Json json = {{"result", to_string(summary.result)}, {"reason", to_string(summary.reason)}};
  if (summary.reason == StopReason::Fault) json["fault"] = summary.fault;
  if (summary.reason == StopReason::Signal) json["signal"] = summary.signal;
  json["why_failed"] = json_of_links(summary.why_failed);
  json["ticks"] = summary.ticks;
  json["time_s"] = summary.seconds;
  json["period"] = summary.period ? json_of(*summary.period) : Json();
  json["lateness"] = summary.lateness ? json_of(*summary.lateness) : Json();
  json["overruns"] = summary.overruns;
  json["skipped"] = summary.skipped;
  json["worst_tick"] = summary.worst ? json_of(*summary.worst) : Json();
  json["faults"] = summary.faults;
  json["went_on_while_held"] = summary.went_on;
  json["tick_budget_s"] = summary.tick_budget;
  json["over_budget"] = json_of(summary.over_budget);
  json["synchronized_nodes"] = Json::array();
  json["pools"] = Json::array();
  for (const auto& node : summary.synchronized_nodes) {
    json[node.is_pool ? "pools" : "synchronized_nodes"].push_back(json_of(node));
  }
  json["never_reached"] = summary.never_reached;
  json["standstills"] = json_of(summary.standstills);
  if (!summary.properties.empty()) json["properties"] = json_of(summary.properties);
  json["notes"] = all_notes(summary);
  return json.printable();
}

}  // namespace lockstep::host
