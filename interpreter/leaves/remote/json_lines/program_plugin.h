// A plugin that is a program: a process for each concurrent run.
#pragma once

#include <deque>
#include <memory>
#include <string>

#include "base/core/problem.h"
#include "base/system/mutex.h"
#include "leaves/plugin/contract/described_types.h"
#include "leaves/remote/isolation_options.h"
#include "leaves/remote/json_lines/conversation.h"
#include "leaves/remote/json_lines/hello.h"
#include "leaves/remote/remote_plugin.h"

namespace lockstep::host {

class ProgramPlugin final : public RemotePlugin, private LeafDescriber {
 public:
  // Starts the first process, which says what leaves it has. Where programs are not run, a file
  // beside it says so.
  [[nodiscard]] static Result<std::unique_ptr<ProgramPlugin>> open(const std::string& path,
                                                                   const std::string& name,
                                                                   Hold hold,
                                                                   const IsolationOptions& options);
  ProgramPlugin(const ProgramPlugin&) = delete;
  ProgramPlugin& operator=(const ProgramPlugin&) = delete;

  const lockstep_plugin& entry() const override { return hello_->plugin(); }
  LeafDescriber* describer() override { return this; }
  bool answers_late() const override { return true; }
  std::string descriptions() override;
  std::unique_ptr<RemoteRun> begin_run(const lockstep_caller& caller) override;
  const Hello& hello() const { return *hello_; }
  // The file beside it says something else; or was read, and may do so.
  bool is_file_stale() const { return is_file_stale_; }
  bool is_file_older() const { return is_file_older_; }

  // A process that has said the same as the first; null on failure, with the reason in `failure`,
  // which continues "its program ".
  // May be called from any thread.
  std::unique_ptr<Conversation> acquire(std::string& failure);

 private:
  ProgramPlugin(std::string path, IsolationOptions options);
  Result<std::string> first_line();
  Result<std::string> ask(std::string_view request);
  Result<std::string> read_answer(std::string_view request) const;
  tl::expected<const lockstep_leaf_type*, ElementRefusal> describe(
      std::string_view id, std::span<const FixedText> fixed) override;

  std::string path_;
  IsolationOptions options_;
  std::unique_ptr<Hello> hello_;
  bool is_file_stale_ = false, is_file_older_ = false;

  Mutex mutex_;
  std::deque<OwnedDescriptors> described_ LOCKSTEP_GUARDED_BY(mutex_);
  std::string descriptions_ LOCKSTEP_GUARDED_BY(mutex_);
  std::unique_ptr<Conversation> first_ LOCKSTEP_GUARDED_BY(mutex_);  // until a run takes it
};

}  // namespace lockstep::host
