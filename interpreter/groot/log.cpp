#include "groot/log.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "groot/message.h"
#include "groot/statuses.h"

namespace lockstep::host {
namespace {

constexpr std::string_view kLogName = "BTCPP4-FileLogger2";
constexpr char kLogProtocol = 1;
constexpr double kMicroseconds = 1e6;
constexpr std::uint64_t kMostMoments = 10'000;

class Log {
 public:
  Log(const RecordingHeader& header, std::size_t nodes, const GrootSink& write)
      : write_(write), statuses_(nodes, Status::Idle), ends_(nodes) {
    for (NodeIndex node = 0; node < nodes; ++node) {
      ends_[node] = node + 1;
      for (auto it = header.nodes[node].parent; it; it = header.nodes[*it].parent) {
        ends_[*it] = node + 1;
      }
    }
  }

  void begin(std::string_view document, double start_time) {
    bytes_ = std::string(kLogName) + kLogProtocol;
    append_number(bytes_, document.size(), 4);
    bytes_ += document;
    append_number(bytes_, static_cast<std::uint64_t>(std::llround(start_time * kMicroseconds)), 8);
  }

  // In the order in which the library ticks: a node begins before its children, and its result
  // comes after theirs.
  bool take(const RecordedTick& tick) {
    time_ = static_cast<std::uint64_t>(std::llround(tick.time * kMicroseconds));
    tick.moments.each(moment_, [&](std::span<const NodeState> states, const TickMoment& it, bool) {
      // A run ticks no more often in one period; a damaged recording may say anything.
      const auto times = std::min<std::uint64_t>(it.times, kMostMoments);
      for (std::uint64_t i = 0; i < times; ++i) take_moment(states);
    });
    if (tick.moments.empty() || !tick.moments.rest.empty()) {
      take_states([&](NodeIndex node) { return tick.nodes[node].status; });
    }
    constexpr std::size_t kFull = 1u << 16u;
    return bytes_.size() < kFull || flush();
  }

  bool flush() { return write_(std::exchange(bytes_, {})); }

 private:
  // A node that is ticked again after its result begins again.
  void take_moment(std::span<const NodeState> states) {
    for (NodeIndex node = 0; node < statuses_.size(); ++node) {
      if (states[node].ticked() && has_ended(statuses_[node])) become(node, Status::Idle);
    }
    take_states([&](NodeIndex node) { return states[node].status(); });
  }

  template <class StatusOf>
  void take_states(StatusOf status_of_node) {
    std::vector<NodeIndex> open;
    const auto close_until = [&](NodeIndex node) {
      for (; !open.empty() && ends_[open.back()] <= node; open.pop_back()) {
        become(open.back(), status_of_node(open.back()));
      }
    };
    for (NodeIndex node = 0; node < statuses_.size(); ++node) {
      close_until(node);
      open.push_back(node);
      if (begins(node, status_of_node(node))) become(node, Status::Running);
    }
    close_until(static_cast<NodeIndex>(statuses_.size()));
  }

  // A node with children runs before it has a result, also in a single tick.
  bool begins(NodeIndex node, Status now) const {
    const bool is_result = now == Status::Success || now == Status::Failure;
    const bool has_children = ends_[node] > node + 1;
    return now == Status::Running || (is_result && has_children && statuses_[node] != now);
  }

  void become(NodeIndex node, Status status) {
    if (std::exchange(statuses_[node], status) == status) return;
    append_number(bytes_, time_, 6);
    append_number(bytes_, groot_uid(node), 2);
    bytes_ += static_cast<char>(status);
  }

  const GrootSink& write_;
  std::vector<Status> statuses_;
  std::vector<NodeState> moment_;
  std::vector<NodeIndex> ends_;  // one past the last descendant
  std::uint64_t time_ = 0;       // µs
  std::string bytes_;
};

}  // namespace

bool write_groot_log(RecordingReader& reader, const GrootTree& shown, double start_time,
                     const GrootSink& write) {
  Log log(reader.header(), shown.order.size(), write);
  log.begin(shown.document, start_time);
  while (const auto tick = reader.next()) {
    if (!log.take(*tick)) return false;
  }
  return log.flush();
}

}  // namespace lockstep::host
