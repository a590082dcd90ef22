"""RosAction after a cut: lockstep is killed, and another process continues the run."""

import signal
import time
import unittest

from world import World, count

SERVICE = 'hold="service:/still" hold_type="example_interfaces/srv/SetBool"'


class Resume(World):
    def checkpoint(self, *options):
        return ("--checkpoint", self.directory / "run.checkpoint", "--resume", *options)

    def cut(self, nodes, server, line, *options):
        """A run that is killed when the server has printed the line."""
        run = self.start(nodes, *self.checkpoint(*options))
        server.wait_for(line)
        time.sleep(0.1)  # the checkpoint follows its tick within 10 ms
        self.assertIsNone(run.poll(), run.communicate() if run.poll() is not None else "")
        run.kill()
        run.communicate()

    def resume(self, nodes, *options, code=0):
        run = self.run_tree(nodes, *self.checkpoint(*options))
        self.assertEqual(run.returncode, code, run.err)
        self.assertIn("resumed after", run.err)
        return run

    def goals(self, server):
        return [line for line in server.lines if line.startswith("goal")]

    def counting(self, *options, action="/count", step=50):
        return self.server("--action", action, "--step", step, "--tell", *options)

    # The server lives

    def test_a_goal_at_work_is_not_sent_again(self):
        server = self.counting()
        leaf = count("c", "/count", 40, 'result.sequence="{all}"')
        self.cut(leaf, server, "at 10")
        run = self.resume(leaf)
        self.assertIn("c' continues at 0.", run.err)
        self.assertEqual(self.goals(server), ["goal 40"])
        self.assertIn("succeeded 40", server.lines)
        self.assertNotIn("cancel", server.lines)
        self.assertIn("38;39;40", "".join(file.read_text() for file in self.directory.glob("run*.jsonl")))

    def test_its_progress_continues(self):
        server = self.counting()
        leaf = count("c", "/count", 40)
        self.cut(leaf, server, "at 20")
        self.resume(leaf)
        seen = [value for _, value in sorted(self.progress("c").items())]
        self.assertGreater(len(seen), 10)
        self.assertEqual(seen, sorted(seen))

    def test_what_first_remembers_is_kept(self):
        server = self.counting()
        leaf = count("c", "/count", 40).replace(
            "size(feedback.sequence) / goal.order",
            "(size(feedback.sequence) - first(size(feedback.sequence))) / (goal.order - 1)")
        self.cut(leaf, server, "at 20")
        self.resume(leaf)
        seen = [value for _, value in sorted(self.progress("c").items())]
        self.assertEqual(seen, sorted(seen))

    def test_a_goal_that_succeeds_during_the_gap(self):
        server = self.counting()
        leaf = count("c", "/count", 20, 'result.sequence="{all}"')
        self.cut(leaf, server, "at 10")
        server.wait_for("succeeded 20")
        self.resume(leaf)
        self.assertEqual(self.goals(server), ["goal 20"])
        self.assertIn("18;19;20", "".join(file.read_text() for file in self.directory.glob("run*.jsonl")))

    def test_a_goal_that_is_canceled_during_the_gap(self):
        server = self.counting("--quit", 20)
        leaf = count("c", "/count", 40, 'on_failure="fault"')
        self.cut(leaf, server, "at 10")
        server.wait_for("canceled 20")
        run = self.resume(leaf, code=5)
        self.assertIn("the action '/count': canceled", run.err)
        self.assertEqual(self.goals(server), ["goal 40"])

    def test_a_goal_that_is_aborted_during_the_gap(self):
        server = self.counting("--abort", 20)
        leaf = count("c", "/count", 40, 'on_failure="fault"')
        self.cut(leaf, server, "at 10")
        server.wait_for("aborted 20")
        run = self.resume(leaf, code=5)
        self.assertIn("the action '/count': aborted", run.err)

    def test_a_goal_that_was_not_accepted_yet(self):
        server = self.counting("--accept-after", 1000)
        leaf = count("c", "/count", 20)
        self.cut(leaf, server, "goal 20")
        self.resume(leaf)
        self.assertEqual(self.goals(server), ["goal 20"])

    def test_a_goal_that_is_rejected_during_the_gap_is_sent_again(self):
        server = self.counting("--accept-after", 500, "--reject")
        leaf = count("c", "/count", 20, 'on_failure="fault"')
        self.cut(leaf, server, "goal 20")
        run = self.resume(leaf, code=5)
        self.assertEqual(self.goals(server), ["goal 20"] * 2)
        self.assertIn("the action '/count': rejected", run.err)

    def test_cut_three_times(self):
        server = self.counting()
        leaf = count("c", "/count", 60)
        for step in (10, 20, 30):
            self.cut(leaf, server, f"at {step}")
        self.resume(leaf, "--resume-limit", 9)
        self.assertEqual(self.goals(server), ["goal 60"])

    def test_cut_again_before_the_server_has_answered(self):
        server = self.counting()
        leaf = count("c", "/count", 60)
        self.cut(leaf, server, "at 10")
        for _ in range(3):
            run = self.start(leaf, *self.checkpoint("--resume-limit", 9))
            run.stderr.readline()
            run.kill()
            run.communicate()
        self.resume(leaf, "--resume-limit", 9)
        self.assertEqual(self.goals(server), ["goal 60"])

    def test_halted_after_it_has_continued(self):
        server = self.counting()
        leaf = count("c", "/count", 1000)
        self.cut(leaf, server, "at 10")
        run = self.start(leaf, *self.checkpoint())
        self.assertIn("resumed after", run.stderr.readline())
        seen = int(server.lines[-1].split()[1])
        server.wait_for(f"at {seen + 20}")
        run.send_signal(signal.SIGTERM)
        run.communicate(timeout=20)
        server.wait_for("cancel")
        self.assertTrue(server.lines[-1].startswith("canceled"), server.lines[-3:])

    def test_halted_before_the_server_is_found(self):
        server = self.counting()
        leaf = count("c", "/count", 1000)
        self.cut(leaf, server, "at 10")
        run = self.start(leaf, *self.checkpoint())
        run.stderr.readline()
        run.send_signal(signal.SIGTERM)
        _, err = run.communicate(timeout=20)
        server.wait_for("cancel")
        self.assertTrue(server.lines[-1].startswith("canceled"), server.lines[-3:])
        self.assertNotIn("there is no server", err)

    def test_in_a_separate_process(self):
        server = self.counting()
        leaf = count("c", "/count", 40)
        self.cut(leaf, server, "at 10", "--isolate")
        self.resume(leaf, "--isolate")
        self.assertEqual(self.goals(server), ["goal 40"])
        self.assertNotIn("cancel", server.lines)

    def test_a_goal_keeps_what_it_was_sent_with(self):
        server = self.counting()
        nodes = f"""<Sequence memory="true"><Script code="n := 40"/>
          <Parallel success_count="1"><Sequence memory="true">{count("c", "/count", "{n}")}</Sequence>
            <Sequence memory="true"><Wait seconds="0.2"/><Script code="n := 10"/><Wait seconds="60"/></Sequence>
          </Parallel></Sequence>"""
        self.cut(nodes, server, "at 10")
        self.resume(nodes)
        self.assertLess(max(self.progress("c").values()), 1.01)
        self.assertEqual(self.goals(server), ["goal 40"])
        self.assertIn(0.5, self.progress("c").values())  # 20 of 40

    @staticmethod
    def changing(seconds, n):
        """A goal of 1000, which becomes another one after a time."""
        leaf = count("c", "/count", "{n}", 'preempt="true"')
        return f"""<Sequence memory="true"><Script code="n := 1000"/>
          <Parallel success_count="1">{leaf}
            <Sequence memory="true"><Wait seconds="{seconds}"/><Script code="n := {n}"/><Wait seconds="60"/></Sequence>
          </Parallel></Sequence>"""

    def test_a_goal_that_has_changed_is_not_sent_a_third_time(self):
        server = self.counting("--preempt")
        nodes = self.changing(0.5, 30)
        self.cut(nodes, server, "goal 30")
        self.resume(nodes)
        self.assertEqual(self.goals(server), ["goal 1000", "goal 30"])

    def test_a_goal_that_changes_after_the_cut_takes_its_place(self):
        server = self.counting("--preempt")
        nodes = self.changing(1.5, 3)
        self.cut(nodes, server, "at 5")
        self.resume(nodes)
        self.assertEqual(self.goals(server), ["goal 1000", "goal 3"])
        self.assertTrue(any(line.startswith("preempted") for line in server.lines))

    # The server does not know the goal

    def another(self, leaf, *options, **more):
        """Killed with its server; another server takes its place."""
        server = self.counting()
        self.cut(leaf, server, "at 10")
        server.stop(signal.SIGKILL)
        server = self.counting()
        return server, self.resume(leaf, *options, **more)

    def test_another_server_gets_the_goal_again(self):
        server, run = self.another(count("c", "/count", 20))
        self.assertIn("the server of '/count' does not know the goal that was sent before the cut: "
                      "it is sent again", run.err)
        self.assertEqual(self.goals(server), ["goal 20"])
        self.assertNotIn("hold=", run.err)
        self.assertIn(0, self.progress("c").values())

    def test_another_server_and_on_resume(self):
        server, run = self.another(count("c", "/count", 20, 'on_resume="failure" on_failure="fault"'), code=5)
        self.assertIn("the action '/count': goal unknown", run.err)
        self.assertEqual(self.goals(server), [])
        server.stop()
        server, run = self.another(count("c", "/count", 20), "--on-resume", "success")
        self.assertIn("it counts as succeeded", run.err)
        self.assertEqual(self.goals(server), [])

    def test_no_server(self):
        server = self.counting()
        leaf = count("c", "/count", 20, 'server_timeout="0.5" on_failure="fault"')
        self.cut(leaf, server, "at 10")
        server.stop(signal.SIGKILL)
        run = self.resume(leaf, code=5)
        self.assertIn("the action '/count': no server", run.err)

    def test_a_server_that_comes_late(self):
        server = self.counting()
        leaf = count("c", "/count", 20)
        self.cut(leaf, server, "at 10")
        server.stop(signal.SIGKILL)
        run = self.start(leaf, *self.checkpoint())
        run.stderr.readline()
        server = self.counting()
        _, err = run.communicate(timeout=20)
        self.assertEqual(run.returncode, 0, err)
        self.assertEqual(self.goals(server), ["goal 20"])

    # At a barrier

    def held(self, hold, line, *fast):
        """The fast robot is held at the barrier; lockstep is killed there, and resumed."""
        self.fast = self.counting(*fast, action="/fast", step=20)
        self.slow = self.counting(action="/slow", step=100)
        nodes = (f'<ParallelAbsolute barriers="0.5">{count("fast", "/fast", 20, hold)}'
                 f'{count("slow", "/slow", 20, hold if "cancel" in hold else "")}</ParallelAbsolute>')
        self.cut(nodes, self.fast, line)
        before = len(self.fast.lines)
        run = self.start(nodes, *self.checkpoint())
        if "nothing" not in hold:
            self.slow.wait_for("at 9")
            still = [word for word in self.fast.lines[before:] if word not in ("hold", "pace 0.000")]
            self.assertEqual(still, [], "it holds still until the other one is there")
        _, err = run.communicate(timeout=30)
        self.assertEqual(run.returncode, 0, err)
        self.assertEqual(self.goals(self.slow), ["goal 20"])
        self.assertIn("succeeded 20", self.fast.lines)
        return self.fast.lines[before:]

    def test_held_by_a_cancel_it_is_sent_again_when_it_gets_its_next_tick(self):
        after = self.held('hold="cancel"', "canceled 10", "--keep")
        self.assertEqual(self.goals(self.fast), ["goal 20"] * 2)
        self.assertEqual(after[0], "goal 20")

    def test_held_by_nothing(self):
        self.held('hold="nothing"', "at 15")
        self.assertEqual(self.goals(self.fast), ["goal 20"])

    def test_held_by_a_service_it_is_told_again(self):
        after = self.held(SERVICE, "hold", "--hold-service", "/still")
        self.assertEqual(self.goals(self.fast), ["goal 20"])
        self.assertEqual([line for line in after if not line.startswith("at")][:2], ["hold", "go on"])

    def test_held_by_a_topic_it_is_told_again(self):
        after = self.held('hold="topic:/still"', "hold", "--hold-topic", "/still")
        self.assertEqual(self.goals(self.fast), ["goal 20"])
        self.assertEqual([line for line in after if not line.startswith("at")][:2], ["hold", "go on"])

    def test_held_by_its_pace_it_gets_0_again(self):
        after = self.held('hold="pace" pace="topic:/slow" pace_type="std_msgs/msg/Float64"', "pace 0.000",
                          "--pace", "real:/slow")
        self.assertEqual(self.goals(self.fast), ["goal 20"])
        self.assertEqual([line for line in after if line.startswith("pace")], ["pace 0.000", "pace 1.000"])

    def test_held_and_another_server(self):
        fast = self.counting("--keep", action="/fast", step=20)
        slow = self.counting(action="/slow", step=100)
        nodes = (f'<ParallelAbsolute barriers="0.5">{count("fast", "/fast", 20, "hold=" + chr(34) + "cancel" + chr(34))}'
                 f'{count("slow", "/slow", 20)}</ParallelAbsolute>')
        self.cut(nodes, fast, "canceled 10")
        fast.stop(signal.SIGKILL)
        fast = self.counting("--keep", action="/fast", step=20)
        self.resume(nodes)
        self.assertEqual(self.goals(slow), ["goal 20"])
        self.assertEqual(self.goals(fast), ["goal 20"])

    # A robot that is slow

    def test_a_robot_that_was_slowed_gets_its_pace_back(self):
        for options, pace, value in (
                (("--pace", "real:/slow", "--panel", 0.6), 'pace="topic:/slow" pace_type="std_msgs/msg/Float64"', 0.6),
                (("--node", "robot"), 'pace="parameter:/robot/speed" pace_value="0.5 * factor"', 1)):
            fast = self.counting(*options, action="/fast", step=15)
            slow = self.counting(action="/slow", step=40)
            hold = 'hold="nothing"'
            nodes = (f'<ParallelRelative delta="0.1" pace="true" reaction="0.2">{count("fast", "/fast", 60, pace)}'
                     f'{count("slow", "/slow", 60, hold)}</ParallelRelative>')
            self.cut(nodes, fast, "at 20")
            told = [line for line in fast.lines if line.startswith("pace")]
            self.assertLess(float(told[-1].split()[1]), 0.9 * value, told)
            self.resume(nodes)
            fast.wait_for("succeeded 60")
            told = [float(line.split()[1]) for line in fast.lines if line.startswith("pace")]
            self.assertEqual(told[-1], value, told)
            self.assertEqual(self.goals(fast), ["goal 60"])
            fast.stop()
            slow.stop()


if __name__ == "__main__":
    unittest.main()
