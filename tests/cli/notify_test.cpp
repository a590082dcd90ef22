// The messages of a run to a service manager: sd_notify(3).
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cstring>

#include "support/program.h"

namespace lockstep::host::test {
namespace {

// Its socket has room for some messages.
class Manager {
 public:
  explicit Manager(const TemporaryDirectory& directory) : path_(directory.path("notify")) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::strncpy(address.sun_path, path_.c_str(), sizeof address.sun_path - 1);
    REQUIRE(bind(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0);
  }
  ~Manager() { close(socket_); }
  Manager(const Manager&) = delete;
  Manager& operator=(const Manager&) = delete;

  Invocation start(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), {"run", "--notify"});
    return {.arguments = std::move(arguments),
            .environment = {{"NOTIFY_SOCKET", path_}, {"WATCHDOG_USEC", "200000"}}};
  }
  // No other message has room.
  void fill() const {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::strncpy(address.sun_path, path_.c_str(), sizeof address.sun_path - 1);
    // The room of one sender may be less: systemd gives the receiver 512 messages.
    for (bool has_sent = true; has_sent;) {
      const int sender = socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
      const auto send = [&] {
        return sendto(sender, "full", 4, MSG_DONTWAIT, reinterpret_cast<const sockaddr*>(&address),
                      sizeof address) >= 0;
      };
      has_sent = send();
      while (send()) {
      }
      close(sender);
    }
  }
  // What has been received so far.
  std::vector<std::string> messages() const {
    std::vector<std::string> all;
    char text[4096];
    for (ssize_t size; (size = recv(socket_, text, sizeof text, MSG_DONTWAIT)) >= 0;)
      all.emplace_back(text, static_cast<std::size_t>(size));
    return all;
  }

 private:
  std::string path_;
  int socket_ = socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
};

const std::string kHalfASecond = "<Timeout seconds=\"0.5\"><AlwaysRunning/></Timeout>";

}  // namespace

TEST_CASE("run --notify says that the run has begun, that it goes on, and that it ends") {
  const TemporaryDirectory directory;
  const Manager manager(directory);
  const std::string tree = directory.file("tree.xml", tree_text(kHalfASecond));
  CHECK(run(manager.start({tree})).code == 1);
  const auto messages = manager.messages();
  REQUIRE(messages.size() >= 3);
  CHECK(messages.front() == "READY=1");
  CHECK(messages.back() == "STOPPING=1");
  CHECK(std::ranges::count(messages, "WATCHDOG=1") == static_cast<long>(messages.size()) - 2);
}

TEST_CASE("run --notify does not say that a run goes on whose leaf does not return") {
  const TemporaryDirectory directory;
  const Manager manager(directory);
  const std::string tree = directory.file("tree.xml", tree_text("<Probe/>"));
  Process process(manager.start(
      {tree, "--hang-limit", "0", "--plugin", LOCKSTEP_BINARY_DIR "/tests/cli/stuck.so"}));
  std::string line = "stuck\n", still;
  for (int i = 0; i < 60; ++i) still += line;  // 10 ms each, and a watchdog is fed twice in 200 ms
  REQUIRE(process.wait_for(still));
  CHECK(std::ranges::count(manager.messages(), "WATCHDOG=1") <= 1);
  process.end_by(SIGKILL);
}

TEST_CASE("run --notify does not wait for a service manager that does not read") {
  const TemporaryDirectory directory;
  const Manager manager(directory);
  manager.fill();
  const std::string tree = directory.file("tree.xml", tree_text(kHalfASecond));
  CHECK(run(manager.start({tree})).code == 1);
  const auto messages = manager.messages();
  CHECK(std::ranges::count(messages, "full") == static_cast<long>(messages.size()));
}

TEST_CASE("run --notify says that the run has begun as soon as the service manager reads") {
  const TemporaryDirectory directory;
  const Manager manager(directory);
  manager.fill();
  const std::string tree = directory.file("tree.xml", tree_text("<AlwaysRunning/>"));
  Process process(manager.start({tree, "--view", "none"}));
  std::vector<std::string> messages;
  while (std::ranges::count(messages, "READY=1") == 0 ||
         std::ranges::count(messages, "WATCHDOG=1") == 0) {
    const auto more = manager.messages();
    messages.insert(messages.end(), more.begin(), more.end());
    usleep(1000);
  }
  CHECK(process.end_by(SIGTERM).code == 128 + SIGTERM);
}

TEST_CASE("run --notify without a service manager is a run") {
  const TemporaryDirectory directory;
  const std::string tree = directory.file("tree.xml", tree_text("<AlwaysSuccess/>"));
  const Outcome outcome = run_lockstep({"run", tree, "--notify"});
  CHECK(outcome.code == 0);
  CHECK(outcome.err.find("notify") == std::string::npos);
}

}  // namespace lockstep::host::test
