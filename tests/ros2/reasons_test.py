"""Reasons of the leaves, in the words of real servers: `lockstep log why` and the summary."""

import subprocess
import time
import unittest

from world import LOCKSTEP, SERVERS, World, count

FETCH = "lockstep_ros2_test_interfaces/action/Fetch"
PLAN = "lockstep_ros2_test_interfaces/action/Plan"


class Reasons(World):
    def why(self, *more):
        return subprocess.run([LOCKSTEP, "log", "why", self.recording, *map(str, more)], text=True,
                              capture_output=True, check=True).stdout

    def why_failed(self, nodes, *options):
        run = self.run_tree(nodes, "--rate", 100, *options)
        self.assertEqual(run.returncode, 1, run.err)
        why = self.why()
        # The summary has the same chain.
        self.assertIn(why.split("\n", 1)[1], run.out)
        return why

    def waits(self, nodes, *texts):
        """Each text is a reason while the tree runs, in this order."""
        run = self.start(nodes, "--max-ticks", 60, "--rate", 100)
        run.communicate(timeout=30)
        said = self.recording.read_text()
        places = [said.find(text) for text in texts]
        self.assertNotIn(-1, places, said)
        self.assertEqual(places, sorted(places))
        return said

    @unittest.skipUnless((SERVERS / "result_server").exists(), "the test interfaces are not built")
    def test_an_error_code_has_its_name_and_its_text(self):
        self.server("--action", "/fetch", "--code", 101, "--text", "the mug is 0.3 m too far",
                    program="result_server")
        why = self.why_failed(f'<RosAction name="f" type="{FETCH}" action="/fetch"/>')
        self.assertIn("f (RosAction): failure: the action '/fetch': aborted: ERROR_OUT_OF_REACH (101): "
                      "the mug is 0.3 m too far\n", why)

    @unittest.skipUnless((SERVERS / "result_server").exists(), "the test interfaces are not built")
    def test_a_code_without_a_constant_is_a_number(self):
        self.server("--action", "/fetch", "--code", 777, program="result_server")
        why = self.why_failed(f'<RosAction name="f" type="{FETCH}" action="/fetch"/>')
        self.assertIn("'/fetch': aborted: error_code 777\n", why)

    @unittest.skipUnless((SERVERS / "result_server").exists(), "the test interfaces are not built")
    def test_without_a_code_and_a_text_the_state_of_the_goal_is_the_reason(self):
        self.server("--action", "/fetch", program="result_server")
        why = self.why_failed(f'<RosAction name="f" type="{FETCH}" action="/fetch" error="{{e}}"/>')
        self.assertIn("f (RosAction): failure: the action '/fetch': aborted\n", why)

    @unittest.skipUnless((SERVERS / "result_server").exists(), "the test interfaces are not built")
    def test_a_code_in_a_message_within_the_result_has_the_constants_of_that(self):
        self.server("--action", "/plan", "--type", "plan", "--code", -1, program="result_server")
        for more in ([], ["--isolate"]):
            self.recording.unlink(missing_ok=True)
            why = self.why_failed(f'<RosAction name="p" type="{PLAN}" action="/plan"/>', *more)
            self.assertIn("'/plan': aborted: PLANNING_FAILED (-1)\n", why)

    @unittest.skipUnless((SERVERS / "result_server").exists(), "the test interfaces are not built")
    def test_a_fault_has_the_words_of_the_server(self):
        self.server("--action", "/fetch", "--code", 100, "--text", "no arm", program="result_server")
        run = self.run_tree(f'<RosAction type="{FETCH}" action="/fetch" on_failure="fault"/>')
        self.assertIn("the action '/fetch': aborted: ERROR_UNKNOWN (100): no arm", run.err)

    @unittest.skipUnless((SERVERS / "result_server").exists(), "the test interfaces are not built")
    def test_a_response_that_does_not_meet_the_condition_tells_why(self):
        self.server("--service", "/open", "--text", "the door is locked", program="result_server")
        why = self.why_failed('<RosService name="s" type="example_interfaces/srv/Trigger" service="/open" '
                              'condition="response.success"/>')
        self.assertIn("s (RosService): failure: the response of '/open' does not meet the condition "
                      "'response.success': the door is locked\n", why)

    def test_a_goal_that_is_rejected_or_canceled_by_others(self):
        self.server("--action", "/a", "--reject")
        self.assertIn("failure: the action '/a': rejected\n", self.why_failed(count("c", "/a")))
        self.server("--action", "/b", "--quit", 2)
        self.recording.unlink()
        self.assertIn("failure: the action '/b': canceled\n", self.why_failed(count("c", "/b")))

    def test_attempts_have_their_reasons(self):
        self.server("--action", "/count", "--reject-order", 5)
        why = self.why_failed(f'<Retry attempts="2">{count("c", "/count")}</Retry>')
        self.assertEqual(why.count(": c: the action '/count': rejected\n"), 2, why)

    def test_what_is_not_there_is_waited_for_and_named(self):
        self.waits(count("c", "/nobody", 5, 'server_timeout="9"'), "waits for the server of '/nobody'")
        self.recording.unlink()
        self.waits('<RosService type="example_interfaces/srv/Trigger" service="/nobody" timeout="9"/>',
                   "waits for the service '/nobody'")
        self.recording.unlink()
        self.waits('<RosLifecycle node="/nobody" transition="activate" timeout="9"/>',
                   "waits for the service '/nobody/change_state'")
        self.recording.unlink()
        self.waits('<RosReceive type="std_msgs/msg/Bool" topic="/nothing"/>', "no message on '/nothing' yet")
        self.recording.unlink()
        why = self.why_failed(count("c", "/nobody", 5, 'server_timeout="0.3"'))
        self.assertIn("the action '/nobody': no server\n", why)

    def test_each_step_of_a_goal_is_said_once(self):
        self.server("--action", "/count", "--step", 150, "--accept-after", 100)
        said = self.waits(count("c", "/count", 100), "waits for the server of '/count'\"",
                          "waits for the server of '/count' to accept the goal",
                          "has accepted the goal, no feedback yet", "has accepted the goal\"")
        self.assertEqual(said.count("has accepted the goal\""), 1)

    def test_the_next_goal_waits_for_the_end_of_the_one_before(self):
        self.server("--action", "/count", "--step", 400)
        said = self.waits(f"""<Retry attempts="2">
          <Timeout seconds="0.3">{count("c", "/count", 100)}</Timeout></Retry>""",
                          "has accepted the goal",
                          "waits for the end of the goal before it at '/count'")
        self.assertEqual(said.count("waits for the end of the goal"), 1)

    def test_a_message_that_does_not_fit_is_the_reason(self):
        publish = '<RosPublish type="std_msgs/msg/Int16" topic="/n" qos="latched" message.data="7"/>'
        why = self.why_failed(f"""<Sequence memory="true">{publish}
          <RosReceive name="r" type="std_msgs/msg/Int16" topic="/n" qos="latched" timeout="0.5"
                      condition="message.data &gt; 10"/></Sequence>""")
        self.assertIn("r (RosReceive): failure: the last message on '/n' does not meet the condition "
                      "'message.data > 10': data: 7\n", why)


if __name__ == "__main__":
    unittest.main()
