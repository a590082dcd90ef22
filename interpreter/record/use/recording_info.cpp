#include "record/use/recording_info.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/core/diagnostics.h"
#include "base/core/wording.h"
#include "base/terminal/style.h"
#include "judge/measure/synchronized_measure.h"
#include "judge/summary/summary.h"
#include "judge/summary/why.h"
#include "record/read/recorded_moments.h"
#include "record/use/recorded_joints.h"

namespace lockstep::host {
namespace {

void write_header(const RecordingHeader& header, std::string& out, bool color) {
  out += fmt::format("{} from {}, recorded by lockstep {}\n",
                     styled(printable(header.id), Style::Strong, color), printable(header.file),
                     printable(header.version));
  out += fmt::format("  {}, {} Hz, {} clock, seed {}, semantics {}\n",
                     counted(header.nodes.size(), "node"), header.rate_hz, printable(header.clock),
                     header.seed, header.law);
  if (!header.tick.empty()) out += fmt::format("  ticks: {}\n", printable(header.tick));
  if (!header.verify.empty()) {
    out += fmt::format("  found by verify: {}\n", printable(header.verify));
  }
  for (const auto& [name, value] : header.arguments) {
    out += fmt::format("  argument {} = {}\n", printable(name), printable(value));
  }
}

// The nodes, and how the last tick has left them, in the words of the path that decided.
void write_tree(const RecordingHeader& header, const Moment* last, std::string& out) {
  constexpr std::size_t kDeepest = 20;  // what is deeper stands below that
  out += last == nullptr ? "  the tree:\n" : fmt::format("  the tree after tick {}:\n", last->tick);
  for (NodeIndex index = 0; index < header.nodes.size(); ++index) {
    const ShapeNode& node = header.nodes[index];
    const std::string kind = kind_text(node);
    out +=
        fmt::format("{:{}}{}", "", 4 + 2 * std::min(node.depth, kDeepest), printable(node.segment));
    if (node.segment != kind) out += fmt::format(" ({})", printable(kind));
    if (last != nullptr) out += fmt::format(": {}", to_string(last->status(index)));
    out += '\n';
  }
}

void write_end(const RecordingReader& reader, std::uint64_t ticks, double time, std::string& out,
               bool color) {
  if (const std::uint64_t first = reader.header().first_tick; first > 0) {
    out += fmt::format("  a part that begins with tick {}\n", first);
  }
  for (const RecordingReader::Resume& it : reader.resumes()) {
    out += fmt::format("  resumed after {:.1f} s, from tick {} on\n", it.after, it.first_tick);
  }
  if (const auto& end = reader.end()) {
    out += fmt::format("  {} after {}, {:.3f} s", printable(ending(end->result, end->reason)),
                       counted(end->ticks, "tick"), end->time);
    out += fmt::format("; {}, {} skipped\n", counted(end->overruns, "overrun"),
                       counted(end->skipped, "deadline"));
    if (!end->fault.empty()) out += fmt::format("  fault: {}\n", printable(end->fault));
    for (const std::string& note : end->notes) out += fmt::format("  note: {}\n", printable(note));
    return;
  }
  if (reader.goes_on()) {
    out += fmt::format("  {}, until {:.3f} s; the run continues in the next part\n",
                       counted(ticks, "tick"), time);
    return;
  }
  out += fmt::format("  {}, {:.3f} s; {} {}\n", counted(ticks, "tick"), time,
                     styled("the recording is cut:", Style::Warning, color), reader.cut());
}

// Nothing when the last tick is lost: what comes before it does not say.
std::vector<WhySummary> why_failed(const RecordingReader& reader, const WhyWatch& why,
                                   const Moment& last) {
  const auto& end = reader.end();
  const bool failed = end && end->result == to_string(RunResult::Failure);
  if (!failed || last.tick + 1 != end->ticks) return {};
  return summarize(why.why(last), reader.header());
}

struct Stalls {
  std::uint64_t ended = 0;  // by --stall-fail
  std::uint64_t tick = 0;   // of the first, and so is the node
  NodeIndex node = 0;
};

void write_warnings(const RecordingReader& reader, std::uint64_t faults, const Stalls& stalls,
                    std::string& out, bool color) {
  if (const std::string gaps = reader.gaps(); !gaps.empty()) {
    out += fmt::format("  {}\n", styled(gaps, Style::Warning, color));
  }
  if (faults > 0) {
    out += fmt::format("  {}\n",
                       styled(counted(faults, "fault") + " of leaves after which the run continued",
                              Style::Warning, color));
  }
  if (stalls.ended > 0) {
    out += fmt::format(
        "  {}, first '{}' in tick {}\n",
        styled("--stall-fail ended " + counted(stalls.ended, "stall"), Style::Warning, color),
        printable(reader.header().nodes[stalls.node].path), stalls.tick);
  }
}

}  // namespace

std::string info_text(RecordingReader& reader, bool color) {
  const RecordingHeader& header = reader.header();
  RecordedMoments moments(header);
  WhyWatch why(header);
  std::vector<MeasuredNode> nodes = measured_nodes(header);
  RecordedJoints joints(reader);
  std::uint64_t ticks = 0, faults = 0;
  Stalls stalls;
  const Moment* last = nullptr;
  while (const auto tick = reader.next()) {
    ticks = tick->tick + 1;
    if (const auto joint = joints.before(*tick)) {
      for (MeasuredNode& node : nodes) node.measure.join(*joint);
    }
    faults += tick->faults.size();
    last = &moments.read(*tick);
    for (const NodeIndex node : last->stood_still) {
      if (stalls.ended++ == 0) stalls = {.ended = 1, .tick = tick->tick, .node = node};
    }
    why.after_tick(*last);
    for (MeasuredNode& node : nodes) node.after_tick(*last);
  }
  if (!reader.error().empty()) return {};
  std::string out;
  const Nanoseconds ended = last != nullptr ? last->time + period_of(header) : Nanoseconds(0);
  const double time = reader.end() ? reader.end()->time : to_seconds(ended);
  write_header(header, out, color);
  write_tree(header, last, out);
  write_end(reader, ticks, time, out, color);
  if (last != nullptr) write_text(why_failed(reader, why, *last), out, color);
  write_warnings(reader, faults, stalls, out, color);
  std::vector<SynchronizedSummary> reached;
  std::vector<std::string> notes;
  for (MeasuredNode& measured : nodes) {
    auto& [parallel, measure] = measured;
    if (measure.distance().samples() == 0) continue;
    append_fall_notes(header, measured, notes);
    measure.run_ended(from_seconds(time));
    const ShapeNode& node = header.nodes[parallel.node()];
    reached.push_back(
        summarize(measure, node.path, node.kind, child_names(header, parallel.node())));
  }
  for (const std::string& note : notes) {
    out += fmt::format("  note: {}\n", printable(note));
  }
  write_text(reached, nodes.size() - reached.size(), out, color);
  return out;
}

}  // namespace lockstep::host
