#include "plugin/isolated/served_plugin.h"

#include <fcntl.h>
#include <pthread.h>
#include <signal.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <thread>

#include "core/plugin_exception.h"
#include "plugin/initialize.h"
#include "plugin/isolated/channel.h"
#include "plugin/isolated/child_process.h"
#include "plugin/isolated/descriptor_message.h"
#include "plugin/isolated/served_run.h"
#include "plugin/shared_object.h"

namespace lockstep {
namespace {

// The host has died when its end of the lifeline closes: nothing of ours outlives it.
void follow_host_into_death() {
  char byte = 0;
  ssize_t count = 1;
  while (count > 0 || (count < 0 && errno == EINTR)) {
    count = read(ChildProcess::kLifeline, &byte, sizeof byte);
  }
  kill(0, SIGKILL);
  _exit(1);
}

// A thread that takes no signal away from the plugin's.
void watch_host() {
  sigset_t all, before;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  std::thread(follow_host_into_death).detach();
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

std::optional<Refusal> load(const std::string& path, Descriptors& descriptors) {
  const MarkedCall mark(CallSite::of("", path), PluginFunction::Load);
  SharedObject object;
  ExportedConstant constant;
  if (auto refusal = open_shared_object(path, object)) return refusal;
  if (auto refusal = find_constant(object, LOCKSTEP_PLUGIN_ENTRY, constant)) return refusal;
  return read_descriptors(*static_cast<const lockstep_plugin*>(constant.address), constant.size,
                          descriptors);
}

class Server {
 public:
  Server(std::string path, Channel& channel)
      : path_(std::move(path)),
        channel_(channel),
        log_(channel.log_ring(), ChildProcess::kLifeline) {}

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

  void answer_deinit() {
    answer_.put(std::uint8_t{1});
    const auto deinit = descriptors_.plugin.deinit;
    if (!initialized_ || deinit == nullptr) return;
    const MarkedCall mark(CallSite::of("", descriptors_.plugin.name), PluginFunction::Deinit);
    thrown_by(deinit);  // the work is done, nobody is left to tell
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
  return fcntl(ChildProcess::kLifeline, F_GETFD) >= 0 && getpgrp() == getpid() &&
         channel.open(ChildProcess::kMemory, Channel::Side::Leafhost);
}

int ServedPlugin::serve(const std::string& path) {
  // What the plugin starts does not inherit them.
  fcntl(ChildProcess::kMemory, F_SETFD, FD_CLOEXEC);
  fcntl(ChildProcess::kLifeline, F_SETFD, FD_CLOEXEC);
  watch_host();
  // Never destroyed: threads of the plugin may log until the process ends.
  static auto& channel = *new Channel;
  if (!channel.open(ChildProcess::kMemory, Channel::Side::Leafhost)) return 1;
  close(ChildProcess::kMemory);
  static auto& server = *new Server(path, channel);
  while (server.serve()) {
  }
  return 0;
}

}  // namespace lockstep
