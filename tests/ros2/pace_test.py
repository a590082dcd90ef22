"""RosAction below a node with pace="true": what a robot is told, and what it is told at the end."""

import signal
import time
import unittest

from world import World, count, has

REAL = 'pace="topic:/slow" pace_type="std_msgs/msg/Float64"'


class Pace(World):
    def told(self):
        """What the fast robot was told, in order."""
        return [float(line.split()[1]) for line in self.fast.lines if line.startswith("pace")]

    def robots(self, *options, step=15):
        self.fast = self.server("--action", "/fast", "--step", step, *options)
        self.slow = self.server("--action", "/slow", "--step", 40)

    def pair(self, pace, order=40, node='ParallelRelative delta="0.1"', slow_order=None):
        return (f'<{node} pace="true" reaction="0.2">'
                f'{count("fast", "/fast", order, pace)}'
                f'{count("slow", "/slow", slow_order or order, "hold=" + chr(34) + "nothing" + chr(34))}'
                f'</{node.split()[0]}>')

    def run_pair(self, pace, *options, **more):
        run = self.run_tree(self.pair(pace, **more), *options)
        self.assertEqual(run.returncode, 0, run.err)
        return run

    def restored(self, to=1.0):
        """The robot was slow, and has now what it had."""
        self.fast.wait_for(f"pace {to:.3f}")
        told = self.told()
        self.assertEqual(told[-1], to, told)
        self.assertLess(min(told), 0.8 * to, told)
        return told

    # What it is told

    def test_a_topic(self):
        self.robots("--pace", "real:/slow")
        self.run_pair(REAL + ' hold="nothing"')
        told = self.restored()
        self.assertLess(abs(sorted(told)[len(told) // 2] - 0.375), 0.2, told)
        fast, slow = self.progress("fast"), self.progress("slow")
        self.assertLess(max(abs(fast[tick] - slow[tick]) for tick in fast.keys() & slow.keys()), 0.35)

    def test_a_percent_of_whole_numbers(self):
        self.robots("--pace", "percent:/slow")
        self.run_pair('pace="topic:/slow" pace_type="std_msgs/msg/Int16" pace_value="100 * factor"')
        self.restored()

    def test_a_service_and_another_field_of_it(self):
        self.robots("--pace", "sum:/slow")
        self.run_pair('pace="service:/slow" pace_type="example_interfaces/srv/AddTwoInts" '
                      'pace_value="100 * factor" request.b="3"')
        self.restored()

    def test_a_parameter_has_what_was_found(self):
        for name, value, found in (("speed", "0.5 * factor", 1), ("percent", "100 * factor", 0.8)):
            self.robots("--node", f"robot_{name}")
            self.run_pair(f'pace="parameter:/robot_{name}/{name}" pace_value="{value}"')
            self.restored(found)
            self.fast.stop()
            self.slow.stop()

    def test_what_somebody_else_has_set_on_a_topic_is_restored(self):
        self.robots("--pace", "real:/slow", "--panel", 0.6)
        self.run_pair(REAL)
        told = self.restored(0.6)
        self.assertLessEqual(max(told), 0.6, told)

    def test_what_the_tree_has_found_is_restored(self):
        self.robots("--pace", "real:/slow")
        nodes = self.pair(REAL + ' pace_found="{slider}"')
        run = self.run_tree(f'<Sequence memory="true"><Script code="slider := 0.7"/>{nodes}</Sequence>')
        self.assertEqual(run.returncode, 0, run.err)
        self.assertLessEqual(max(self.restored(0.7)), 0.7)

    def test_the_least_pace_is_what_it_takes_up(self):
        self.robots("--pace", "real:/slow")
        self.run_pair(REAL + ' least_pace="0.6"')
        told = self.restored()
        self.assertGreaterEqual(min(told), 0.6)

    def test_at_most_ten_messages_a_second(self):
        self.robots("--pace", "real:/slow", step=10)
        began = time.monotonic()
        self.run_pair(REAL, order=100, slow_order=50)
        self.assertLessEqual(len(self.told()), 10 * (time.monotonic() - began))
        told = self.restored()
        for one, other in zip(told, told[1:]):
            self.assertTrue(other == 1 or abs(one - other) >= 0.049 * one, told)

    def test_nothing_is_told_to_a_robot_that_is_not_slowed(self):
        self.robots("--pace", "real:/slow")
        run = self.run_tree(f'<ParallelRelative delta="0.5">{count("fast", "/fast", 10, REAL)}'
                            f'{count("slow", "/slow", 10)}</ParallelRelative>')
        self.assertEqual(run.returncode, 0, run.err)
        self.assertEqual(self.told(), [])

    def test_in_a_separate_process(self):
        self.robots("--pace", "real:/slow")
        self.run_pair(REAL, "--isolate")
        self.restored()

    # What it is told at the end

    def test_after_failure(self):
        self.robots("--pace", "real:/slow", "--abort", 20)
        self.run_tree(self.pair(REAL))
        self.assertLess(min(self.restored()), 0.8)

    def test_after_a_halt(self):
        self.robots("--pace", "real:/slow")
        run = self.start(f"""<Sequence memory="true"><Inverter><Timeout clock="wall" seconds="1.2">
          {self.pair(REAL, order=400)}</Timeout></Inverter><Wait seconds="9"/></Sequence>""")
        self.restored()
        self.assertIsNone(run.poll())
        ended = next(line for line in self.fast.lines if line.startswith("canceled"))
        self.assertEqual(self.fast.lines[-2:], [ended, "pace 1.000"])

    def test_after_a_cancel_by_somebody_else(self):
        self.robots("--pace", "real:/slow", "--quit", 20)
        self.run_tree(self.pair(REAL))
        self.restored()

    def test_at_the_end_of_the_run(self):
        for number in (signal.SIGINT, signal.SIGTERM):
            self.robots("--pace", "real:/slow")
            run = self.start(self.pair(REAL, order=400))
            time.sleep(1.5)
            run.send_signal(number)
            run.communicate(timeout=20)
            self.restored()
            self.fast.stop()
            self.slow.stop()

    def test_a_service_and_a_parameter_at_the_end_of_the_run(self):
        for server, pace in (
                (("--pace", "sum:/slow"), 'pace="service:/slow" pace_value="100 * factor" '
                                          'pace_type="example_interfaces/srv/AddTwoInts"'),
                (("--node", "robot"), 'pace="parameter:/robot/speed" pace_value="0.5 * factor"')):
            self.robots(*server)
            self.run_tree(f'<Timeout clock="wall" seconds="1.5">{self.pair(pace, order=400)}</Timeout>')
            self.restored()
            self.fast.stop()
            self.slow.stop()

    def test_each_activation_begins_anew(self):
        self.robots("--pace", "real:/slow")
        run = self.run_tree(f'<Repeat times="3">{self.pair(REAL, order=20)}</Repeat>')
        self.assertEqual(run.returncode, 0, run.err)
        self.assertGreaterEqual(self.restored().count(1), 1)

    def test_a_second_leaf_with_the_same_robot_does_not_find_it_slow(self):
        for pace in (REAL, 'pace="parameter:/robot/speed" pace_value="0.5 * factor"'):
            self.robots("--node", "robot", "--pace", "real:/slow", step=10)
            steps = count("fast", "/fast", 30, pace) + count("again", "/fast", 30, pace)
            run = self.run_tree(f"""<ParallelRelative delta="0.1" pace="true" reaction="0.2">
              <Sequence memory="true">{steps}</Sequence>{count("slow", "/slow", 40, 'hold="nothing"')}
              </ParallelRelative>""")
            self.assertEqual(run.returncode, 0, run.err)
            second = self.fast.lines.index("succeeded 30")
            told = [line for line in self.fast.lines[second:] if line.startswith("pace")]
            self.assertLessEqual(told.count("pace 1.000"), 2, told)
            self.restored()
            self.fast.stop()
            self.slow.stop()

    def test_two_leaves_slow_one_robot_and_the_larger_factor_applies(self):
        self.robots("--pace", "real:/slow", step=10)
        other = count("other", "/other", 40, REAL + ' least_pace="0.7"')
        self.server("--action", "/other", "--step", 10)
        run = self.run_tree(f"""<ParallelRelative delta="0.1" pace="true" reaction="0.2">
          {count("fast", "/fast", 40, REAL)}{other}{count("slow", "/slow", 40, 'hold="nothing"')}
          </ParallelRelative>""")
        self.assertEqual(run.returncode, 0, run.err)
        self.assertGreaterEqual(min(self.restored()), 0.7)

    def test_one_topic_with_two_types(self):
        self.robots("--pace", "real:/slow")
        other = 'pace="topic:/slow" pace_type="std_msgs/msg/Int16" pace_value="100 * factor"'
        run = self.run_tree(f"""<Sequence memory="true">{self.pair(REAL, order=20)}
          {self.pair(other, order=20)}{self.pair(REAL, order=20)}</Sequence>""")
        self.assertEqual(run.returncode, 0, run.err)

    # Robots that are not there, and that do not obey

    def test_told_again_when_the_robot_has_come_back(self):
        self.server("--action", "/fast", "--step", 15)
        self.server("--action", "/slow", "--step", 40)
        panel = self.server("--action", "/other", "--pace", "real:/slow")
        run = self.start(self.pair(REAL, order=120))
        time.sleep(1.5)
        panel.stop()
        self.fast = self.server("--action", "/another", "--pace", "real:/slow")
        time.sleep(1)
        self.assertTrue(self.told(), self.fast.lines)
        run.communicate(timeout=30)
        self.restored()

    def comes_back(self, number):
        self.server("--action", "/fast", "--step", 15)
        self.server("--action", "/slow", "--step", 40)
        first = self.server("--action", "/other", "--pace", "sum:/slow")
        run = self.start(self.pair('pace="service:/slow" pace_value="100 * factor" '
                                   'pace_type="example_interfaces/srv/AddTwoInts"', order=120))
        time.sleep(1.5)
        first.stop(number)
        self.fast = self.server("--action", "/another", "--pace", "sum:/slow")
        time.sleep(1.5)
        self.assertTrue(self.told(), self.fast.lines)
        run.communicate(timeout=30)
        self.restored()

    def test_a_service_that_has_ended_comes_back(self):
        self.comes_back(signal.SIGTERM)

    def test_a_service_that_was_killed_comes_back(self):
        self.comes_back(signal.SIGKILL)

    def test_a_robot_that_hangs_when_it_is_to_be_fast_again(self):
        self.robots("--pace", "sum:/slow")
        run = self.start(f"""<Sequence memory="true"><Inverter><Timeout clock="wall" seconds="1.2">
          {self.pair('pace="service:/slow" pace_type="example_interfaces/srv/AddTwoInts" pace_value="100 * factor"',
                     order=400)}</Timeout></Inverter><Wait seconds="3.5"/></Sequence>""")
        time.sleep(1.2)
        self.fast.process.send_signal(signal.SIGSTOP)
        time.sleep(2.5)
        self.fast.process.send_signal(signal.SIGCONT)
        run.communicate(timeout=20)
        self.restored()

    def test_nobody_listens(self):
        self.robots()
        run = self.run_pair(REAL)
        self.assertEqual((run.out + run.err).count(
            "the topic '/slow' has no listener: the robot is not slowed"), 1, run.err)

    def test_a_parameter_that_is_not_there(self):
        self.robots("--node", "robot")
        run = self.run_pair('pace="parameter:/robot/none"')
        self.assertIn("the parameter 'none' of '/robot' was not set: it is not a number", run.out + run.err)

    # Held by the pace

    def test_held_by_the_pace(self):
        self.robots("--pace", "real:/slow", step=10)
        self.run_pair(REAL + ' hold="pace"', node='ParallelAbsolute barriers="0.3;0.6"')
        self.assertIn(0, self.told())
        self.restored()
        self.assertEqual(self.fast.lines.count("goal 40"), 1)
        self.assertNotIn("cancel", self.fast.lines)

    def test_halted_while_it_is_held_by_the_pace(self):
        self.robots("--pace", "real:/slow", step=5)
        self.run_tree(f"""<Timeout clock="wall" seconds="1.5">{self.pair(REAL + ' hold="pace" least_pace="0.6"', order=300,
                      node='ParallelAbsolute barriers="0.3"')}</Timeout>""")
        self.assertIn(0, self.told())
        self.restored()

    # The types of robots

    @has("control_msgs")
    def test_a_trajectory_controller(self):
        self.robots("--pace", "scaling:/arm_controller/speed_scaling_input", "--panel", 0.9)
        self.run_pair('pace="topic:/arm_controller/speed_scaling_input" hold="pace"')
        self.restored(0.9)

    @has("ur_msgs")
    def test_a_slider(self):
        self.robots("--pace", "slider:/io_and_status_controller/set_speed_slider")
        self.run_pair('pace="service:/io_and_status_controller/set_speed_slider" pace_found="0.8"')
        self.restored(0.8)

    @has("ur_msgs")
    def test_a_slider_that_refuses(self):
        self.robots("--pace", "slider:/s", "--refuse-pace")
        run = self.run_pair('pace="service:/s" pace_found="0.8"')
        self.assertIn("the service '/s' was not set: refused", run.out + run.err)

    @has("nav2_msgs")
    def test_a_speed_limit(self):
        self.robots("--pace", "limit:/speed_limit")
        self.run_pair('pace="topic:/speed_limit" pace_type="nav2_msgs/msg/SpeedLimit" '
                      'message.percentage="true" pace_value="100 * factor" least_pace="0.01"')
        self.restored()


class Check(World):
    FIBONACCI = 'type="example_interfaces/action/Fibonacci" action="/count"'

    def said(self, attributes, code=3):
        run = self.check(f"<RosAction {self.FIBONACCI} {attributes}/>")
        self.assertEqual(run.returncode, code, run.stderr)
        return run.stdout + run.stderr

    def test_mistakes(self):
        for attributes, what in (
                ('pace="softly"', "'softly' is not a way to slow a robot"),
                ('pace="topic:"', "is not a way to slow a robot"),
                ('pace="parameter:speed"', "write topic:NAME, service:NAME or parameter:NODE/NAME"),
                ('pace="topic:/s" pace_type="std_msgs/msg/Nothing"', "has no message 'Nothing'"),
                ('pace="topic:/s" pace_type="std_msgs/msg/String"', "has no number"),
                (f'{REAL} pace_value="100 * facto"', "knows no 'facto'"),
                (f'{REAL} pace_value="100 *"', "ends too early"),
                (f'{REAL} pace_value="100"', "does not depend on factor"),
                (f'{REAL} least_pace="2"', "least_pace"),
                (f'{REAL} message.dato="2"', "did you mean 'message.data'?"),
                ('hold="pace"', 'hold="pace" needs the attribute pace'),
                (f'{REAL} hold="pace" pace_value="1 / factor"', "the value has no result for factor 0")):
            with self.subTest(attributes):
                self.assertIn(what, self.said(attributes))

    @has("nav2_msgs")
    def test_a_limit_of_0_is_none(self):
        said = self.said('pace="topic:/speed_limit" pace_type="nav2_msgs/msg/SpeedLimit" hold="pace"')
        self.assertIn("0 in a 'nav2_msgs/msg/SpeedLimit' means no limit: the robot continues", said)

    @has("ur_msgs")
    def test_a_slider_has_no_0(self):
        self.assertIn("it cannot hold the robot", self.said('pace="service:/s" hold="pace"'))

    def test_a_robot_that_is_only_held(self):
        def nodes(pace):
            return (f'<ParallelRelative delta="0.1" pace="true">{count("a", "/a", 5, REAL)}'
                    f'{count("b", "/b", 5, pace)}</ParallelRelative>')
        run = self.check(nodes(""))
        self.assertIn("'b' is not slowed by 'ParallelRelative', only held", run.stdout + run.stderr)
        run = self.check(nodes(REAL))
        self.assertNotIn("only held", run.stdout + run.stderr)

    @has("nav2_msgs")
    def test_a_time_of_the_server_goes_on(self):
        leaf = ('<RosAction name="back" type="nav2_msgs/action/DriveOnHeading" action="/back" hold="nothing" '
                'goal.time_allowance="10"/>')
        run = self.check(f'<ParallelRelative delta="0.1" pace="true">{count("a", "/a", 5, REAL)}{leaf}'
                         f'</ParallelRelative>')
        self.assertIn("'goal.time_allowance' of 'back' counts in full", run.stdout + run.stderr)


if __name__ == "__main__":
    unittest.main()
