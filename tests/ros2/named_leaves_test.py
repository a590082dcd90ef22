"""Short tags from a table, as nav2.nodes has them for Nav2."""

import os
import unittest
from unittest import mock

from world import LOCKSTEP, PLUGINS, ROOT, TYPES, World

TABLE = """# tags of this test
CountTo action example_interfaces/action/Fibonacci /count
  server_name = action
  order = goal.order
  counted = result.sequence
  progress : size(feedback.sequence) / goal.order
  hold : cancel

Lamp service example_interfaces/srv/SetBool
  service_name = service
  on = request.data
  is_recovery = nothing

DriveTo action example_interfaces/action/Fibonacci
  server_name = action
  order = goal.order
  goal.order : 40
  progress : size(feedback.sequence) / 40
  hold : nothing
  pace_type : std_msgs/msg/Float64
  pace_value : factor / 2

LampWorks service example_interfaces/srv/SetBool /lamp
  condition : not response.success

Picked topic std_msgs/msg/String
  topic_name = topic
  default_pick = default
  pick = message.data
  qos : latched
  timeout : 0
"""


class Named(World):
    plugins = ("ros2", "nav_control")
    plugin_paths = (PLUGINS, LOCKSTEP.parent / "plugins")

    def setUp(self):
        super().setUp()
        self.use(TABLE)

    def use(self, text):
        table = self.directory / "own.nodes"
        table.write_text(text)
        patch = mock.patch.dict(os.environ, LOCKSTEP_ROS_NODES=str(table))
        patch.start()
        self.addCleanup(patch.stop)

    def test_a_tree_of_the_shape_of_those_of_nav2(self):
        server = self.server("--action", "/count", "--abort", 9, "--hold-service", "/lamp")
        tree = self.directory / "navigate.xml"
        tree.write_text("""<root BTCPP_format="4" main_tree_to_execute="Main">
          <BehaviorTree ID="Main">
            <RecoveryNode number_of_retries="2" name="all">
              <PipelineSequence name="drive">
                <RateController hz="10"><CountTo order="2" counted="{path}"/></RateController>
                <CountTo server_name="/slow" order="4"/>
              </PipelineSequence>
              <ReactiveFallback name="recover">
                <GoalUpdated/>
                <RoundRobin name="help">
                  <Lamp service_name="/lamp" on="true" is_recovery="true"/>
                  <CountTo order="1"/>
                </RoundRobin>
              </ReactiveFallback>
            </RecoveryNode>
          </BehaviorTree></root>""")
        self.server("--action", "/slow", "--step", 100)
        with mock.patch.object(self, "command", lambda verb, nodes, *options: [
                LOCKSTEP, verb, tree, "--plugin", "ros2", "--plugin", "nav_control", "--plugin-path", PLUGINS,
                "--plugin-path", LOCKSTEP.parent / "plugins", *options]):
            run = self.run_tree("")
        self.assertEqual(run.returncode, 0, run.err)
        self.assertGreater(server.lines.count("succeeded 2"), 1)

    def test_a_goal_that_is_received_again_is_the_same(self):
        goal = 'type="geometry_msgs/msg/PoseStamped" topic="/goal" qos="latched"'
        published = "".join(f'<RosPublish {goal} message.pose.position.x="{x}"/><Wait seconds="0.5"/>' for x in (1, 2))
        for options in ((), ("--isolate",)):
            with self.subTest(options):
                run = self.run_tree(f"""<Sequence memory="true">
                  <Script code="updates := 0"/>
                  <Parallel success_count="1">
                    <Sequence memory="true">{published}</Sequence>
                    <Repeat><Sequence memory="true">
                      <RosReceive {goal} message="{{goal}}"/>
                      <ForceSuccess><GlobalUpdatedGoal on_success="updates += 1"/></ForceSuccess>
                      </Sequence></Repeat>
                  </Parallel>
                  <Check code="updates == 2"/></Sequence>""", *options)
                self.assertEqual(run.returncode, 0, (run.err, self.recording.read_text()[-1000:]))

    def test_in_the_language_of_lockstep(self):
        self.server("--action", "/count")
        run = self.run_tree('<CountTo name="c" order="5" counted="{all}"/>')
        self.assertEqual(run.returncode, 0, run.err)
        self.assertIn('"1;2;3;4;5"', self.recording.read_text())
        self.assertIn(0.4, self.progress("c").values())

    def test_a_barrier_holds_them(self):
        self.server("--action", "/fast", "--step", 20, "--keep")
        self.server("--action", "/slow", "--step", 60)
        run = self.run_tree("""<ParallelAbsolute barriers="0.5">
          <CountTo name="fast" server_name="/fast" order="20"/>
          <CountTo name="slow" server_name="/slow" order="20"/></ParallelAbsolute>""")
        self.assertEqual(run.returncode, 0, run.err)
        fast, slow = self.progress("fast"), self.progress("slow")
        self.assertLess(max(abs(fast[at] - slow[at]) for at in fast.keys() & slow.keys()), 0.45)

    def test_a_selector_takes_what_was_published_last_else_its_default(self):
        run = self.run_tree("""<Sequence memory="true">
          <Picked topic_name="/pick" default_pick="careful" pick="{first}"/>
          <RosPublish type="std_msgs/msg/String" topic="/pick" qos="latched" message.data="fast"/>
          <Wait seconds="0.7"/>
          <Picked topic_name="/pick" default_pick="careful" pick="{second}"/>
          <Check code="first == 'careful' &amp;&amp; second == 'fast'"/></Sequence>""")
        self.assertEqual(run.returncode, 0, run.err)
        run = self.run_tree('<Picked topic_name="/unpicked" pick="{p}"/>')
        self.assertEqual(run.returncode, 1, run.err)

    def test_a_condition_that_is_a_service(self):
        self.server("--action", "/c", "--hold-service", "/lamp")
        run = self.run_tree('<LampWorks request.data="true" error="{why}"/>')
        self.assertEqual(run.returncode, 1, run.err)
        self.assertIn('"condition"', self.recording.read_text())

    def test_a_robot_that_is_slowed(self):
        fast = self.server("--action", "/fast", "--step", 15, "--pace", "real:/slow")
        slow = self.server("--action", "/slow", "--step", 40)
        run = self.run_tree("""<ParallelRelative delta="0.1" pace="true" reaction="0.2">
          <DriveTo server_name="/fast" pace="topic:/slow"/><DriveTo server_name="/slow"/></ParallelRelative>""")
        self.assertEqual(run.returncode, 0, run.err)
        fast.wait_for("pace 0.500")
        self.assertIn("succeeded 40", fast.lines)
        self.assertIn("succeeded 40", slow.lines)

    def test_mistakes_in_a_tree(self):
        run = self.check('<CountTo ordr="5"/>')
        self.assertIn("did you mean 'order'?", run.stderr)
        run = self.check('<Lamp on="true"/>')
        self.assertIn("needs the parameter 'service_name'", run.stderr)

    @unittest.skipIf((TYPES / "nav2_msgs").exists(), "there is nav2_msgs")
    def test_a_package_that_is_not_there(self):
        self.use((ROOT / "plugins/ros2/nav2.nodes").read_text())
        self.plugins = ("ros2",)
        run = self.check('<ComputePathToPose goal="{goal}" path="{path}"/>')
        if os.path.exists("/opt/ros") and run.returncode == 0:
            self.skipTest("nav2_msgs is installed")
        self.assertIn("there is no package 'nav2_msgs'", run.stderr)

    def test_mistakes_in_a_table(self):
        for text, what in (("CountTo parameter a/b/C", "own.nodes:1: expected TAG action|service|topic"),
                           (TABLE + "\n  nothing", f"own.nodes:{TABLE.count(chr(10)) + 2}: expected NAME = FIELD"),
                           (TABLE + "\nCountTo action a/action/B", "'CountTo' is there twice")):
            self.use(text)
            run = self.check("<AlwaysSuccess/>")
            self.assertNotEqual(run.returncode, 0)
            self.assertIn(what, run.stderr)


if __name__ == "__main__":
    import unittest

    unittest.main()
