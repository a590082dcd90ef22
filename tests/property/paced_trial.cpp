#include <fmt/format.h>

#include <array>
#include <functional>
#include <string>

#include "property/random_source.h"
#include "property/random_tree.h"

namespace lockstep::host::test {
namespace {

// The same for equal nodes: the trees of two SubTrees may be one.
void add_pace(Plan& plan, std::uint64_t seed) {
  RandomSource random(seed + std::hash<std::string>()(plan.name + tree_text(plan)));
  const bool compares =
      plan.kind == "ParallelAbsolute" || plan.kind == "ParallelRelative" || plan.kind == "barrier";
  if (compares && !random.one_in(3)) {
    plan.pace = true;
    plan.reaction = random.pick(std::array{0.0, 0.1, 0.5, 1.0, 2.0});
  }
  // Most leaves obey, some not below a least pace, and the others go on.
  if (plan.script.starts_with('+') && !random.one_in(4)) {
    const auto end = plan.script.find_first_of("/!^~");
    plan.script.insert(end == std::string::npos ? plan.script.size() : end,
                       fmt::format("*{}", random.pick(std::array{0.0, 0.0, 0.0, 0.2, 0.6})));
  }
  for (Plan& child : plan.children) add_pace(child, seed);
  for (Plan& group : plan.beside) add_pace(group, seed);
}

}  // namespace

Trial paced(Trial trial, std::uint64_t seed) {
  add_pace(trial.plan, seed);
  return trial;
}

}  // namespace lockstep::host::test
