// A plugin in separate processes, one for each concurrent run.
#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/core/problem.h"
#include "base/system/mutex.h"
#include "leaves/plugin/contract/described_types.h"
#include "leaves/remote/isolation_options.h"
#include "leaves/remote/remote_plugin.h"
#include "leaves/remote/shared_memory/descriptor_message.h"
#include "leaves/remote/shared_memory/session.h"

namespace lockstep::host {

class IsolatedPlugin final : public RemotePlugin, public LeafDescriber {
 public:
  // Starts the first process, which opens the file, checks it and describes the plugin.
  [[nodiscard]] static Result<std::unique_ptr<IsolatedPlugin>> open(
      const std::string& path, const IsolationOptions& options);
  // Deinitializes the plugin in each of its processes and ends them. No run may be in progress.
  ~IsolatedPlugin() override;
  IsolatedPlugin(const IsolatedPlugin&) = delete;
  IsolatedPlugin& operator=(const IsolatedPlugin&) = delete;

  const lockstep_plugin& entry() const override { return descriptors_.plugin(); }
  // In the first process.
  std::string initialize() override;
  PluginWords script_words() const override { return descriptors_.words(); }
  LeafDescriber* describer() override { return this; }
  tl::expected<const lockstep_leaf_type*, ElementRefusal> describe(
      std::string_view id, std::span<const FixedText> fixed) override;
  std::unique_ptr<RemoteRun> begin_run(const lockstep_caller& caller) override;

  // The place of a leaf type among those of the plugin, by its id, which is the very pointer that
  // entry() has.
  std::optional<std::uint32_t> index_of(const lockstep_leaf_type& type) const;

  // Takes back the session of a run that is over. May be called from any thread.
  void release(std::unique_ptr<Session> session);

 private:
  IsolatedPlugin(std::string path, IsolationOptions options);
  std::optional<Problem> start(Session& session);
  std::optional<Problem> describe(MessageReader description);
  // An initialized process for one run.
  Result<std::unique_ptr<Session>> acquire();
  std::unique_ptr<Session> take_idle();
  Result<Object> from_text(const PackedType& type, std::string_view text);
  tl::expected<const lockstep_leaf_type*, ElementRefusal> read_described(MessageReader& answer);

  std::string path_;
  IsolationOptions options_;
  ReadDescriptors descriptors_;
  std::vector<std::byte> description_;  // what descriptors_ was made of

  Mutex mutex_;
  // Types of elements; none moves when another one is added.
  std::deque<ReadDescriptors> described_ LOCKSTEP_GUARDED_BY(mutex_);
  // Initialized, but for the first of all.
  std::vector<std::unique_ptr<Session>> idle_ LOCKSTEP_GUARDED_BY(mutex_);
};

}  // namespace lockstep::host
