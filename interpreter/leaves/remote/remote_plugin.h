// A plugin whose leaves other processes do. To the rest of lockstep it is an ordinary plugin, whose
// functions are proxies for the functions here. Each link to a process implements these classes:
// shared_memory/ for an isolated plugin, json_lines/ for one that is a program.
#pragma once

#include <memory>
#include <string>

#include "leaves/plugin/contract/process_leaves.h"
#include "leaves/plugin/contract/words.h"
#include "lockstep/leaf.h"

namespace lockstep::host {

class LeafDescriber;

// A call that goes wrong leaves an error at the caller of the leaf, as one of a leaf does.
class RemoteLeaf : public ProcessLeaf {
 public:
  explicit RemoteLeaf(const lockstep_caller& caller);
  ~RemoteLeaf() override;
  RemoteLeaf(const RemoteLeaf&) = delete;
  RemoteLeaf& operator=(const RemoteLeaf&) = delete;

  virtual void start() = 0;
  virtual void start_unreset() {}
  virtual lockstep_status tick() = 0;
  virtual void halt() = 0;
  virtual void pause() = 0;
  virtual void resume() = 0;
  virtual double progress() = 0;
  virtual double set_pace(double /*factor*/) { return 1; }
  virtual std::size_t save(void* /*bytes*/, std::size_t /*room*/) { return 0; }
  virtual lockstep_after_cut restore(const void* /*bytes*/, std::size_t /*size*/,
                                     const lockstep_cut* /*cut*/) {
    return LOCKSTEP_STARTS_AGAIN;
  }
  // The last call.
  virtual void end() = 0;

 protected:
  void fail(const std::string& why) const;

  const lockstep_caller& caller_;
};

// The leaves of a plugin in one run, seen by LeafSet as the run context of the plugin.
class RemoteRun {
 public:
  virtual ~RemoteRun() = default;
  // Null after a failure, which is the caller's error.
  virtual std::unique_ptr<RemoteLeaf> create(const lockstep_caller& caller) = 0;
  // The last call; its leaves are gone.
  virtual void end() {}
};

class RemotePlugin {
 public:
  virtual ~RemotePlugin() = default;
  // With the proxies as its functions. Valid as long as this object.
  virtual const lockstep_plugin& entry() const = 0;
  // Whether a tick on the wall clock leaves without the answer of an action.
  virtual bool answers_late() const { return false; }
  // Calls init. Returns "" or the reason of a failure.
  virtual std::string initialize() { return {}; }
  // Those of the plugin itself, where it was asked for them.
  virtual PluginWords script_words() const { return {}; }
  // Describes the elements of its leaf types; null: there are none.
  virtual LeafDescriber* describer() { return nullptr; }
  // The questions that a program was asked to describe elements, each with its answer, as lines.
  virtual std::string descriptions() { return {}; }
  // Null after a failure, which is the caller's error.
  virtual std::unique_ptr<RemoteRun> begin_run(const lockstep_caller& caller) = 0;
};

// The proxies; everything else in these is zero.
const lockstep_plugin& proxy_plugin();
const lockstep_leaf_type& proxy_leaf_type();

}  // namespace lockstep::host
