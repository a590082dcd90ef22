#include "base/core/message_kinds.h"

namespace lockstep::host {

std::span<const MessageKind> message_kinds() {
  static constexpr MessageKind kAll[] = {
      {"always-fault",
       "Each tick of a node is a fault, whatever the leaves return, or unless one returns Skipped.",
       "Correct what the message quotes. For example, give the entry one type everywhere.",
       R"xml(<root BTCPP_format="4" main_tree_to_execute="Main">
  <BehaviorTree ID="Main">
    <SubTree ID="Lift" ready="true"/>
  </BehaviorTree>
  <BehaviorTree ID="Lift">
    <Script code="ready = false"/>
  </BehaviorTree>
</root>
)xml"},
      {"assigning-condition",
       "A condition uses `=`, which assigns a value. The value decides, so the condition nearly "
       "always holds.",
       "Write `==` to compare.",
       R"xml(<root lockstep="1">
  <BehaviorTree ID="Main">
    <Sequence memory="true">
      <Script code="open := false"/>
      <Check code="open = true"/>
    </Sequence>
  </BehaviorTree>
</root>
)xml"},
      {"bad-argument", "A `${` in the file has no closing brace.",
       "Write `${name}`, or `$${` for the characters themselves.",
       R"xml(<root lockstep="1">
  <arg name="seconds" default="1"/>
  <BehaviorTree ID="Main">
    <Wait seconds="${seconds"/>
  </BehaviorTree>
</root>
)xml"},
      {"bad-attributes",
       "The attributes of an element exclude each other, or one of several is missing.",
       "Keep exactly one of the attributes that the message names."},
      {"bad-format", "`lockstep fmt` cannot bring the file into the canonical layout.",
       "Correct what the message names. The file is unchanged."},
      {"bad-include",
       "An `include` cannot be followed: the file is missing, unreadable, or includes itself.",
       "Correct the path. It is relative to the file that contains the `include`.",
       R"xml(<root lockstep="1">
  <include path="parts/none.xml"/>
  <BehaviorTree ID="Main">
    <Wait seconds="1"/>
  </BehaviorTree>
</root>
)xml"},
      {"bad-key", "The key of a blackboard entry has characters that a key cannot have.",
       "Use letters, digits and `_`, and begin with a letter or `_`.",
       R"xml(<root lockstep="1" main_tree_to_execute="Main">
  <BehaviorTree ID="Main">
    <SubTree ID="Part" the-door="{door}"/>
  </BehaviorTree>
  <BehaviorTree ID="Part">
    <Wait seconds="1"/>
  </BehaviorTree>
</root>
)xml"},
      {"bad-leaf-model", "A leaf model contradicts the tree or itself.",
       "Correct the row of the leaf model that the message names."},
      {"bad-leaf-script", "A script of leaves has a mistake, or does not fit the tree.",
       "Correct the line that the message names. `lockstep verify` writes such scripts."},
      {"bad-model",
       "A model in `TreeNodesModel` is ignored: it is a second list, has no `ID`, or describes no "
       "node.",
       "Remove the model, or give it the `ID` of the node."},
      {"bad-name", "A name is empty, or has characters that it cannot have.",
       "Choose a name as the hint describes it.",
       R"xml(<root lockstep="1">
  <BehaviorTree ID="Main">
    <Wait name="a/b" seconds="1"/>
  </BehaviorTree>
</root>
)xml"},
      {"bad-option",
       "An option of the command line names a thing that the tree does not have, or its value has "
       "the wrong form.",
       "Correct the option. `lockstep help COMMAND` shows its form."},
      {"bad-progress", "A leaf reported a progress outside 0 to 1.",
       "Correct the plugin: progress is a fraction of the motion, from 0 to 1."},
      {"bad-property",
       "The text of a property is not in the language of properties, or names a node or an entry "
       "that the tree does not have.",
       "Correct the text at the marked place. properties.md describes the language.",
       R"xml(<root lockstep="1">
  <property name="safe">nver arm.failure</property>
  <BehaviorTree ID="Main">
    <Wait name="arm" seconds="1"/>
  </BehaviorTree>
</root>
)xml"},
      {"bad-reading", "A script reads what a node or a resource does not have.",
       "Correct the name of the node, the resource or what is read of it.",
       R"xml(<root lockstep="1">
  <BehaviorTree ID="Main">
    <Parallel>
      <Wait name="dig" seconds="1"/>
      <Wait seconds="1" skip_if="status(digg) == idle"/>
    </Parallel>
  </BehaviorTree>
</root>
)xml"},
      {"bad-scenario", "A scenario cannot be played as it is written.",
       "Correct the element that the message names. testing.md describes scenarios."},
      {"bad-start-value",
       "The start value of an entry does not have the type that a port or a script gives the "
       "entry.",
       "Change the start value, or connect the port to another entry.",
       R"xml(<root lockstep="1" main_tree_to_execute="Main">
  <BehaviorTree ID="Main">
    <SubTree ID="Part" seconds="long"/>
  </BehaviorTree>
  <BehaviorTree ID="Part">
    <Wait seconds="{seconds}"/>
  </BehaviorTree>
</root>
)xml"},
      {"bad-study", "The grid, the measures or the folder of a study cannot be used.",
       "Correct the option that the message names. studies.md describes the options."},
      {"bad-type", "The plugin rejects the parameters of an element, so the element has no ports.",
       "Correct the value that the message names."},
      {"bad-value", "The value of an attribute does not have the type or the range of its port.",
       "Write a value as the message describes it, or a blackboard entry: `{key}`.",
       R"xml(<root lockstep="1">
  <BehaviorTree ID="Main">
    <ParallelRelative delta="much">
      <Wait seconds="1"/>
      <Wait seconds="2"/>
    </ParallelRelative>
  </BehaviorTree>
</root>
)xml"},
      {"begins-apart",
       "A barrier at 0 does not wait for idle members, so its members do not begin together.",
       "Remove `idle=\"ignore\"`, or the barrier at 0.",
       R"xml(<root lockstep="1">
  <barrier name="go" barriers="0;0.5" idle="ignore"/>
  <BehaviorTree ID="Main">
    <Parallel>
      <SyncProgress barrier="go"><Wait seconds="1"/></SyncProgress>
      <SyncProgress barrier="go"><Wait seconds="2"/></SyncProgress>
    </Parallel>
  </BehaviorTree>
</root>
)xml"},
      {"child-count", "A node has too many or too few children.",
       "Group children with a `Sequence` or a parallel node, or add the missing child.",
       R"xml(<root lockstep="1">
  <BehaviorTree ID="Main">
    <Inverter>
      <Wait seconds="1"/>
      <Wait seconds="2"/>
    </Inverter>
  </BehaviorTree>
</root>
)xml"},
      {"dead-node",
       "A node can never run, whatever the leaves return, or unless one returns Skipped.",
       "Remove the node, or change the node before it that decides.",
       R"xml(<root lockstep="1">
  <BehaviorTree ID="Main">
    <Sequence memory="true">
      <AlwaysFailure/>
      <Wait seconds="1"/>
    </Sequence>
  </BehaviorTree>
</root>
)xml"},
      {"deadlock", "Nodes wait for each other, so none of them can continue.",
       "Break the chain of nodes that the message shows. deadlocks.md has examples.",
       R"xml(<root lockstep="1">
  <barrier name="one" barriers="0.5"/>
  <barrier name="two" barriers="0.5"/>
  <BehaviorTree ID="Main">
    <Parallel>
      <Sequence memory="true">
        <SyncProgress barrier="one"><Wait seconds="1"/></SyncProgress>
        <SyncProgress barrier="two"><Wait seconds="1"/></SyncProgress>
      </Sequence>
      <Sequence memory="true">
        <SyncProgress barrier="two"><Wait seconds="1"/></SyncProgress>
        <SyncProgress barrier="one"><Wait seconds="1"/></SyncProgress>
      </Sequence>
    </Parallel>
  </BehaviorTree>
</root>
)xml"},
      {"doubtful-result", "The summary of a study has a value that may mislead.",
       "Read the warning. studies.md describes the summary."},
      {"duplicate-name", "Two declarations have the same name.", "Rename one of them.",
       R"xml(<root lockstep="1">
  <arg name="seconds" default="1"/>
  <arg name="seconds" default="2"/>
  <BehaviorTree ID="Main">
    <Wait seconds="${seconds}"/>
  </BehaviorTree>
</root>
)xml"},
      {"duplicate-tree", "Two trees have the same `ID`.", "Rename one of the trees.",
       R"xml(<root lockstep="1" main_tree_to_execute="Main">
  <BehaviorTree ID="Main">
    <Wait seconds="1"/>
  </BehaviorTree>
  <BehaviorTree ID="Main">
    <Wait seconds="2"/>
  </BehaviorTree>
</root>
)xml"},
      {"empty-tree", "A `BehaviorTree` contains no node.", "Put one node into the tree.",
       R"xml(<root lockstep="1">
  <BehaviorTree ID="Main">
  </BehaviorTree>
</root>
)xml"},
      {"endless-pause", "A synchronized node may pause a child indefinitely.",
       "Make sure that the slowest child completes or makes progress. deadlocks.md has examples."},
      {"endless-tree",
       "The tree never ends, whatever its leaves return, or unless one returns Skipped.",
       "None, if the tree is meant to run until it is stopped."},
      {"entry-type", "Two uses of a blackboard entry give it different types.",
       "Use two entries, or ports of the same type."},
      {"fixed-parameter",
       "A parameter that is fixed when the tree is loaded is connected to a blackboard entry.",
       "Write a value, or `${name}` with an `arg`.",
       R"xml(<root lockstep="1">
  <BehaviorTree ID="Main">
    <Sequence memory="{m}">
      <Wait seconds="1"/>
    </Sequence>
  </BehaviorTree>
</root>
)xml"},
      {"hidden-leaf",
       "A leaf of a plugin has the ID of a built-in node, so the tree cannot use the leaf.",
       "Give the leaf another ID."},
      {"ignored-attribute", "BehaviorTree.CPP ignores this attribute.",
       "Remove the attribute, or correct its name."},
      {"inexact-progress",
       "`lockstep verify` cannot divide the progress of a leaf into steps that match `delta` or a "
       "barrier.",
       "Give the leaf model the `progress` that the hint names."},
      {"left-out",
       "The converted file does not contain this element or attribute. A run is the same without "
       "it.",
       "Nothing to do."},
      {"lone-member", "A barrier has only one member, so the member waits for no other node.",
       "Add a `SyncProgress` with the same barrier to each node that takes part.",
       R"xml(<root lockstep="1">
  <barrier name="lift" delta="0.1"/>
  <BehaviorTree ID="Main">
    <SyncProgress barrier="lift"><Wait seconds="1"/></SyncProgress>
  </BehaviorTree>
</root>
)xml"},
      {"lone-resource",
       "Only one node uses this resource, although others of the pool have several users. The name "
       "may be mistyped.",
       "Correct the name of the resource.",
       R"xml(<root lockstep="1">
  <resources name="arms"/>
  <BehaviorTree ID="Main">
    <Parallel>
      <UseResources pool="arms" resources="left"><Wait seconds="1"/></UseResources>
      <UseResources pool="arms" resources="left"><Wait seconds="2"/></UseResources>
      <UseResources pool="arms" resources="leftt"><Wait seconds="3"/></UseResources>
    </Parallel>
  </BehaviorTree>
</root>
)xml"},
      {"loose-script",
       "A script in the syntax of BehaviorTree.CPP has another meaning than it seems to have, or "
       "an outdated form.",
       "Write the script as the hint shows it.",
       R"xml(<root lockstep="1">
  <BehaviorTree ID="Main">
    <Script code="3 = 4"/>
  </BehaviorTree>
</root>
)xml"},
      {"lost-output",
       "An output port is not connected to a blackboard entry, so its value is lost.",
       "Write `port=\"{key}\"`."},
      {"member-twice", "Two nodes of a tree are in step with one team, or two pools are of one.",
       "A robot is a member once. Declare a team for each `InStep`, and put the resources into one "
       "pool.",
       R"xml(<root lockstep="1">
  <team name="table" members="left;right"/>
  <BehaviorTree ID="Main">
    <Sequence>
      <InStep team="table" as="left" delta="0.1"><Wait seconds="1"/></InStep>
      <InStep team="table" as="left" delta="0.1"><Wait seconds="2"/></InStep>
    </Sequence>
  </BehaviorTree>
</root>
)xml"},
      {"members-never-meet",
       "Two members of a barrier are in different children of a node that runs its children one "
       "after the other, so they never run together.",
       "Put the members into children of a parallel node, or use two barriers.",
       R"xml(<root lockstep="1">
  <barrier name="lift" delta="0.1"/>
  <BehaviorTree ID="Main">
    <Sequence memory="true">
      <SyncProgress barrier="lift"><Wait seconds="1"/></SyncProgress>
      <SyncProgress barrier="lift"><Wait seconds="2"/></SyncProgress>
    </Sequence>
  </BehaviorTree>
</root>
)xml"},
      {"missing-argument", "An `arg` of the tree has no default, and no value is given.",
       "Give the value with `--arg NAME=VALUE`, or a `default`.",
       R"xml(<root lockstep="1">
  <arg name="seconds"/>
  <BehaviorTree ID="Main">
    <Wait seconds="${seconds}"/>
  </BehaviorTree>
</root>
)xml"},
      {"missing-attribute", "An element lacks an attribute that it needs.", "Add the attribute.",
       R"xml(<root lockstep="1">
  <BehaviorTree>
    <Wait seconds="1"/>
  </BehaviorTree>
</root>
)xml"},
      {"missing-directory", "A directory that is searched for plugins does not exist.",
       "Correct `--plugin-path`."},
      {"missing-entry",
       "No port or script of the tree creates the entry that a node names by its key.",
       "Correct the key, or declare the entry.",
       R"xml(<root BTCPP_format="4">
  <BehaviorTree ID="Main">
    <Script code="x = 1"/>
  </BehaviorTree>
</root>
)xml"},
      {"missing-port", "A node lacks a port or parameter that has no default.",
       "Add the attribute with a value or `{key}`.",
       R"xml(<root lockstep="1">
  <BehaviorTree ID="Main">
    <Wait/>
  </BehaviorTree>
</root>
)xml"},
      {"mocked-node", "No plugin has this node, so a mock takes its place.",
       "Nothing to do with `--mock`. For a real run load the plugin: `--plugin`, `--plugin-path`."},
      {"moves-while-paused",
       "A synchronized node may pause this leaf, but the robot continues to move while the leaf is "
       "paused.",
       "Give the leaf a pause that stops the robot, if the synchronization must be tight."},
      {"needs-entry", "An output or a key is written as a value.", "Write `port=\"{key}\"`.",
       R"xml(<root lockstep="1">
  <resources name="arms" resources="left;right"/>
  <BehaviorTree ID="Main">
    <UseResources pool="arms" resources="any(left;right)" granted="which"><Wait seconds="1"/></UseResources>
  </BehaviorTree>
</root>
)xml"},
      {"nested-pools", "Two pools are nested in both orders. The nodes may deadlock.",
       "Nest pools in one order, or make them one.",
       R"xml(<root lockstep="1">
  <resources name="arms"/>
  <resources name="door"/>
  <BehaviorTree ID="Main">
    <Parallel>
      <UseResources pool="arms" resources="left">
        <UseResources pool="door" resources="space"><Wait seconds="1"/></UseResources>
      </UseResources>
      <UseResources pool="door" resources="space">
        <UseResources pool="arms" resources="right"><Wait seconds="1"/></UseResources>
      </UseResources>
    </Parallel>
  </BehaviorTree>
</root>
)xml"},
      {"no-main-tree", "The file has several trees, and none is chosen.",
       "Add `main_tree_to_execute`, or give `--tree ID`.",
       R"xml(<root lockstep="1">
  <BehaviorTree ID="Main">
    <Wait seconds="1"/>
  </BehaviorTree>
  <BehaviorTree ID="Home">
    <Wait seconds="2"/>
  </BehaviorTree>
</root>
)xml"},
      {"no-pace", "A node paces its children, but none of their leaves can be slowed.",
       "Use leaves that can be slowed, or remove `pace`. pacing.md describes both.",
       R"xml(<root lockstep="1">
  <BehaviorTree ID="Main">
    <ParallelRelative delta="0.1" pace="true">
      <AlwaysSuccess/>
      <AlwaysSuccess/>
    </ParallelRelative>
  </BehaviorTree>
</root>
)xml"},
      {"no-progress",
       "A synchronized node compares the progress of this child, but the child reports no "
       "progress. Its progress is 0 until it succeeds.",
       "Report progress in the plugin, or expect the others to wait at their first barrier."},
      {"no-tree", "The file contains no `BehaviorTree`.", "Add one.",
       R"xml(<root lockstep="1">
</root>
)xml"},
      {"not-a-node", "An element of `root`, such as a barrier, stands where a node is expected.",
       "Move the declaration into `root`.",
       R"xml(<root lockstep="1">
  <BehaviorTree ID="Main">
    <Sequence memory="true">
      <barrier name="inside" delta="0.1"/>
      <Wait seconds="1"/>
    </Sequence>
  </BehaviorTree>
</root>
)xml"},
      {"not-convertible", "The other language has nothing that behaves like this.",
       "Rewrite this part by hand, as the hint describes it."},
      {"not-slowed",
       "A child of a node that paces has no leaf that can be slowed. It is held instead.",
       "None, if that is acceptable. Otherwise give its leaf `set_pace`, or a `RosAction` `pace`."},
      {"not-the-same", "The converted node behaves differently in a special case.",
       "Read the hint, and check whether your tree meets the case."},
      {"old-model",
       "The tree uses a node in a way that its model in `TreeNodesModel` does not declare.",
       "Correct the tree, or update the model."},
      {"old-syntax", "The file uses syntax of an older version of BehaviorTree.CPP.",
       "Write what the hint shows."},
      {"opens-early",
       "After a failure of one member, a barrier may open for the others although the failed "
       "member will try again.",
       "Retry above the barrier, or read the hint. deadlocks.md has examples."},
      {"overlap",
       "Two actions of one device overlap for a call: a reactive parent ticks the one that takes "
       "over, and then halts the other one.",
       "Let both use a resource of one pool, if they must not overlap. guards.md has an example."},
      {"pace-without-all",
       "A node that paces succeeds before all of its children have come, so it slows none of them.",
       "None, if that is acceptable. Otherwise remove `success_count`.",
       R"xml(<root lockstep="1">
  <BehaviorTree ID="Main">
    <ParallelRelative delta="0.1" success_count="1" pace="true">
      <Wait seconds="1"/>
      <Wait seconds="2"/>
    </ParallelRelative>
  </BehaviorTree>
</root>
)xml"},
      {"partly-isolated",
       "Some leaves of an isolated plugin run in the process of lockstep, because they use what "
       "cannot cross processes.",
       "None, if that is acceptable. Otherwise remove the named functions from the leaves."},
      {"partly-read", "Only the beginning of the value is read, as BehaviorTree.CPP does it.",
       "Remove the rest of the value."},
      {"plugin-conflict", "Two elements name the same plugin with different programs or pauses.",
       "Write the same attributes in all elements of the plugin."},
      {"plugin-not-loaded",
       "The editor does not trust the workspace, so lockstep does not load its plugins.",
       "Trust the workspace in your editor."},
      {"plugin-refused",
       "A plugin is not found, cannot be loaded, or does not keep the contract of plugins.",
       "Correct the name or `--plugin-path`. `lockstep plugin check FILE` examines a plugin."},
      {"pool-size", "A pool has no resources, or too many.",
       "Declare the resources: `resources=\"left;right\"`.",
       R"xml(<root lockstep="1">
  <resources name="arms"/>
  <BehaviorTree ID="Main">
    <UseResources pool="arms" resources="{arm}"><Wait seconds="1"/></UseResources>
  </BehaviorTree>
</root>
)xml"},
      {"process-border",
       "An entry carries objects between processes, but the plugin cannot turn them into bytes.",
       "Add `to_bytes` and `from_bytes` to the type, or run both plugins in one process."},
      {"progress-range",
       "A script compares the progress of a node with a number above 1, which progress never "
       "exceeds.",
       "Write a number from 0 to 1, such as 0.5 for half of the motion.",
       R"xml(<root lockstep="1">
  <BehaviorTree ID="Main">
    <Parallel>
      <Wait name="arm" seconds="1"/>
      <Wait seconds="1" skip_if="progress(arm) >= 50"/>
    </Parallel>
  </BehaviorTree>
</root>
)xml"},
      {"real-time-leaf",
       "A leaf does its work in real time, but the virtual clock does not wait for it.",
       "Run with `--clock wall`, or use `--mock-leaf`."},
      {"recursive-tree", "A tree contains itself.", "Use a decorator such as `Repeat` for a loop.",
       R"xml(<root lockstep="1">
  <BehaviorTree ID="Main">
    <Sequence memory="true">
      <Wait seconds="1"/>
      <SubTree ID="Main"/>
    </Sequence>
  </BehaviorTree>
</root>
)xml"},
      {"restarted", "An action is started again in every tick in which another child runs.",
       "Give the parent `memory=\"true\"`, or put a condition before the action."},
      {"same-name",
       "Two children of a node have the same name. Their paths differ by a number, which changes "
       "with their order.",
       "Give each child its own name."},
      {"script-syntax", "A script has a syntax error.",
       "Correct the script at the marked place. expressions.md describes scripts.",
       R"xml(<root lockstep="1">
  <BehaviorTree ID="Main">
    <Script code="x := 1 +"/>
  </BehaviorTree>
</root>
)xml"},
      {"script-type", "A script compares, calculates or assigns values of types that do not match.",
       "Convert a value, or use another entry.",
       R"xml(<root lockstep="1">
  <BehaviorTree ID="Main">
    <Script code="x := 'a' - 1"/>
  </BehaviorTree>
</root>
)xml"},
      {"several-roots", "A tree has more than one root node.",
       "Put the nodes into a `Sequence`, a `Fallback` or a parallel node."},
      {"stale-leaf-file", "The file of leaves next to a process plugin may not match the plugin.",
       "Write the file again: `lockstep plugin check --list --save FILE`."},
      {"starvation",
       "With `increment=\"0\"` the first members of a pool always win, and a later one may wait "
       "indefinitely.",
       "Remove `increment`."},
      {"team-differs",
       "Two of the checked files declare a team with the same name in different ways: other "
       "members, barriers or delta. Robots with these trees do not move together.",
       "Declare it in the same way in both. Where the files are of different missions, nothing is "
       "wrong."},
      {"too-deep", "Elements are nested too deeply.", "Divide the tree into subtrees."},
      {"too-large", "A file, a value or a tree exceeds a limit.",
       "Divide it. reliability.md lists the limits."},
      {"tree-elsewhere", "A tree that this file uses is in another file.",
       "Nothing to do if this file is part of another one. Otherwise include the file with the "
       "tree."},
      {"unexpected-element", "An element contains elements, but it cannot.",
       "Remove the inner elements.",
       R"xml(<root lockstep="1">
  <arg name="seconds" default="1"><Wait seconds="1"/></arg>
  <BehaviorTree ID="Main">
    <Wait seconds="${seconds}"/>
  </BehaviorTree>
</root>
)xml"},
      {"unfair-pool",
       "A synchronized node withholds ticks from a member of a pool, so another member may get the "
       "resource each time.",
       "Put the members of the pool above the synchronized node."},
      {"unknown-argument", "The file or an option uses an argument that no `arg` declares.",
       "Correct the name, or declare it: `<arg name=\"…\"/>`.",
       R"xml(<root lockstep="1">
  <arg name="seconds" default="1"/>
  <BehaviorTree ID="Main">
    <Wait seconds="${second}"/>
  </BehaviorTree>
</root>
)xml"},
      {"unknown-attribute", "An element does not have this attribute.",
       "Correct the name. The hint lists the attributes.",
       R"xml(<root lockstep="1" main="Main">
  <BehaviorTree ID="Main">
    <Wait seconds="1"/>
  </BehaviorTree>
</root>
)xml"},
      {"unknown-element", "The file does not have this kind of element here.",
       "Correct the name. The hint lists the elements.",
       R"xml(<root lockstep="1">
  <bariers name="lift" delta="0.1"/>
  <BehaviorTree ID="Main">
    <Wait seconds="1"/>
  </BehaviorTree>
</root>
)xml"},
      {"unknown-entry",
       "Nothing declares the blackboard entry that a script, a scenario or an option names.",
       "Correct the key. In a subtree, pass the entry as an attribute of `SubTree`.",
       R"xml(<root lockstep="1">
  <BehaviorTree ID="Main">
    <Sequence memory="true">
      <Script code="ready := true"/>
      <Check code="redy"/>
    </Sequence>
  </BehaviorTree>
</root>
)xml"},
      {"unknown-fact", "A leaf model names a fact that it does not declare.",
       "Declare it: `<fact name=\"…\"/>`."},
      {"unknown-group", "A node names a barrier or a pool that `root` does not declare.",
       "Correct the name, or declare it in `root`.",
       R"xml(<root lockstep="1">
  <barrier name="lift" delta="0.1"/>
  <BehaviorTree ID="Main">
    <Parallel>
      <SyncProgress barrier="lift"><Wait seconds="1"/></SyncProgress>
      <SyncProgress barrier="lfit"><Wait seconds="2"/></SyncProgress>
    </Parallel>
  </BehaviorTree>
</root>
)xml"},
      {"unknown-leaf", "A leaf model names a leaf that the tree does not have.",
       "Correct the name or the path."},
      {"unknown-member", "A node or a pool names a member that its team does not have.",
       "Write one of the `members` of the team.",
       R"xml(<root lockstep="1">
  <team name="table" members="left;right"/>
  <BehaviorTree ID="Main">
    <InStep team="table" as="middle" delta="0.1"><Wait seconds="1"/></InStep>
  </BehaviorTree>
</root>
)xml"},
      {"unknown-node", "No built-in node and no loaded plugin has this ID.",
       "Correct the ID, name the plugin with `<plugin name=\"…\"/>`, or try the tree without it: "
       "`--mock`.",
       R"xml(<root lockstep="1">
  <BehaviorTree ID="Main">
    <Sequnce>
      <Wait seconds="1"/>
    </Sequnce>
  </BehaviorTree>
</root>
)xml"},
      {"unknown-package", "The ROS package of an `include` is not found.",
       "Source the workspace, or give `--ros-package NAME=DIR`."},
      {"unknown-port", "The node does not have this port or parameter.",
       "Correct the name. `lockstep nodes ID` lists the ports.",
       R"xml(<root lockstep="1">
  <BehaviorTree ID="Main">
    <Sequence memroy="true">
      <Wait seconds="1"/>
    </Sequence>
  </BehaviorTree>
</root>
)xml"},
      {"unknown-resource", "A node names a resource that its pool does not have.",
       "Correct the name, or add the resource to the pool.",
       R"xml(<root lockstep="1">
  <resources name="arms" resources="left;right"/>
  <BehaviorTree ID="Main">
    <UseResources pool="arms" resources="lefft"><Wait seconds="1"/></UseResources>
  </BehaviorTree>
</root>
)xml"},
      {"unknown-tree", "No `BehaviorTree` has this ID.",
       "Correct the ID, or include the file that has the tree.",
       R"xml(<root lockstep="1" main_tree_to_execute="Main">
  <BehaviorTree ID="Main">
    <SubTree ID="Grsp"/>
  </BehaviorTree>
  <BehaviorTree ID="Grasp">
    <Wait seconds="1"/>
  </BehaviorTree>
</root>
)xml"},
      {"unknown-version", "The file is for another version of the format.",
       "Write the version that the hint names, or update lockstep.",
       R"xml(<root lockstep="2">
  <BehaviorTree ID="Main">
    <Wait seconds="1"/>
  </BehaviorTree>
</root>
)xml"},
      {"unmatched-case", "A case of a switch has a value that the variable cannot have.",
       "Correct the value of the case."},
      {"unreadable-file", "A file cannot be read.", "Check its name and its permissions."},
      {"unslowed-time",
       "A time limit counts in full while a node that paces slows what is in it, and may end it "
       "early.",
       "Use `clock=\"active\"`, or a longer time."},
      {"unstated-hold",
       "A synchronized node may pause this leaf, but the leaf does not describe what the robot "
       "does then.",
       "Add `hold` to the leaf. `lockstep nodes ID` lists its values."},
      {"untrusted-path",
       "lockstep runs with more rights than its user, so it does not search relative paths or "
       "paths from the environment.",
       "Give an absolute path with `--plugin-path`."},
      {"unused-entry", "A `SubTree` passes an entry that its tree does not use.",
       "Correct the key, or remove the attribute."},
      {"unused-group", "No node of the tree uses this barrier or pool.",
       "Remove the declaration, or name it in a node.",
       R"xml(<root lockstep="1">
  <barrier name="lift" delta="0.1"/>
  <BehaviorTree ID="Main">
    <Wait seconds="1"/>
  </BehaviorTree>
</root>
)xml"},
      {"unused-hold",
       "A node has hold=\"between\", and there is no Sequence in it that could be held between its "
       "children.",
       "Leave out the attribute, or put the steps into a Sequence.",
       R"xml(<root lockstep="1">
  <BehaviorTree ID="Main">
    <ParallelAbsolute barriers="0.5" hold="between">
      <Wait seconds="1"/>
      <Wait seconds="2"/>
    </ParallelAbsolute>
  </BehaviorTree>
</root>
)xml"},
      {"unwritten-entry", "A node reads an entry that no node writes and that has no start value.",
       "Correct the key, or give a start value: `--set KEY=VALUE`.",
       R"xml(<root lockstep="1">
  <BehaviorTree ID="Main">
    <Wait seconds="{pause}"/>
  </BehaviorTree>
</root>
)xml"},
      {"useless-value",
       "The start value of an entry makes a script fail, and no node changes the entry.",
       "Correct the start value or the script."},
      {"waits-for-idle", "A barrier waits for a member that may not run.",
       "Write `idle=\"ignore\"` to wait only for members that run."},
      {"whitespace", "A name or an entry has whitespace around it.", "Remove the whitespace."},
      {"writable-by-all",
       "Every user of this machine may change a plugin or its directory, and so control lockstep.",
       "Run the `chmod` that the hint shows."},
      {"wrong-category", "A node is written as another kind of node than it is.",
       "Write the element that the hint names.",
       R"xml(<root lockstep="1">
  <BehaviorTree ID="Main">
    <Condition ID="AlwaysSuccess"/>
  </BehaviorTree>
</root>
)xml"},
      {"wrong-language",
       "The file is in another language than expected: lockstep's, or that of BehaviorTree.CPP.",
       "Write all files of a tree in one language. `lockstep convert` translates a file.",
       R"xml(<root>
  <BehaviorTree ID="Main">
    <AlwaysSuccess/>
  </BehaviorTree>
</root>
)xml"},
      {"wrong-root", "The root element of the file is not that of its kind of file.",
       "Trees begin with `root`, scenarios with `scenarios`, leaf models with `leaves`.",
       R"xml(<BehaviorTree ID="Main">
  <Wait seconds="1"/>
</BehaviorTree>
)xml"},
      {"xml-syntax", "The file is not well-formed XML.", "Correct the text at the marked place.",
       R"xml(<root lockstep="1">
  <BehaviorTree ID="Main">
    <Sequence>
      <Wait seconds="1"/>
  </BehaviorTree>
</root>
)xml"},
  };
  return kAll;
}

}  // namespace lockstep::host
