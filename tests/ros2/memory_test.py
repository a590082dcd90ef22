"""What the plugin does with memory, by valgrind: neither a leak nor a value that nobody has set."""

import shutil
import subprocess
import time
import unittest

from world import World, count

# Of Cyclone DDS and of the loader.
NOT_OURS = """{
   cyclone
   Memcheck:Cond
   obj:*/libddsc.so*
}
{
   loader
   Memcheck:Leak
   fun:malloc
   ...
   fun:_dl_map_object_deps
}
{
   scopes of the loader
   Memcheck:Leak
   fun:malloc
   ...
   fun:dl_open_worker_begin
}
"""
BOOL = 'type="example_interfaces/srv/SetBool"'
POSES = 'type="geometry_msgs/msg/PoseArray" topic="/poses" qos="latched"'
TREES = {
    "an action that succeeds, one that is aborted and one that is canceled": f"""<Sequence memory="true">
        {count("ok", "/ok", more='result.sequence="{s}" feedback.sequence="{f}"')}
        <Inverter>{count("bad", "/bad", 9, 'error="{why}"')}</Inverter>
        <Inverter><Timeout seconds="0.5">{count("slow", "/slow", 50)}</Timeout></Inverter></Sequence>""",
    "actions that are held": f"""<ParallelAbsolute barriers="0.5">
        {count("fast", "/ok", 20, 'hold="cancel"')}
        {count("told", "/fast", 20, 'hold="service:/still" hold_type="example_interfaces/srv/SetBool"')}
        {count("slow", "/slow", 20, 'hold="nothing"')}</ParallelAbsolute>""",
    "robots that are slowed": f"""<ParallelRelative delta="0.1" pace="true" reaction="0.2">
        {count("topic", "/ok", 30, 'hold="pace" pace="topic:/slow" pace_type="std_msgs/msg/Float64"')}
        {count("service", "/fast", 30, 'pace="service:/sum" pace_type="example_interfaces/srv/AddTwoInts" '
               'pace_value="100 * factor" request.b="1"')}
        <Sequence memory="true"><Inverter><Timeout seconds="2">
          {count("halted", "/nav", 300, 'pace="parameter:/robot/speed" pace_value="0.5 * factor"')}
        </Timeout></Inverter>{count("none", "/nav", 10, 'pace="parameter:/nobody/speed"')}</Sequence>
        {count("slow", "/slow", 30, 'hold="nothing"')}</ParallelRelative>""",
    "services and topics": f"""<Sequence memory="true">
        <RosService {BOOL} service="/still" request.data="false" condition="response.success"/>
        <Inverter><RosService {BOOL} service="/nobody" timeout="0.3" error="{{why}}"/></Inverter>
        <RosPublish {POSES} message.poses.position.x="1;2;3" message.header.frame_id="map"/>
        <RosReceive {POSES} timeout="20" message="{{m}}" message.poses.position.x="{{x}}"
                    condition="size(message.poses) == 3"/>
        <RosPublish {POSES} message="{{m}}" message.header.stamp="now"/></Sequence>""",
    "a goal that changes, a message that is taken again, a topic of another type": f"""<Sequence memory="true">
        <Script code="n := 1000"/>
        <RosPublish {POSES} message.header.frame_id="map"/>
        <Repeat times="3"><RosReceive {POSES} timeout="20" message="{{m}}"/></Repeat>
        <Inverter><RosReceive type="std_msgs/msg/Bool" topic="/poses" timeout="3"/></Inverter>
        <Parallel success_count="1">
          {count("changes", "/nav", "{n}", 'preempt="true"')}
          <Sequence memory="true"><Wait seconds="1"/><Script code="n := 3"/><Wait seconds="50"/></Sequence>
        </Parallel></Sequence>""",
    "lifecycle and parameters": """<Sequence memory="true">
        <RosLifecycle node="/camera" transition="configure"/>
        <RosParameter node="/camera" parameter="use_sim_time" as="bool" value="{sim}"/>
        <Inverter><RosParameter node="/camera" parameter="none" value="{none}"/></Inverter></Sequence>"""}


@unittest.skipUnless(shutil.which("valgrind"), "there is no valgrind")
class Memory(World):
    def servers(self):
        self.server("--action", "/ok", "--step", 20, "--keep", "--pace", "real:/slow")
        self.server("--action", "/bad", "--step", 20, "--abort", 3)
        self.fast = self.server("--action", "/fast", "--step", 20, "--keep", "--hold-service", "/still",
                                "--pace", "sum:/sum")
        self.server("--action", "/slow", "--step", 50, "--keep")
        self.server("--action", "/nav", "--step", 20, "--preempt", "--node", "robot")
        self.server("camera", program="lifecycle_server")

    def valgrind(self, nodes):
        known = self.directory / "known.supp"
        known.write_text(NOT_OURS)
        run = subprocess.run(
            ["valgrind", "-q", "--error-exitcode=99", "--leak-check=full", "--show-leak-kinds=definite,indirect",
             "--errors-for-leak-kinds=definite,indirect", f"--suppressions={known}",
             *self.command("run", nodes, "--hang-limit", 0, "--view", "none", "--timeout", 60, *self.kept())],
            text=True, capture_output=True, timeout=200)
        self.assertEqual(run.returncode, 0, run.stderr[-4000:])
        return run

    def kept(self):
        return ("--checkpoint", self.directory / "run.checkpoint", "--resume")

    def test_memory(self):
        self.servers()
        for name, nodes in TREES.items():
            with self.subTest(name):
                self.valgrind(nodes)

    def test_after_a_cut(self):
        self.servers()
        slowed = TREES["robots that are slowed"].replace("30", "300").replace("<Inverter><Timeout", "<ForceSuccess><Timeout")
        slowed = slowed.replace("</Timeout></Inverter>", "</Timeout></ForceSuccess>")
        for nodes, line, seconds in ((TREES["actions that are held"], "hold", 0.1), (slowed, "goal 300", 1)):
            with self.subTest(line):
                run = self.start(nodes, *self.kept())
                self.fast.wait_for(line)
                time.sleep(seconds)
                run.kill()
                run.communicate()
                self.assertIn("resumed after", self.valgrind(nodes).stderr)


if __name__ == "__main__":
    unittest.main()
