// Parses and checks the JSON of the lines of a recording. An error in a line is thrown as a
// JsonError, which recording_reader, the only user, turns into an error with a line number.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/json/reader.h"
#include "record/recording.h"

namespace lockstep::host {

class RecordingJson {
 public:
  RecordingHeader header(std::string& line);

  // The tick of a line; none: it is a line of another kind, or not one that a recorder writes.
  static std::optional<std::uint64_t> tick_of(std::string_view line);
  static bool may_be_whole(std::string_view line);
  static bool is_end(std::string_view line);
  static bool is_part_end(std::string_view line);

  // Parses any other line. The changes of a tick are stored in `states`; what it points to is valid
  // until the next call.
  using Line = std::variant<RecordedTick, RecordedGap, RecordedPartEnd, RecordedEnd>;
  Line line(std::string& line, std::vector<RecordedState>& states);

 private:
  MomentsView moments(const std::vector<RecordedState>& states);

  JsonReader json_;
  std::vector<NodeIndex> changed_;
  std::vector<NodeIndex> succeeded_;
  std::vector<NodeState> first_moment_;
  std::vector<TickMoment> moments_;
  std::vector<MomentChange> moment_changes_;
  std::vector<NodeTotals> totals_;
  std::vector<LeafProgress> leaf_progress_;
  std::vector<RecordedReason> reasons_;
  std::vector<GivenAnswer> answers_;
  std::vector<RecordedHeard> heard_;
  std::vector<RecordedFault> faults_;
  std::vector<RecordedEntry> entries_;
  std::vector<std::uint32_t> set_;
  std::vector<RecordedEntry> given_;
  std::vector<RecordedEntry> whole_;
  std::vector<LeafLine> logs_;
  std::size_t keys_ = 0;     // how many entries the header names
  std::vector<bool> users_;  // by index: does the node use resources?
};

}  // namespace lockstep::host
