// What watching costs beside the run: the processor time of a run of 1,000 nodes at 1 kHz, all of
// which change in each tick, without a monitor, with one, and with some who watch.
#include <arpa/inet.h>
#include <benchmark/benchmark.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

extern char** environ;

namespace {

constexpr int kNodes = 1000, kTicks = 5000;  // 5 s
constexpr int kNoMonitor = -1;

std::string write_tree() {
  const std::string path = std::filesystem::temp_directory_path() / "lockstep_bench_monitor.xml";
  std::ofstream file(path);
  file << "<root lockstep=\"1\"><plugin name=\"motion\"/><BehaviorTree ID=\"B\"><ParallelRelative "
          "delta=\"1\">";
  for (int i = 1; i < kNodes; ++i) file << "<Advance name=\"a" << i << "\" step=\"0.0001\"/>";
  file << "</ParallelRelative></BehaviorTree></root>";
  return path;
}

int free_port() {
  const int socket = ::socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  bind(socket, reinterpret_cast<sockaddr*>(&address), size);
  getsockname(socket, reinterpret_cast<sockaddr*>(&address), &size);
  close(socket);
  return ntohs(address.sin_port);
}

pid_t start(const std::string& tree, int port) {
  std::vector<std::string> words{
      LOCKSTEP_BENCH_PROGRAM, "run",    tree,   "--rate", "1000", "--max-ticks",
      std::to_string(kTicks), "--view", "none", "--json"};
  if (port != 0) words.push_back("--monitor=" + std::to_string(port));
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  for (const int file : {STDOUT_FILENO, STDERR_FILENO}) {
    posix_spawn_file_actions_addopen(&files, file, "/dev/null", O_WRONLY, 0);
  }
  pid_t process = 0;
  if (posix_spawn(&process, arguments[0], &files, nullptr, arguments.data(), environ) != 0) {
    std::abort();
  }
  return process;
}

int watch(int port) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  for (int attempt = 0; attempt < 1000; ++attempt) {
    const int socket = ::socket(AF_INET, SOCK_STREAM, 0);
    if (connect(socket, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0) {
      constexpr std::string_view kRequest = "GET /events HTTP/1.1\r\nHost: localhost\r\n\r\n";
      if (send(socket, kRequest.data(), kRequest.size(), MSG_NOSIGNAL) > 0) return socket;
    }
    close(socket);
    poll(nullptr, 0, 10);
  }
  std::abort();
}

// Reads all until the other side closes. The bytes.
std::size_t read_all(std::vector<pollfd> sockets) {
  std::vector<char> room(1 << 20);
  std::size_t bytes = 0, open = sockets.size();
  while (open > 0) {
    poll(sockets.data(), sockets.size(), -1);
    for (pollfd& it : sockets) {
      if (it.revents == 0) continue;
      const ssize_t count = read(it.fd, room.data(), room.size());
      if (count > 0) {
        bytes += static_cast<std::size_t>(count);
        continue;
      }
      close(it.fd);
      it.fd = -1;
      --open;
    }
  }
  return bytes;
}

double seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_usec) / 1e6;
}

// The argument: how many watch; kNoMonitor: nobody could.
void monitored_run(benchmark::State& state) {
  const std::string tree = write_tree();
  const auto viewers = static_cast<int>(state.range(0));
  const int port = viewers == kNoMonitor ? 0 : free_port();
  rusage used{};
  std::size_t bytes = 0;
  for (auto _ : state) {
    const pid_t process = start(tree, port);
    std::vector<pollfd> sockets;
    for (int i = 0; i < viewers; ++i) sockets.push_back({watch(port), POLLIN, 0});
    bytes = read_all(sockets);
    int status = 0;
    wait4(process, &status, 0, &used);
    if (WEXITSTATUS(status) != 124) std::abort();  // all its ticks
  }
  const double run = kTicks / 1000.0;
  const double cpu = seconds(used.ru_utime) + seconds(used.ru_stime);
  state.counters["core_%"] = 100 * cpu / run;
  state.counters["MB/s"] = static_cast<double>(bytes) / 1e6 / run;
  state.counters["peak_MB"] = static_cast<double>(used.ru_maxrss) / 1024;
  std::filesystem::remove(tree);
}
BENCHMARK(monitored_run)
    ->Arg(kNoMonitor)
    ->Arg(0)
    ->Arg(1)
    ->Arg(10)
    ->Iterations(1)
    ->Unit(benchmark::kSecond)
    ->UseRealTime();

}  // namespace
