// What a plugin says about its leaves counts where no leaf file says otherwise.
#include <catch2/catch.hpp>

#include "leaves/models.h"
#include "lockstep/leaf.h"
#include "support/scripted_leaf.h"
#include "support/scripted_types.h"
#include "support/tree_text.h"

namespace lockstep::host::test {
namespace {

struct Declaring {
  explicit Declaring(std::initializer_list<lockstep_behavior> statements) : said(statements) {
    leaf.behavior_count = static_cast<std::uint32_t>(said.size());
    leaf.behavior = said.data();
    type.plugin = "arm";
    type.leaf = &leaf;
  }
  Declaring(const Declaring&) = delete;

  std::vector<lockstep_behavior> said;
  lockstep_leaf_type leaf = kScriptedAction;
  NodeType type = kScriptedActionType;
};

struct Made {
  Diagnostics diagnostics;
  std::vector<NodeProblem> problems;
  LeafModels models;
};

Made make(const Declaring& declaring, std::string_view tree_text, std::string_view rows,
          Declared declared = Declared::Counts) {
  Made made;
  Tree tree = tree_from_text(tree_text);
  for (LeafNode& leaf : tree.leaves) leaf.type = &declaring.type;
  const std::string text = "<leaves lockstep=\"1\">" + std::string(rows) + "</leaves>";
  const auto file = read_leaf_file("t.leaves.xml", text, made.diagnostics);
  made.models = make_models(tree, file.get(), made.diagnostics, made.problems, {}, declared);
  return made;
}

}  // namespace

TEST_CASE("a leaf does what its plugin declares, and the verdict says so") {
  const Declaring declaring({{"result", "success"},
                             {"ticks", "2..40"},
                             {"progress", "grid:4"},
                             {"step", "0..1"},
                             {"finish", "full"},
                             {"held", "-1..0"}});
  const Made made = make(declaring, "Sequence(a)", "");
  const LeafModel& model = made.models.leaves.at(0);
  CHECK(model.results == ResultSet{true, false, false, false});
  CHECK(model.least_ticks == 2);
  CHECK(model.most_ticks == 40);
  CHECK(model.parts == 4);
  CHECK(model.most_step == 1);
  CHECK(model.finishes_full);
  CHECK(model.least_drift == -1);
  CHECK(made.models.declared ==
        std::vector<std::string>{
            "Scripted behaves as plugin 'arm' declares: result=\"success\" ticks=\"2..40\" "
            "progress=\"grid:4\" step=\"0..1\" finish=\"full\" held=\"-1..0\""});
}

TEST_CASE("a leaf model wins over a plugin, statement by statement") {
  const Declaring declaring{{"result", "success"}, {"ticks", "2..40"}};
  const Made made = make(declaring, "Sequence(a)", R"(<leaf path="*" result="failure"/>)");
  CHECK(made.models.leaves.at(0).results == ResultSet{false, true, false, false});
  CHECK(made.models.leaves.at(0).most_ticks == 40);
  CHECK(made.models.declared ==
        std::vector<std::string>{"Scripted behaves as plugin 'arm' declares: ticks=\"2..40\""});
  const Made all = make(declaring, "Sequence(a)", R"(<leaf path="*" result="failure" ticks="1"/>)");
  CHECK(all.models.declared.empty());
}

TEST_CASE("a step in parts of a plugin ends with them") {
  const Declaring declaring{{"progress", "grid:4"}, {"step", "1"}, {"held", "-1..0"}};
  const Made made = make(declaring, "Sequence(a)", R"(<leaf path="*" progress="grid:10"/>)");
  CHECK(made.models.leaves.at(0).parts == 10);
  CHECK(made.models.leaves.at(0).least_step == 0);
  CHECK_FALSE(made.models.leaves.at(0).drifts());
}

TEST_CASE("parts of a plugin that a delta does not fit are a problem of the node") {
  const Declaring declaring{{"progress", "grid:4"}};
  const Made made = make(declaring, "ParallelRelative[delta=.2](a b)", "");
  REQUIRE(made.problems.size() == 2);
  CHECK(made.problems[0].hint == "write in the leaf model: progress=\"grid:10\"");
  CHECK(make(declaring, "ParallelRelative[delta=.2](a b)", R"(<leaf path="*" progress="grid:10"/>)")
            .problems.empty());
}

TEST_CASE("what a plugin declares can be left aside, as check does") {
  const Declaring declaring{{"result", "success"}};
  const Made made = make(declaring, "Sequence(a)", "", Declared::Ignored);
  CHECK(made.models.leaves.at(0).results == ResultSet{});
  CHECK(made.models.declared.empty());
}

}  // namespace lockstep::host::test
