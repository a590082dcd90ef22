// A tree of one control node and many leaves of the bench plugin. Used by the benchmarks.
#pragma once

#include <fmt/format.h>

#include <string>

#include "support/compiled.h"

namespace lockstep::host {

// A compiled tree of the built-in nodes and the leaves of bench_leaves.
class BenchTree {
 public:
  // `node` is the root node, as XML.
  explicit BenchTree(const std::string& node) {
    const std::string text =
        fmt::format("<root lockstep=\"1\"><BehaviorTree ID=\"B\">{}</BehaviorTree></root>", node);
    Diagnostics diagnostics;
    plugins_.load_file(LOCKSTEP_BENCH_LEAVES, diagnostics);
    plugins_.load_file(LOCKSTEP_BENCH_SDK, diagnostics);
#ifdef LOCKSTEP_BENCH_BTCPP
    plugins_.load_file(LOCKSTEP_BENCH_BTCPP, diagnostics);
#endif
    tree_ = test::compiled(text, plugins_);
  }
  // One control node with so many leaves.
  BenchTree(const std::string& control, const std::string& attributes, const std::string& leaf,
            std::int64_t leaves)
      : BenchTree(fmt::format("<{} {}>{}</{}>", control, attributes,
                              repeated(fmt::format("<{}/>", leaf), leaves), control)) {}

  const Tree& tree() const {
    return tree_;
  }

  static std::string repeated(const std::string& text, std::int64_t times) {
    std::string all;
    for (std::int64_t i = 0; i < times; ++i) all += text;
    return all;
  }

 private:
  PluginSet plugins_;
  Tree tree_;
};

}  // namespace lockstep::host
