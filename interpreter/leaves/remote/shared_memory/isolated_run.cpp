#include "leaves/remote/shared_memory/isolated_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>

#include "base/core/plugin_exception.h"
#include "base/system/call_mark.h"
#include "leaves/plugin/contract/host.h"
#include "leaves/remote/shared_memory/answer.h"
#include "leaves/remote/shared_memory/remote_entries.h"

namespace lockstep::host {
namespace {

void fail(const lockstep_caller& caller, const std::string& reason) {
  host_table().set_error(&caller, reason.c_str());
}

void fail_too_large(const lockstep_caller& caller) {
  fail(caller, fmt::format("the values of its ports are larger than the {} MiB that an isolated "
                           "plugin can exchange in a call",
                           Channel::kLargest >> 20));
}

// Notes, for a call with much to carry, all of its time that the plugin did not take. What it took
// is not known of the first one, for which it is not blamed.
void note_carried(std::size_t carried, Nanoseconds began, Nanoseconds took) {
  if (carried < kMuchToCarry && took == Nanoseconds(0)) return;
  CallMark::this_thread().carried += std::max(monotonic_now() - began - took, Nanoseconds(0));
}

class IsolatedRun final : public RemoteRun {
 public:
  IsolatedRun(IsolatedPlugin& plugin, std::unique_ptr<Session> session,
              const lockstep_caller& caller)
      : plugin_(plugin), session_(std::move(session)), caller_(caller) {
    session_->add_listener(0, caller);
  }
  ~IsolatedRun() override {
    session_->forget_listeners();
    plugin_.release(std::move(session_));
  }

  bool begin() {
    begin_call(PluginFunction::CreateRun, 0, caller_).put(caller_.random);
    // A result that came there with an error and without a context is not destroyed there either.
    return call(caller_, {}) != 0;
  }
  std::unique_ptr<RemoteLeaf> create(const lockstep_caller& caller) override;
  void end() override {
    if (session_->is_gone()) return;
    begin_call(PluginFunction::DestroyRun, 0, caller_);
    call_last(caller_, {});
  }

 private:
  class Leaf;

  MessageWriter& begin_call(PluginFunction function, std::uint32_t number,
                            const lockstep_caller& caller);
  // Makes the call that was begun. The result's bits; 0 when there is none, which the caller's
  // error tells.
  std::uint64_t call(const lockstep_caller& caller, std::span<const std::uint32_t> ports);
  std::uint64_t take_answer(const lockstep_caller& caller, Nanoseconds began);
  void call_last(const lockstep_caller& caller, std::span<const std::uint32_t> ports);
  std::string write(const lockstep_caller& caller, std::span<const std::uint32_t> ports);
  bool read(const lockstep_caller& caller, MessageReader& message, std::string& refused);

  IsolatedPlugin& plugin_;
  std::unique_ptr<Session> session_;
  const lockstep_caller& caller_;
  RemoteEntries entries_;
  std::span<char> kept_ = {};      // where a leaf that saves writes
  std::uint32_t last_number_ = 0;  // of a leaf; 0 is the run itself
  std::uint32_t leaves_ = 0;
};

class IsolatedRun::Leaf final : public RemoteLeaf {
 public:
  Leaf(IsolatedRun& run, const lockstep_caller& caller)
      : RemoteLeaf(caller), run_(run), number_(++run.last_number_) {
    RemoteEntries& entries = run.entries_;
    for (const BoundPort* const port : caller.ports) {
      ports_.push_back(port->read == nullptr ? RemoteEntries::kNone : entries.number_of(*port));
      ports_.push_back(port->fallback == nullptr
                           ? RemoteEntries::kNone
                           : entries.number_of({.read = port->fallback, .type = port->type}));
    }
    ++run.leaves_;
    run.session_->add_listener(number_, caller);
  }
  // Values of other plugins in the entries do not outlive the leaves.
  ~Leaf() override {
    if (--run_.leaves_ == 0) run_.entries_.forget();
  }

  bool create();
  void put_fixed(MessageWriter& request) const;
  void start() override { call(PluginFunction::Start); }
  void start_unreset() override { call(PluginFunction::StartUnreset); }
  lockstep_status tick() override {
    return static_cast<lockstep_status>(call(PluginFunction::Tick));
  }
  // Where there is no process, there is nothing to halt.
  void halt() override {
    if (!run_.session_->is_gone()) call(PluginFunction::Halt);
  }
  void pause() override { call(PluginFunction::Pause); }
  void resume() override { call(PluginFunction::Resume); }
  double progress() override { return std::bit_cast<double>(call(PluginFunction::Progress)); }
  double set_pace(double factor) override {
    run_.begin_call(PluginFunction::SetPace, number_, caller_).put(factor);
    return std::bit_cast<double>(run_.call(caller_, ports_));
  }
  std::size_t save(void* bytes, std::size_t room) override {
    if (run_.session_->is_gone()) return 0;
    run_.kept_ = {static_cast<char*>(bytes), room};
    const std::uint64_t size = call(PluginFunction::Save);
    run_.kept_ = {};
    return size;
  }
  lockstep_after_cut restore(const void* bytes, std::size_t size,
                             const lockstep_cut* cut) override {
    MessageWriter& request = run_.begin_call(PluginFunction::Restore, number_, caller_);
    request.put(*cut);
    request.put_text({static_cast<const char*>(bytes), size});
    return static_cast<lockstep_after_cut>(run_.call(caller_, ports_));
  }
  void end() override {
    if (run_.session_->is_gone()) return;
    run_.begin_call(PluginFunction::Destroy, number_, caller_);
    run_.call_last(caller_, ports_);
  }
  std::string trouble() override {
    return run_.session_->is_gone() ? run_.session_->epitaph() : std::string();
  }

 private:
  std::uint64_t call(PluginFunction function) {
    run_.begin_call(function, number_, caller_);
    return run_.call(caller_, ports_);
  }

  IsolatedRun& run_;
  const std::uint32_t number_;
  std::vector<std::uint32_t> ports_;  // which entry each is bound to, and its default
};

// Writes the texts that decide the type of its element.
void IsolatedRun::Leaf::put_fixed(MessageWriter& request) const {
  std::vector<std::string> texts;
  std::vector<FixedText> fixed;
  texts.reserve(caller_.ports.size());
  for (const BoundPort* const port : caller_.ports) {
    if (!port->parameter->constant || port->read == nullptr) continue;
    fixed.push_back({port->parameter->name, texts.emplace_back(to_text(*port->read))});
  }
  write_fixed(fixed, request);
}

bool IsolatedRun::Leaf::create() {
  MessageWriter& request = run_.begin_call(PluginFunction::Create, number_, caller_);
  request.put(caller_.random);
  request.put(run_.plugin_.index_of(*caller_.slot->type).value());
  request.put_text(caller_.who);
  request.put_text(texts_of(caller_).name);
  put_fixed(request);
  request.put(static_cast<std::uint32_t>(caller_.ports.size()));
  for (std::size_t index = 0; index < caller_.ports.size(); ++index) {
    const BoundPort& port = *caller_.ports[index];
    request.put(port.type);
    request.put(static_cast<std::uint8_t>(port.write == nullptr ? RemoteEntries::Sets::No
                                          : port.write->typing == Typing::Strict
                                              ? RemoteEntries::Sets::Strictly
                                              : RemoteEntries::Sets::Loosely));
    request.put(ports_[2 * index]);
    request.put(ports_[2 * index + 1]);
    request.put_text(port.entry);
  }
  return run_.call(caller_, ports_) != 0;
}

std::unique_ptr<RemoteLeaf> IsolatedRun::create(const lockstep_caller& caller) {
  auto leaf = std::make_unique<Leaf>(*this, caller);
  return leaf->create() ? std::move(leaf) : nullptr;
}

MessageWriter& IsolatedRun::begin_call(PluginFunction function, std::uint32_t number,
                                       const lockstep_caller& caller) {
  MessageWriter& request = session_->begin_request(function);
  request.put(number);
  request.put(caller.time->now);
  request.put(caller.time->period);
  request.put(caller.time->workers != nullptr ? caller.time->turns : std::uint32_t{0});
  return request;
}

std::uint64_t IsolatedRun::call(const lockstep_caller& caller,
                                std::span<const std::uint32_t> ports) {
  const Nanoseconds began = monotonic_now();
  const std::string reason = write(caller, ports);
  if (!reason.empty()) fail(caller, "cannot be sent an object: " + reason);
  if (!session_->request_fits()) {
    entries_.forget();
    fail_too_large(caller);
    return 0;
  }
  if (session_->call(caller.who)) return take_answer(caller, began);
  fail(caller, session_->last_words());
  return 0;
}

std::string IsolatedRun::write(const lockstep_caller& caller,
                               std::span<const std::uint32_t> ports) {
  const InEngine scope(caller.run->lock);
  return entries_.write(ports, session_->request());
}

bool IsolatedRun::read(const lockstep_caller& caller, MessageReader& message,
                       std::string& refused) {
  const InEngine scope(caller.run->lock);
  return entries_.read(message, refused);
}

// Repeats here what the plugin did there.
std::uint64_t IsolatedRun::take_answer(const lockstep_caller& caller, Nanoseconds began) {
  MessageReader message = session_->answer();
  const std::size_t size = message.rest().size();
  Answer answer;
  std::string refused;
  if (!read_answer(message, answer) || !read(caller, message, refused)) {
    session_->reject_answer();
    fail(caller, session_->last_words());
    return 0;
  }
  note_carried(size, began, answer.took);
  if (answer.outcome == Outcome::TooLarge) {
    entries_.forget();
    fail_too_large(caller);
  }
  if (!refused.empty()) fail(caller, refused);
  if (!answer.error.empty()) take_error(caller, Shortened::as_it_is(answer.error));
  std::ranges::copy(answer.kept.substr(0, kept_.size()), kept_.begin());
  if (!answer.reason.empty()) take_reason(caller, Shortened::as_it_is(answer.reason));
  if (answer.outcome == Outcome::Threw) throw PluginException(answer.thrown);
  return answer.result;
}

// The end of a leaf or a run: its error will not be read, so it is logged.
void IsolatedRun::call_last(const lockstep_caller& caller, std::span<const std::uint32_t> ports) {
  call(caller, ports);
  if (caller.slot->error == nullptr || !session_->is_gone()) return;
  const std::string text = fmt::format("its destroy did not return: {}", caller.slot->error);
  host_table().log(&caller, LOCKSTEP_LOG_WARNING, text.c_str());
}

}  // namespace

std::unique_ptr<RemoteRun> begin_isolated_run(IsolatedPlugin& plugin,
                                              std::unique_ptr<Session> session,
                                              const lockstep_caller& caller) {
  auto run = std::make_unique<IsolatedRun>(plugin, std::move(session), caller);
  return run->begin() ? std::move(run) : nullptr;
}

}  // namespace lockstep::host
