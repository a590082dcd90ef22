"""--clock ros: a run in simulated time, which a publisher of /clock makes."""

import json
import signal
import time

from world import World, count


class Clock(World):
    def clock(self, *parts):
        return self.server(*parts, program="clock_publisher")

    def timed(self, nodes, *options):
        """A run in simulated time: its seconds, and the real ones."""
        began = time.monotonic()
        run = self.run_tree(nodes, "--clock", "ros", *options)
        self.assertEqual(run.returncode, 0, run.err)
        end = json.loads(self.recording.read_text().splitlines()[-1])["end"]
        return end["time_s"], time.monotonic() - began

    def test_faster_than_real(self):
        self.clock("100:140:10")
        seconds, real = self.timed('<Wait seconds="20"/>')
        self.assertAlmostEqual(seconds, 20, delta=0.5)
        self.assertLess(real, 10)

    def test_slower_than_real(self):
        self.clock("100:140:0.25")
        seconds, real = self.timed('<Wait seconds="0.5"/>')
        self.assertAlmostEqual(seconds, 0.5, delta=0.1)
        self.assertGreater(real, 1.8)

    def test_while_the_clock_stands_nothing_is_ticked(self):
        self.clock("100:100.5:1", "stand:2", "100.5:102:1")
        seconds, real = self.timed('<Wait seconds="1"/>')
        self.assertAlmostEqual(seconds, 1, delta=0.1)
        self.assertGreater(real, 2.8)
        ticks = len(self.recording.read_text().splitlines())
        self.assertLess(ticks, 120)

    def test_a_clock_that_is_reset(self):
        self.clock("100:100.5:1", "3:5:1", "0:5:1")
        seconds, _ = self.timed('<Wait seconds="3"/>')
        self.assertAlmostEqual(seconds, 3, delta=0.2)

    def test_without_a_clock_the_run_does_not_begin(self):
        run = self.start('<Wait seconds="1"/>', "--clock", "ros")
        time.sleep(3)
        run.send_signal(signal.SIGINT)
        _, err = run.communicate(timeout=5)
        self.assertEqual(run.returncode, 130, err)
        self.assertIn("the run begins when --clock ros has a time", err)

    def test_an_interrupt_while_the_clock_stands(self):
        clock = self.clock("100:100.3:1")
        run = self.start('<Wait seconds="1"/>', "--clock", "ros")
        clock.wait_for("stands")
        run.send_signal(signal.SIGINT)
        run.communicate(timeout=5)
        self.assertEqual(run.returncode, 130)

    def test_stamps_are_of_the_clock(self):
        self.clock("100:160:1")
        self.timed("""<Sequence memory="true">
          <RosPublish type="std_msgs/msg/Header" topic="/h" qos="latched" message.stamp="now"/>
          <RosReceive type="std_msgs/msg/Header" topic="/h" qos="latched" timeout="5"
                      message.stamp.sec="{sec}"/>
          <Check code="sec &gt;= 100 &amp;&amp; sec &lt; 160"/></Sequence>""")

    def test_an_action(self):
        self.clock("100:160:1")
        self.server("--action", "/count")
        self.timed(count("c", "/count", 5))

    def test_a_plugin_that_has_no_clock(self):
        run = self.run_tree("<AlwaysSuccess/>", "--clock", "ros", "--isolate")
        self.assertEqual(run.returncode, 2, run.err)
        self.assertIn("no plugin of this process has it", run.err)


if __name__ == "__main__":
    import unittest

    unittest.main()
