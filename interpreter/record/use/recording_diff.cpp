#include "record/use/recording_diff.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <utility>

#include "base/core/wording.h"
#include "record/read/tick_results.h"

namespace lockstep::host {
namespace {

using Values = std::vector<ValueDifference>;

void add(Values& values, std::string what, std::optional<std::string> a,
         std::optional<std::string> b) {
  if (a != b) values.push_back({std::move(what), std::move(a), std::move(b)});
}

std::optional<std::string> find(const auto& map, const std::string& key) {
  const auto found = map.find(key);
  if (found == map.end()) return std::nullopt;
  return found->second;
}

// The nodes that both have, by their paths.
struct Pair {
  NodeIndex a, b;
};

std::vector<Pair> pair_nodes(const RecordingHeader& a, const RecordingHeader& b, Values& values) {
  std::unordered_map<std::string_view, NodeIndex> in_b;
  for (NodeIndex node = 0; node < b.nodes.size(); ++node) in_b.emplace(b.nodes[node].path, node);
  std::vector<Pair> pairs;
  for (NodeIndex node = 0; node < a.nodes.size(); ++node) {
    const ShapeNode& one = a.nodes[node];
    const auto found = in_b.find(one.path);
    if (found == in_b.end()) {
      add(values, "node " + one.path, kind_text(one), std::nullopt);
      continue;
    }
    add(values, "node " + one.path, kind_text(one), kind_text(b.nodes[found->second]));
    pairs.push_back({node, found->second});
    in_b.erase(found);
  }
  for (const ShapeNode& one : b.nodes) {
    if (in_b.contains(one.path)) add(values, "node " + one.path, std::nullopt, kind_text(one));
  }
  return pairs;
}

Values compare_headers(const RecordingHeader& a, const RecordingHeader& b) {
  Values values;
  add(values, "tree", a.id, b.id);
  add(values, "rate_hz", fmt::format("{}", a.rate_hz), fmt::format("{}", b.rate_hz));
  add(values, "clock", a.clock, b.clock);
  add(values, "seed", std::to_string(a.seed), std::to_string(b.seed));
  const auto tick_of = [](const RecordingHeader& it) {
    return it.tick.empty() ? std::string("once") : it.tick;
  };
  add(values, "tick", tick_of(a), tick_of(b));
  const auto compare = [&](const std::string& what, const auto& in_a, const auto& in_b) {
    auto names = in_a;
    names.insert(in_b.begin(), in_b.end());
    for (const auto& [name, value] : names) {
      add(values, what + name, find(in_a, name), find(in_b, name));
    }
  };
  compare("argument ", a.arguments, b.arguments);
  compare("start value ", a.values, b.values);
  return values;
}

Values compare_ends(const std::optional<RecordedEnd>& a, const std::optional<RecordedEnd>& b,
                    const DiffOptions& options) {
  Values values;
  const auto compare = [&](const char* what, auto text_of) {
    add(values, what, a ? text_of(*a) : std::nullopt, b ? text_of(*b) : std::nullopt);
  };
  using Text = std::optional<std::string>;
  compare("result", [](const RecordedEnd& end) { return Text(end.result); });
  compare("reason", [](const RecordedEnd& end) { return Text(end.reason); });
  compare("fault",
          [](const RecordedEnd& end) { return end.fault.empty() ? Text() : Text(end.fault); });
  compare("notes", [](const RecordedEnd& end) {
    return end.notes.empty() ? Text() : Text(joined(end.notes, "; "));
  });
  compare("signal", [](const RecordedEnd& end) {
    return end.signal ? Text(std::to_string(*end.signal)) : Text();
  });
  compare("ticks", [](const RecordedEnd& end) { return Text(std::to_string(end.ticks)); });
  compare("lost", [](const RecordedEnd& end) { return Text(std::to_string(end.lost)); });
  if (options.ignore_time) return values;
  compare("time_s", [](const RecordedEnd& end) { return Text(fmt::format("{}", end.time)); });
  compare("overruns", [](const RecordedEnd& end) { return Text(std::to_string(end.overruns)); });
  compare("skipped", [](const RecordedEnd& end) { return Text(std::to_string(end.skipped)); });
  return values;
}

std::vector<std::string> texts(const RecordingHeader& header,
                               std::span<const RecordedFault> faults) {
  std::vector<std::string> texts;
  for (const RecordedFault& fault : faults) {
    texts.push_back(fmt::format("{}: {}", header.nodes[fault.node].path, fault.message));
  }
  return texts;
}

std::vector<std::string> texts(const RecordingHeader& header,
                               std::span<const RecordedEntry> entries) {
  std::vector<std::string> texts;
  for (const RecordedEntry& it : entries) {
    texts.push_back(header.entries[it.entry].key + " = " + shown_value(it));
  }
  return texts;
}

// Compares tick by tick until one differs.
class Comparison {
 public:
  Comparison(RecordingReader& a, RecordingReader& b, const DiffOptions& options)
      : a_(a), b_(b), options_(options) {}

  RecordingDiff run() {
    diff_.header = compare_headers(a_.header(), b_.header());
    pairs_ = pair_nodes(a_.header(), b_.header(), diff_.header);
    diff_.has_common_nodes = !pairs_.empty();
    read_ticks();
    diff_.end = compare_ends(a_.end(), b_.end(), options_);
    const std::string& version_a = a_.header().version;
    const std::string& version_b = b_.header().version;
    if (version_a != version_b) {
      diff_.notes.push_back(
          fmt::format("recorded by lockstep {} and by lockstep {}", version_a, version_b));
    }
    return std::move(diff_);
  }

 private:
  // Until one of them has no more ticks, and then on for their number.
  void read_ticks() {
    auto a = next(a_, diff_.ticks_a), b = next(b_, diff_.ticks_b);
    while (a || b) {
      if (!diff_.tick && diff_.has_common_nodes) compare(a, b);
      if (a) a = next(a_, diff_.ticks_a);
      if (b) b = next(b_, diff_.ticks_b);
    }
  }

  static std::optional<RecordedTick> next(RecordingReader& reader, std::uint64_t& count) {
    auto tick = reader.next();
    if (tick) ++count;
    return tick;
  }

  void compare(const std::optional<RecordedTick>& a, const std::optional<RecordedTick>& b) {
    if (a && b && a->tick == b->tick) return compare(*a, *b);
    const bool missing_in_b = a && (!b || a->tick < b->tick);
    diff_.tick = TickDifference{.tick = missing_in_b ? a->tick : b->tick};
    diff_.tick->missing =
        missing_in_b ? TickDifference::Missing::InB : TickDifference::Missing::InA;
    diff_.tick->lost = a && b;
  }

  void compare(const RecordedTick& a, const RecordedTick& b) {
    TickDifference tick{.tick = a.tick, .time_a = a.time, .time_b = b.time};
    if (options_.ignore_time) tick.time_b = tick.time_a;
    for (const auto& [node_a, node_b] : pairs_) {
      const RecordedState &in_a = a.nodes[node_a], &in_b = b.nodes[node_b];
      if (same(in_a, in_b)) continue;
      tick.nodes.push_back({a_.header().nodes[node_a].path, in_a, in_b});
    }
    if (!a.moments.empty() || !b.moments.empty()) compare_moments(a, b, tick);
    if (!a.faults.empty() || !b.faults.empty()) {
      tick.faults_a = texts(a_.header(), a.faults);
      tick.faults_b = texts(b_.header(), b.faults);
      if (tick.faults_a == tick.faults_b) tick.faults_a = tick.faults_b = {};
    }
    if (!a.entries.empty() || !b.entries.empty()) {
      tick.entries_a = texts(a_.header(), a.entries);
      tick.entries_b = texts(b_.header(), b.entries);
      if (tick.entries_a == tick.entries_b) tick.entries_a = tick.entries_b = {};
    }
    const bool is_same = tick.nodes.empty() && tick.time_a == tick.time_b &&
                         tick.moments_a.empty() && tick.moments_b.empty() &&
                         tick.faults_a.empty() && tick.faults_b.empty() && tick.entries_a.empty() &&
                         tick.entries_b.empty();
    if (!is_same) diff_.tick = std::move(tick);
  }

  void compare_moments(const RecordedTick& a, const RecordedTick& b, TickDifference& tick) const {
    // A tick of one moment has its results in the states.
    std::vector<std::string> in_a = results_within(a), in_b = results_within(b);
    in_a.resize(a.nodes.size());
    in_b.resize(b.nodes.size());
    for (const auto& [node_a, node_b] : pairs_) {
      const std::string &of_a = in_a[node_a], &of_b = in_b[node_b];
      if (of_a == of_b) continue;
      const std::string& path = a_.header().nodes[node_a].path;
      if (!of_a.empty()) tick.moments_a.push_back(path + ": " + brief(of_a));
      if (!of_b.empty()) tick.moments_b.push_back(path + ": " + brief(of_b));
    }
  }

  bool same(const RecordedState& a, const RecordedState& b) const {
    const auto near = [&](double one, double other) {
      return one == other || std::abs(one - other) <= options_.tolerance;
    };
    return a.status == b.status && a.ticked == b.ticked && a.held == b.held &&
           near(a.progress, b.progress) && near(a.limit, b.limit);
  }

  RecordingReader &a_, &b_;
  const DiffOptions& options_;
  std::vector<Pair> pairs_;
  RecordingDiff diff_;
};

}  // namespace

RecordingDiff compare(RecordingReader& a, RecordingReader& b, const DiffOptions& options) {
  return Comparison(a, b, options).run();
}

}  // namespace lockstep::host
