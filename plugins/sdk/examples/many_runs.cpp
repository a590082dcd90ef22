// Runs one tree a thousand times on the virtual clock, on all processors, and prints how often it
// succeeded. The tree is loaded once; each thread has a run and restarts it.
//   many_runs tree.xml [plugin directory]
#include <algorithm>
#include <atomic>
#include <cstdio>
#include <lockstep/runtime.hpp>
#include <thread>
#include <vector>

namespace runtime = lockstep::runtime;

namespace {

constexpr int kRuns = 1000;

int run(int count, char** arguments) {
  if (count < 2) {
    std::fprintf(stderr, "usage: many_runs tree.xml [plugin directory]\n");
    return 2;
  }
  runtime::Project project;
  if (count > 2) project.add_plugin_path(arguments[2]);
  project.load_file(arguments[1]);

  std::atomic<int> next{0}, succeeded{0};
  std::atomic<bool> broken{false};
  const auto work = [&] {
    try {
      runtime::Run tree(project);
      for (int seed = next++; seed < kRuns; seed = next++) {
        tree.restart(static_cast<std::uint64_t>(seed));
        const auto result = tree.loop({true, 0, 60});
        if (result.status == lockstep::Status::Success) ++succeeded;
      }
    } catch (const std::exception& error) {
      std::fprintf(stderr, "many_runs: %s\n", error.what());
      broken = true;
    }
  };
  std::vector<std::thread> threads;
  for (unsigned i = 0; i < std::max(1u, std::thread::hardware_concurrency()); ++i) {
    threads.emplace_back(work);
  }
  for (std::thread& thread : threads) thread.join();
  std::printf("%d of %d runs succeeded\n", succeeded.load(), kRuns);
  return broken ? 1 : 0;
}

}  // namespace

int main(int count, char** arguments) {
  try {
    return run(count, arguments);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "many_runs: %s\n", error.what());
    return 2;
  }
}
