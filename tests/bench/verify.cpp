// What a search over all behaviors costs, and what is asked after it: ticks in a second, and bytes
// for each state.
#include <benchmark/benchmark.h>

#include "bench/bench_tree.h"
#include "leaves/leaf_file.h"
#include "verify/verdict.h"

namespace {

using namespace lockstep::host;

constexpr auto kFull = R"(<leaf path="*" finish="full" result="success"/>)";
constexpr auto kLeaf = "<BenchAdvance/>";

std::string absolute(std::int64_t children, std::int64_t barriers) {
  std::string list;
  for (std::int64_t i = 1; i <= barriers; ++i) {
    list += fmt::format("{}{}", i == 1 ? "" : ";",
                        static_cast<double>(i) / static_cast<double>(barriers + 1));
  }
  return fmt::format("<ParallelAbsolute barriers=\"{}\">{}</ParallelAbsolute>", list,
                     BenchTree::repeated(kLeaf, children));
}

// 50 nodes, half of them leaves: two arms, each with three ways to do its work.
std::string mixed() {
  const std::string way =
      "<Sequence memory=\"true\"><Inverter><BenchAdvance/></Inverter><Timeout seconds=\"1\">"
      "<BenchAdvance/></Timeout><ForceSuccess><BenchAdvance/></ForceSuccess><BenchAdvance/></"
      "Sequence>";
  const std::string arm =
      "<Fallback memory=\"true\">" + BenchTree::repeated(way, 3) + "</Fallback>";
  return "<Parallel>" + arm + arm + "</Parallel>";
}

// The Fallback over the conditions that x is one of these.
std::string any_of(int first, int last) {
  if (first == last) return fmt::format("<Check code='x == {}'/>", first);
  const int middle = (first + last) / 2;
  return "<Fallback>" + any_of(first, middle) + any_of(middle + 1, last) + "</Fallback>";
}

// The public case of BehaVerify, written anew: so many levels of Fallbacks and their conditions
// between two groups, and one entry that counts the ticks; 2,055 nodes with 11 levels.
std::string binary(int levels) {
  const int values = 1 << (levels - 1);
  return fmt::format(
      "<Sequence><RunOnce><Script code='x := 0'/></RunOnce>{}"
      "<Fallback><Check code='x == {}'/><Sequence><Script code='x = x + 1'/><AlwaysRunning/>"
      "</Sequence></Fallback></Sequence>",
      any_of(0, values - 1), values - 1);
}

// So many conditions whose results change nothing.
std::string free_conditions(std::int64_t many) {
  return "<Sequence memory=\"true\">" +
         BenchTree::repeated("<ForceSuccess><BenchCondition/></ForceSuccess>", many) +
         "</Sequence>";
}

std::string parallel_of(const char* child, std::int64_t many) {
  return "<Parallel>" + BenchTree::repeated(child, many) + "</Parallel>";
}

// Whether states of equal children count once, or each for itself.
enum class Equal : bool { Each, Once };

void verify(benchmark::State& state, const std::string& text, const std::string& rows,
            Equal equal) {
  const BenchTree bench(text);
  const Tree& tree = bench.tree();
  Diagnostics diagnostics;
  std::vector<NodeProblem> problems;
  const auto file =
      read_leaf_file("l.xml", "<leaves lockstep=\"1\">" + rows + "</leaves>", diagnostics);
  const LeafModels models = make_models(tree, file.get(), diagnostics, problems);
  const auto jobs = static_cast<unsigned>(state.range(0));
  double ticks = 0, states = 1, memory = 0, seconds = 0;
  for (auto _ : state) {
    const SearchResult found =
        search(tree, models, {}, 10,
               {.memory = std::size_t{4} << 30u, .jobs = jobs, .symmetry = equal == Equal::Once});
    const Verdict verdict = make_verdict(tree, models, {}, found, {});
    benchmark::DoNotOptimize(verdict.findings.data());
    ticks += static_cast<double>(found.transitions);
    seconds += to_seconds(found.took);
    states = static_cast<double>(found.store.size());
    memory = static_cast<double>(found.memory());
  }
  state.counters["nodes"] = static_cast<double>(tree.nodes.size());
  state.counters["states"] = states;
  state.counters["bytes/state"] = memory / states;
  state.counters["ticks"] = ticks / static_cast<double>(state.iterations());
  state.counters["ticks/s"] = ticks / seconds;
  state.counters["search_ms"] = seconds * 1000 / static_cast<double>(state.iterations());
}

void add(const char* name, const std::string& tree, const std::string& rows = "",
         Equal equal = Equal::Each) {
  benchmark::RegisterBenchmark(name,
                               [=](benchmark::State& state) { verify(state, tree, rows, equal); })
      ->ArgName("jobs")
      ->Arg(1)
      ->Arg(2)
      ->UseRealTime()
      ->Unit(benchmark::kMillisecond);
}

}  // namespace

int main(int argc, char** argv) {
  add("mixed", mixed());
  add("absolute/4/8", absolute(4, 8), kFull);
  add("absolute/6/4", absolute(6, 4), kFull);
  add("equal/4/8", absolute(4, 8), kFull, Equal::Once);
  add("equal/6/4", absolute(6, 4), kFull, Equal::Once);
  add("equal/6/8", absolute(6, 8), kFull, Equal::Once);
  add("equal/40/1", absolute(40, 1), "", Equal::Once);
  add("retry/12",
      "<Parallel>" +
          BenchTree::repeated("<Retry attempts=\"2\">" + std::string(kLeaf) + "</Retry>", 12) +
          "</Parallel>",
      "", Equal::Once);
  add("sequence/400",
      "<Sequence memory=\"true\">" + BenchTree::repeated(kLeaf, 400) + "</Sequence>");
  for (const int levels : {9, 10, 11})
    add(fmt::format("binary/{}", levels).c_str(), binary(levels));
  add("conditions/20", free_conditions(20));
  add("conditions/40", free_conditions(40));
  add("retries/20", parallel_of("<Retry attempts=\"2\"><BenchAdvance/></Retry>", 20), "",
      Equal::Once);
  for (const int count : {12, 40}) {
    add(fmt::format("sequences/{}", count).c_str(),
        parallel_of("<Sequence memory=\"true\"><BenchAdvance/><BenchAdvance/></Sequence>", count),
        "", Equal::Once);
  }
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
