// Leaf types whose ports depend on their element, in this process and isolated.
#include <catch2/catch.hpp>

#include "abi/support/isolated_leaves.h"
#include "loading/load.h"

namespace lockstep::host::test {
namespace {

constexpr Isolation kBoth[] = {Isolation::InProcess, Isolation::Isolated};

struct Shapes {
  Shapes(const std::string& nodes, Isolation isolation) {
    LoadOptions options;
    options.plugins.directories = {LOCKSTEP_ABI_PLUGINS};
    options.plugins.program_directory = LOCKSTEP_BINARY_DIR;
    options.plugins.isolate = isolation == Isolation::Isolated;
    const std::string text =
        "<root lockstep=\"1\"><plugin name=\"shapes\"/><BehaviorTree ID=\"T\">"
        "<Sequence memory=\"true\">\n" +
        nodes + "</Sequence></BehaviorTree></root>";
    auto loaded = load_text("tree.xml", text, options, diagnostics);
    if (loaded) runnable = make_runnable(std::move(*loaded));
  }

  Strings errors() const {
    Strings all;
    for (const Diagnostic& it : diagnostics.all()) {
      if (it.severity != Severity::Error) continue;
      all.push_back(
          fmt::format("{}:{}: {} | {}", it.location.line, it.location.column, it.message, it.hint));
    }
    return all;
  }

  // The fault, or the entries as "name=text".
  std::string run() {
    if (!runnable) return errors().at(0);
    Run run(runnable->tree, RunOptions{});
    run.tick(Nanoseconds(0));
    if (run.fault() != nullptr) return run.fault()->message;
    std::string text;
    for (std::size_t slot = 0; slot < runnable->tree.slots.size(); ++slot) {
      text += (text.empty() ? "" : " ") + runnable->tree.slots[slot].name + "=" +
              to_text(run.blackboard().entries[slot].value);
    }
    return text;
  }

  Diagnostics diagnostics;
  std::optional<Runnable> runnable;
};

TEST_CASE("an element has the ports that its constants decide, and its leaf knows which") {
  for (const Isolation isolation : kBoth) {
    CHECK(Shapes(R"(<Shape kind="round" size.radius="2" out.area="{a}" out.text="{t}"/>
                    <Shape kind="square" size.side="{a}" out.area="{b}"/>)",
                 isolation)
              .run() == "a=12 t=round of 2 b=144");
  }
}

TEST_CASE("what an element gives to a port that it does not have is an error at its place") {
  for (const Isolation isolation : kBoth) {
    CHECK(Shapes(R"(<Shape kind="round" size.side="2"/>)", isolation).errors() ==
          Strings{"2:21: 'Shape' has no parameter 'size.side' | parameters of 'Shape': 'kind', "
                  "'out.area', 'out.text', 'size.radius'",
                  "2:1: 'Shape' needs the parameter 'size.radius' | parameters of 'Shape': 'kind', "
                  "'out.area', 'out.text', 'size.radius'"});
    CHECK(Shapes(R"(<Shape kind="round" size.radios="2"/>)", isolation).errors() ==
          Strings{"2:21: 'Shape' has no parameter 'size.radios' | did you mean 'size.radius'?; "
                  "parameters of 'Shape': 'kind', 'out.area', 'out.text', 'size.radius'"});
    CHECK(Shapes(R"(<Shape kind="round" size.radius="200"/>)", isolation).errors() ==
          Strings{"2:34: 200 is outside the range of 'size.radius' | it must be from 0 to 100"});
  }
}

TEST_CASE("an element that its plugin refuses is an error at the text to blame") {
  for (const Isolation isolation : kBoth) {
    CHECK(Shapes(R"(<Shape kind="oval" size.radius="2"/>)", isolation).errors() ==
          Strings{"2:14: there is no such shape | use round or square"});
    CHECK(Shapes(R"(<Shape kind="nameless"/>)", isolation).errors() ==
          Strings{"2:1: 'Shape' cannot be described, and gives no reason | ask the author of the "
                  "plugin what it needs"});
  }
}

TEST_CASE("without what decides its ports, an element lacks only that") {
  for (const Isolation isolation : kBoth) {
    CHECK(Shapes(R"(<Shape size.radius="2"/>)", isolation).errors() ==
          Strings{"2:1: 'Shape' needs the parameter 'kind' | parameters of 'Shape': 'kind'"});
    CHECK(
        Shapes(R"(<Shape kind="{k}" size.radius="2"/>)", isolation).errors() ==
        Strings{"2:14: 'kind' of 'Shape' cannot be a blackboard entry | it is fixed when the tree "
                "is loaded: write a value, or ${name} with an <arg>"});
  }
}

TEST_CASE("the elements of trees for BehaviorTree.CPP have them, too") {
  const auto errors = [](const std::string& leaf) {
    LoadOptions options;
    options.plugins.directories = {LOCKSTEP_ABI_PLUGINS};
    options.plugins.plugins = {"shapes"};
    Diagnostics diagnostics;
    const bool is_loaded = load_text("tree.xml",
                                     "<root BTCPP_format=\"4\"><BehaviorTree ID=\"T\">" + leaf +
                                         "</BehaviorTree></root>",
                                     options, diagnostics)
                               .has_value();
    Strings all = texts(diagnostics);
    if (is_loaded) all.emplace_back("loaded");
    return all;
  };
  CHECK(errors(R"(<Shape kind="round" size.radius="2" out.area="{a}"/>)") == Strings{"loaded"});
  CHECK(errors(R"(<Shape kind="square" size.side="2" size.sidd="3"/>)") ==
        Strings{"'Shape' has no port 'size.sidd' | did you mean 'size.side'?"});
  CHECK(errors(R"(<Shape kind="oval"/>)") ==
        Strings{"there is no such shape | use round or square"});
}

TEST_CASE("elements with the same constants have one type") {
  const Shapes shapes(R"(<Shape kind="round" size.radius="1"/><Shape kind="round" size.radius="2"/>
                         <Shape kind="square" size.side="1"/>)",
                      Isolation::InProcess);
  REQUIRE(shapes.runnable);
  const auto& leaves = shapes.runnable->tree.leaves;
  REQUIRE(leaves.size() == 3);
  CHECK(leaves[0].type == leaves[1].type);
  CHECK(leaves[0].type != leaves[2].type);
}

}  // namespace
}  // namespace lockstep::host::test
