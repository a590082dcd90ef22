// Leaf types whose ports depend on their element: in C, over leaf.hpp, in this process and
// isolated, and as programs.
#include <catch2/catch.hpp>

#include "abi/support/isolated_leaves.h"
#include "run/loading/load.h"

namespace lockstep::host::test {
namespace {

struct Link {
  const char* plugin;
  const char* program = "";
  bool isolate = false;
};
constexpr Link kInC{"shapes"};
constexpr Link kLinks[] = {kInC,
                           {.plugin = "shapes", .isolate = true},
                           {"shapes_sdk"},
                           {.plugin = "shapes_sdk", .isolate = true},
                           {"shapes", "shapes.py"},
                           {"shapes", "shapes_class.py"}};

struct Shapes {
  Shapes(const std::string& nodes, const Link& link, bool run_programs = true) {
    LoadOptions options;
    options.plugins.directories = {LOCKSTEP_ABI_PLUGINS, LOCKSTEP_SOURCE_DIR "/tests/programs"};
    options.plugins.program_directory = LOCKSTEP_BINARY_DIR;
    options.plugins.isolate = link.isolate;
    options.plugins.run_programs = run_programs;
    const std::string program =
        *link.program == '\0' ? "" : fmt::format(" program=\"{}\"", link.program);
    const std::string text =
        fmt::format("<root lockstep=\"1\"><plugin name=\"{}\"{}/>", link.plugin, program) +
        "<BehaviorTree ID=\"T\">"
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
    Run run(runnable->tree, {.virtual_time = true});
    run.tick(Nanoseconds(0));
    if (run.fault() != nullptr) return run.fault()->message;
    std::string text;
    for (std::size_t slot = 0; slot < runnable->tree.slots.size(); ++slot) {
      text += (text.empty() ? "" : " ") + runnable->tree.slots[slot].name + "=" +
              to_text(run.blackboard().entries[slot].value());
    }
    return text;
  }

  Diagnostics diagnostics;
  std::optional<Runnable> runnable;
};

TEST_CASE("an element has the ports that its constants decide, and its leaf knows which") {
  for (const Link& link : kLinks) {
    CAPTURE(link.plugin, link.program, link.isolate);
    CHECK(Shapes(R"(<Shape kind="round" size.radius="2" out.area="{a}" out.text="{t}"/>
                    <Shape kind="square" size.side="{a}" out.area="{b}"/>)",
                 link)
              .run() == "a=12 t=round of 2 b=144");
  }
}

TEST_CASE("what an element gives to a port that it does not have is an error at its place") {
  for (const Link& link : kLinks) {
    CAPTURE(link.plugin, link.program, link.isolate);
    CHECK(Shapes(R"(<Shape kind="round" size.side="2"/>)", link).errors() ==
          Strings{"2:21: 'Shape' has no parameter 'size.side' | parameters of 'Shape': 'kind', "
                  "'out.area', 'out.text', 'size.radius'",
                  "2:1: 'Shape' needs the parameter 'size.radius' | parameters of 'Shape': 'kind', "
                  "'out.area', 'out.text', 'size.radius'"});
    CHECK(Shapes(R"(<Shape kind="round" size.radios="2"/>)", link).errors() ==
          Strings{"2:21: 'Shape' has no parameter 'size.radios' | did you mean 'size.radius'?; "
                  "parameters of 'Shape': 'kind', 'out.area', 'out.text', 'size.radius'"});
    CHECK(Shapes(R"(<Shape kind="round" size.radius="200"/>)", link).errors() ==
          Strings{"2:34: 200 is outside the range of 'size.radius' | it must be from 0 to 100"});
  }
}

TEST_CASE("an element that its plugin refuses is an error at the text to blame") {
  for (const Link& link : kLinks) {
    CAPTURE(link.plugin, link.program, link.isolate);
    CHECK(Shapes(R"(<Shape kind="oval" size.radius="2"/>)", link).errors() ==
          Strings{"2:14: there is no such shape | use round or square"});
  }
  for (const Link& link : {kLinks[0], kLinks[1], kLinks[4]}) {
    CHECK(Shapes(R"(<Shape kind="nameless"/>)", link).errors() ==
          Strings{"2:1: 'Shape' cannot be described, and gives no reason | the author of the "
                  "plugin knows what it needs"});
  }
}

TEST_CASE("a command that runs no programs says so at an element whose ports one knows") {
  const Link saved{"hulls", "hulls.py"};  // with hulls.leaves.json
  CHECK(Shapes(R"(<Hull kind="round"/>)", saved, false).errors() ==
        Strings{
            "2:1: 'Hull' cannot be described: its program is not run by this command, and its file "
            "does not have this element | give --run-programs, or let 'lockstep plugin check "
            "--list --save --tree TREE " LOCKSTEP_SOURCE_DIR
            "/tests/programs/hulls.py' write it to '" LOCKSTEP_SOURCE_DIR
            "/tests/programs/hulls.leaves.json'"});
}

TEST_CASE("a program that does not answer describe as it should is an error of the element") {
  const auto error = [](const std::string& kind) {
    return Shapes(fmt::format(R"(<Hull kind="{}"/>)", kind), {"hulls", "hulls.py"}).errors().at(0);
  };
  CHECK(error("wrong") ==
        "2:1: 'Hull' cannot be described: its program answers describe wrongly: expected 'ports' "
        "or 'refused' | "
        "`lockstep docs programs` has the answers to describe");
  CHECK(error("ends").starts_with(
      "2:1: 'Hull' cannot be described: its program ended with exit code 3 before it answered "
      "describe | run it by hand to see what it prints: PYTHONPATH="));
  CHECK(error("bad") ==
        "2:1: 'Hull' cannot be described: its program answers describe wrongly: port 'size.x': the "
        "type "
        "of a port is 'thing', "
        "expected bool, int, double, string, number, or 'list of ' and one of the first four | "
        "`lockstep docs programs` has the answers to describe");
}

TEST_CASE("a constant that its port does not take is the error that it always is") {
  CHECK(Shapes(R"(<Hull kind="round" count="many" size.x="1"/>)", {"hulls", "hulls.py"}).errors() ==
        Strings{"2:27: 'many' is not a whole number, which 'count' must be | "});
}

TEST_CASE("without what decides its ports, an element lacks only that") {
  for (const Link& link : kLinks) {
    CAPTURE(link.plugin, link.program, link.isolate);
    CHECK(Shapes(R"(<Shape size.radius="2"/>)", link).errors() ==
          Strings{"2:1: 'Shape' needs the parameter 'kind' | parameters of 'Shape': 'kind'"});
    CHECK(
        Shapes(R"(<Shape kind="{k}" size.radius="2"/>)", link).errors() ==
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
                      kInC);
  REQUIRE(shapes.runnable);
  const auto& leaves = shapes.runnable->tree.leaves;
  REQUIRE(leaves.size() == 3);
  CHECK(leaves[0].type == leaves[1].type);
  CHECK(leaves[0].type != leaves[2].type);
}

}  // namespace
}  // namespace lockstep::host::test
