// The paths of a definition are those of the tree that is compiled from it, which recordings have.
#include "tree/paths.h"

#include <catch2/catch.hpp>

#include "engine/compile.h"
#include "language/document/project.h"
#include "run/loading/plugins.h"
#include "tree/resolve.h"

using namespace lockstep::host;

namespace {

std::vector<std::string> paths(const std::string& inside) {
  Diagnostics diagnostics;
  const auto project = load_project_text(
      "t.xml", "<root lockstep=\"1\" main_tree_to_execute=\"T\">" + inside + "</root>", Arguments(),
      diagnostics);
  REQUIRE(project != nullptr);
  const auto definition = resolve(*project, make_catalog(PluginSet()), {}, diagnostics);
  REQUIRE(definition);
  const Tree tree = compile(*definition);
  std::vector<std::string> of_tree;
  for (NodeIndex node = 0; node < tree.nodes.size(); ++node) of_tree.push_back(tree.path(node));
  CHECK(paths_of(*definition) == of_tree);
  return of_tree;
}

}  // namespace

TEST_CASE("siblings of one name are numbered") {
  using Paths = std::vector<std::string>;
  CHECK(paths("<BehaviorTree ID=\"T\"><AlwaysSuccess/></BehaviorTree>") ==
        Paths{"T/AlwaysSuccess"});
  // "a#2" is taken from the start, and "a#2#2" follows from a name that comes too late.
  CHECK(paths("<BehaviorTree ID=\"T\"><Sequence><AlwaysSuccess name=\"a#2\"/><Wait seconds=\"1\"/>"
              "<AlwaysFailure name=\"a\"/><AlwaysSuccess name=\"a\"/><Wait seconds=\"1\"/>"
              "</Sequence></BehaviorTree>") == Paths{"T/Sequence", "T/Sequence/a#2",
                                                     "T/Sequence/Wait", "T/Sequence/a",
                                                     "T/Sequence/a#3", "T/Sequence/Wait#2"});
  CHECK(
      paths("<BehaviorTree ID=\"T\"><Sequence><AlwaysSuccess name=\"a\"/>"
            "<AlwaysFailure name=\"a\"/><AlwaysSuccess name=\"a#2\"/></Sequence></BehaviorTree>") ==
      Paths{"T/Sequence", "T/Sequence/a", "T/Sequence/a#2", "T/Sequence/a#2#2"});
  CHECK(paths("<BehaviorTree ID=\"T\"><Sequence><SubTree ID=\"S\"/><SubTree ID=\"S\"/></Sequence>"
              "</BehaviorTree><BehaviorTree ID=\"S\"><AlwaysSuccess/></BehaviorTree>") ==
        Paths{"T/Sequence", "T/Sequence/S", "T/Sequence/S/AlwaysSuccess", "T/Sequence/S#2",
              "T/Sequence/S#2/AlwaysSuccess"});
}

TEST_CASE("a barrier beside the trees is beside the root") {
  CHECK(paths("<barrier name=\"Parallel\" barriers=\"0.5\"/><BehaviorTree ID=\"T\"><Parallel>"
              "<SyncProgress barrier=\"Parallel\"><Wait seconds=\"1\"/></SyncProgress>"
              "<SyncProgress barrier=\"Parallel\"><Wait seconds=\"1\"/></SyncProgress>"
              "</Parallel></BehaviorTree>")
            .back() == "T/Parallel#2");
}
