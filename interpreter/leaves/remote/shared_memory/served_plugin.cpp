#include "leaves/remote/shared_memory/served_plugin.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <thread>

#include "base/core/plugin_exception.h"
#include "base/system/own_thread.h"
#include "leaves/plugin/contract/initialize.h"
#include "leaves/plugin/open/shared_object.h"
#include "leaves/remote/shared_memory/channel.h"
#include "leaves/remote/shared_memory/descriptor_message.h"
#include "leaves/remote/shared_memory/leafhost_descriptors.h"
#include "leaves/remote/shared_memory/served_run.h"

namespace lockstep::host {
namespace {

// A number that the plugin will not reuse for a file after it has closed all unknown descriptors.
int moved_up(int descriptor) {
  const int high = fcntl(descriptor, F_DUPFD_CLOEXEC, 500);
  if (high >= 0) {
    close(descriptor);
    return high;
  }
  fcntl(descriptor, F_SETFD, FD_CLOEXEC);
  return descriptor;
}

// Nothing here outlives the host. The group that we were given is killed, which is not that of the
// host, whatever group the plugin has put us into.
[[noreturn]] void follow_host_into_death(int descriptor, pid_t host) {
  pollfd end{descriptor, POLLIN, 0};
  poll(&end, 1, -1);
  while (getppid() == host) usleep(100'000);  // the plugin has closed the descriptor
  kill(-getpid(), SIGKILL);
  kill(getpid(), SIGKILL);
  _exit(1);
}

// By a thread that takes no signal away from the plugin's. If we are stopped when the host dies, we
// go on, to our end.
void watch_host(int descriptor) {
  const pid_t host = getppid();
  pollfd end{descriptor, POLLIN, 0};
  if (poll(&end, 1, 0) != 0) _exit(1);  // it has died before, and our parent is another one
  prctl(PR_SET_PDEATHSIG, SIGCONT);
  own_thread([=] { follow_host_into_death(descriptor, host); }).detach();
}

std::optional<Problem> load(const std::string& path, Descriptors& descriptors) {
  const MarkedCall mark(CallSite::of_plugin(path), PluginFunction::Load);
  const auto constant = open_shared_object(path).and_then(
      [](const SharedObject& object) { return find_constant(object, LOCKSTEP_PLUGIN_ENTRY); });
  if (!constant) return constant.error();
  return read_descriptors(*static_cast<const lockstep_plugin*>(constant->address), constant->size,
                          descriptors);
}

class Server {
 public:
  Server(std::string path, Channel& channel, int bell)
      : path_(std::move(path)), channel_(channel), log_(channel, bell) {}

  // One call. False: it was the last one.
  bool serve() {
    const std::atomic<bool> never{false};
    channel_.wait(std::nullopt, never);
    const auto bytes = channel_.received();
    MessageReader request(bytes ? *bytes : std::span<const std::byte>{});
    const auto function = request.get<PluginFunction>();
    answer_.clear();
    handle(function, request);
    channel_.send(answer_.bytes());
    return function != PluginFunction::Deinit;
  }

 private:
  void handle(PluginFunction function, MessageReader& request) {
    switch (function) {
      case PluginFunction::Load:
        answer_load();
        break;
      case PluginFunction::Init:
        answer_init();
        break;
      case PluginFunction::FromText:
        if (!answer_from_text(request)) answer_.clear();
        break;
      case PluginFunction::Describe:
        if (!answer_describe(request)) answer_.clear();
        break;
      case PluginFunction::Deinit:
        answer_deinit();
        break;
      default:
        // An answer that is none: the host finds it wrong and ends us.
        if (!run_.answer(function, request, answer_)) answer_.clear();
    }
  }

  void answer_load() {
    const auto refusal = load(path_, descriptors_);
    answer_.put_text_or_null(refusal ? refusal->message.c_str() : nullptr);
    if (refusal) {
      answer_.put_text(refusal->hint);
    } else {
      write_descriptors(descriptors_, answer_);
    }
  }

  void answer_init() {
    const std::string failure = initialize_plugin(descriptors_.plugin);
    initialized_ = failure.empty();
    answer_.put_text(failure);
  }

  // No value when the text is none, and why. False: there is no such type, or no text of the
  // host's.
  bool answer_from_text(MessageReader& request) {
    const ObjectType* const type = find_object_type(request.text());
    const std::string_view text = request.text();
    if (type == nullptr || !request.good()) return false;
    const auto packed = type->from_text(text).and_then(
        [](const Object& object) { return pack(object, WithText::Yes); });
    answer_.put_value(packed ? Value(*packed) : Value());
    answer_.put_text(packed ? std::string() : packed.error().message);
    return true;
  }

  // False: there is no such type whose elements are described.
  bool answer_describe(MessageReader& request) {
    const std::string_view id = request.text();
    const std::vector<FixedText> fixed = read_fixed(request);
    const auto found = std::ranges::find(descriptors_.leaves, id,
                                         [](const auto& leaf) { return leaf->node_type.id; });
    if (!request.good() || found == descriptors_.leaves.end()) return false;
    if ((*found)->element_types == nullptr) return false;
    const auto described = (*found)->element_types->type_of(fixed);
    answer_.put_text_or_null(described ? nullptr : described.error().why.message.c_str());
    if (described) {
      write_leaf(*(*described)->leaf, (*described)->parameters, answer_);
    } else {
      answer_.put_text(described.error().why.hint);
      answer_.put_text(described.error().parameter);
    }
    return true;
  }

  const ObjectType* find_object_type(std::string_view name) const {
    for (const auto& leaf : descriptors_.leaves) {
      for (const Parameter& port : leaf->parameters) {
        if (port.object != nullptr && port.object->name() == name) return port.object;
      }
    }
    return nullptr;
  }

  void answer_deinit() {
    answer_.put(std::uint8_t{1});
    const auto deinit = descriptors_.plugin.deinit;
    if (!initialized_ || deinit == nullptr) return;
    const MarkedCall mark(CallSite::of_plugin(descriptors_.plugin.name), PluginFunction::Deinit);
    thrown_by(deinit);  // the work is done; there is no one to report to
  }

  std::string path_;
  Channel& channel_;
  HostLog log_;
  Descriptors descriptors_;
  bool initialized_ = false;
  ServedRun run_{descriptors_, log_};
  MessageWriter answer_;
};

}  // namespace

bool ServedPlugin::has_host() {
  Channel channel;
  return fcntl(LeafhostDescriptors::kBell, F_GETFD) >= 0 &&
         fcntl(LeafhostDescriptors::kParent, F_GETFD) >= 0 && getpgrp() == getpid() &&
         channel.open(LeafhostDescriptors::kMemory, Channel::Side::Leafhost);
}

int ServedPlugin::serve(const std::string& path) {
  // Processes that the plugin starts do not inherit them.
  const int bell = moved_up(LeafhostDescriptors::kBell);
  watch_host(moved_up(LeafhostDescriptors::kParent));
  // Never destroyed: threads of the plugin may log until the process ends.
  static auto& channel = *new Channel;
  if (!channel.open(LeafhostDescriptors::kMemory, Channel::Side::Leafhost)) return 1;
  close(LeafhostDescriptors::kMemory);
  static auto& server = *new Server(path, channel, bell);
  while (server.serve()) {
  }
  return 0;
}

}  // namespace lockstep::host
