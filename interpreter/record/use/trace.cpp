#include "record/use/trace.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/json/json.h"
#include "record/use/compared_children.h"

namespace lockstep::host {
namespace {

constexpr double kLate = 1.5;  // periods from one tick to the next: the first has overrun

// Microseconds, exact to the nanosecond.
std::string in_trace(double seconds) {
  const auto time = static_cast<std::uint64_t>(std::llround(seconds * 1e9));
  return fmt::format("{}.{:03}", time / 1000, time % 1000);
}

// The name of the slice of what a node does in a tick; "": it has none.
std::string_view activity(const RecordedState& state) {
  const bool is_active =
      state.status == Status::Running || (state.ticked && state.status != Status::Idle);
  return is_active ? to_string(state.status) : std::string_view();
}

struct Slice {
  std::string_view name;  // "": none is open
  double begin = 0;
};

class Trace {
 public:
  Trace(const RecordingHeader& header, const ExportSink& write)
      : header_(header), write_(write), slices_(header.nodes.size()), held_(header.nodes.size()) {
    text_ = "{\"displayTimeUnit\":\"ms\",\"traceEvents\":[\n";
    begin_event("M", 0);
    text_ += ",\"name\":\"process_name\",\"args\":{\"name\":";
    append_json(text_, header.id + " (lockstep)");
    text_ += "}}";
    for (NodeIndex node = 0; node < header.nodes.size(); ++node) name_track(node);
    for (auto& it : compared_children(header)) counters_.push_back({std::move(it)});
  }

  // False: no more is wanted.
  bool take(const RecordedTick& tick) {
    note_gap(tick);
    for (NodeIndex node = 0; node < slices_.size(); ++node) {
      const RecordedState& state = tick.nodes[node];
      // The inner slice ends first and begins last.
      const std::string_view held = state.held ? "held" : "", now = activity(state);
      if (held != held_[node].name || now != slices_[node].name) end(held_[node], node, tick.time);
      if (now != slices_[node].name) {
        end(slices_[node], node, tick.time);
        slices_[node] = {now, tick.time};
      }
      if (held_[node].name.empty()) held_[node] = {held, tick.time};
    }
    add_moments(tick);
    for (Counter& it : counters_) add_counter(it, tick);
    for (const RecordedFault& it : tick.faults)
      add_instant(it.node, tick.time, "fault: " + it.message);
    for (const RecordedEntry& it : tick.entries) {
      add_instant(std::nullopt, tick.time, header_.entries[it.entry].key + " = " + shown_value(it));
    }
    last_ = tick.time;
    next_ = tick.tick + 1;
    return flush(kFull);
  }

  // The last tick lasts until the next one would have begun.
  bool finish() {
    const double end_time = last_ + to_seconds(period_of(header_));
    for (NodeIndex node = 0; node < slices_.size(); ++node) {
      end(held_[node], node, end_time);
      end(slices_[node], node, end_time);
    }
    text_ += "\n]}\n";
    return flush(0);
  }

 private:
  static constexpr std::size_t kFull = 1u << 16u;

  struct Counter {
    ComparedChildren of;
    std::vector<double> progress = {};  // that was written; empty: none
  };

  // {"ph":"X","pid":1,"tid":3, where the track of a node is its index and one more.
  void begin_event(std::string_view phase, std::uint64_t track) {
    if (has_event_) text_ += ",\n";
    has_event_ = true;
    text_ += fmt::format("{{\"ph\":\"{}\",\"pid\":1,\"tid\":{}", phase, track);
  }

  void name_track(NodeIndex node) {
    begin_event("M", node + 1);
    text_ += ",\"name\":\"thread_name\",\"args\":{\"name\":";
    append_json(text_, header_.nodes[node].path);
    text_ += "}}";
    begin_event("M", node + 1);
    text_ += fmt::format(",\"name\":\"thread_sort_index\",\"args\":{{\"sort_index\":{}}}}}", node);
  }

  void end(Slice& slice, NodeIndex node, double time) {
    if (!slice.name.empty()) {
      begin_event("X", node + 1);
      text_ += fmt::format(",\"ts\":{},\"dur\":{},\"name\":\"{}\"}}", in_trace(slice.begin),
                           in_trace(time - slice.begin), slice.name);
    }
    slice = {};
  }

  // The results within a tick that its slices do not show: instants.
  void add_moments(const RecordedTick& tick) {
    tick.moments.each(moment_,
                      [&](std::span<const NodeState> now, const TickMoment& it, bool is_last) {
                        if (is_last && it.times == 1) return;
                        for (NodeIndex node = 0; node < now.size(); ++node) {
                          if (!now[node].ticked() || !has_ended(now[node].status())) continue;
                          std::string name(to_string(now[node].status()));
                          if (it.times > 1) name += fmt::format(", {} times", it.times);
                          add_instant(node, tick.time, name);
                        }
                      });
  }

  void add_counter(Counter& counter, const RecordedTick& tick) {
    if (!tick.nodes[counter.of.node].ticked && !counter.progress.empty()) return;
    std::vector<double> progress;
    for (const NodeIndex child : counter.of.children)
      progress.push_back(tick.nodes[child].progress);
    if (progress == counter.progress) return;
    begin_event("C", 0);
    text_ += fmt::format(",\"ts\":{},\"name\":", in_trace(tick.time));
    append_json(text_, "progress " + header_.nodes[counter.of.node].path);
    text_ += ",\"args\":{";
    for (std::size_t i = 0; i < progress.size(); ++i) {
      if (i > 0) text_ += ',';
      append_json(text_, counter.of.names[i]);
      text_ += fmt::format(":{}", progress[i]);
    }
    text_ += "}}";
    counter.progress = std::move(progress);
  }

  void add_instant(std::optional<NodeIndex> node, double time, const std::string& name) {
    begin_event("i", node ? *node + 1 : 0);
    text_ += fmt::format(",\"ts\":{},\"s\":\"{}\",\"name\":", in_trace(time), node ? 't' : 'p');
    append_json(text_, name);
    text_ += '}';
  }

  void note_gap(const RecordedTick& tick) {
    if (!next_) return;
    const double period = to_seconds(period_of(header_));
    if (tick.tick > *next_) {
      add_instant(std::nullopt, tick.time, fmt::format("{} ticks lost", tick.tick - *next_));
    } else if (header_.clock == "wall" && tick.time - last_ >= kLate * period) {
      add_instant(std::nullopt, last_, fmt::format("tick {} overran", tick.tick - 1));
    }
  }

  bool flush(std::size_t room) {
    if (text_.size() < room) return true;
    const bool goes_on = write_(text_);
    text_.clear();
    return goes_on;
  }

  const RecordingHeader& header_;
  const ExportSink& write_;
  std::string text_;
  bool has_event_ = false;
  std::vector<NodeState> moment_;
  std::vector<Slice> slices_, held_;  // of each node
  std::vector<Counter> counters_;
  double last_ = 0;                         // time of a tick
  std::optional<std::uint64_t> next_ = {};  // tick; none: there was none yet
};

}  // namespace

bool write_trace(RecordingReader& reader, TickRange range, const ExportSink& write) {
  Trace trace(reader.header(), write);
  if (range.from > 0) reader.skip_to(range.from);
  while (const auto tick = reader.next()) {
    if (tick->tick < range.from) continue;
    if (tick->tick > range.to) break;
    if (!trace.take(*tick)) return false;
  }
  return trace.finish();
}

}  // namespace lockstep::host
