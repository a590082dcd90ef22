#include "leaves/remote/json_lines/listener.h"

#include <poll.h>
#include <sys/eventfd.h>

#include <algorithm>
#include <ctime>

#include "base/system/own_thread.h"

namespace lockstep::host {
namespace {

// Answers that come within this time are written, and read, at once. A tick asks many leaves, and
// each thread that is woken for one of them may take the processor from the tick.
constexpr timespec kGather{.tv_sec = 0, .tv_nsec = 100'000};

std::optional<Nanoseconds> first_deadline(const std::vector<Conversation*>& conversations) {
  std::optional<Nanoseconds> first;
  for (Conversation* conversation : conversations) {
    const auto deadline = conversation->deadline();
    if (deadline && (!first || *deadline < *first)) first = deadline;
  }
  return first;
}

void await(std::vector<pollfd>& descriptors, std::optional<Nanoseconds> deadline) {
  timespec left{};
  if (deadline) {
    const Nanoseconds rest = std::max(*deadline - monotonic_now(), Nanoseconds(0));
    left = {rest.count() / 1'000'000'000, rest.count() % 1'000'000'000};
  }
  ppoll(descriptors.data(), descriptors.size(), deadline ? &left : nullptr, nullptr);
}

}  // namespace

Listener::Listener()
    : bell_(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)), thread_(own_thread([this] { listen(); })) {}

Listener::~Listener() {
  is_over_.store(true);
  wake();
  thread_.join();
  for (Conversation* conversation : conversations()) {
    conversation->flush();
    conversation->set_listened(false);
  }
}

void Listener::add(Conversation& conversation) {
  conversation.set_listened(true);
  {
    const Lock lock(mutex_);
    conversations_.push_back(&conversation);
  }
  wake();
}

std::vector<Conversation*> Listener::conversations() {
  const Lock lock(mutex_);
  return conversations_;
}

void Listener::wake() {
  if (!is_woken_.exchange(true)) eventfd_write(bell_.number(), 1);
}

void Listener::listen() {
  std::vector<pollfd> descriptors;
  while (true) {
    // First: who has something new before this does not ring, and who has it later does.
    is_woken_.store(false);
    if (is_over_.load()) return;
    std::vector<Conversation*> known = conversations();
    std::erase_if(known, [](Conversation* it) {
      if (it->is_gone()) it->bury();
      return it->is_gone();
    });
    descriptors.assign(1, {bell_.number(), POLLIN, 0});
    for (Conversation* it : known) {
      it->flush();
      descriptors.push_back({it->output(), POLLIN, 0});
      descriptors.push_back({it->process().end(), POLLIN, 0});
    }
    await(descriptors, first_deadline(known));
    if (!is_over_.load() && !hurries_.load()) nanosleep(&kGather, nullptr);
    eventfd_t rings = 0;
    eventfd_read(bell_.number(), &rings);
    for (std::size_t i = 0; i < known.size(); ++i) {
      const bool speaks =
          descriptors[2 * i + 1].revents != 0 || descriptors[2 * i + 2].revents != 0;
      if (speaks || known[i]->is_overdue()) known[i]->listen();
      known[i]->check_deadline();
    }
  }
}

}  // namespace lockstep::host
