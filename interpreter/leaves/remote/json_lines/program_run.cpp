#include "leaves/remote/json_lines/program_run.h"

#include <fmt/format.h>

#include <optional>
#include <utility>
#include <vector>

#include "base/core/end_budget.h"
#include "base/core/running_time.h"
#include "leaves/plugin/contract/host.h"
#include "leaves/remote/json_lines/listener.h"
#include "leaves/remote/json_lines/program_leaf.h"

namespace lockstep::host {
namespace {

class ProgramRun final : public RemoteRun {
 public:
  ProgramRun(ProgramPlugin& plugin, const lockstep_caller& caller)
      : plugin_(plugin), caller_(caller) {
    if (caller.time->workers == nullptr) listener_.emplace();
  }
  ~ProgramRun() override {
    begin_end();
    RunningClock clock;
    const auto until = end_of_patience(clock);
    bool is_in_time = true;
    for (const auto& it : conversations_) is_in_time &= it->await_end(clock, until);
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

  std::unique_ptr<RemoteLeaf> create(const lockstep_caller& caller) override {
    const Hold hold = plugin_.hello().hold_of(caller.type->leaf->id);
    Conversation* const conversation =
        hold == Hold::Signal ? begin_another(caller) : shared(caller);
    if (conversation == nullptr) return nullptr;
    auto leaf = std::make_unique<Leaf>(*this, caller, *conversation, hold);
    if (!leaf->create()) {
      leaf->ProgramLeaf::end();
      return nullptr;
    }
    ++leaves_;
    return leaf;
  }

 private:
  class Leaf final : public ProgramLeaf {
   public:
    Leaf(ProgramRun& run, const lockstep_caller& caller, Conversation& conversation, Hold hold)
        : ProgramLeaf(caller, conversation, hold, run.listener_ ? &*run.listener_ : nullptr),
          run_(run) {}
    // The programs of other plugins end at the same time, since all leaves go before any run.
    void end() override {
      ProgramLeaf::end();
      if (--run_.leaves_ == 0) run_.begin_end();
    }

   private:
    ProgramRun& run_;
  };

  void begin_end() {
    if (std::exchange(is_ending_, true)) return;
    listener_.reset();
    for (const auto& conversation : conversations_) conversation->begin_end();
  }

  // Nothing: there is no end of it.
  std::optional<Nanoseconds> end_of_patience(RunningClock& clock) const {
    if (conversations_.empty()) return std::nullopt;
    const EndBudget* const budget = caller_.time->end_budget;
    const auto patience =
        budget == nullptr ? conversations_[0]->options().halt_limit : budget->rest();
    return patience ? std::optional(clock.now() + *patience) : std::nullopt;
  }

  // The conversation of all leaves that may share one.
  Conversation* shared(const lockstep_caller& caller) {
    if (shared_ == nullptr) shared_ = begin_another(caller);
    return shared_;
  }

  Conversation* begin_another(const lockstep_caller& caller) {
    std::string failure;
    auto conversation = plugin_.acquire(failure);
    if (conversation == nullptr) {
      host_table().set_error(&caller, ("its program " + failure).c_str());
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

}  // namespace

std::unique_ptr<RemoteRun> begin_program_run(ProgramPlugin& plugin, const lockstep_caller& caller) {
  return std::make_unique<ProgramRun>(plugin, caller);
}

}  // namespace lockstep::host
