"""Namespaces and remapping, as --ros-args has them: LOCKSTEP_ROS_ARGS."""

import os
from unittest import mock

from world import World, count


class Names(World):
    def run_with(self, arguments, nodes):
        with mock.patch.dict(os.environ, LOCKSTEP_ROS_ARGS=arguments):
            run = self.run_tree(nodes)
        self.assertEqual(run.returncode, 0, run.err)

    def test_a_namespace(self):
        server = self.server("--action", "/left/count")
        self.run_with("-r __ns:=/left", count("c", "count", 3))
        self.assertIn("succeeded 3", server.lines)

    def test_an_action_of_another_name(self):
        """In Humble, an action is not remapped as a whole."""
        server = self.server("--action", "/real")
        parts = ("send_goal", "get_result", "cancel_goal", "feedback", "status")
        rules = " ".join(f"-r /count/_action/{part}:=/real/_action/{part}" for part in parts)
        self.run_with("--ros-args " + rules, count("c", "/count", 3))
        self.assertIn("succeeded 3", server.lines)

    def test_a_service_of_another_name(self):
        server = self.server("--action", "/c", "--hold-service", "/real")
        self.run_with("-r /lamp:=/real", """<RosService type="example_interfaces/srv/SetBool"
          service="/lamp" request.data="true"/>""")
        server.wait_for("hold")

    def test_a_topic_of_another_name(self):
        bool_type = 'type="std_msgs/msg/Bool" qos="latched"'
        self.run_with("-r /said:=/heard", f"""<Sequence memory="true">
          <RosPublish {bool_type} topic="/said" message.data="true"/>
          <RosReceive {bool_type} topic="/heard" timeout="5"/></Sequence>""")

    def test_the_name_of_the_node(self):
        self.server("camera", program="lifecycle_server")
        self.run_with("-r __node:=robot", '<RosLifecycle node="/camera" transition="configure"/>')

    def test_arguments_that_are_wrong(self):
        with mock.patch.dict(os.environ, LOCKSTEP_ROS_ARGS="-r nonsense"):
            run = self.run_tree("<Sequence><RosPublish type='std_msgs/msg/Bool' topic='/t'/></Sequence>")
        self.assertEqual(run.returncode, 4, run.err)
        self.assertIn("nonsense", run.err)


if __name__ == "__main__":
    import unittest

    unittest.main()
