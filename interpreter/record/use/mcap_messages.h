// The messages of a run in a file of MCAP: docs/recording.md lists them. Used by mcap and
// mcap_stream.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "record/recording.h"
#include "record/use/compared_children.h"
#include "record/use/mcap_file.h"

namespace lockstep::host {

class McapMessages {
 public:
  // `header` and `write` must outlive it. `start_time`: of the run, in seconds.
  McapMessages(const RecordingHeader& header, double start_time, const ExportSink& write);

  // False: no more is wanted.
  bool take(const RecordedTick& tick);
  // The messages that were taken are written now.
  void flush() { file_.end_chunk(); }
  bool finish(const std::optional<RecordedEnd>& end);

 private:
  struct Compared {
    ComparedChildren of;
    std::uint16_t channel;
  };

  void add_statuses(const RecordedTick& tick, std::uint64_t time);
  void begin_statuses(const RecordedTick& tick, std::uint64_t times);
  void add_status(NodeIndex node, const RecordedState& state);
  void end_statuses(std::uint64_t time);
  void add_progress(const Compared& compared, const RecordedTick& tick, std::uint64_t time);
  void add_log(const LeafLine& line, std::uint64_t time);
  std::uint16_t channel_of(std::uint32_t entry);

  const RecordingHeader& header_;
  const std::uint64_t start_;  // ns
  McapFile file_;
  const std::uint16_t status_, log_, entry_schema_;
  std::vector<Compared> compared_;
  std::map<std::uint32_t, std::uint16_t> entries_;  // channels
  std::vector<RecordedState> before_;
  std::vector<NodeState> moment_;
  std::string text_;  // of the message
};

}  // namespace lockstep::host
