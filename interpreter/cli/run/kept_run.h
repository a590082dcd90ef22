// A run that is kept in a checkpoint file, and may go on from it: --checkpoint and --resume.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <tl/expected.hpp>

#include "cli/run/run_options.h"
#include "run/checkpoint/checkpoint_writer.h"
#include "run/loading/load.h"

namespace lockstep::host {

class KeptRun {
 public:
  // What makes the tree: before the documents are gone.
  static CheckpointFacts facts_of(const RunCommandOptions& options, const Loaded& loaded);

  // Opens the file, and reads it with --resume. A failure is an exit code, and reported. Nothing
  // is kept without --checkpoint.
  static tl::expected<std::unique_ptr<KeptRun>, int> open(const RunCommandOptions& options,
                                                          CheckpointFacts facts, const Tree& tree);

  // Before the first tick of a new run: as it was at the cut, if it goes on. Returns once the file
  // has it; false: it cannot, which is reported. The file stays as it was where a leaf could not be
  // created.
  bool begin(Run& run, std::function<void(const std::string& error)> on_error);
  bool continues() const { return from_.has_value(); }
  CheckpointWriter* writer() { return writer_ ? &*writer_ : nullptr; }
  LoopOptions::Before before() const;
  void end(const RunEnd& end) {
    if (writer_) writer_->end(end.ticks, end.last);
  }

  bool has_failed() const { return writer_ && !writer_->error().empty(); }

  // "resumed after 35 s; 'Main/left' continues at 0.42; 'Main/right' starts again"; "": it has
  // begun.
  const std::string& resumed() const { return resumed_; }
  // Why nothing is kept any more, and since when; "": all is.
  std::string error() const;

 private:
  KeptRun(const RunCommandOptions& options, CheckpointFacts facts, const Tree& tree)
      : options_(options), facts_(std::move(facts)), tree_(tree) {}
  int read();
  int refuse(const KeptCheckpoint& kept);
  void go_on(Run& run);

  const RunCommandOptions& options_;
  CheckpointFacts facts_;
  const Tree& tree_;
  std::unique_ptr<CheckpointFile> file_;  // until the writer has it
  std::optional<Checkpoint> from_;        // what the run goes on from
  Nanoseconds gap_{0};                    // since then
  SavedRun saved_;                        // its state
  LeafBytes leaves_;                      // what its leaves kept
  std::string resumed_;
  std::optional<CheckpointWriter> writer_;
};

}  // namespace lockstep::host
