#include "judge/summary/summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstring>
#include <iterator>
#include <numeric>

#include "base/core/diagnostics.h"
#include "base/core/wording.h"
#include "base/terminal/style.h"
#include "base/terminal/text_table.h"
#include "judge/measure/measure_spec.h"
#include "judge/summary/capped_notes.h"
#include "trace/shape.h"

namespace lockstep::host {
namespace {

std::string why(const Summary& summary) {
  switch (summary.reason) {
    case StopReason::Completed:
      return {};
    case StopReason::Fault:
      return printable(summary.fault);
    case StopReason::Timeout:
      return "the time limit (--timeout) was reached";
    case StopReason::MaxTicks:
      return fmt::format("the tick limit ({}) was reached", printable(summary.tick_limit));
    case StopReason::Signal:
      return fmt::format("signal: {}", strsignal(summary.signal));
    case StopReason::Overrun:
      return "a tick missed the next deadline";
    case StopReason::Recording:
      return "the recording or the checkpoint cannot be written";
    case StopReason::Property:
      return "a property is violated";
    case StopReason::Stopped:
      return "its program stopped it";
  }
  return {};
}

// "91.2 % within 0.0164 ms, 99.9 % within 0.131 ms, all within 1.05 ms": a step is eight times the
// one before.
std::string shares(const LatenessSummary& lateness) {
  constexpr std::size_t kFirst = 14, kStep = 3;  // binary digits of ns
  const auto all = std::accumulate(lateness.ticks.begin(), lateness.ticks.end(), std::uint64_t{0});
  std::string text;
  for (std::size_t digits = kFirst;; digits += kStep) {
    const auto end = lateness.ticks.begin() +
                     static_cast<std::ptrdiff_t>(std::min(digits + 1, lateness.ticks.size()));
    const auto within = std::accumulate(lateness.ticks.begin(), end, std::uint64_t{0});
    const double limit = std::ldexp(1e-6, static_cast<int>(digits));
    if (within == all) return text + fmt::format("all within {:.3g} ms", limit);
    text += fmt::format("{:.3g} % within {:.3g} ms, ",
                        100 * static_cast<double>(within) / static_cast<double>(all), limit);
  }
}

std::string lateness_text(const LatenessSummary& lateness) {
  return fmt::format("  late       p50 {:.3f} ms, p99 {:.3f} ms, max {:.3f} ms\n             {}\n",
                     lateness.p50 * 1e3, lateness.p99 * 1e3, lateness.max * 1e3, shares(lateness));
}

std::string timing(const Summary& summary) {
  if (!summary.period) return {};
  return fmt::format("  period     p50 {:.3f} ms, p99 {:.3f} ms, max {:.3f} ms\n",
                     summary.period->p50 * 1e3, summary.period->p99 * 1e3,
                     summary.period->max * 1e3) +
         (summary.lateness ? lateness_text(*summary.lateness) : "") +
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

void write_over_budget(const Summary& summary, std::string& out, bool color) {
  for (const LeafTimingSummary& leaf : summary.over_budget) {
    out += fmt::format(
        "  {} of {:.6g} ms: {} in {}, max {:.3f} ms; {}{}: p50 {:.3f} ms, p99 {:.3f} ms\n",
        styled("over the tick budget", Style::Warning, color),
        summary.tick_budget.value_or(0) * 1e3, printable(leaf.path),
        counted(leaf.over_budget, "call"), leaf.max * 1e3,
        leaf.is_sampled ? "sampled from about " : "", counted(leaf.calls, "tick"), leaf.p50 * 1e3,
        leaf.p99 * 1e3);
  }
}

std::string waited(const ChildSummary& child) {
  if (child.waits == 0) return "did not wait";
  return fmt::format("waited {}, {:.3f} s in {}", counted(child.waits, "time"), child.held_seconds,
                     counted(child.held_ticks, "tick"));
}

void write_distance(const SynchronizedSummary& node, std::string& out) {
  out += fmt::format("    progress distance {}, mean {} a tick\n", rounded(node.distance_sum),
                     rounded(node.distance_mean));
  out += fmt::format("    largest spread {}", rounded(node.largest_spread));
  if (node.spread_bound) out += fmt::format(" (bound {})", rounded(*node.spread_bound));
  out += fmt::format(", longest step {}\n", rounded(node.step_length));
}

void write_node(const SynchronizedSummary& node, std::string& out, bool color) {
  const auto name = styled(printable(node.path), Style::Strong, color);
  out += fmt::format("  {} ({}, {})\n", name, printable(node.kind), counted(node.samples, "tick"));
  if (!node.is_pool) write_distance(node, out);
  std::vector<TableRow> rows;
  for (const ChildSummary& child : node.children) {
    rows.push_back({"    " + printable(child.name), waited(child)});
  }
  out += text_table(rows, 2);
}

// The node, and below it what it has tried.
void write_link(const WhySummary& node, std::size_t indent, std::string& out, bool color) {
  const std::string name = last_segment(node.path);
  const Style style = node.status == Status::Failure ? Style::Bad : Style::Good;
  out += fmt::format("{:{}}{}", "", indent, printable(name));
  if (name != node.kind) out += fmt::format(" ({})", printable(node.kind));
  out += fmt::format(": {}", styled(to_string(node.status), style, color));
  if (node.is_held) out += ", held";
  if (node.agreeing > 1 && node.status != Status::Idle)
    out += fmt::format(" ({} of {} children)", node.agreeing, node.children);
  if (node.failed_attempts > 0) {
    out += fmt::format(", {} failed", counted(node.failed_attempts, "attempt"));
    if (node.attempts_since) {
      out += fmt::format(" since tick {}, where this recording begins", *node.attempts_since);
    }
  }
  if (!node.reason.empty()) out += fmt::format(": {}", printable(node.reason));
  out += '\n';
  for (const WhySummary::Attempt& it : node.others) {
    if (it.reason.empty()) continue;
    out += fmt::format("{:{}}- {}: {}\n", "", indent + 2, printable(last_segment(it.path)),
                       printable(it.reason));
  }
  if (node.failed_attempts < 2 && node.status != Status::Running) return;
  std::uint64_t listed = 0;
  for (const WhySummary::Attempt& it : node.attempts) listed += it.times;
  if (node.failed_attempts > listed) {
    out += fmt::format("{:{}}- the last {}:\n", "", indent + 2, listed);
  }
  for (const WhySummary::Attempt& it : node.attempts) {
    out += fmt::format("{:{}}- tick {}: {}", "", indent + 2, it.tick,
                       printable(last_segment(it.path)));
    if (it.times > 1) out += fmt::format(", {} times", it.times);
    out += it.reason.empty() ? "\n" : fmt::format(": {}\n", printable(it.reason));
  }
}

void write_note(std::span<const std::string> lines, std::string& out, bool color) {
  out += styled("note:", Style::Warning, color);
  std::string_view indent = " ";
  for (const std::string& line : lines) {
    out += fmt::format("{}{}\n", indent, printable(line));
    indent = "  ";
  }
}

}  // namespace

std::string to_text(const PropertySummary& property, bool color) {
  const bool is_violated = property.verdict == PropertyVerdict::Violated;
  std::string text = fmt::format(
      "{}: {}", printable(property.name),
      styled(to_string(property.verdict), is_violated ? Style::Bad : Style::Good, color));
  if (property.tick) text += fmt::format(" in tick {}", *property.tick);
  return text;
}

std::string_view to_string(RunResult result) {
  constexpr std::string_view kNames[] = {"success", "failure", "stopped", "fault", "skipped"};
  return kNames[static_cast<unsigned>(result)];
}

std::string ending(std::string_view result, std::string_view reason) {
  if (result == reason) return std::string(result);
  return fmt::format("{} ({})", result, reason);
}

Style style_of(RunResult result) {
  if (result == RunResult::Success) return Style::Good;
  const bool is_bad = result == RunResult::Failure || result == RunResult::Fault;
  return is_bad ? Style::Bad : Style::Warning;
}

std::string_view to_string(StopReason reason) {
  constexpr std::string_view kNames[] = {"completed", "fault",    "timeout",
                                         "max_ticks", "signal",   "overrun",
                                         "recording", "property", "stopped"};
  return kNames[static_cast<unsigned>(reason)];
}

std::vector<WhySummary> summarize(std::span<const WhyLink> links, const Shape& shape) {
  std::vector<WhySummary> summaries;
  for (const WhyLink& it : links) {
    const ShapeNode& node = shape.nodes[it.decided.node];
    WhySummary& summary = summaries.emplace_back(WhySummary{.path = node.path,
                                                            .kind = node.kind,
                                                            .status = it.decided.status,
                                                            .depth = it.depth,
                                                            .is_held = it.is_held,
                                                            .children = it.decided.children,
                                                            .agreeing = it.decided.agreeing,
                                                            .reason = it.reason,
                                                            .failed_attempts = it.failed_attempts,
                                                            .attempts_since = it.attempts_since,
                                                            .stood_still = it.stood_still});
    const auto add = [&](std::span<const Attempt> from, std::vector<WhySummary::Attempt>& to) {
      for (const Attempt& attempt : from) {
        to.push_back({attempt.tick, shape.nodes[attempt.node].path, attempt.reason, attempt.times});
      }
    };
    add(it.attempts, summary.attempts);
    add(it.others, summary.others);
  }
  return summaries;
}

SynchronizedSummary summarize(const SynchronizedMeasure& measure, std::string path,
                              std::string kind, const std::vector<std::string>& children) {
  const ProgressDistance& distance = measure.distance();
  SynchronizedSummary summary{.path = std::move(path),
                              .kind = std::move(kind),
                              .samples = distance.samples(),
                              .distance_sum = distance.sum(),
                              .distance_mean = distance.mean(),
                              .largest_spread = measure.largest_spread(),
                              .spread_bound = measure.bound(),
                              .step_length = measure.step_length(),
                              .children = {},
                              .is_pool = measure.is_pool()};
  for (std::size_t child = 0; child < children.size(); ++child) {
    const auto& held = measure.held()[child];
    summary.children.push_back(
        {children[child], to_seconds(held.time()), held.ticks(), held.pauses()});
  }
  return summary;
}

void append_fall_notes(const Shape& shape, const MeasuredNode& node,
                       std::vector<std::string>& notes) {
  const FallWatch& falls = node.measure.falls();
  const auto add = [&](const std::optional<FallWatch::Fall>& fall, std::string_view what,
                       std::string_view consequence) {
    if (!fall) return;
    notes.push_back(fmt::format("the progress of '{}' {}, first at {:.3f} s: {}",
                                shape.nodes[node.ticks.children()[fall->child]].path, what,
                                to_seconds(fall->time), consequence));
  };
  add(falls.while_ticked(), "fell", "the spread has no bound then");
  add(falls.while_held(), "fell while it was held", "the others may then wait indefinitely");
  add(falls.rise_before(), "rose in a period with several ticks", "the spread has no bound then");
  add(falls.rise_while_held(), "rose while it was held", "the spread has no bound then");
}

void write_text(std::span<const SynchronizedSummary> nodes, std::size_t never_reached,
                std::string& out, bool color) {
  for (const SynchronizedSummary& node : nodes) write_node(node, out, color);
  if (never_reached == 0) return;
  out += fmt::format("  {} {} never reached\n", counted(never_reached, "synchronized node"),
                     never_reached == 1 ? "was" : "were");
}

// A deep tree shows its first and its last nodes: in between a result is mostly passed on. Where
// several nodes run, the first ones.
void write_links(std::span<const WhySummary> links, std::string& out, bool color) {
  constexpr std::size_t kFirst = 5, kLast = 15, kMost = 60;
  const bool is_chain = links.empty() || links.back().depth + 1 == links.size();
  const std::size_t left_out = is_chain ? links.size() - std::min(links.size(), kFirst + kLast) : 0;
  for (std::size_t i = 0; i < links.size(); ++i) {
    if (!is_chain && i == kMost) {
      out += fmt::format("    ... {} more\n", counted(links.size() - i, "node"));
      return;
    }
    // What is left out takes one line, and one step to the right.
    std::size_t indent = 4 + 2 * links[i].depth;
    if (left_out > 0 && i == kFirst) {
      out += fmt::format("{:{}}... {} more\n", "", indent, counted(left_out, "node"));
      i += left_out;
    }
    if (left_out > 0 && i >= kFirst) indent = 4 + 2 * (links[i].depth - left_out + 1);
    write_link(links[i], indent, out, color);
  }
}

void write_text(std::span<const WhySummary> why_failed, std::string& out, bool color) {
  if (why_failed.empty()) return;
  out += fmt::format("  decided by {}:\n", printable(why_failed.back().path));
  write_links(why_failed, out, color);
}

void write_text(const Summary& summary, std::string& out, bool color) {
  const auto result = styled(to_string(summary.result), style_of(summary.result), color);
  const std::string reason = why(summary);
  const auto when =
      fmt::format(" after {}, {:.3f} s", counted(summary.ticks, "tick"), summary.seconds);
  const std::string colon = reason.empty() ? "" : ": " + reason;
  // A fault is a sentence.
  const bool is_long = summary.reason == StopReason::Fault;
  out += result + (is_long ? when + colon : colon + when) + '\n';
  write_text(summary.why_failed, out, color);
  out += timing(summary) + worst_tick(summary);
  write_over_budget(summary, out, color);
  write_text(summary.synchronized_nodes, summary.never_reached, out, color);
  for (const PropertySummary& it : summary.properties)
    out += fmt::format("  property   {}\n", to_text(it, color));
  for (const std::string& note : summary.notes) write_note({&note, 1}, out, color);
  for (const auto& note : standstill_notes(summary)) write_note(note, out, color);
}

std::vector<std::vector<std::string>> standstill_notes(const Summary& summary) {
  std::vector<std::vector<std::string>> notes;
  for (const StandstillSummary& it : summary.standstills) {
    if (notes.size() < CappedNotes::kMost) notes.push_back(it.lines);
  }
  const std::uint64_t more = summary.standstills.size() + summary.more_standstills - notes.size();
  if (more > 0) notes.push_back({fmt::format("and {} more", counted(more, "standstill"))});
  return notes;
}

}  // namespace lockstep::host
