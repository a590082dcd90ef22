// docs/plugins.md: ports that carry objects.
#include <catch2/catch.hpp>

#include "language/pipeline.h"
#include "language/robot_plugin.h"
#include "run/run.h"

namespace lockstep::host::test {
namespace {

TEST_CASE("objects: written, read, checked") {
  constexpr ClaimRow kRows[] = {
      {"what one leaf sets another reads",
       R"(<Sequence memory="true"><Plan goal="1;2.5" route="{r}"/><Follow route="{r}"/></Sequence>)",
       "success 3: plan to 1;2.5, at 4, at 2"},
      {"a text is one where the type has them", R"(<Plan goal=" 3 ; 4"/>)",
       "success 1: plan to 3;4"},
      {"--set too", R"(<Plan goal="{g}"/>)", "success 1: plan to 3;4", "set.g=3;4"},
      {"an object that was set is read as one from a text",
       R"(<Sequence memory="true"><Plan goal="8;4" half="{h}"/><Plan goal="{h}" half="{h}"/>
          <Plan goal="{h}"/></Sequence>)",
       "success 1: plan to 8;4, plan to 4;2, plan to 2;1"},
      {"a text that is none", R"(<Plan goal="home"/>)",
       "2:13 error: 'home' is not the text of a robot.Pose, which 'goal' must be"},
      {"one that throws is none either", R"(<Plan goal="throw"/>)",
       "2:13 error: 'throw' is not the text of a robot.Pose, which 'goal' must be"},
      {"a start value that is none", R"(<Plan goal="{g}"/>)",
       "2:13 error: the start value 'home' of 'g' is not the text of a robot.Pose, which 'goal' "
       "must be",
       "set.g=home"},
      {"a type without texts has no start values",
       "<Sequence memory=\"true\">\n<Follow route=\"{r}\"/></Sequence>",
       "3:16 error: the start value '1;2' of 'r' is not an entry {key} that carries a robot.Route, "
       "which 'route' must be",
       "set.r=1;2"},
      {"two types of objects are two types",
       "<Sequence memory=\"true\">\n<Plan goal=\"1;2\" half=\"{h}\"/>\n<Follow route=\"{h}\"/>"
       "</Sequence>",
       "4:16 error: '{h}' is a robot.Route for 'route', but a robot.Pose elsewhere"},
      {"an object is no text",
       "<Sequence memory=\"true\">\n<Plan goal=\"1;2\" half=\"{h}\"/>\n<Say text=\"{h}\"/>"
       "</Sequence>",
       "4:12 error: '{h}' is a string for 'text', but a robot.Pose elsewhere"},
      {"an entry that nobody wrote has no object", R"(<Plan goal="{g}"/>)",
       "fault: port 'goal' has no value: nothing has written the entry '{g}'"},
      {"a port with an object has no default", R"(<Plan/>)",
       "2:1 error: 'Plan' needs the parameter 'goal'"},
  };
  for (const ClaimRow& row : kRows) {
    INFO(row.claim);
    {
      const Pipeline pipeline(row.xml, row.options);
      CHECK((pipeline.loaded() ? pipeline.run() : pipeline.told()) == row.expected);
    }
    CHECK(objects_alive == 0);
  }
}

// The objects in the entries are what is alive, as long as the run is.
TEST_CASE("objects live as long as an entry, a leaf or the tree has them") {
  REQUIRE(objects_alive == 0);
  {
    const Pipeline pipeline(
        R"(<Sequence memory="true"><Plan goal="1;2" route="{r}" half="{h}"/><Follow route="{r}"/>
           <Plan goal="{h}" half="{h}"/></Sequence>)");
    REQUIRE(pipeline.loaded());
    const int of_tree = objects_alive;
    CHECK(of_tree == 1);
    {
      Run run(pipeline.tree(), {});
      CHECK(objects_alive == of_tree);
      for (int round = 0; round < 2; ++round) {
        CHECK(run.tick(Nanoseconds(0)) == Status::Running);
        CHECK(objects_alive == of_tree + 2);  // a route and half of the way
        CHECK(run.tick(Nanoseconds(1)) == Status::Running);
        CHECK(run.tick(Nanoseconds(2)) == Status::Success);
        CHECK(objects_alive == of_tree + 2);
        run.restart(1);
        CHECK(objects_alive == of_tree);
      }
      run.tick(Nanoseconds(0));
    }
    CHECK(objects_alive == of_tree);
  }
  CHECK(objects_alive == 0);
}

// So an object may use what the leaves of its run share.
TEST_CASE("objects in entries go with the leaves, not with the blackboard") {
  const Pipeline pipeline(R"(<Plan goal="1;2" route="{r}" half="{h}"/>)");
  REQUIRE(pipeline.loaded());
  Blackboard blackboard(pipeline.tree());
  const LeafTime time;
  LeafSet leaves(pipeline.tree(), blackboard, time, 1);
  const LeafSlot& slot = leaves.slots()[0];
  CHECK(slot.type->tick(slot.self) == LOCKSTEP_SUCCESS);
  CHECK(objects_alive == 3);
  leaves.destroy_all();
  CHECK(objects_alive == 1);  // that of the tree
}

TEST_CASE("an entry with an object has the text of the object") {
  const Pipeline pipeline(R"(<Plan goal="1;2" route="{r}" half="{h}"/>)");
  REQUIRE(pipeline.loaded());
  Run run(pipeline.tree(), {});
  run.tick(Nanoseconds(0));
  for (std::size_t slot = 0; slot < pipeline.tree().slots.size(); ++slot) {
    const std::string text = to_text(run.blackboard().entries[slot].value());
    CHECK(text == (pipeline.tree().slots[slot].name == "h" ? "0.5;1" : "(robot.Route)"));
  }
}

}  // namespace
}  // namespace lockstep::host::test
