// Random trees with barriers: what stands still was warned of, and what was warned of stands still
// if its leaves are as fast as it takes.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <random>
#include <string>
#include <vector>

#include "language/pipeline.h"
#include "run/run.h"
#include "support/trials.h"

namespace lockstep::host::test {
namespace {

constexpr int kMaxTicks = 4000;

// Its leaves have the steps ${s0}, ${s1}, …
class RandomTree {
 public:
  explicit RandomTree(std::uint32_t seed) : random_(seed) {
    const std::string tree = parallel(3);
    std::string declared;
    for (int i = 0; i < kBarriers; ++i)
      declared += fmt::format("<barrier name=\"b{}\" {}/>", i, limits("barriers"));
    for (int i = 0; i < leaves_; ++i)
      declared += fmt::format("<arg name=\"s{}\" default=\"0.01\"/>", i);
    text_ = fmt::format(
        "<root lockstep=\"1\"><plugin name=\"motion\"/>{}<BehaviorTree ID=\"T\">{}</BehaviorTree>"
        "</root>",
        declared, tree);
  }

  const std::string& text() const { return text_; }

  // One speed for each leaf: "arg.s0=0.01 arg.s1=0.002".
  std::string speeds() {
    std::string options;
    for (int i = 0; i < leaves_; ++i) {
      options += fmt::format("arg.s{}={} ", i, one_of({"0.02", "0.01", "0.005", "0.002"}));
    }
    return options;
  }

 private:
  static constexpr int kBarriers = 2;

  unsigned below(unsigned count) { return static_cast<unsigned>(random_() % count); }
  std::string_view one_of(std::vector<std::string_view> words) {
    return words[below(static_cast<unsigned>(words.size()))];
  }

  std::string limits(std::string_view list) {
    if (below(4) == 0 && list == "barriers") return "delta=\"0.2\"";
    return fmt::format("barriers=\"{}\"", one_of({"0.25", "0.5", "0.75", "0.4;0.6"}));
  }

  std::string children(int depth) {
    std::string text;
    for (unsigned i = 2 + below(2); i > 0; --i) text += node(depth - 1);
    return text;
  }
  std::string parallel(int depth) { return "<Parallel>" + children(depth) + "</Parallel>"; }

  std::string node(int depth) {
    if (depth == 0) return fmt::format("<Advance step=\"${{s{}}}\"/>", leaves_++);
    switch (below(6)) {
      case 0:
      case 1:
      case 2:
        return fmt::format("<SyncProgress barrier=\"b{}\">{}</SyncProgress>", below(kBarriers),
                           node(depth - 1));
      case 3:
      case 4:
        return "<Sequence memory=\"true\">" + children(depth) + "</Sequence>";
      default:
        return below(2) == 0 ? parallel(depth)
                             : fmt::format("<ParallelAbsolute {}>{}</ParallelAbsolute>", limits(""),
                                           children(depth));
    }
  }

  std::mt19937 random_;
  int leaves_ = 0;
  std::string text_;
};

bool ends(const Tree& tree) {
  Run run(tree, {});
  for (int tick = 0; tick < kMaxTicks; ++tick) {
    if (run.tick(tick * run.period()) != Status::Running) return true;
  }
  return false;
}

TEST_CASE("held nodes: a random tree is warned of if it stands still, and only then", "[trials]") {
  std::uint64_t warned = 0, silent = 0;
  for (std::uint32_t seed = 0; warned < trials(10) || silent < trials(30); ++seed) {
    RandomTree tree(seed);
    INFO("seed " << seed << "\n" << tree.text());
    Pipeline pipeline(tree.text());
    if (!pipeline.loaded()) continue;
    pipeline.advise();
    const bool is_warned = pipeline.told().find(" may deadlock: ") != std::string::npos;
    ++(is_warned ? warned : silent);
    bool stands = !ends(pipeline.tree());
    for (int tries = is_warned ? 40 : 2; tries > 0 && !stands; --tries) {
      stands = !ends(Pipeline(tree.text(), tree.speeds()).tree());
    }
    CHECK(stands == is_warned);
  }
}

}  // namespace
}  // namespace lockstep::host::test
