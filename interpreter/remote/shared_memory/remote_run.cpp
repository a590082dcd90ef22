#include "remote/shared_memory/remote_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>

#include "core/plugin_exception.h"
#include "plugin/contract/carried_time.h"
#include "plugin/contract/descriptor.h"
#include "plugin/contract/host.h"
#include "plugin/contract/process_leaves.h"
#include "remote/shared_memory/answer.h"
#include "remote/shared_memory/isolated_plugin.h"
#include "remote/shared_memory/remote_entries.h"

namespace lockstep {
namespace {

// One run in the other process, seen by LeafSet as the run context of the plugin.
class RemoteRun {
 public:
  RemoteRun(IsolatedPlugin& plugin, std::unique_ptr<Session> session, const lockstep_caller& caller)
      : plugin_(plugin), session_(std::move(session)), caller_(caller) {
    session_->add_listener(0, caller);
  }
  ~RemoteRun() {
    session_->forget_listeners();
    plugin_.release(std::move(session_));
  }
  RemoteRun(const RemoteRun&) = delete;
  RemoteRun& operator=(const RemoteRun&) = delete;

  const IsolatedPlugin& plugin() const { return plugin_; }
  const lockstep_caller& caller() const { return caller_; }
  Session& session() { return *session_; }
  RemoteEntries& entries() { return entries_; }
  std::uint32_t add_leaf() {
    ++leaves_;
    return ++last_number_;
  }
  // What the entries have of other plugins does not outlive the leaves.
  void remove_leaf() {
    if (--leaves_ == 0) entries_.forget();
  }

 private:
  IsolatedPlugin& plugin_;
  std::unique_ptr<Session> session_;
  const lockstep_caller& caller_;
  RemoteEntries entries_;
  std::uint32_t last_number_ = 0;  // of a leaf; 0 is the run itself
  std::uint32_t leaves_ = 0;
};

struct RemoteLeaf final : ProcessLeaf {
  RemoteLeaf(RemoteRun& its_run, const lockstep_caller& its_caller)
      : run(its_run), caller(its_caller), number(its_run.add_leaf()) {
    for (const BoundPort& port : caller.ports) {
      ports.push_back(port.read == nullptr ? RemoteEntries::kNone : run.entries().number_of(port));
      ports.push_back(port.fallback == nullptr
                          ? RemoteEntries::kNone
                          : run.entries().number_of({.type = port.type, .read = port.fallback}));
    }
    run.session().add_listener(number, caller);
    if (caller.time->processes != nullptr) caller.time->processes->add(caller.node, *this);
  }
  ~RemoteLeaf() override {
    if (caller.time->processes != nullptr) caller.time->processes->remove(*this);
    run.remove_leaf();
  }
  RemoteLeaf(const RemoteLeaf&) = delete;
  RemoteLeaf& operator=(const RemoteLeaf&) = delete;

  std::string trouble() override {
    return run.session().is_gone() ? run.session().epitaph() : std::string();
  }

  RemoteRun& run;
  const lockstep_caller& caller;
  std::uint32_t number;
  std::vector<std::uint32_t> ports;  // which entry each is bound to, and its default
};

MessageWriter& begin(RemoteRun& run, PluginFunction function, std::uint32_t number,
                     const lockstep_caller& caller) {
  MessageWriter& request = run.session().begin_request(function);
  request.put(number);
  request.put(caller.time->now);
  request.put(caller.time->period);
  request.put(static_cast<std::uint8_t>(caller.time->workers != nullptr));
  return request;
}

void fail(const lockstep_caller& caller, const std::string& reason) {
  host_table().set_error(&caller, reason.c_str());
}

void fail_too_large(const lockstep_caller& caller) {
  fail(caller, fmt::format("the values of its ports are larger than the {} MiB that an isolated "
                           "plugin can exchange in a call",
                           Channel::kLargest >> 20));
}

// Of a call with much to carry: all of its time that the plugin did not take. What it took is not
// known of the first one, for which it is not blamed.
void note_carried(std::size_t carried, Nanoseconds began, Nanoseconds took) {
  if (carried < kMuchToCarry && took == Nanoseconds(0)) return;
  t_carried += std::max(monotonic_now() - began - took, Nanoseconds(0));
}

// Repeats here what the plugin did there. The result's bits.
std::uint64_t take_answer(RemoteRun& run, const lockstep_caller& caller, Nanoseconds began) {
  MessageReader message = run.session().answer();
  const std::size_t size = message.rest().size();
  Answer answer;
  bool refused = false;
  if (!read_answer(message, answer) || !run.entries().read(message, refused)) {
    run.session().reject_answer();
    fail(caller, run.session().last_words());
    return 0;
  }
  note_carried(size, began, answer.took);
  if (answer.outcome == Outcome::TooLarge) {
    run.entries().forget();
    fail_too_large(caller);
  }
  if (refused) fail(caller, "an entry has a type that does not take what it set");
  if (!answer.error.empty()) take_error(caller, Shortened::as_it_is(answer.error));
  if (answer.outcome == Outcome::Threw) throw PluginException(answer.thrown);
  return answer.result;
}

// Sends what begin() began. The result's bits; 0 when there is none, which the caller's error
// tells.
std::uint64_t finish(RemoteRun& run, const lockstep_caller& caller,
                     std::span<const std::uint32_t> ports) {
  Session& session = run.session();
  const Nanoseconds began = monotonic_now();
  const std::string reason = run.entries().write(ports, session.request());
  if (!reason.empty()) fail(caller, "cannot be sent an object: " + reason);
  if (!session.request_fits()) {
    run.entries().forget();
    fail_too_large(caller);
    return 0;
  }
  if (session.call(caller.who)) return take_answer(run, caller, began);
  fail(caller, session.last_words());
  return 0;
}

std::uint64_t call(void* leaf, PluginFunction function) {
  RemoteLeaf& it = *static_cast<RemoteLeaf*>(leaf);
  begin(it.run, function, it.number, it.caller);
  return finish(it.run, it.caller, it.ports);
}

// The end of a leaf or a run: its error will not be read, so it is logged.
void finish_end(RemoteRun& run, const lockstep_caller& caller,
                std::span<const std::uint32_t> ports) {
  finish(run, caller, ports);
  if (caller.slot->error == nullptr || !run.session().is_gone()) return;
  const std::string text = fmt::format("its destroy did not return: {}", caller.slot->error);
  host_table().log(&caller, LOCKSTEP_LOG_WARNING, text.c_str());
}

void* create_run(const lockstep_host* /*host*/, const lockstep_caller* caller) {
  IsolatedPlugin& plugin = *static_cast<const HostedPlugin*>(caller->plugin)->isolated;
  std::string failure;
  auto session = plugin.acquire(failure);
  if (session == nullptr) {
    fail(*caller, failure);
    return nullptr;
  }
  auto run = std::make_unique<RemoteRun>(plugin, std::move(session), *caller);
  begin(*run, PluginFunction::CreateRun, 0, *caller).put(caller->random);
  // What came there with an error and without a context is not destroyed there either.
  const bool created = finish(*run, *caller, {}) != 0;
  return created ? run.release() : nullptr;
}

void destroy_run(void* context) {
  const std::unique_ptr<RemoteRun> run(static_cast<RemoteRun*>(context));
  if (run->session().is_gone()) return;
  begin(*run, PluginFunction::DestroyRun, 0, run->caller());
  finish_end(*run, run->caller(), {});
}

void write_creation(const RemoteLeaf& leaf, std::uint32_t type, MessageWriter& request) {
  request.put(leaf.caller.random);
  request.put(type);
  request.put_text(leaf.caller.who);
  request.put_text(leaf.caller.name);
  request.put(static_cast<std::uint32_t>(leaf.caller.ports.size()));
  for (std::size_t index = 0; index < leaf.caller.ports.size(); ++index) {
    const BoundPort& port = leaf.caller.ports[index];
    request.put(port.type);
    request.put(static_cast<std::uint8_t>(port.write != nullptr));
    request.put(leaf.ports[2 * index]);
    request.put(leaf.ports[2 * index + 1]);
    request.put_text(port.entry);
  }
}

void* create(const lockstep_host* /*host*/, const lockstep_caller* caller, void* run_context) {
  RemoteRun& run = *static_cast<RemoteRun*>(run_context);
  const auto type = run.plugin().index_of(*caller->slot->type);
  auto leaf = std::make_unique<RemoteLeaf>(run, *caller);
  write_creation(*leaf, type.value(), begin(run, PluginFunction::Create, leaf->number, *caller));
  const bool created = finish(run, *caller, leaf->ports) != 0;
  return created ? leaf.release() : nullptr;
}

void destroy(void* self) {
  const std::unique_ptr<RemoteLeaf> leaf(static_cast<RemoteLeaf*>(self));
  if (leaf->run.session().is_gone()) return;
  begin(leaf->run, PluginFunction::Destroy, leaf->number, leaf->caller);
  finish_end(leaf->run, leaf->caller, leaf->ports);
}

void start(void* leaf) {
  call(leaf, PluginFunction::Start);
}
void start_unreset(void* leaf) {
  call(leaf, PluginFunction::StartUnreset);
}
lockstep_status tick(void* leaf) {
  return static_cast<lockstep_status>(call(leaf, PluginFunction::Tick));
}
// Where there is no process, there is nothing to halt.
void halt(void* leaf) {
  if (!static_cast<RemoteLeaf*>(leaf)->run.session().is_gone()) call(leaf, PluginFunction::Halt);
}
void pause(void* leaf) {
  call(leaf, PluginFunction::Pause);
}
void resume(void* leaf) {
  call(leaf, PluginFunction::Resume);
}
double progress(void* leaf) {
  return std::bit_cast<double>(call(leaf, PluginFunction::Progress));
}

}  // namespace

const lockstep_plugin& remote_plugin() {
  static constexpr lockstep_plugin kPlugin{.abi_major = 0,
                                           .abi_minor = 0,
                                           .struct_size = 0,
                                           .name = nullptr,
                                           .version = nullptr,
                                           .doc = nullptr,
                                           .leaf_type_count = 0,
                                           .leaf_types = nullptr,
                                           .init = nullptr,
                                           .deinit = nullptr,
                                           .create_run = create_run,
                                           .destroy_run = destroy_run,
                                           .get_extension = nullptr,
                                           .describe = nullptr};
  return kPlugin;
}

const lockstep_leaf_type& remote_leaf_type() {
  static constexpr lockstep_leaf_type kType{.struct_size = 0,
                                            .kind = 0,
                                            .id = nullptr,
                                            .doc = nullptr,
                                            .port_count = 0,
                                            .ports = nullptr,
                                            .create = create,
                                            .destroy = destroy,
                                            .start = start,
                                            .tick = tick,
                                            .halt = halt,
                                            .pause = pause,
                                            .resume = resume,
                                            .progress = progress,
                                            .get_extension = nullptr,
                                            .flags = 0,
                                            .min_children = 0,
                                            .max_children = 0,
                                            .start_unreset = start_unreset};
  return kType;
}

}  // namespace lockstep
