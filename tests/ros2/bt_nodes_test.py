"""Classes in the style of BehaviorTree.ROS2 against real servers."""

from world import SERVERS, World


class BtNodes(World):
    plugins = ("bt_nodes", "bt_one_node")
    plugin_paths = (SERVERS,)

    @staticmethod
    def count(name, action, order, more=""):
        return f'<Count name="{name}" action_name="{action}" order="{order}" {more}/>'

    def test_an_action_succeeds(self):
        server = self.server("--action", "/count")
        run = self.run_tree(self.count("c", "/count", 5))
        self.assertEqual(run.returncode, 0, run.err)
        self.assertIn("succeeded 5", server.lines)
        self.assertEqual(sorted(set(self.progress("c").values()))[-2:], [0.8, 1])

    def failure(self, node, words):
        run = self.run_tree(f"""<Sequence memory="true"><Inverter>{node}</Inverter>
          <Check code="why == '{words}'"/></Sequence>""")
        self.assertEqual(run.returncode, 0, (run.err, self.recording.read_text()[-1500:]))

    def test_an_action_fails(self):
        for options, words in ((["--reject"], "GOAL_REJECTED_BY_SERVER"),
                               (["--abort", 2], "ACTION_ABORTED"),
                               (["--quit", 2], "ACTION_CANCELLED")):
            server = self.server("--action", "/count", *options)
            self.failure(self.count("c", "/count", 5, 'why="{why}"'), words)
            server.stop()
        self.failure(self.count("c", "/count", -1, 'why="{why}"'), "INVALID_GOAL")
        self.failure(self.count("c", "/nobody", 1, 'why="{why}"'), "SERVER_UNREACHABLE")

    def test_feedback_may_end_an_action(self):
        server = self.server("--action", "/count")
        run = self.run_tree(self.count("c", "/count", 1000, 'stop_at="3"') )
        self.assertEqual(run.returncode, 0, run.err)
        server.wait_for("cancel")

    def test_halt_cancels(self):
        server = self.server("--action", "/count")
        self.run_tree(f'<Timeout seconds="0.5">{self.count("c", "/count", 1000)}</Timeout>')
        server.wait_for("cancel")

    def test_held_at_a_barrier(self):
        fast = self.server("--action", "/fast", "--step", 20, "--keep")
        self.server("--action", "/slow", "--step", 60)
        run = self.run_tree(f"""<ParallelAbsolute barriers="0.5">{self.count("fast", "/fast", 20)}
          {self.count("slow", "/slow", 20)}</ParallelAbsolute>""")
        self.assertEqual(run.returncode, 0, run.err)
        quick, slow = self.progress("fast"), self.progress("slow")
        # A barrier and a step; without it, 0.67. How much less it is depends on the machine.
        self.assertLessEqual(max(abs(quick[at] - slow[at]) for at in quick.keys() & slow.keys()), 0.56)
        self.assertGreaterEqual(fast.lines.count("goal 20"), 2)

    def test_a_service(self):
        server = self.server("--action", "/c", "--hold-service", "/still")
        run = self.run_tree('<Hold service_name="/still" held="true"/>')
        self.assertEqual(run.returncode, 0, run.err)
        server.wait_for("hold")
        self.failure('<Hold service_name="/nobody" held="true" why="{why}"/>',
                     "SERVICE_UNREACHABLE")

    def test_topics(self):
        run = self.run_tree("""<Timeout seconds="5"><Parallel success_count="1" failure_count="2">
          <Repeat><Say topic_name="/said" data="true"/></Repeat>
          <Retry attempts="1000"><Hear topic_name="/said"/></Retry></Parallel></Timeout>""")
        self.assertEqual(run.returncode, 0, run.err)

    def test_a_plugin_with_one_node(self):
        run = self.run_tree("""<Timeout seconds="5"><Parallel success_count="1" failure_count="2">
          <Repeat><SayTrue topic_name="/one"/></Repeat>
          <Retry attempts="1000"><Hear topic_name="/one"/></Retry></Parallel></Timeout>""")
        self.assertEqual(run.returncode, 0, run.err)


if __name__ == "__main__":
    import unittest

    unittest.main()
