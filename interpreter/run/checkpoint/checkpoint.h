// A checkpoint: a run between two ticks, as a file has it, and what it is the run of.
// docs/resume.md says what it is for.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/core/clock.h"
#include "base/core/problem.h"
#include "language/property/property_checks.h"

namespace lockstep::host {

// What is the same in all checkpoints of a file.
struct CheckpointFacts {
  // What the tree is made from, by names for people: another value is another tree.
  std::vector<std::pair<std::string, std::string>> identity;
  std::vector<std::string> nodes;     // their paths
  std::vector<std::uint8_t> is_leaf;  // of each node: an object of a plugin
};

struct Checkpoint {
  enum class Kind : std::uint8_t {
    Unfinished,  // a run goes on from here
    Ended,       // in order: nothing goes on
    Lost         // a run went on from here, but its state could not be kept: `note` says why
  };
  Kind kind = Kind::Unfinished;
  std::uint32_t resumes = 0;  // in a row, without a leaf that has completed in between
  std::uint64_t ticks = 0;    // so many are done
  Nanoseconds time{0};        // of the last one, since the run began
  Nanoseconds written{0};     // since 1970
  std::string boot;           // boot_id()
  std::string note;
  std::vector<std::uint32_t> rounds;  // of a robot in teams: TeamRun::keep_rounds
  std::vector<std::uint32_t> set;     // slots that were written since the last tick, from outside
  KeptProperties properties;          // that were checked
  std::string run;                    // append_bytes()
};

// The difference that matters most: "the text of 'door.xml'", and its two values. Nothing: none.
struct Difference {
  std::string name, kept, now;  // a value that is not there is ""
};
std::vector<Difference> differences(const CheckpointFacts& kept, const CheckpointFacts& now);

// For `identity`: a text by its size and its checksum.
std::string text_mark(std::string_view text);

// Appends it without the bytes of the run, which come behind it to the end. The second reads both.
void append_head(const Checkpoint& checkpoint, std::string& to);
[[nodiscard]] bool read_checkpoint_bytes(std::string_view bytes, Checkpoint& into);
void append_facts(const CheckpointFacts& facts, std::string& to);
[[nodiscard]] bool read_facts(std::string_view bytes, CheckpointFacts& into);

}  // namespace lockstep::host
