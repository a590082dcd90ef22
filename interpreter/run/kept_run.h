// A run that is kept in a checkpoint file, and may go on from it: docs/resume.md.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <tl/expected.hpp>
#include <utility>
#include <vector>

#include "base/core/after_cut.h"
#include "base/core/problem.h"
#include "run/checkpoint/checkpoint_writer.h"
#include "run/loop.h"

namespace lockstep::host {

struct KeepOptions {
  std::string file = {};                       // "": the run is not kept
  bool resumes = false;                        // where the file is of a run that has not ended
  AfterCut on_resume = AfterCut::StartsAgain;  // of leaves that ran at the cut
  std::uint64_t resume_limit = 3;              // in a row
  Nanoseconds sync = std::chrono::milliseconds(100);
  bool real_time = true;
};

// Why a run is not kept, or does not go on.
struct NotKept {
  enum class Why : std::uint8_t {
    Objects,   // the tree has some, which no checkpoint has
    File,      // it cannot be used
    OtherRun,  // the file is of one, or damaged
    TooOften   // resumed, and nothing has completed
  };
  Why why;
  Problem problem;
};

// The line about a property that was not checked before a cut.
std::string fresh_property_text(const std::string& name);

class KeptRun {
 public:
  // Locks the file, and reads it if the run may go on. `identity` is what makes the run, by names
  // for people: a checkpoint with another one is refused.
  static tl::expected<std::unique_ptr<KeptRun>, NotKept> open(
      KeepOptions options, std::vector<std::pair<std::string, std::string>> identity,
      const Tree& tree);

  // Before `begin`: the teams of the robot. It must outlive this.
  void set_team(TeamRun& team) { team_ = &team; }
  // Likewise, those that are checked.
  void set_properties(PropertyChecks& properties) { properties_ = &properties; }
  // Before the first tick of a new run: as it was at the cut, if it goes on. Returns once the file
  // has it, or why it cannot. The file stays as it was where a leaf could not be created.
  std::optional<Problem> begin(Run& run, std::function<void(const std::string& error)> on_error);
  bool continues() const { return from_.has_value(); }
  CheckpointWriter* writer() { return writer_ ? &*writer_ : nullptr; }
  LoopOptions::Before before() const;  // valid as long as this
  // Around the ticks of who ticks by himself; the loop has the writer.
  void before_tick(Ticker& ticker) { ticker.set_durable(writer_->durable()); }
  void after_tick(Ticker& ticker, Status status);
  void between_ticks(const Ticker& ticker) { writer_->between_ticks(ticker, false); }
  // All was halted between two ticks: nothing goes on from here.
  void halted(Ticker& ticker) { writer_->after_tick(ticker, ticks_, true); }
  void end(std::uint64_t ticks, Nanoseconds last) {
    if (writer_) writer_->end(ticks, last);
  }
  void end(Nanoseconds last) { end(ticks_, last); }

  bool has_failed() const { return writer_ && !writer_->error().empty(); }

  // "resumed after 35 s; 'Main/left' continues at 0.42; 'Main/right' starts again"; "": it has
  // begun.
  const std::string& resumed() const { return resumed_; }
  // Those that ran at the cut, and what they do.
  const std::vector<CutLeaf>& cut_leaves() const { return cut_; }
  // Of the run before the cut; empty: there was none, or it had none.
  KeptProperties kept_properties() const { return from_ ? from_->properties : KeptProperties(); }
  // The names of the properties that were not checked before the cut.
  const std::vector<std::string>& fresh_properties() const { return fresh_properties_; }
  // Why nothing is kept any more, and since when; "": all is.
  std::string error() const;

 private:
  KeptRun(KeepOptions options, const Tree& tree) : options_(std::move(options)), tree_(tree) {}
  std::optional<NotKept> read();
  std::optional<NotKept> refuse(const KeptCheckpoint& kept);
  void go_on(Run& run);

  const KeepOptions options_;
  const Tree& tree_;
  TeamRun* team_ = nullptr;               // null: the robot is in none
  PropertyChecks* properties_ = nullptr;  // null: none is checked
  std::vector<std::string> fresh_properties_;
  CheckpointFacts facts_;
  std::unique_ptr<CheckpointFile> file_;  // until the writer has it
  std::optional<Checkpoint> from_;        // what the run goes on from
  Nanoseconds gap_{0};                    // since then
  SavedRun saved_;                        // its state
  LeafBytes leaves_;                      // what its leaves kept
  std::vector<CutLeaf> cut_;
  std::string resumed_;
  std::uint64_t ticks_ = 0;  // of who ticks by himself, with those before the cut
  std::optional<CheckpointWriter> writer_;
};

}  // namespace lockstep::host
