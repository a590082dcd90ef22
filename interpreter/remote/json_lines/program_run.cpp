#include "remote/json_lines/program_run.h"

#include <fmt/format.h>

#include <memory>
#include <optional>
#include <utility>

#include "core/end_budget.h"
#include "plugin/contract/descriptor.h"
#include "plugin/contract/host.h"
#include "remote/json_lines/listener.h"
#include "remote/json_lines/program_leaf.h"
#include "remote/json_lines/program_plugin.h"

namespace lockstep {
namespace {

void fail(const lockstep_caller& caller, const std::string& reason) {
  host_table().set_error(&caller, reason.c_str());
}

class ProgramRun;

struct RunLeaf final : ProgramLeaf {
  template <class... Arguments>
  explicit RunLeaf(ProgramRun& its_run, Arguments&&... arguments)
      : ProgramLeaf(std::forward<Arguments>(arguments)...), run(its_run) {}
  ProgramRun& run;
};

// What the leaves of a program share in a run, seen by LeafSet as the run context of the plugin.
class ProgramRun {
 public:
  ProgramRun(ProgramPlugin& plugin, const lockstep_caller& caller)
      : plugin_(plugin), caller_(caller) {
    if (caller.time->workers == nullptr) listener_.emplace();
  }
  ~ProgramRun() {
    begin_end();
    const auto until = end_of_patience();
    bool is_in_time = true;
    for (const auto& conversation : conversations_) is_in_time &= conversation->await_end(until);
    for (const auto& conversation : conversations_) conversation->hurry_end();
    EndBudget* const budget = caller_.time->end_budget;
    if (!is_in_time && budget != nullptr) {
      budget->used_up_by(fmt::format("the program '{}'", caller_.who));
    }
    for (const auto& conversation : conversations_) {
      const std::string what = conversation->end();
      if (!what.empty())
        host_table().log(&caller_, LOCKSTEP_LOG_WARNING, ("its program " + what).c_str());
    }
  }
  ProgramRun(const ProgramRun&) = delete;
  ProgramRun& operator=(const ProgramRun&) = delete;

  // Null after a failure, which is the caller's error.
  std::unique_ptr<RunLeaf> create(const lockstep_caller& caller) {
    const Hold hold = plugin_.hello().hold_of(caller.id);
    Conversation* const conversation =
        hold == Hold::Signal ? begin_another(caller) : shared(caller);
    if (conversation == nullptr) return nullptr;
    auto leaf = std::make_unique<RunLeaf>(*this, caller, *conversation, hold,
                                          listener_ ? &*listener_ : nullptr);
    if (!leaf->create()) return nullptr;
    ++leaves_;
    return leaf;
  }

  // The programs of other plugins end at the same time, since all leaves go before any of these.
  void leaf_is_gone() {
    if (--leaves_ == 0) begin_end();
  }

 private:
  void begin_end() {
    if (std::exchange(is_ending_, true)) return;
    listener_.reset();
    for (const auto& conversation : conversations_) conversation->begin_end();
  }

  // Nothing: there is no end of it.
  std::optional<Nanoseconds> end_of_patience() const {
    if (conversations_.empty()) return std::nullopt;
    const EndBudget* const budget = caller_.time->end_budget;
    const auto patience =
        budget == nullptr ? conversations_[0]->options().halt_limit : budget->rest();
    return patience ? std::optional(monotonic_now() + *patience) : std::nullopt;
  }

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
  std::size_t leaves_ = 0;
  bool is_ending_ = false;
  std::optional<Listener> listener_;
};

void* create_run(const lockstep_host* /*host*/, const lockstep_caller* caller) {
  return new ProgramRun(*static_cast<const HostedPlugin*>(caller->plugin)->program, *caller);
}

void destroy_run(void* context) {
  delete static_cast<ProgramRun*>(context);
}

void* create(const lockstep_host* /*host*/, const lockstep_caller* caller, void* run_context) {
  ProgramLeaf* const leaf = static_cast<ProgramRun*>(run_context)->create(*caller).release();
  return leaf;
}

void destroy(void* leaf) {
  auto* const it = static_cast<RunLeaf*>(static_cast<ProgramLeaf*>(leaf));
  ProgramRun& run = it->run;
  delete it;
  run.leaf_is_gone();
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
