#include "record/use/recording_why.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "base/core/wording.h"
#include "base/json/json.h"
#include "judge/measure/wait_chain.h"
#include "judge/summary/standstill_text.h"
#include "judge/summary/why.h"
#include "language/property/node_names.h"
#include "record/read/recorded_moments.h"
#include "trace/progress_text.h"

namespace lockstep::host {
namespace {

class Asked {
 public:
  Asked(const RecordingHeader& header, NodeIndex node) : header_(header), watch_(header) {
    for (std::optional<NodeIndex> it = node; it; it = header.nodes[*it].parent) {
      line_.push_back({.node = *it});
    }
  }

  void after_tick(const Moment& moment) {
    watch_.after_tick(moment);
    if (!moment.held(line_.front().node))
      held_since_.reset();
    else if (!held_since_)
      held_since_ = moment.time;
    for (Seen& it : line_) {
      const Status status = moment.status(it.node);
      if (moment.ticked(it.node)) {
        it.reached = moment.tick;
        it.halted.reset();
      }
      const Status last = status == Status::Idle ? last_in_tick(moment, it) : status;
      if (last == Status::Running && status == Status::Idle) it.halted = moment.tick;
      if (has_ended(last) && moment.ticked(it.node)) {
        auto links = watch_.why(moment, it.node);
        links.front().decided.status = last;  // it may have been ended since
        it.completed = {moment.tick, std::move(links)};
      }
      it.status = status;
    }
  }

  RecordedWhy answer(const Moment& last) const {
    const Seen& seen = line_.front();
    if (seen.status == Status::Running) return of_running(last);
    if (!seen.reached) return of_unreached(last);
    if (seen.halted) return of_halted(last, *seen.halted);
    return of_completed(seen);
  }

 private:
  // A node of the way from the asked one up to the root.
  struct Seen {
    NodeIndex node = 0;
    Status status = Status::Idle;
    std::optional<std::uint64_t> reached = {}, halted = {};
    struct Completed {
      std::uint64_t tick = 0;
      std::vector<WhyLink> links = {};
    } completed = {};
  };

  // Of a node that is idle after the tick: what it was in it before.
  Status last_in_tick(const Moment& moment, const Seen& it) {
    if (std::ranges::find(moment.ended, it.node) != moment.ended.end()) return Status::Success;
    if (!moment.ticked(it.node)) return it.status;
    Status last = it.status == Status::Running ? Status::Running : Status::Idle;
    const auto look = [&](std::span<const NodeState> states, bool, bool) {
      const NodeState state = states[it.node];
      if (state.ticked() && state.status() != Status::Idle) last = state.status();
    };
    if (!moment.within.empty()) moment.within.each_part(states_, look);
    // It began, and was ended: what it was in between is not recorded.
    return last == Status::Idle ? Status::Running : last;
  }

  std::string name(NodeIndex node) const { return header_.nodes[node].path; }
  std::vector<WhySummary> summaries(const std::vector<WhyLink>& links) const {
    return summarize(links, header_);
  }

  RecordedWhy of_running(const Moment& last) const {
    const NodeIndex node = line_.front().node;
    const auto links = watch_.why(last, node);
    RecordedWhy why{
        .headline = fmt::format("'{}' {} in tick {}", name(node),
                                last.held(node) ? "was held" : "was running", last.tick),
        .tick = last.tick,
        .links = summaries(links)};
    for (const WhyLink& it : links) {
      for (std::string& line : waits(last, it.decided.node)) {
        if (std::ranges::find(why.waits, line) == why.waits.end()) {
          why.waits.push_back(std::move(line));
        }
      }
    }
    return why;
  }

  // Who withholds ticks from the node, and what that waits for.
  std::vector<std::string> waits(const Moment& last, NodeIndex node) const {
    if (!last.held(node)) return {};
    // The user of a pool is the node around what is held.
    for (const NodeIndex it : {node, header_.nodes[node].parent.value_or(node)}) {
      const Hindrance hindrance(header_, last, it);
      if (hindrance.withheld().empty()) continue;
      auto lines = wait_lines(header_, wait_chain(header_, last, hindrance.withheld().front()));
      for (std::string& line : robots(last, hindrance.withheld().front().node))
        lines.push_back(std::move(line));
      return lines;
    }
    return {};
  }

  // What is known of the robots that a node waits for: "'right': not heard for 0.4 s; heard at
  // 0.24, 0.43 s ago".
  std::vector<std::string> robots(const Moment& last, NodeIndex keeper) const {
    std::vector<std::string> lines;
    const std::span<const double> used = last.used(keeper);
    const auto& children = header_.nodes[keeper].children;
    for (std::size_t i = 0; i < std::min(used.size(), children.size()); ++i) {
      if (!is_robot(header_, children[i])) continue;
      std::string line = fmt::format("'{}'", header_.nodes[children[i]].segment);
      std::string_view between = ": ";
      if (const std::string_view reason = last.reason(children[i]); !reason.empty()) {
        line += fmt::format("{}{}", std::exchange(between, "; "), reason);
      }
      const auto heard = std::ranges::find(last.heard, children[i], &Heard::node);
      if (heard != last.heard.end())
        line += std::string(between) + heard_text(used[i], last.time - heard->time);
      lines.push_back(std::move(line));
    }
    if (!lines.empty() && held_since_) {
      lines.push_back(fmt::format("held since {:.3f} s, for {:.2f} s", to_seconds(*held_since_),
                                  to_seconds(last.time - *held_since_)));
    }
    return lines;
  }

  RecordedWhy of_completed(const Seen& seen) const {
    const auto& [tick, links] = seen.completed;
    if (links.empty()) return {.headline = fmt::format("'{}' does not run", name(seen.node))};
    const Status status = links.empty() ? Status::Idle : links.front().decided.status;
    const std::string_view what = status == Status::Failure   ? "failed"
                                  : status == Status::Success ? "succeeded"
                                                              : "was skipped";
    return {.headline = fmt::format("'{}' {} in tick {}", name(seen.node), what, tick),
            .tick = tick,
            .links = summaries(links)};
  }

  // What the lowest of the nodes above it decided then.
  RecordedWhy of_halted(const Moment& last, std::uint64_t tick) const {
    RecordedWhy why{
        .headline = fmt::format("'{}' was halted in tick {}", name(line_.front().node), tick),
        .tick = tick};
    for (const Seen& it : line_) {
      if (it.completed.links.empty() || it.completed.tick != tick) continue;
      why.links = summaries(it.completed.links);
      why.headline += fmt::format(", when '{}' {}", name(it.node),
                                  result_text(it.completed.links.front().decided.status));
      return why;
    }
    return above(std::move(why), last);
  }

  RecordedWhy of_unreached(const Moment& last) const {
    return above({.headline = fmt::format("'{}' was not reached until tick {}",
                                          name(line_.front().node), last.tick),
                  .tick = last.tick},
                 last);
  }

  // The first of the nodes above it that was reached has not gone there.
  RecordedWhy above(RecordedWhy why, const Moment& last) const {
    const auto it = std::find_if(line_.begin() + 1, line_.end(),
                                 [](const Seen& seen) { return seen.reached.has_value(); });
    if (it == line_.end()) return why;
    const bool is_over = !it->completed.links.empty() && it->status != Status::Running;
    const auto links = is_over ? it->completed.links : watch_.why(last, it->node);
    why.headline +=
        fmt::format(": '{}' {}", name(it->node),
                    is_over ? result_text(links.front().decided.status) : "has not come to it");
    if (is_over) why.tick = it->completed.tick;
    why.links = summaries(links);
    return why;
  }

  static std::string_view result_text(Status status) {
    return status == Status::Success   ? "succeeded"
           : status == Status::Failure ? "failed"
                                       : "was skipped";
  }

  const RecordingHeader& header_;
  WhyWatch watch_;
  std::vector<Seen> line_;  // from the asked node up to the root
  std::vector<NodeState> states_;
  std::optional<Nanoseconds> held_since_;  // the asked node
};

}  // namespace

Result<RecordedWhy> why_of(RecordingReader& reader, std::string_view node,
                           std::optional<std::uint64_t> at) {
  const RecordingHeader& header = reader.header();
  NodeIndex asked_node = 0;
  if (!node.empty()) {
    const auto found = find_node(node, paths_of(header));
    if (!found) return tl::unexpected(found.error());
    asked_node = *found;
  }
  Asked asked(header, asked_node);
  RecordedMoments moments(header);
  const Moment* last = nullptr;
  while (const auto tick = reader.next()) {
    if (at && tick->tick > *at) break;
    last = &moments.read(*tick);
    asked.after_tick(*last);
  }
  if (last == nullptr) return problem("the recording has no such tick");
  RecordedWhy why = asked.answer(*last);
  if (header.first_tick > 0) {
    why.headline +=
        fmt::format("; this part of the recording begins with tick {}", header.first_tick);
  }
  const auto& end = reader.end();
  if (end && !end->fault.empty()) {
    why.headline += fmt::format("; the run ended with a fault: {}", end->fault);
  }
  return why;
}

std::string to_text(const RecordedWhy& why, bool color) {
  std::string out = printable(why.headline) + '\n';
  write_links(why.links, out, color);
  for (const std::string& line : why.waits) out += fmt::format("  {}\n", printable(line));
  return out;
}

std::string to_json(const RecordedWhy& why) {
  Json json = {{"why", why.headline}, {"tick", why.tick}};
  json["links"] = json_of_links(why.links);
  json["waits"] = Json::array();
  for (const std::string& line : why.waits) json["waits"].push_back(line);
  return json.text() + '\n';
}

}  // namespace lockstep::host
