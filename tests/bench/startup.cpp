// From the start of a process to its end: `lockstep run` of a tree of ten nodes that completes in
// its first tick, beside /bin/true.
#include <benchmark/benchmark.h>
#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

extern char** environ;

namespace {

// A file that is gone when the program ends.
class TreeFile {
 public:
  TreeFile() : path_(std::filesystem::temp_directory_path() / "lockstep_bench_startup.xml") {
    std::ofstream file(path_);
    file << "<root lockstep=\"1\"><BehaviorTree ID=\"Ten\"><Sequence>";
    for (int i = 0; i < 9; ++i) file << "<AlwaysSuccess/>";
    file << "</Sequence></BehaviorTree></root>";
  }
  ~TreeFile() { std::filesystem::remove(path_); }
  TreeFile(const TreeFile&) = delete;
  TreeFile& operator=(const TreeFile&) = delete;
  std::string path() const { return path_.string(); }

 private:
  std::filesystem::path path_;
};

void run_process(benchmark::State& state, std::vector<std::string> arguments) {
  std::vector<char*> pointers;
  for (std::string& argument : arguments) pointers.push_back(argument.data());
  pointers.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  for (const int file : {STDOUT_FILENO, STDERR_FILENO}) {
    posix_spawn_file_actions_addopen(&actions, file, "/dev/null", O_WRONLY, 0);
  }
  for (auto _ : state) {
    pid_t child = 0;
    int status = 1;
    if (posix_spawn(&child, pointers[0], &actions, nullptr, pointers.data(), environ) == 0) {
      waitpid(child, &status, 0);
    }
    if (status != 0) state.SkipWithError("the program failed");
  }
  posix_spawn_file_actions_destroy(&actions);
}

void bin_true(benchmark::State& state) {
  run_process(state, {"/bin/true"});
}
void lockstep_run(benchmark::State& state) {
  const TreeFile tree;
  run_process(state, {LOCKSTEP_BENCH_PROGRAM, "run", tree.path()});
}
void lockstep_run_virtual(benchmark::State& state) {
  const TreeFile tree;
  run_process(state, {LOCKSTEP_BENCH_PROGRAM, "run", tree.path(), "--clock", "virtual"});
}
BENCHMARK(bin_true)->Unit(benchmark::kMicrosecond)->UseRealTime();
BENCHMARK(lockstep_run)->Unit(benchmark::kMicrosecond)->UseRealTime();
BENCHMARK(lockstep_run_virtual)->Unit(benchmark::kMicrosecond)->UseRealTime();

}  // namespace
