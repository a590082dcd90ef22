#include "observers/summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <csignal>
#include <cstring>
#include <nlohmann/json.hpp>

#include "core/diagnostics.h"
#include "core/printable_json.h"

namespace lockstep {
namespace {

using Json = nlohmann::ordered_json;

std::string why(const Summary& summary) {
  switch (summary.reason) {
    case StopReason::Completed:
      return {};
    case StopReason::Fault:
      return printable(summary.fault);
    case StopReason::Timeout:
      return "the time limit was reached";
    case StopReason::MaxTicks:
      return "the tick limit was reached";
    case StopReason::Signal:
      return fmt::format("signal: {}", strsignal(summary.signal));
    case StopReason::Overrun:
      return "a tick missed the next deadline";
    case StopReason::Recording:
      return "the recording cannot be written";
  }
  return {};
}

std::string timing(const Summary& summary) {
  if (!summary.period) return {};
  return fmt::format("  period     p50 {:.3f} ms, p99 {:.3f} ms, max {:.3f} ms\n",
                     summary.period->p50 * 1e3, summary.period->p99 * 1e3,
                     summary.period->max * 1e3) +
         fmt::format("  overruns   {} (deadlines skipped: {})\n", summary.overruns,
                     summary.skipped);
}

std::string worst_tick(const Summary& summary) {
  if (!summary.worst) return {};
  const WorstTickSummary& worst = *summary.worst;
  std::string text = fmt::format("  worst tick {}: {:.3f} ms", worst.tick, worst.took * 1e3);
  if (!worst.leaf.empty()) {
    text += fmt::format(", of which {:.3f} ms in {}", worst.leaf_took * 1e3, printable(worst.leaf));
  }
  return text + "\n";
}

void write_over_budget(const Summary& summary, std::FILE* out, bool color) {
  for (const LeafTimingSummary& leaf : summary.over_budget) {
    fmt::print(out, "  {} of {:.6g} ms: {} {} of {}, p50 {:.3f} ms, p99 {:.3f} ms, max {:.3f} ms\n",
               styled("over the tick budget", Style::Warning, color),
               summary.tick_budget.value_or(0) * 1e3, printable(leaf.path), leaf.over_budget,
               counted(leaf.calls, "tick"), leaf.p50 * 1e3, leaf.p99 * 1e3, leaf.max * 1e3);
  }
}

Json json_of(const SynchronizedSummary& node) {
  Json children = Json::array();
  for (const ChildSummary& child : node.children) {
    children.push_back(
        {{"name", child.name}, {"held_s", child.held_seconds}, {"held_ticks", child.held_ticks}});
  }
  return {{"path", node.path},
          {"kind", node.kind},
          {"samples", node.samples},
          {"progress_distance", node.distance_sum},
          {"progress_distance_mean", node.distance_mean},
          {"largest_spread", node.largest_spread},
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

}  // namespace

std::string_view to_string(RunResult result) {
  constexpr std::string_view kNames[] = {"success", "failure", "stopped", "fault"};
  return kNames[static_cast<unsigned>(result)];
}

Style style_of(RunResult result) {
  if (result == RunResult::Success) return Style::Good;
  return result == RunResult::Stopped ? Style::Warning : Style::Bad;
}

std::string counted(std::uint64_t count, std::string_view noun) {
  return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

std::string_view to_string(StopReason reason) {
  constexpr std::string_view kNames[] = {"completed", "fault",   "timeout",  "max_ticks",
                                         "signal",    "overrun", "recording"};
  return kNames[static_cast<unsigned>(reason)];
}

SynchronizedSummary summarize(const SynchronizedMeasure& measure, std::string path,
                              std::string kind, const std::vector<std::string>& children) {
  const ProgressDistance& distance = measure.distance();
  SynchronizedSummary summary{.path = std::move(path),
                              .kind = std::move(kind),
                              .samples = distance.samples(),
                              .distance_sum = distance.sum(),
                              .distance_mean = distance.mean(),
                              .largest_spread = distance.largest_spread(),
                              .step_length = distance.step_length(),
                              .children = {}};
  for (std::size_t child = 0; child < children.size(); ++child) {
    const auto& held = measure.held()[child];
    summary.children.push_back({children[child], to_seconds(held.time), held.ticks});
  }
  return summary;
}

void write_text(const SynchronizedSummary& node, std::FILE* out, bool color) {
  const auto name = styled(printable(node.path), Style::Strong, color);
  fmt::print(out, "  {} ({}, {})\n", name, printable(node.kind), counted(node.samples, "tick"));
  fmt::print(out, "    progress distance {:.6g}, mean {:.6g} a tick; largest spread {:.6g}, ",
             node.distance_sum, node.distance_mean, node.largest_spread);
  fmt::print(out, "longest step {:.6g}\n", node.step_length);
  std::size_t width = 0;
  for (const ChildSummary& child : node.children) {
    width = std::max(width, printable(child.name).size());
  }
  for (const ChildSummary& child : node.children) {
    fmt::print(out, "    {:<{}}  waited {:.3f} s in {}\n", printable(child.name), width,
               child.held_seconds, counted(child.held_ticks, "tick"));
  }
}

void write_text(const Summary& summary, std::FILE* out, bool color) {
  const auto result = styled(to_string(summary.result), style_of(summary.result), color);
  const std::string reason = why(summary);
  fmt::print(out, "{}{}{} after {}, {:.3f} s\n", result, reason.empty() ? "" : ": ", reason,
             counted(summary.ticks, "tick"), summary.seconds);
  fmt::print(out, "{}{}", timing(summary), worst_tick(summary));
  write_over_budget(summary, out, color);
  for (const SynchronizedSummary& node : summary.synchronized_nodes) write_text(node, out, color);
  for (const std::string& note : summary.notes) {
    fmt::print(out, "{} {}\n", styled("note:", Style::Warning, color), printable(note));
  }
}

std::string to_json(const Summary& summary) {
  Json json = {{"result", to_string(summary.result)}, {"reason", to_string(summary.reason)}};
  if (summary.reason == StopReason::Fault) json["fault"] = summary.fault;
  if (summary.reason == StopReason::Signal) json["signal"] = summary.signal;
  json["ticks"] = summary.ticks;
  json["time_s"] = summary.seconds;
  json["period"] = summary.period ? json_of(*summary.period) : Json();
  json["overruns"] = summary.overruns;
  json["skipped"] = summary.skipped;
  json["worst_tick"] = summary.worst ? json_of(*summary.worst) : Json();
  json["faults"] = summary.faults;
  json["tick_budget_s"] = summary.tick_budget ? Json(*summary.tick_budget) : Json();
  json["over_budget"] = json_of(summary.over_budget);
  json["synchronized_nodes"] = Json::array();
  for (const auto& node : summary.synchronized_nodes) {
    json["synchronized_nodes"].push_back(json_of(node));
  }
  json["notes"] = summary.notes;
  return printable_json(json.dump(-1, ' ', false, Json::error_handler_t::replace));
}

}  // namespace lockstep
