// `run --monitor-socket` and `lockstep monitor --attach`: a monitor that is opened while the run
// goes on.
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <optional>

#include "web/client.h"

using namespace lockstep::host::test;

namespace {

namespace fs = std::filesystem;

const std::string kAttachedTo = tree_text("<Advance name=\"arm\" step=\"0\"/>");

class Attachable {
 public:
  explicit Attachable(std::vector<std::string> more = {}) {
    fs::create_directory(directory.path("run"));
    arguments = {
        "run", directory.file("tree.xml", kAttachedTo), "--view", "none", "--monitor-socket",
        socket};
    arguments.insert(arguments.end(), more.begin(), more.end());
    begin();
  }
  void begin() {
    process.emplace(Invocation{.arguments = arguments, .environment = environment()});
    // It has the socket first, and is listed a moment later.
    while (!contains(lockstep({"monitor"}).out, std::to_string(process->id()))) {
    }
  }
  Outcome lockstep(std::vector<std::string> words) const {
    return run({.arguments = std::move(words), .environment = environment()});
  }
  Outcome attach() const { return lockstep({"monitor", "--attach", socket}); }
  std::map<std::string, std::string> environment() const {
    return {{"XDG_RUNTIME_DIR", directory.path("run")}};
  }

  TemporaryDirectory directory;
  const std::string socket = directory.path("robot.sock");
  std::vector<std::string> arguments;
  std::optional<Process> process;
};

unsigned port_of(const std::string& link) {
  const auto colon = link.rfind(':');
  return static_cast<unsigned>(std::stoul(link.substr(colon + 1)));
}

}  // namespace

TEST_CASE("a run without a monitor gets one through its socket, once") {
  Attachable robot;
  struct stat status {};
  REQUIRE(stat(robot.socket.c_str(), &status) == 0);
  CHECK((status.st_mode & 0777) == 0600);
  const std::string before = robot.lockstep({"monitor"}).out;
  CHECK(contains(before, "  none yet: --attach  "));
  const Outcome attached = robot.attach();
  CHECK(attached.code == 0);
  const std::string link = lines(attached.out).at(0);
  CHECK(link.starts_with("http://127.0.0.1:"));
  CHECK(contains(get(port_of(link), "/").body, "\"live\":true"));
  Client client(port_of(link));
  client.send(get_text(port_of(link), "/events"));
  CHECK(client.wait_for("\"tree\":\"Main\""));
  CHECK(robot.attach().out == attached.out);
  const std::string pid = before.substr(0, before.find(' '));
  CHECK(robot.lockstep({"monitor", "--attach", pid}).out == attached.out);
  CHECK(contains(robot.lockstep({"monitor"}).out, link));
  robot.process->signal(SIGTERM);
  const Outcome end = robot.process->finish();
  CHECK(end.code == 143);
  CHECK(contains(end.err, "monitor: " + link + "\n"));
  CHECK(contains(client.finish(), "event: end"));
  CHECK_FALSE(fs::exists(robot.socket));
}

TEST_CASE("who controls the run through a socket needs the token of the link") {
  Attachable robot({"--monitor-control", "--monitor-paused"});
  const std::string link = lines(robot.attach().out).at(0);
  REQUIRE(contains(link, "#token="));
  CHECK(get(port_of(link), "/events").status == 403);
  CHECK(post(port_of(link), "/control", R"({"do":"halt"})").status == 403);
  const std::string token = link.substr(link.rfind('=') + 1);
  CHECK(post(port_of(link), "/control", R"({"do":"halt"})", "X-Lockstep-Token: " + token + "\r\n")
            .status == 204);
  CHECK(robot.process->finish().code == 130);
}

TEST_CASE("a run takes no harm from who asks for a monitor in a wrong way") {
  Attachable robot;
  sockaddr_un address{.sun_family = AF_UNIX, .sun_path = {}};
  robot.socket.copy(address.sun_path, sizeof address.sun_path - 1);
  const auto connected = [&] {
    const int socket = ::socket(AF_UNIX, SOCK_SEQPACKET, 0);
    REQUIRE(connect(socket, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0);
    return socket;
  };
  const int silent = connected(), gone = connected(), large = connected();
  close(gone);
  const std::string packet(100'000, 'x');
  send(large, packet.data(), packet.size(), MSG_NOSIGNAL);
  const Outcome wrong = robot.lockstep({"monitor", "--attach", robot.socket, "--at", "nowhere"});
  CHECK(wrong.code == 2);
  CHECK(contains(wrong.err, "'nowhere' is not an address"));
  CHECK(contains(wrong.err, "as 127.0.0.1:8080"));
  CHECK(robot.attach().code == 0);
  close(silent);
  close(large);
}

TEST_CASE("a socket that a run has left is replaced, nothing else is") {
  Attachable robot;
  const Outcome twice = robot.lockstep(robot.arguments);
  CHECK(twice.code == 2);
  CHECK(contains(twice.err, "--monitor-socket: '" + robot.socket + "' exists"));
  robot.process->signal(SIGKILL);
  robot.process->finish();
  CHECK(fs::exists(robot.socket));
  const Outcome nobody = robot.attach();
  CHECK(nobody.code == 2);
  CHECK(contains(nobody.err, "cannot reach the run at"));
  robot.begin();
  while (robot.attach().code != 0) robot.lockstep({"monitor"});

  std::vector<std::string> words = robot.arguments;
  words.back() = robot.arguments[1];
  CHECK(contains(robot.lockstep(words).err, "tree.xml' exists"));
  words.back() = robot.directory.path(std::string(120, 'x'));
  CHECK(contains(robot.lockstep(words).err, "name too long"));
  words.back() = "";
  CHECK(robot.lockstep(words).code == 2);
  words.back() = robot.directory.path("other.sock");
  words.emplace_back("--monitor");
  CHECK(contains(robot.lockstep(words).err, "is for a run without --monitor"));
}
