// Loading, ns per node: the whole of it and its parts (read, resolve, compile, destroy), beside
// tinyxml2's parse of the same files (the counter "ratio"), each in a process of its own, as a
// program that is started loads: memory is new. Memory: bytes per node of Tree and RunState,
// counted, and what the process grew by.
#include <benchmark/benchmark.h>
#include <fmt/format.h>
#include <malloc.h>
#include <sys/wait.h>
#include <tinyxml2.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>

#include "base/system/freed_memory.h"
#include "engine/compile.h"
#include "engine/run_state.h"
#include "language/document/file.h"
#include "run/loading/plugins.h"
#include "tree/resolve.h"

namespace {

using namespace lockstep::host;
namespace fs = std::filesystem;

// A main file and the files that it includes, in a directory of their own.
class Files {
 public:
  explicit Files(const std::vector<std::string>& texts) {
    std::string name = (fs::temp_directory_path() / "lockstep_load_XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) std::abort();
    directory_ = name;
    for (std::size_t i = 0; i < texts.size(); ++i) {
      paths_.push_back((directory_ / fmt::format("{}.xml", i)).string());
      std::ofstream(paths_.back()) << texts[i];
    }
  }
  Files(const Files&) = delete;
  Files& operator=(const Files&) = delete;
  ~Files() { fs::remove_all(directory_); }

  const std::vector<std::string>& paths() const { return paths_; }

 private:
  fs::path directory_;
  std::vector<std::string> paths_;
};

std::string file_of(const std::string& inside) {
  return fmt::format("<root lockstep=\"1\" main_tree_to_execute=\"Main\">\n{}</root>\n", inside);
}

std::string tree_of(const std::string& id, const std::string& inside) {
  return fmt::format("  <BehaviorTree ID=\"{}\">\n{}  </BehaviorTree>\n", id, inside);
}

std::string leaves(std::int64_t count) {
  std::string text = "    <Sequence>\n";
  for (std::int64_t i = 1; i < count; ++i) text += "      <AlwaysSuccess/>\n";
  return text + "    </Sequence>\n";
}

using Texts = std::vector<std::string> (*)(std::int64_t nodes);

std::vector<std::string> flat(std::int64_t nodes) {
  return {file_of(tree_of("Main", leaves(nodes)))};
}

std::vector<std::string> named(std::int64_t nodes) {
  std::string text = "    <Sequence>\n";
  for (std::int64_t i = 1; i < nodes; ++i) {
    text += fmt::format("      <AlwaysSuccess name=\"leaf{}\"/>\n", i);
  }
  return {file_of(tree_of("Main", text + "    </Sequence>\n"))};
}

// With a name and a parameter each.
std::vector<std::string> parameters(std::int64_t nodes) {
  std::string text = "    <Parallel>\n";
  for (std::int64_t i = 1; i < nodes; ++i) {
    text += fmt::format("      <Wait name=\"leaf{}\" seconds=\"0.5\"/>\n", i);
  }
  return {file_of(tree_of("Main", text + "    </Parallel>\n"))};
}

void append_binary(std::string& text, std::int64_t nodes, std::size_t depth) {
  text.append(depth, ' ');
  if (nodes < 2) {
    text += "<AlwaysSuccess/>\n";
    return;
  }
  const char* tag = depth % 2 == 0 ? "Sequence" : "Fallback";
  text += fmt::format("<{}>\n", tag);
  const std::int64_t left = (nodes - 1) / 2;
  append_binary(text, left, depth + 1);
  if (nodes - 1 - left > 0) append_binary(text, nodes - 1 - left, depth + 1);
  text.append(depth, ' ');
  text += fmt::format("</{}>\n", tag);
}

std::vector<std::string> nested(std::int64_t nodes) {
  std::string text;
  append_binary(text, nodes, 2);
  return {file_of(tree_of("Main", text))};
}

// 1,000 references to one tree: the file is small, the tree has all the nodes.
std::vector<std::string> subtrees(std::int64_t nodes) {
  std::string text = "    <Sequence>\n";
  for (int i = 0; i < 1000; ++i) text += "      <SubTree ID=\"Part\"/>\n";
  return {file_of(tree_of("Main", text + "    </Sequence>\n") +
                  tree_of("Part", leaves(nodes / 1000 - 1)))};
}

// 1,000 references to a tree of its own each.
std::vector<std::string> many_trees(std::int64_t nodes) {
  std::string text = "    <Sequence>\n", trees;
  for (int i = 0; i < 1000; ++i) {
    text += fmt::format("      <SubTree ID=\"Part{}\"/>\n", i);
    trees += tree_of(fmt::format("Part{}", i), leaves(nodes / 1000 - 1));
  }
  return {file_of(tree_of("Main", text + "    </Sequence>\n") + trees)};
}

std::vector<std::string> includes(std::int64_t nodes) {
  std::vector<std::string> texts(1);
  std::string text = "    <Sequence>\n", head;
  for (int i = 1; i <= 100; ++i) {
    head += fmt::format("  <include path=\"{}.xml\"/>\n", i);
    text += fmt::format("      <SubTree ID=\"Part{}\"/>\n", i);
    texts.push_back(file_of(tree_of(fmt::format("Part{}", i), leaves(nodes / 100 - 1))));
  }
  texts[0] = file_of(head + tree_of("Main", text + "    </Sequence>\n"));
  return texts;
}

// What a run of the benchmark did, in seconds.
struct Times {
  double tinyxml2 = 0, read = 0, resolve = 0, compile = 0, destroy = 0, nodes = 0;
};

// What `measure` measures in a child of this process.
template <class Measure>
Times in_fresh_process(Measure measure) {
  int ends[2];
  if (pipe(ends) != 0) std::abort();
  const pid_t child = fork();
  if (child == 0) {
    keep_freed_memory();
    Times times;
    measure(times);
    _exit(write(ends[1], &times, sizeof times) == sizeof times ? 0 : 1);
  }
  close(ends[1]);
  Times times;
  if (child < 0 || read(ends[0], &times, sizeof times) != sizeof times) std::abort();
  close(ends[0]);
  waitpid(child, nullptr, 0);
  return times;
}

// Of the processor, so that what else the machine does does not count.
class Watch {
 public:
  double lap() {
    const double time = now();
    return time - std::exchange(last_, time);
  }

 private:
  static double now() {
    timespec time{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_nsec) * 1e-9;
  }

  double last_ = now();
};

void parse_alone(const std::vector<std::string>& paths, Times& times) {
  Watch watch;
  std::vector<std::unique_ptr<tinyxml2::XMLDocument>> documents;
  for (const std::string& path : paths) {
    documents.push_back(std::make_unique<tinyxml2::XMLDocument>());
    const auto text = read_file(path, Document::kMaxBytes);
    documents.back()->Parse(text->data(), text->size());
  }
  documents.clear();
  times.tinyxml2 = watch.lap();
}

void load_once(const std::string& path, const Catalog& catalog, Times& times) {
  Watch watch;
  Diagnostics diagnostics;
  auto project = load_project(path, {}, diagnostics);
  times.read = watch.lap();
  auto definition = resolve(*project, catalog, {}, diagnostics);
  times.resolve = watch.lap();
  if (!definition) std::abort();
  const Tree tree = compile(*definition);
  times.compile = watch.lap();
  definition.reset();
  project.reset();
  return_freed_memory();
  times.destroy = watch.lap();
  times.nodes = static_cast<double>(tree.nodes.size());
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

void load(benchmark::State& state, Texts texts) {
  const Files files(texts(state.range(0)));
  const Catalog catalog = make_catalog({});
  std::vector<Times> all;
  for (auto _ : state) {
    const Times alone = in_fresh_process([&](Times& it) { parse_alone(files.paths(), it); });
    Times times =
        in_fresh_process([&](Times& it) { load_once(files.paths().front(), catalog, it); });
    times.tinyxml2 = alone.tinyxml2;
    state.SetIterationTime(times.read + times.resolve + times.compile);
    all.push_back(times);
  }
  const auto counter = [&](const char* name, auto of, double scale) {
    std::vector<double> values;
    for (const Times& times : all) values.push_back(of(times) * scale);
    state.counters[name] = median(std::move(values));
  };
  const double per_node = 1e9 / all.front().nodes;
  counter(
      "tinyxml2", [](const Times& it) { return it.tinyxml2; }, per_node);
  counter(
      "read", [](const Times& it) { return it.read; }, per_node);
  counter(
      "resolve", [](const Times& it) { return it.resolve; }, per_node);
  counter(
      "compile", [](const Times& it) { return it.compile; }, per_node);
  counter(
      "destroy", [](const Times& it) { return it.destroy; }, per_node);
  const auto loaded = [](const Times& it) { return it.read + it.resolve + it.compile; };
  counter(
      "ratio", [&](const Times& it) { return loaded(it) / it.tinyxml2; }, 1);
  counter(
      "ratio_all", [&](const Times& it) { return (loaded(it) + it.destroy) / it.tinyxml2; }, 1);
}

template <class T>
std::size_t bytes_of(const std::vector<T>& vector) {
  return vector.size() * sizeof(T);
}

double resident_bytes() {
  std::ifstream file("/proc/self/statm");
  double total = 0, resident = 0;
  file >> total >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE));
}

void memory(benchmark::State& state, Texts texts) {
  const Files files(texts(state.range(0)));
  const Catalog catalog = make_catalog({});
  malloc_trim(0);
  const double before = resident_bytes();
  Diagnostics diagnostics;
  auto project = load_project(files.paths().front(), {}, diagnostics);
  auto definition = resolve(*project, catalog, {}, diagnostics);
  if (!definition) std::abort();
  const Tree tree = compile(*definition);
  const double loaded = resident_bytes();
  definition.reset();
  project.reset();
  malloc_trim(0);
  const double kept = resident_bytes();
  const RunState run(tree);
  for (auto _ : state) benchmark::DoNotOptimize(run.activity.data());
  const auto per_node = [&](auto bytes) {
    return static_cast<double>(bytes) / static_cast<double>(tree.nodes.size());
  };
  state.counters["nodes"] = per_node(bytes_of(tree.nodes));
  state.counters["parameters"] =
      per_node(bytes_of(tree.cells) + bytes_of(tree.numbers) + bytes_of(tree.leaves) +
               bytes_of(tree.ports) + bytes_of(tree.constants) + bytes_of(tree.slots));
  state.counters["labels"] = per_node(bytes_of(tree.labels) + tree.names->size());
  state.counters["run_state"] =
      per_node(bytes_of(run.activity) + bytes_of(run.last_tick) + bytes_of(run.bytes));
  state.counters["resident_loading"] = per_node(loaded - before);
  state.counters["resident_tree"] = per_node(kept - before);
}

void sizes(benchmark::internal::Benchmark* benchmark) {
  for (const int nodes : {100, 1'000, 10'000, 100'000, 1'000'000}) benchmark->Arg(nodes);
  benchmark->UseManualTime()->Unit(benchmark::kMillisecond);
}

void large(benchmark::internal::Benchmark* benchmark) {
  for (const int nodes : {10'000, 100'000, 1'000'000}) benchmark->Arg(nodes);
  benchmark->UseManualTime()->Unit(benchmark::kMillisecond);
}

BENCHMARK_CAPTURE(load, flat, flat)->Apply(sizes);
BENCHMARK_CAPTURE(load, named, named)->Apply(sizes);
BENCHMARK_CAPTURE(load, parameters, parameters)->Apply(sizes);
BENCHMARK_CAPTURE(load, nested, nested)->Apply(sizes);
BENCHMARK_CAPTURE(load, subtrees, subtrees)->Apply(large);
BENCHMARK_CAPTURE(load, many_trees, many_trees)->Apply(large);
BENCHMARK_CAPTURE(load, includes, includes)->Apply(large);
BENCHMARK_CAPTURE(memory, flat, flat)->Arg(1'000'000)->Iterations(1);
BENCHMARK_CAPTURE(memory, named, named)->Arg(1'000'000)->Iterations(1);
BENCHMARK_CAPTURE(memory, nested, nested)->Arg(1'000'000)->Iterations(1);

}  // namespace
