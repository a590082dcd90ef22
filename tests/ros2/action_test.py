"""RosAction against servers that do all that servers do."""

import signal
import time

from world import World, count


class Action(World):
    def test_success_brings_the_result(self):
        self.server("--action", "/count")
        run = self.run_tree(count("c", "/count", 5, 'result.sequence="{all}"'))
        self.assertEqual(run.returncode, 0, run.err)
        self.assertIn("1;2;3;4;5", self.recording.read_text())

    def test_the_whole_result_is_an_object(self):
        self.server("--action", "/count")
        run = self.run_tree(count("c", "/count", 5, 'result="{whole}" goal="{none}"'))
        self.assertEqual(run.returncode, 0, run.err)
        self.assertIn("sequence: 5 items", self.recording.read_text())

    def test_in_a_separate_process(self):
        self.server("--action", "/count")
        run = self.run_tree(count("c", "/count", 5, 'result.sequence="{all}"'), "--isolate")
        self.assertEqual(run.returncode, 0, run.err)
        self.assertIn("1;2;3;4;5", self.recording.read_text())

    def test_progress_is_that_of_the_expression(self):
        self.server("--action", "/count", "--step", 50)
        run = self.run_tree(count("c", "/count", 5))
        self.assertEqual(run.returncode, 0, run.err)
        seen = sorted(set(self.progress("c").values()))
        self.assertEqual(seen[:5], [0, 0.2, 0.4, 0.6, 0.8])

    def failure(self, server, words, *options):
        self.server("--action", "/count", *server)
        run = self.run_tree(f"""<Sequence memory="true">
          <Inverter>{count("c", "/count", 5, 'error="{why}" ' + " ".join(options))}</Inverter>
          <Check code="why == '{words}'"/></Sequence>""")
        self.assertEqual(run.returncode, 0, run.err)

    def test_rejected(self):
        self.failure(["--reject"], "rejected")

    def test_aborted(self):
        self.failure(["--abort", 2], "aborted")

    def test_why_it_fails_is_said_where_no_entry_takes_it(self):
        self.server("--action", "/count", "--abort", 2)
        run = self.run_tree(count("c", "/count"))
        self.assertIn("c: info: the action '/count': aborted", run.err)
        run = self.run_tree(count("c", "/count", 5, 'error="{why}"'))
        self.assertNotIn("info", run.err)

    def test_a_server_that_is_killed_is_noticed(self):
        self.failure(["--die", 2], "server lost")

    def test_a_server_that_ends_is_noticed_soon(self):
        server = self.server("--action", "/count", "--step", 100)
        run = self.start(count("c", "/count", 100, 'on_failure="fault"'))
        server.wait_for("goal 100")
        time.sleep(0.25)  # between two steps: a server that publishes while it ends throws
        server.stop()
        began = time.monotonic()
        _, err = run.communicate(timeout=20)
        self.assertLess(time.monotonic() - began, 3)
        self.assertIn("the action '/count': server lost", err)

    def test_absent(self):
        began = time.monotonic()
        run = self.run_tree(count("c", "/nobody", 5, 'server_timeout="0.5" on_failure="fault"'))
        self.assertLess(time.monotonic() - began, 5)
        self.assertIn("the action '/nobody': no server", run.err)

    def test_an_action_of_another_name(self):
        self.server("--action", "/left/count")
        run = self.run_tree(f"""<Retry attempts="2">{count("c", "/count", 5, 'server_timeout="0.7" error="{why}"')}</Retry>""")
        said = "there is no action '/count'; of its type there is '/left/count'"
        self.assertEqual(run.err.count(said), 1, run.err)

    def test_an_action_of_another_type(self):
        self.server("--action", "/count")
        run = self.run_tree('<RosAction type="lockstep_ros/action/RunTree" action="/count" server_timeout="0.7"/>')
        self.assertIn("the action '/count' is of the type example_interfaces/action/Fibonacci, not "
                      "lockstep_ros/action/RunTree", run.err)

    def test_late(self):
        run = self.start(count("c", "/count"))
        time.sleep(0.5)
        self.server("--action", "/count")
        _, err = run.communicate(timeout=20)
        self.assertEqual(run.returncode, 0, err)

    def test_halt_cancels(self):
        server = self.server("--action", "/count")
        run = self.run_tree(f'<Timeout seconds="0.5">{count("c", "/count", 1000)}</Timeout>')
        server.wait_for("cancel")
        server.wait_for(next(line for line in server.lines if line.startswith("cancel")))
        self.assertTrue(any(line.startswith("canceled") for line in server.lines), server.lines)
        self.assertNotEqual(run.returncode, 0)

    def test_halted_before_it_is_accepted_it_is_canceled_then(self):
        server = self.server("--action", "/count", "--accept-after", 500)
        self.run_tree(f'<Timeout seconds="0.2">{count("c", "/count", 1000)}</Timeout>')
        server.wait_for("goal 1000")
        server.wait_for("cancel")
        self.assertTrue(any(line.startswith("canceled") for line in server.lines), server.lines)

    def test_accepted_long_after_the_halt_it_does_not_stay_at_work(self):
        server = self.server("--action", "/count", "--accept-after", 2000)
        run = self.run_tree(f"""<Sequence memory="true">
          <Inverter><Timeout seconds="0.2">{count("c", "/count", 1000)}</Timeout></Inverter>
          <Wait seconds="3"/></Sequence>""")
        self.assertIn("has not accepted the goal within 1 s of the cancel", run.err)
        server.wait_for("cancel")

    def test_halted_twice_before_the_first_goal_is_accepted(self):
        server = self.server("--action", "/count", "--accept-after", 600)
        goal = f'<Timeout seconds="0.1">{count("c", "/count", 1000)}</Timeout>'
        self.run_tree(f"""<Sequence memory="true"><Inverter>{goal}</Inverter>
          <Inverter>{goal}</Inverter><Wait seconds="2"/></Sequence>""")
        server.wait_for("cancel")
        goals = [line for line in server.lines if line.startswith("goal")]
        ended = [line for line in server.lines if line.startswith("canceled")]
        self.assertEqual(len(goals), len(ended), server.lines)

    def test_halted_while_it_connects_it_sends_no_goal(self):
        run = self.start(f"""<Sequence memory="true">
          <Inverter><Timeout seconds="0.3">{count("c", "/count", 1000)}</Timeout></Inverter>
          <Wait seconds="2"/>{count("d", "/count", 3)}</Sequence>""")
        time.sleep(0.8)
        server = self.server("--action", "/count")
        _, err = run.communicate(timeout=20)
        self.assertEqual(run.returncode, 0, err)
        self.assertEqual([line for line in server.lines if line.startswith("goal")], ["goal 3"])

    def test_refused_cancel_is_said(self):
        self.server("--action", "/count", "--refuse")
        run = self.run_tree(f'<Timeout seconds="0.5">{count("c", "/count", 1000)}</Timeout>')
        self.assertIn("refuses to cancel the goal", run.err)

    def test_an_interrupt_cancels(self):
        for number in (signal.SIGINT, signal.SIGTERM):
            server = self.server("--action", "/count")
            run = self.start(count("c", "/count", 1000))
            server.wait_for("goal 1000")
            time.sleep(0.2)
            run.send_signal(number)
            run.communicate(timeout=20)
            server.wait_for("cancel")
            server.stop()

    def test_an_interrupt_twice_ends_at_once(self):
        server = self.server("--action", "/count", "--refuse")
        run = self.start(count("c", "/count", 1000))
        server.wait_for("goal 1000")
        run.send_signal(signal.SIGTERM)
        run.send_signal(signal.SIGTERM)
        began = time.monotonic()
        run.communicate(timeout=20)
        self.assertLess(time.monotonic() - began, 3)

    def changing(self, more, step=20, reject=None, then="3"):
        """A run whose goal is 1000, and another one after half a second."""
        server = self.server("--action", "/count", "--step", step, "--preempt",
                             *(("--reject-order", reject) if reject else ()))
        leaf = count("c", "/count", "{n}", "preempt=" + f'"{more}" error="{{why}}"')
        run = self.run_tree(f"""<Sequence memory="true"><Script code="n := 1000; why := ''"/>
          <Timeout seconds="4"><Parallel success_count="1" failure_count="1">{leaf}
            <Sequence memory="true"><Wait seconds="0.5"/><Script code="n := {then}"/><Wait seconds="9"/></Sequence>
          </Parallel></Timeout></Sequence>""")
        return server, run

    def test_a_goal_that_changes_takes_the_place_of_the_one_at_work(self):
        server, run = self.changing("true")
        self.assertEqual(run.returncode, 0, run.err)
        goals = [line for line in server.lines if line.startswith("goal")]
        self.assertEqual(goals, ["goal 1000", "goal 3"])
        self.assertIn("succeeded 3", server.lines)
        self.assertTrue(any(line.startswith("preempted") for line in server.lines), server.lines)
        self.assertNotIn("cancel", server.lines)
        self.assertNotIn("its progress fell", run.err)

    def test_without_preempt_the_goal_stays(self):
        server, run = self.changing("false")
        self.assertEqual(run.returncode, 1, run.err)
        self.assertEqual([line for line in server.lines if line.startswith("goal")], ["goal 1000"])

    def test_an_entry_that_is_set_to_what_it_is_changes_no_goal(self):
        server, run = self.changing("true", then="n + 0")
        self.assertEqual([line for line in server.lines if line.startswith("goal")], ["goal 1000"])

    def test_a_goal_that_is_rejected_leaves_none_at_work(self):
        server, run = self.changing("true", reject=3)
        self.assertEqual(run.returncode, 1, run.err)
        self.assertIn('"rejected"', self.recording.read_text())
        server.wait_for("cancel")

    def test_a_goal_that_changes_while_it_is_held_is_sent_when_ticks_come_again(self):
        server = self.server("--action", "/fast", "--step", 10, "--keep", "--preempt")
        self.server("--action", "/slow", "--step", 60)
        run = self.run_tree(f"""<Sequence memory="true"><Script code="n := 20"/>
          <Parallel success_count="2"><ParallelAbsolute barriers="0.5">
            {count("fast", "/fast", "{n}", 'hold="cancel" preempt="true"')}
            {count("slow", "/slow", 20, 'hold="nothing"')}</ParallelAbsolute>
            <Sequence memory="true"><Wait seconds="0.7"/><Script code="n := 30"/></Sequence>
          </Parallel></Sequence>""")
        self.assertEqual(run.returncode, 0, run.err)
        self.assertIn("goal 30", server.lines)
        self.assertEqual(server.lines[-1], "succeeded 30")

    def test_two_leaves_at_one_action(self):
        server = self.server("--action", "/count", "--step", 10)
        pair = count("a", "/count", 10) + count("b", "/count", 20)
        run = self.run_tree(f'<Parallel success_count="2">{pair}</Parallel>')
        self.assertEqual(run.returncode, 0, run.err)
        self.assertIn("succeeded 10", server.lines)
        self.assertIn("succeeded 20", server.lines)

    def test_canceled_by_somebody_else(self):
        self.server("--action", "/count", "--quit", 2)
        run = self.run_tree(count("c", "/count", 100, 'on_failure="fault"'))
        self.assertIn("the action '/count': canceled", run.err)

    def test_begun_again_after_a_halt(self):
        server = self.server("--action", "/count")
        run = self.run_tree(f"""<Sequence memory="true">
          <Inverter><Timeout seconds="0.3">{count("a", "/count", 1000)}</Timeout></Inverter>
          {count("b", "/count", 3)}</Sequence>""")
        self.assertEqual(run.returncode, 0, run.err)
        self.assertIn("succeeded 3", server.lines)

    def test_many_goals_in_a_row(self):
        self.server("--action", "/count", "--step", 2)
        run = self.run_tree(f'<Repeat times="100">{count("c", "/count", 1)}</Repeat>', seconds=60)
        self.assertEqual(run.returncode, 0, run.err)


class Held(World):
    """Two servers, one three times as slow, over a barrier at the half."""

    def pair(self, hold, *slow):
        self.fast = self.server("--action", "/fast", "--step", 20, *slow)
        self.slow = self.server("--action", "/slow", "--step", 60)
        nodes = (count("fast", "/fast", 20, hold) + count("slow", "/slow", 20, hold))
        run = self.run_tree(f'<ParallelAbsolute barriers="0.5">{nodes}</ParallelAbsolute>')
        self.assertEqual(run.returncode, 0, run.err)
        fast, slow = self.progress("fast"), self.progress("slow")
        self.spread = max(abs(fast[tick] - slow[tick]) for tick in fast.keys() & slow.keys())
        return run

    def test_nothing_lets_the_robot_go_on(self):
        run = self.pair('hold="nothing"')
        self.assertGreater(self.spread, 0.55)
        self.assertIn("continued while it was held", run.out)

    def test_cancel_and_send_again_to_a_robot_that_has_a_position(self):
        self.pair('hold="cancel"', "--keep")
        self.assertLess(self.spread, 0.45)
        self.assertGreaterEqual(self.fast.lines.count("goal 20"), 2)

    def test_a_server_that_begins_again_is_named(self):
        self.server("--action", "/fast", "--step", 20)
        self.server("--action", "/slow", "--step", 60)
        pair = count("fast", "/fast", 20, 'hold="cancel"') + count("slow", "/slow", 20,
                                                                   'hold="cancel"')
        # The two would hold each other in turn for ever.
        run = self.run_tree(f'<ParallelAbsolute barriers="0.5">{pair}</ParallelAbsolute>',
                            "--timeout", 4)
        self.assertIn("after the goal was sent again: the server begins where it began first",
                      run.err + run.out)

    def test_a_service_that_is_not_there_is_named(self):
        run = self.pair('hold="service:/nobody" hold_type="example_interfaces/srv/SetBool"')
        self.assertIn("there is no service '/nobody': the robot goes on", run.err + run.out)

    def test_a_server_that_refuses_to_cancel_is_named(self):
        run = self.pair('hold="cancel"', "--refuse")
        self.assertIn("refuses to cancel the goal: the robot goes on", run.err + run.out)

    def test_a_topic_tells_the_robot(self):
        self.pair('hold="topic:/still"', "--hold-topic", "/still")
        self.assertLess(self.spread, 0.45)
        self.assertIn("hold", self.fast.lines)
        self.assertIn("go on", self.fast.lines)
        self.assertEqual(self.fast.lines.count("goal 20"), 1)

    def test_halted_while_it_is_held_it_is_told_that_it_is_not(self):
        for told, more in (("topic:/still", ""),
                           ("service:/still", 'hold_type="example_interfaces/srv/SetBool"')):
            fast = self.server("--action", "/fast", "--step", 10, f"--hold-{told.split(':')[0]}", "/still")
            slow = self.server("--action", "/slow", "--step", 200)
            nodes = count("fast", "/fast", 20, f'hold="{told}" {more}') + count("slow", "/slow", 20)
            self.run_tree(f'<Timeout clock="wall" seconds="1"><ParallelAbsolute barriers="0.5">{nodes}'
                          f'</ParallelAbsolute></Timeout>')
            fast.wait_for("go on")
            told = [line.split()[0] for line in fast.lines if line.split()[0] in ("hold", "canceled", "go")]
            self.assertEqual(told, ["hold", "canceled", "go"])
            fast.stop()
            slow.stop()

    def test_a_service_tells_the_robot(self):
        self.pair('hold="service:/still" hold_type="example_interfaces/srv/SetBool"',
                  "--hold-service", "/still")
        self.assertLess(self.spread, 0.45)
        self.assertIn("hold", self.fast.lines)
        self.assertIn("go on", self.fast.lines)


class Check(World):
    def errors(self, attributes):
        run = self.check(f"<RosAction {attributes}/>")
        self.assertNotEqual(run.returncode, 0)
        return run.stdout + run.stderr

    FIBONACCI = 'type="example_interfaces/action/Fibonacci" action="/count"'

    def test_a_field_that_is_not_there(self):
        self.assertRegex(self.errors(self.FIBONACCI + ' goal.ordr="3"'),
                         r"(?s)2:\d+.*no parameter 'goal.ordr'.*did you mean 'goal.order'\?")

    def test_a_value_that_does_not_fit(self):
        self.assertIn("2147483647", self.errors(self.FIBONACCI + ' goal.order="4000000000"'))

    def test_types_that_are_not_there(self):
        for name, what in (("example_interfaces/action/Fibo", "has no action 'Fibo'"),
                           ("no_such/action/X", "there is no package 'no_such'"),
                           ("Fibonacci", "is not the name of a type of actions")):
            self.assertIn(what, self.errors(f'type="{name}" action="/count"'))

    def test_progress_that_cannot_be_read(self):
        for text, what in (("feedback.sequenze", "did you mean 'feedback.sequence'?"),
                           ("feedback.sequence", "is no number"),
                           ("1 +", "ends too early"), ("nonsense", "knows no 'nonsense'")):
            self.assertIn(what, self.errors(f'{self.FIBONACCI} progress="{text}"'))

    def test_a_robot_that_may_be_held_and_goes_on(self):
        pair = f"<RosAction name='a' {self.FIBONACCI}/><RosAction name='b' {self.FIBONACCI} "
        for hold, what in (("", "'b' may be held by 'ParallelAbsolute', and does not declare"),
                           ("hold='nothing'", "holds 'b', the robot continues")):
            run = self.check(f"<ParallelAbsolute barriers='0.5'>{pair}{hold}/></ParallelAbsolute>")
            self.assertEqual(run.returncode, 0)
            self.assertIn(what, run.stdout + run.stderr)

    def test_a_way_to_hold_that_is_none(self):
        self.assertIn("is no way to hold", self.errors(self.FIBONACCI + ' hold="softly"'))


if __name__ == "__main__":
    import unittest

    unittest.main()
