#include "plugin/program/program_run.h"

#include <memory>
#include <optional>

#include "plugin/descriptor.h"
#include "plugin/host.h"
#include "plugin/program/listener.h"
#include "plugin/program/program_leaf.h"
#include "plugin/program/program_plugin.h"

namespace lockstep {
namespace {

void fail(const lockstep_caller& caller, const std::string& reason) {
  host_table().set_error(&caller, reason.c_str());
}

// What the leaves of a program share in a run, seen by LeafSet as the run context of the plugin.
class ProgramRun {
 public:
  ProgramRun(ProgramPlugin& plugin, const lockstep_caller& caller)
      : plugin_(plugin), caller_(caller) {
    if (caller.time->workers == nullptr) listener_.emplace();
  }
  ~ProgramRun() {
    listener_.reset();
    for (const auto& conversation : conversations_) conversation->process().close_input();
    for (const auto& conversation : conversations_) {
      const std::string what = conversation->end();
      if (!what.empty())
        host_table().log(&caller_, LOCKSTEP_LOG_WARNING, ("its program " + what).c_str());
    }
  }
  ProgramRun(const ProgramRun&) = delete;
  ProgramRun& operator=(const ProgramRun&) = delete;

  // Null after a failure, which is the caller's error.
  std::unique_ptr<ProgramLeaf> create(const lockstep_caller& caller) {
    const Hold hold = plugin_.hello().hold_of(caller.id);
    Conversation* const conversation =
        hold == Hold::Signal ? begin_another(caller) : shared(caller);
    if (conversation == nullptr) return nullptr;
    auto leaf = std::make_unique<ProgramLeaf>(caller, *conversation, hold,
                                              listener_ ? &*listener_ : nullptr);
    return leaf->create() ? std::move(leaf) : nullptr;
  }

 private:
  // That of all leaves that may share one.
  Conversation* shared(const lockstep_caller& caller) {
    if (shared_ == nullptr) shared_ = begin_another(caller);
    return shared_;
  }

  Conversation* begin_another(const lockstep_caller& caller) {
    std::string failure;
    auto conversation = plugin_.acquire(failure);
    if (conversation == nullptr) {
      fail(caller, failure);
      return nullptr;
    }
    conversation->begin(caller_);
    if (listener_) listener_->add(*conversation);
    return conversations_.emplace_back(std::move(conversation)).get();
  }

  ProgramPlugin& plugin_;
  const lockstep_caller& caller_;
  std::vector<std::unique_ptr<Conversation>> conversations_;
  Conversation* shared_ = nullptr;
  std::optional<Listener> listener_;
};

void* create_run(const lockstep_host* /*host*/, const lockstep_caller* caller) {
  return new ProgramRun(*static_cast<const HostedPlugin*>(caller->plugin)->program, *caller);
}

void destroy_run(void* context) {
  delete static_cast<ProgramRun*>(context);
}

void* create(const lockstep_host* /*host*/, const lockstep_caller* caller, void* run_context) {
  return static_cast<ProgramRun*>(run_context)->create(*caller).release();
}

void destroy(void* leaf) {
  delete static_cast<ProgramLeaf*>(leaf);
}

template <auto kMember>
auto call(void* leaf) {
  return (static_cast<ProgramLeaf*>(leaf)->*kMember)();
}

}  // namespace

const lockstep_plugin& program_functions() {
  static constexpr lockstep_plugin kPlugin = [] {
    lockstep_plugin plugin{};
    plugin.create_run = create_run;
    plugin.destroy_run = destroy_run;
    return plugin;
  }();
  return kPlugin;
}

const lockstep_leaf_type& program_leaf_functions() {
  static constexpr lockstep_leaf_type kType = [] {
    lockstep_leaf_type type{};
    type.create = create;
    type.destroy = destroy;
    type.start = call<&ProgramLeaf::start>;
    type.tick = call<&ProgramLeaf::tick>;
    type.halt = call<&ProgramLeaf::halt>;
    type.pause = call<&ProgramLeaf::pause>;
    type.resume = call<&ProgramLeaf::resume>;
    type.progress = call<&ProgramLeaf::progress>;
    return type;
  }();
  return kType;
}

}  // namespace lockstep
