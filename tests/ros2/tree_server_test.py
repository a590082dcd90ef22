"""The action server run_tree, which RosAction uses here as any client does."""

import signal
import subprocess

from world import PLUGINS, TREE_SERVER, World, count

STATE = 'type="lockstep_ros/msg/TreeState" topic="/tree_server/state" qos="latched" timeout="5"'


class TreeServer(World):
    def serve(self, *parameters):
        options = [f"trees:={self.directory}", f"plugin_path:=['{PLUGINS}']", *parameters]
        arguments = [word for option in options for word in ("-p", option)]
        return self.server("--ros-args", *arguments, program=TREE_SERVER, ready="")

    def tree(self, nodes, name="served.xml"):
        (self.directory / name).write_text(
            '<root lockstep="1"><plugin name="ros2"/><arg name="order" default="3"/>'
            f'<BehaviorTree ID="T">{nodes}</BehaviorTree></root>')

    @staticmethod
    def goal(more="", tree="served.xml"):
        return (f'<RosAction name="run" type="lockstep_ros/action/RunTree" action="/run_tree" '
                f'goal.tree="{tree}" progress="feedback.state.progress" error="{{error}}" '
                f'result.status="{{status}}" result.reason="{{reason}}" {more}/>')

    def run_goal(self, checks, more="", tree="served.xml"):
        """Sends the goal, whatever becomes of it, and checks the entries."""
        run = self.run_tree(f"""<Sequence memory="true">
          <Fallback memory="true">{self.goal(more, tree)}<AlwaysSuccess/></Fallback>
          <Check code="{checks}"/></Sequence>""")
        self.assertEqual(run.returncode, 0, (run.err, self.recording.read_text()[-2000:]))
        return run

    def test_success(self):
        self.tree('<Wait seconds="1"/>')
        self.serve()
        self.run_goal("status == 'success' &amp;&amp; reason == ''")
        self.assertGreater(len(set(self.progress("run").values())), 3)

    def test_what_fails_is_named(self):
        self.tree('<Sequence><AlwaysSuccess/><AlwaysFailure name="broken"/></Sequence>')
        self.serve()
        self.run_goal("status == 'failure' &amp;&amp; reason == 'T/Sequence/broken' "
                      "&amp;&amp; error == 'aborted'")

    def test_a_file_that_is_no_tree(self):
        self.tree("<Nonsense/>")
        self.serve()
        self.run_goal("status == 'invalid'")
        self.assertIn("Nonsense", self.recording.read_text())
        self.run_goal("status == 'invalid'", tree="absent.xml")

    def test_an_argument_that_is_not_there(self):
        self.tree("<AlwaysSuccess/>")
        self.serve()
        self.run_goal("status == 'invalid'", 'goal.arguments="ordr=5"')
        self.assertIn("ordr", self.recording.read_text())

    def test_a_fault_is_told(self):
        self.tree(count("c", "/nobody", 1, 'server_timeout="0.1" on_failure="fault"'))
        self.serve()
        self.run_goal("status == 'fault'")
        self.assertIn("the action '/nobody': no server", self.recording.read_text())

    def test_the_tree_may_use_ros_and_has_arguments(self):
        server = self.server("--action", "/count")
        self.tree(count("c", "/count", "${order}"))
        self.serve()
        self.run_goal("status == 'success'", 'goal.arguments="order=7"')
        self.assertIn("succeeded 7", server.lines)

    def test_who_is_held_by_whom(self):
        self.tree("""<ParallelAbsolute name="both" barriers="0.5">
          <Wait name="fast" seconds="0.4"/><Wait name="slow" seconds="4"/></ParallelAbsolute>""")
        self.serve()
        run = self.run_tree(f"""<Parallel success_count="1">{self.goal()}
          <Sequence memory="true"><Wait seconds="1.5"/>
            <RosReceive {STATE} message.progress="{{progress}}" message.held.path="{{held}}"
                        message.held.by="{{by}}" message.running.path="{{running}}"/>
            <Check code="progress &gt; 0.1"/></Sequence></Parallel>""")
        self.assertEqual(run.returncode, 0, run.err)
        text = self.recording.read_text()
        self.assertIn('"T/both/fast"', text)
        self.assertIn('"T/both"', text)
        self.assertIn('"T/both/fast;T/both/slow"', text)

    def test_a_cancel_halts(self):
        server = self.server("--action", "/count")
        self.tree(count("c", "/count", 1000))
        self.serve()
        run = self.run_tree(f"""<Sequence memory="true">
          <Inverter><Timeout seconds="1.5">{self.goal()}</Timeout></Inverter><Wait seconds="1"/>
          <RosReceive {STATE} message.status="{{status}}"/>
          <Check code="status == 'halted'"/></Sequence>""")
        self.assertEqual(run.returncode, 0, run.err)
        server.wait_for("cancel")

    def test_a_cancel_while_a_leaf_is_held(self):
        left = self.server("--action", "/left", "--step", 10, "--keep")
        right = self.server("--action", "/right", "--step", 100)
        self.tree(f"""<ParallelAbsolute barriers="0.5">{count("left", "/left", 20, 'hold="cancel"')}
          {count("right", "/right", 100, 'hold="cancel"')}</ParallelAbsolute>""")
        self.serve()
        run = self.run_tree(f'<Timeout seconds="2">{self.goal()}</Timeout>')
        self.assertEqual(run.returncode, 1, run.err)
        right.wait_for("cancel")
        self.assertEqual([line for line in left.lines if line.startswith("goal")], ["goal 20"])
        self.assertEqual(left.lines.count("cancel"), 1)

    def test_a_server_that_is_stopped_halts_the_tree(self):
        for number in (signal.SIGINT, signal.SIGTERM):
            robot = self.server("--action", "/count")
            self.tree(count("c", "/count", 1000))
            server = self.serve()
            run = self.start(self.goal())
            robot.wait_for("goal 1000")
            server.stop(number)
            robot.wait_for("cancel")
            _, err = run.communicate(timeout=5)
            self.assertIn("run: failure", err)
            self.assertIn('"aborted"', self.recording.read_text())
            self.assertIn('"halted"', self.recording.read_text())
            self.assertEqual(server.process.returncode, 0)
            robot.stop()

    def test_one_tree_at_a_time(self):
        self.tree('<Wait seconds="2"/>')
        self.serve()
        run = self.run_tree(f"""<Parallel success_count="2">{self.goal()}
          <Sequence memory="true"><Wait seconds="1"/>
            <Inverter>{self.goal().replace("{error}", "{why}")}</Inverter>
            <Check code="why == 'rejected'"/></Sequence></Parallel>""")
        self.assertEqual(run.returncode, 0, run.err)

    def test_in_simulated_time(self):
        self.tree('<Wait seconds="4"/>')
        self.serve("use_sim_time:=true")
        self.server("100:102:4", "50:60:4", program="clock_publisher")
        self.run_goal("status == 'success' &amp;&amp; seconds &gt; 3.9 &amp;&amp; seconds &lt; 4.2",
                      'result.seconds="{seconds}"')
        real = max(float(row["time_s"]) for row in self.rows("run"))
        self.assertLess(real, 3.5)

    def test_a_rate_without_a_point(self):
        self.tree('<Wait seconds="0.1"/>')
        self.serve("rate:=50", "feedback_period:=1")
        self.run_goal("status == 'success'")

    def test_parameters_that_are_none(self):
        for given, said in (("rate:=0", "the parameter 'rate' is 0, expected a number above 0"),
                            ("rate:=fast", "the parameter 'rate' is fast, expected a number above 0"),
                            ("plugin_path:=here", "plugin_path")):
            with self.subTest(given):
                run = subprocess.run([TREE_SERVER, "--ros-args", "-p", given], text=True,
                                     capture_output=True, timeout=20)
                self.assertEqual(run.returncode, 2, run.stderr)
                self.assertIn(said, run.stderr)

    def test_diagnostics(self):
        self.tree('<AlwaysFailure name="broken"/>')
        self.serve()
        self.run_goal("status == 'failure'")
        run = self.run_tree("""<RosReceive type="diagnostic_msgs/msg/DiagnosticArray" take="next"
          topic="/diagnostics" timeout="5" message.status.message="{message}"/>""")
        self.assertEqual(run.returncode, 0, run.err)
        self.assertIn("failure: T/broken", self.recording.read_text())


if __name__ == "__main__":
    import unittest

    unittest.main()
