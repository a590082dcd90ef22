// Compares two recordings: the differences in their headers, in the first tick that differs, and in
// their ends. The names of the files are not compared. Different versions of lockstep are only
// noted.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "record/read/recording_reader.h"

namespace lockstep::host {

struct DiffOptions {
  double tolerance = 0;      // of progress
  bool ignore_time = false;  // on the wall clock no two runs have the same times
};

// A difference between two texts; none: missing.
struct ValueDifference {
  std::string what;
  std::optional<std::string> a, b;
};

struct NodeDifference {
  std::string path;
  RecordedState a, b;
};

struct TickDifference {
  std::uint64_t tick = 0;
  // If not None, the rest is not set.
  enum class Missing : std::uint8_t { None, InA, InB } missing = Missing::None;
  bool lost = false;              // it is missing, but later ones are there
  double time_a = 0, time_b = 0;  // seconds; the same when they are not compared
  std::vector<NodeDifference> nodes = {};
  // The results of nodes in a tick of several moments: "path: failure, 2 times success"; likewise.
  std::vector<std::string> moments_a = {}, moments_b = {};
  // Each as "path: message"; empty when they are the same.
  std::vector<std::string> faults_a = {}, faults_b = {};
  // Each as "key = value", of those that have changed; empty when they are the same.
  std::vector<std::string> entries_a = {}, entries_b = {};
};

struct RecordingDiff {
  std::vector<ValueDifference> header;
  bool has_common_nodes = true;  // else no tick could be compared
  std::optional<TickDifference> tick;
  std::uint64_t ticks_a = 0, ticks_b = 0;  // that are in them
  std::vector<ValueDifference> end;
  std::vector<std::string> notes;  // not differences, but facts that may explain one

  bool same() const { return header.empty() && !tick && ticks_a == ticks_b && end.empty(); }
};

// Reads both to their ends.
RecordingDiff compare(RecordingReader& a, RecordingReader& b, const DiffOptions& options);

// Like the output of diff -u, "" when they are the same; one line of JSON.
std::string to_text(const RecordingDiff& diff, const std::string& a, const std::string& b,
                    bool color);
std::string to_json(const RecordingDiff& diff);

}  // namespace lockstep::host
