#include "record/use/recording_merge.h"

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "base/core/wording.h"
#include "judge/summary/summary.h"
#include "record/json_lines.h"

namespace lockstep::host {
namespace {

constexpr NodeIndex kRoot = 0;
constexpr std::string_view kTeamKind = "Team", kRobotKind = "Robot";  // of no tree

// A robot, and where its nodes and entries are in the result.
struct Merged {
  RecordingReader& reader;
  std::string name, prefix;
  bool is_followed;
  std::vector<ClockFit> clocks;
  NodeIndex node = 0;                 // that stands for it
  std::vector<NodeIndex> nodes = {};  // by its own index
  std::uint32_t first_entry = 0;
  std::optional<RecordedTick> next = {};
  double time = 0;          // of `next`, on the clock of the result
  bool has_ticked = false;  // in the last line
  bool is_over = false;

  // Of the process that the reader is in.
  double on_clock(double seconds) const {
    const std::size_t cuts = reader.resumes().size() - (reader.header().resumed_after ? 1 : 0);
    const ClockFit& clock = clocks[std::min(cuts, clocks.size() - 1)];  // a file may have grown
    return clock.began + (1 + clock.drift) * seconds;
  }
  void read() {
    next = reader.next();
    if (next) time = std::max(time, on_clock(next->time));
  }
};

std::string with_entry(const Merged& robot, const std::string& port) {
  if (!port.starts_with('{') || !port.ends_with('}')) return port;
  const std::string_view key(port.data() + 1, port.size() - 2);
  const auto& entries = robot.reader.header().entries;
  const bool is_one = std::ranges::find(entries, key, &ShapeEntry::key) != entries.end();
  return is_one ? fmt::format("{{{}{}}}", robot.prefix, key) : port;
}

// --- the header ---------------------------------------------------------------------------------

class MergedHeader {
 public:
  MergedHeader(const std::string& team, std::vector<Merged>& robots) : robots_(robots) {
    const RecordingHeader& first = robots.front().reader.header();
    header_.id = team;
    header_.file = joined_of(&RecordingHeader::file);
    header_.version = joined_of(&RecordingHeader::version);
    header_.law = first.law;
    header_.clock = first.clock;
    header_.seed = first.seed;
    header_.nodes.push_back({.path = team, .kind = std::string(kTeamKind), .name = team});
    for (Merged& it : robots) {
      it.prefix = it.name + '/';
      add_tree(team, it);
      header_.rate_hz = std::max(header_.rate_hz, it.reader.header().rate_hz);
    }
    for (Merged& it : robots) add_groups(team, it);
    for (Merged& it : robots) add_values(it);
    complete(header_);
  }

  RecordingHeader take() { return std::move(header_); }

 private:
  std::string joined_of(std::string RecordingHeader::*text) const {
    std::vector<std::string> all;
    for (const Merged& it : robots_) {
      const std::string& one = it.reader.header().*text;
      if (std::ranges::find(all, one) == all.end()) all.push_back(one);
    }
    return joined(all, ", ");
  }

  static bool is_group(const RecordingHeader& header, NodeIndex node) {
    return node != 0 && !header.nodes[node].parent;
  }

  void add_tree(const std::string& team, Merged& robot) {
    const RecordingHeader& own = robot.reader.header();
    robot.node = static_cast<NodeIndex>(header_.nodes.size());
    header_.nodes.push_back({.path = team + '/' + robot.name,
                             .kind = std::string(kRobotKind),
                             .name = robot.name,
                             .parent = kRoot});
    for (NodeIndex node = 0; node < own.nodes.size(); ++node) {
      robot.nodes.push_back(0);
      if (!is_group(own, node)) add(team, robot, node);
    }
  }

  void add_groups(const std::string& team, Merged& robot) {
    const RecordingHeader& own = robot.reader.header();
    for (NodeIndex node = 0; node < own.nodes.size(); ++node) {
      if (is_group(own, node)) add(team, robot, node);
    }
  }

  void add(const std::string& team, Merged& robot, NodeIndex node) {
    const RecordingHeader& own = robot.reader.header();
    robot.nodes[node] = static_cast<NodeIndex>(header_.nodes.size());
    ShapeNode copy = own.nodes[node];
    copy.path = team + '/' + robot.prefix + copy.path;
    if (node == 0)
      copy.parent = robot.node;
    else if (copy.parent)
      copy.parent = robot.nodes[*copy.parent];
    for (NodeIndex& it : copy.members) it = robot.nodes[it];
    for (std::string& key : copy.reads) key = robot.prefix + key;
    if (copy.ports) {
      auto ports = *copy.ports;
      for (auto& [name, value] : ports) value = with_entry(robot, value);
      copy.ports = std::make_shared<const decltype(ports)>(std::move(ports));
    }
    // These follow from the others.
    copy.children.clear();
    copy.names.clear();
    copy.keeper.reset();
    copy.group.reset();
    copy.depth = 0;
    header_.nodes.push_back(std::move(copy));
  }

  void add_values(Merged& robot) {
    const RecordingHeader& own = robot.reader.header();
    for (const auto& [name, value] : own.arguments) header_.arguments[robot.prefix + name] = value;
    for (const auto& [name, value] : own.values) header_.values[robot.prefix + name] = value;
    robot.first_entry = static_cast<std::uint32_t>(header_.entries.size());
    for (const ShapeEntry& it : own.entries) {
      ShapeEntry& copy = header_.entries.emplace_back(it);
      copy.key = robot.prefix + it.key;
      for (NodeIndex& writer : copy.writers) writer = robot.nodes[writer];
    }
  }

  std::vector<Merged>& robots_;
  RecordingHeader header_;
};

// --- a line -------------------------------------------------------------------------------------

// What is in one line besides the nodes. Texts are those of the ticks, which outlive it.
struct MergedTick {
  std::vector<ReasonChange> reasons = {};
  std::vector<GivenAnswer> answers = {};
  std::vector<Heard> heard = {};
  std::vector<NodeIndex> succeeded = {};
  std::vector<TickMoment> moments = {};
  std::vector<MomentChange> moment_changes = {};
  std::vector<NodeTotals> totals = {};
  std::vector<LeafProgress> leaf_progress = {};
  std::vector<Fault> faults = {};
  std::vector<EntryChange> entries = {};
  std::vector<LeafLine> logs = {};

  void add(const Merged& robot, const RecordedTick& tick) {
    const auto node = [&](NodeIndex it) { return robot.nodes[it]; };
    for (const RecordedReason& it : tick.reasons)
      reasons.push_back({.node = node(it.node), .text = it.text});
    for (GivenAnswer it : tick.answers) {
      it.node = node(it.node);
      answers.push_back(std::move(it));
    }
    for (const RecordedHeard& it : tick.heard)
      heard.push_back({.node = node(it.node), .run = it.run, .word = it.word});
    for (const NodeIndex it : tick.succeeded) succeeded.push_back(node(it));
    add_moments(tick.moments, node);
    for (const RecordedFault& it : tick.faults)
      faults.push_back({.node = node(it.node), .message = it.message});
    for (const RecordedEntry& it : tick.entries) {
      const bool is_set = std::ranges::find(tick.set, it.entry) != tick.set.end();
      const auto given = std::ranges::find(tick.given, it.entry, &RecordedEntry::entry);
      const bool is_given = given != tick.given.end();
      entries.push_back({.entry = robot.first_entry + it.entry,
                         .text = it.value ? &*it.value : nullptr,
                         .is_set = is_set,
                         .is_written_again = is_given,
                         .given = is_given && given->value ? &*given->value : nullptr});
    }
    for (const LeafLine& it : tick.logs) logs.push_back(line_of(robot, it));
  }

  static LeafLine line_of(const Merged& robot, LeafLine line) {
    line.who = robot.prefix + line.who;
    return line;
  }

  TickEnd end() const {
    TickEnd all{.reasons = reasons, .answers = answers, .heard = heard, .succeeded = succeeded};
    all.moments = {
        .moments = moments, .changes = moment_changes, .rest = totals, .progress = leaf_progress};
    all.faults = faults;
    all.entries = entries;
    all.logs = logs;
    return all;
  }

 private:
  template <class Node>
  void add_moments(const MomentsView& view, Node node) {
    moments.insert(moments.end(), view.moments.begin(), view.moments.end());
    for (MomentChange it : view.changes) {
      it.node = node(it.node);
      moment_changes.push_back(it);
    }
    for (NodeTotals it : view.rest) {
      it.node = node(it.node);
      totals.push_back(it);
    }
    for (LeafProgress it : view.progress) {
      it.node = node(it.node);
      leaf_progress.push_back(it);
    }
  }
};

// The whole state: what a reader that begins there must know.
struct MergedState {
  explicit MergedState(const RecordingHeader& header)
      : nodes(header.nodes.size()), written(header.nodes.size()), entries(header.entries.size()) {}

  void take(const MergedTick& tick) {
    for (const ReasonChange& it : tick.reasons) reasons[it.node] = it.text;
    for (const Heard& it : tick.heard) heard[it.node] = it;
    for (const EntryChange& it : tick.entries) {
      entries[it.entry].emplace();
      if (it.text != nullptr) entries[it.entry]->emplace(*it.text);
    }
  }

  std::vector<RecordedState> nodes, written;
  std::map<NodeIndex, std::string> reasons = {};
  std::map<NodeIndex, Heard> heard = {};
  std::vector<std::optional<std::optional<std::string>>> entries;  // none: no value yet
};

class TeamMerge {
 public:
  TeamMerge(const std::string& team, std::span<const RobotRecording> robots,
            const std::function<bool(std::string_view)>& write)
      : robots_(merged(robots)),
        header_(MergedHeader(team, robots_).take()),
        state_(header_),
        half_period_(header_.rate_hz > 0 ? 0.5 / header_.rate_hz : 0),
        write_(write) {}

  bool run() {
    if (!write_(json_lines::header(header_))) return false;
    for (Merged& it : robots_) it.read();
    while (const Merged* const first = earliest()) {
      if (!write_line(*first)) return false;
    }
    return write_rest();
  }

 private:
  static std::vector<Merged> merged(std::span<const RobotRecording> robots) {
    std::vector<Merged> all;
    for (const RobotRecording& it : robots)
      all.push_back({.reader = *it.reader,
                     .name = it.name,
                     .prefix = {},
                     .is_followed = it.is_followed,
                     .clocks = it.clocks});
    return all;
  }

  const Merged* earliest() const {
    const Merged* found = nullptr;
    for (const Merged& it : robots_) {
      if (it.next && (found == nullptr || it.time < found->time)) found = &it;
    }
    return found;
  }

  // A tick with moments gets a separate line, since all moments of a line belong to one tick.
  bool is_in_line(const Merged& robot, const Merged& first) const {
    if (&robot == &first) return true;
    const bool is_alone = !first.next->moments.empty() || !robot.next->moments.empty();
    return !is_alone && robot.time < first.time + half_period_;
  }

  bool write_line(const Merged& first) {
    MergedTick tick;
    const double time = first.time;
    std::vector<bool> are_in;
    for (const Merged& it : robots_) are_in.push_back(it.next && is_in_line(it, first));
    for (std::size_t i = 0; i < robots_.size(); ++i) {
      Merged& it = robots_[i];
      if (are_in[i]) {
        take(it, *it.next);
        tick.add(it, *it.next);
      } else {
        if (it.has_ticked) forget_ticked(it);
        if (!it.next && !it.is_over) end_robot(it, tick);
      }
    }
    set_root();
    if (!put(tick, time)) return false;
    for (std::size_t i = 0; i < robots_.size(); ++i) {
      if (are_in[i]) robots_[i].read();
    }
    return true;
  }

  RecordedState& state(NodeIndex node) {
    changed_.insert(node);
    return state_.nodes[node];
  }

  void take(Merged& robot, const RecordedTick& tick) {
    const auto set = [&](NodeIndex node) { state(robot.nodes[node]) = tick.nodes[node]; };
    if (robot.has_ticked) {
      std::ranges::for_each(tick.changed, set);
    } else {  // forget_ticked() has changed others
      for (NodeIndex node = 0; node < tick.nodes.size(); ++node) set(node);
    }
    RecordedState& its = state(robot.node);
    const RecordedState& root = tick.nodes[0];
    its.status = root.status;
    its.progress = root.progress;
    its.ticked = robot.has_ticked = true;
    robot.is_over = has_ended(root.status);
  }

  void forget_ticked(Merged& robot) {
    robot.has_ticked = false;
    state(robot.node).ticked = false;
    for (const NodeIndex node : robot.nodes) {
      if (state_.nodes[node].ticked) state(node).ticked = false;
    }
  }

  // Its run has ended before its tree has: what ran was halted, and the robot has failed.
  void end_robot(Merged& robot, MergedTick& tick) {
    robot.is_over = true;
    for (const NodeIndex node : robot.nodes) {
      if (state_.nodes[node].status == Status::Running) state(node) = {};
    }
    state(robot.node) = {.status = Status::Failure, .ticked = true};
    ends_.push_back(how_it_ended(robot));
    tick.reasons.push_back({.node = robot.node, .text = ends_.back()});
  }

  static std::string how_it_ended(const Merged& robot) {
    const auto& end = robot.reader.end();
    if (!end) return "the recording is cut: " + robot.reader.cut();
    return end->fault.empty() ? ending(end->result, end->reason) : end->fault;
  }

  void set_root() {
    const bool are_over = std::ranges::all_of(robots_, &Merged::is_over);
    const bool succeed = std::ranges::all_of(robots_, [&](const Merged& it) {
      return it.is_followed || state_.nodes[it.node].status == Status::Success;
    });
    RecordedState& root = state(kRoot);
    root.status = !are_over ? Status::Running : succeed ? Status::Success : Status::Failure;
    root.ticked = true;
    root.progress = 1;
    for (const Merged& it : robots_) {
      const RecordedState& its = state_.nodes[it.node];
      if (it.is_followed) continue;
      root.progress = std::min(root.progress, its.status == Status::Success ? 1 : its.progress);
    }
  }

  // --- what is written
  // ----------------------------------------------------------------------------

  bool put(const MergedTick& tick, double time) {
    state_.take(tick);
    TickEnd end = tick.end();
    MergedTick whole;
    const bool is_whole = ++lines_ % kWholeEach == 0;
    if (is_whole) add_whole(whole, end);
    put_changes(is_whole, end);
    std::string text(json_lines::kMostAtOnce + 64 * nodes_.size(), '\0');
    char* const from = text.data();
    last_time_ = from_seconds(time);
    char* to = json_lines::put_tick(from, ticks_++, last_time_);
    const std::span<char> room(to, from + text.size());
    to = json_lines::put_nodes(room, nodes_, true).end;
    std::string rest;
    json_lines::set_tick_end(rest, end);
    text.resize(static_cast<std::size_t>(to - from));
    return write_(text += rest);
  }

  // The whole state: also what no robot has changed in this tick.
  void add_whole(MergedTick& whole, TickEnd& end) {
    for (const auto& [node, text] : state_.reasons) {
      const bool is_new =
          std::ranges::find(end.reasons, node, &ReasonChange::node) != end.reasons.end();
      if (!text.empty() || is_new) whole.reasons.push_back({.node = node, .text = text});
    }
    for (const auto& [node, heard] : state_.heard) {
      if (heard.word != 0) whole.heard.push_back(heard);
    }
    for (std::uint32_t i = 0; i < state_.entries.size(); ++i) {
      const auto& it = state_.entries[i];
      if (it) whole.entries.push_back({.entry = i, .text = *it ? &**it : nullptr});
    }
    end.reasons = whole.reasons;
    end.heard = whole.heard;
    end.whole = whole.entries;
  }

  void put_changes(bool is_whole, TickEnd& end) {
    nodes_.clear();
    limits_.clear();
    rounds_.clear();
    factors_.clear();
    const auto add = [&](NodeIndex node) {
      const RecordedState& now = state_.nodes[node];
      const RecordedState none, &before = is_whole ? none : state_.written[node];
      const bool is_same = now.state().bits == before.state().bits && now.held == before.held &&
                           now.progress == before.progress;
      if (!is_same) nodes_.push_back({now.progress, node, now.state().bits});
      if (now.limit != before.limit) limits_.push_back({node, now.limit});
      if (now.round != before.round) rounds_.push_back({node, now.round});
      if (now.factor != before.factor) factors_.push_back({node, now.factor});
      state_.written[node] = now;
    };
    if (is_whole) {
      for (NodeIndex node = 0; node < state_.nodes.size(); ++node) add(node);
    } else {
      for (const NodeIndex node : changed_) add(node);
    }
    changed_.clear();
    end.limits = limits_;
    end.rounds = rounds_;
    end.factors = factors_;
  }

  // The ends of runs that nothing has followed, and how the team has ended.
  bool write_rest() {
    double time = to_seconds(last_time_);
    for (const Merged& it : robots_) {
      const auto& end = it.reader.end();
      if (end) time = std::max(time, it.on_clock(end->time));
    }
    if (ticks_ > 0 && !std::ranges::all_of(robots_, &Merged::is_over)) {
      MergedTick tick;
      for (Merged& it : robots_) {
        if (it.has_ticked) forget_ticked(it);
        if (!it.is_over) end_robot(it, tick);
      }
      set_root();
      if (!put(tick, time)) return false;
    }
    return write_(json_lines::end(end(time)));
  }

  RecordedEnd end(double time) const {
    RecordedEnd all{.result = std::string(to_string(RunResult::Success)),
                    .reason = std::string(to_string(StopReason::Completed)),
                    .fault = "",
                    .ticks = ticks_,
                    .time = time};
    for (const Merged& it : robots_) add_end(it, all);
    return all;
  }

  // The first one that has not succeeded decides.
  static void add_end(const Merged& robot, RecordedEnd& all) {
    const auto& end = robot.reader.end();
    const auto note = [&](std::string_view text) {
      all.notes.push_back(fmt::format("{}: {}", robot.name, text));
    };
    const bool is_first = !robot.is_followed && all.result == to_string(RunResult::Success);
    if (!end) {
      note("the recording is cut: " + robot.reader.cut());
      if (is_first) all.result = to_string(RunResult::Stopped);
      if (is_first) all.reason = "cut";
    } else {
      if (is_first) all.result = end->result, all.reason = end->reason, all.signal = end->signal;
      if (all.fault.empty() && !end->fault.empty()) all.fault = robot.prefix + end->fault;
      all.overruns += end->overruns;
      all.skipped += end->skipped;
      for (const std::string& it : end->notes) note(it);
      for (const LeafLine& it : end->logs) all.logs.push_back(MergedTick::line_of(robot, it));
    }
    if (const std::string gaps = robot.reader.gaps(); !gaps.empty()) note(gaps);
  }

  static constexpr std::uint64_t kWholeEach = 4096;

  std::vector<Merged> robots_;
  const RecordingHeader header_;
  MergedState state_;
  const double half_period_;
  const std::function<bool(std::string_view)>& write_;
  std::set<NodeIndex> changed_;
  std::vector<NodeChange> nodes_;
  std::vector<LimitChange> limits_;
  std::vector<RoundChange> rounds_;
  std::vector<FactorChange> factors_;
  std::deque<std::string> ends_;  // texts of reasons
  std::uint64_t ticks_ = 0, lines_ = 0;
  Nanoseconds last_time_{0};
};

}  // namespace

bool is_merged(const Shape& shape) {
  return shape.nodes.front().kind == kTeamKind;
}

bool merge_recordings(const std::string& team, std::span<const RobotRecording> robots,
                      const std::function<bool(std::string_view)>& write) {
  return TeamMerge(team, robots, write).run();
}

}  // namespace lockstep::host
