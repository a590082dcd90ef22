#include "observers/recording_info.h"

#include <fmt/format.h>

#include <memory>

#include "core/diagnostics.h"
#include "observers/style.h"
#include "observers/summary.h"

namespace lockstep {
namespace {

// A synchronized node of the recording and what is measured of it.
class Replayed {
 public:
  Replayed(const RecordingHeader& header, NodeIndex node) : node_(node) {
    for (NodeIndex child = node + 1; child < header.nodes.size(); ++child) {
      if (header.nodes[child].parent == node) children_.push_back(child);
    }
    measure_ = SynchronizedMeasure(children_.size());
    progress_.resize(children_.size());
    held_ = std::make_unique<bool[]>(children_.size());
  }

  void after_tick(const RecordedTick& tick) {
    for (std::size_t child = 0; child < children_.size(); ++child) {
      progress_[child] = tick.nodes[children_[child]].progress;
      held_[child] = tick.nodes[children_[child]].held;
    }
    measure_.after_tick({.time = from_seconds(tick.time),
                         .ticked = tick.nodes[node_].ticked,
                         .status = tick.nodes[node_].status,
                         .progress = progress_,
                         .held = {held_.get(), children_.size()}});
  }

  SynchronizedSummary summary(const RecordingHeader& header, double end) {
    measure_.run_ended(from_seconds(end));
    std::vector<std::string> names;
    for (const NodeIndex child : children_) {
      const std::string& path = header.nodes[child].path;
      names.push_back(path.substr(path.rfind('/') + 1));
    }
    return summarize(measure_, header.nodes[node_].path, header.nodes[node_].kind, names);
  }

 private:
  NodeIndex node_;
  std::vector<NodeIndex> children_;
  std::vector<double> progress_;
  std::unique_ptr<bool[]> held_;
  SynchronizedMeasure measure_{0};
};

void write_header(const RecordingHeader& header, std::FILE* out, bool color) {
  fmt::print(out, "{} from {}, recorded by lockstep {}\n",
             styled(printable(header.tree), Style::Strong, color), printable(header.file),
             printable(header.version));
  fmt::print(out, "  {} nodes, {} Hz, {} clock, seed {}\n", header.nodes.size(), header.rate_hz,
             printable(header.clock), header.seed);
  for (const auto& [name, value] : header.arguments) {
    fmt::print(out, "  argument {} = {}\n", printable(name), printable(value));
  }
}

void write_end(const RecordingReader& reader, std::uint64_t ticks, double time, std::FILE* out,
               bool color) {
  if (const auto& end = reader.end()) {
    fmt::print(out, "  {} ({}) after {} ticks, {:.3f} s", printable(end->result),
               printable(end->reason), end->ticks, end->time);
    fmt::print(out, "; {} overruns, {} deadlines skipped\n", end->overruns, end->skipped);
    if (!end->fault.empty()) fmt::print(out, "  fault: {}\n", printable(end->fault));
    return;
  }
  fmt::print(out, "  {} ticks, {:.3f} s; {} {}\n", ticks, time,
             styled("the recording is cut:", Style::Warning, color), reader.cut());
}

}  // namespace

void write_info(RecordingReader& reader, std::FILE* out, bool color) {
  const RecordingHeader& header = reader.header();
  std::vector<Replayed> nodes;
  for (NodeIndex node = 0; node < header.nodes.size(); ++node) {
    if (header.nodes[node].synchronization == Synchronization::None) continue;
    nodes.emplace_back(header, node);
  }
  std::uint64_t ticks = 0;
  double time = 0;
  while (const auto tick = reader.next()) {
    ++ticks;
    time = tick->time;
    for (Replayed& node : nodes) node.after_tick(*tick);
  }
  if (!reader.error().empty()) return;
  if (reader.end()) time = reader.end()->time;
  write_header(header, out, color);
  write_end(reader, ticks, time, out, color);
  for (Replayed& node : nodes) write_text(node.summary(header, time), out, color);
}

}  // namespace lockstep
