"""RosService, RosPublish and RosReceive."""

from world import World

SET_BOOL = 'type="example_interfaces/srv/SetBool"'
BOOL = 'type="std_msgs/msg/Bool"'


class Service(World):
    def test_an_answer(self):
        server = self.server("--action", "/c", "--hold-service", "/still")
        run = self.run_tree(f"""<Sequence memory="true">
          <RosService {SET_BOOL} service="/still" request.data="true" response.success="{{ok}}"/>
          <Check code="ok"/></Sequence>""")
        self.assertEqual(run.returncode, 0, run.err)
        self.assertIn("hold", server.lines)

    def test_an_answer_that_is_not_as_it_should_be(self):
        self.server("--action", "/c", "--hold-service", "/still")
        for condition, code in (("response.success", 0), ("not response.success", 1), ("response.success == 0", 1),
                                ("size(response.message) &lt; 100 and elapsed &lt; 60", 0)):
            run = self.run_tree(f"""<RosService {SET_BOOL} service="/still" request.data="true"
              condition="{condition}" error="{{why}}"/>""")
            self.assertEqual(run.returncode, code, (condition, run.err))

    def test_no_service(self):
        run = self.run_tree(f"""<Sequence memory="true"><Inverter>
          <RosService {SET_BOOL} service="/nobody" timeout="0.3" error="{{why}}"/></Inverter>
          <Check code="why == 'no service'"/></Sequence>""")
        self.assertEqual(run.returncode, 0, run.err)

    def test_a_service_of_another_name(self):
        self.server("--action", "/c", "--hold-service", "/left/still")
        run = self.run_tree(f'<RosService {SET_BOOL} service="/still" timeout="1"/>')
        self.assertIn("there is no service '/still'; of its type there is '/left/still'", run.err)

    def test_a_service_of_another_type(self):
        self.server("--action", "/c", "--hold-service", "/still")
        run = self.run_tree('<RosService type="rcl_interfaces/srv/GetParameters" service="/still" timeout="1"/>')
        self.assertIn("the service '/still' is of the type example_interfaces/srv/SetBool, not "
                      "rcl_interfaces/srv/GetParameters", run.err)

    def test_a_field_that_is_not_there(self):
        run = self.check(f'<RosService {SET_BOOL} service="/s" request.dato="true"/>')
        self.assertIn("did you mean 'request.data'?", run.stderr)


class Topic(World):
    def test_what_is_published_is_received(self):
        run = self.run_tree(f"""<Sequence memory="true">
          <RosPublish {BOOL} topic="/t" qos="latched" message.data="true"/>
          <RosReceive {BOOL} topic="/t" qos="latched" timeout="5" message.data="{{got}}"/>
          <Check code="got"/></Sequence>""")
        self.assertEqual(run.returncode, 0, run.err)

    def test_published_to_others(self):
        server = self.server("--action", "/c", "--hold-topic", "/still")
        run = self.run_tree(f"""<Sequence memory="true"><Wait seconds="0.5"/>
          <RosPublish {BOOL} topic="/still" message.data="true"/></Sequence>""")
        self.assertEqual(run.returncode, 0, run.err)
        server.wait_for("hold")

    def test_a_message_that_is_not_waited_for(self):
        kind = 'type="std_msgs/msg/Float64" topic="/level" qos="latched"'
        for condition, code in (
                ("message.data &gt; 2", 0), ("message.data &lt;= 2", 1), ("message.data != 2.5", 1),
                ("message.data == 5 / 2 and not (message.data &lt; 1 or message.data &gt;= 3)", 0),
                ("message.data / 0 &gt; 1", 1), ("not message.data / 0 &gt; 1", 1)):
            run = self.run_tree(f"""<Sequence memory="true">
              <RosPublish {kind} message.data="2.5"/><RosReceive {kind} timeout="5"/>
              <RosReceive {kind} condition="{condition}" timeout="1" message.data="{{d}}"/></Sequence>""")
            self.assertEqual(run.returncode, code, (condition, run.err))

    def test_mistakes_in_a_condition(self):
        for condition, what in (
                ("message.dato", "did you mean 'message.data'?"), ("message.data = 1", "expected one of &lt;"),
                ("message.data and", "ends too early"), ("goal.x", "use message.FIELD, elapsed"),
                ("not", "ends too early"), ("message.data 1", "expected an operator or the end")):
            run = self.check(f'<RosReceive {BOOL} topic="/t" condition="{condition}"/>')
            self.assertEqual(run.returncode, 3, run.stderr)
            self.assertIn(what.replace("&lt;", "<"), run.stderr)

    def silence(self, publisher, receiver, *said):
        """Nothing goes from one to the other, and both say why."""
        run = self.run_tree(f"""<Parallel success_count="2">
          <Repeat times="4"><Sequence memory="true">
            <RosPublish topic="/t" {publisher}/><Wait seconds="0.5"/></Sequence></Repeat>
          <RosReceive topic="/t" {receiver} timeout="1.8"/></Parallel>""")
        self.assertEqual(run.returncode, 1, run.err)
        for words in said:
            self.assertIn(words, run.err)
            self.assertEqual(run.err.count(words), 1)

    def test_a_topic_of_another_type(self):
        text = 'type="std_msgs/msg/String"'
        self.silence(BOOL, text, "publishes std_msgs/msg/Bool, not std_msgs/msg/String",
                     "receives std_msgs/msg/String, not std_msgs/msg/Bool")

    def test_qualities_of_service_that_do_not_fit(self):
        self.silence(f'{BOOL} qos="sensor_data"', BOOL, 'may lose messages: write qos="sensor_data"',
                     'wants all messages: write qos="default"')

    def test_a_publisher_that_keeps_nothing(self):
        self.silence(BOOL, f'{BOOL} qos="latched"', 'keeps none for those who come late: write qos="default"',
                     'wants the last one when it comes late: write qos="latched"')

    def test_nothing_comes(self):
        run = self.run_tree(f'<RosReceive {BOOL} topic="/silent" timeout="0.3"/>')
        self.assertNotEqual(run.returncode, 0)
        self.assertIn("failure", run.out + run.err)

    def test_the_next_one_is_not_an_old_one(self):
        run = self.run_tree(f"""<Sequence memory="true">
          <RosPublish {BOOL} topic="/t" qos="latched" message.data="true"/>
          <RosReceive {BOOL} topic="/t" qos="latched" timeout="5"/>
          <RosReceive name="n" {BOOL} topic="/t" qos="latched" take="next" timeout="0.3"/>
          </Sequence>""")
        self.assertNotEqual(run.returncode, 0)
        self.assertIn("n: failure", run.out + run.err)

    def test_every_kind_of_field_goes_there_and_comes_back(self):
        kind = 'type="std_msgs/msg/Float64MultiArray"'
        run = self.run_tree(f"""<Sequence memory="true">
          <RosPublish {kind} topic="/list" qos="latched" message.data="0.5;-1.5"
                      message.layout.data_offset="7"/>
          <RosReceive {kind} topic="/list" qos="latched" timeout="5" message.data="{{list}}"
                      message.layout.data_offset="{{offset}}"/>
          <Check code="offset == 7"/></Sequence>""")
        self.assertEqual(run.returncode, 0, run.err)
        self.assertIn("0.5;-1.5", self.recording.read_text())
        run = self.run_tree("""<Sequence memory="true">
          <RosPublish type="std_msgs/msg/Header" topic="/head" qos="latched" message.stamp="now"
                      message.frame_id="map"/>
          <RosReceive type="std_msgs/msg/Header" topic="/head" qos="latched" timeout="5"
                      message.frame_id="{frame}" message.stamp.sec="{sec}"/>
          <Check code="frame == 'map' &amp;&amp; sec &gt; 1000000000"/></Sequence>""")
        self.assertEqual(run.returncode, 0, run.err)

    POSES = 'type="geometry_msgs/msg/PoseArray" topic="/poses" qos="latched"'

    def test_a_sequence_of_messages_is_columns(self):
        run = self.run_tree(f"""<Sequence memory="true">
          <RosPublish {self.POSES} message.poses.position.x="1;2;3" message.header.frame_id="map"
                      message.poses.position.y="0.5" message.poses.orientation.w="1"/>
          <RosReceive {self.POSES} timeout="5" message.poses.position.x="{{x}}"
                      message.poses.position.y="{{y}}" message.poses.position.z="{{z}}"/></Sequence>""")
        self.assertEqual(run.returncode, 0, run.err)
        for text in ('"1;2;3"', '"0.5;0.5;0.5"', '"0;0;0"'):
            self.assertIn(text, self.recording.read_text())

    def test_columns_of_different_lengths(self):
        run = self.run_tree(f"""<RosPublish {self.POSES} message.poses.position.x="1;2;3"
                                            message.poses.position.y="1;2"/>""")
        self.assertIn("'poses.position.y' has 2 values for the 3 items of 'poses'", run.err)

    def test_whole_messages_are_objects(self):
        stamped = 'type="geometry_msgs/msg/PoseStamped" qos="latched"'
        run = self.run_tree(f"""<Sequence memory="true">
          <RosPublish {stamped} topic="/a" message.header.frame_id="map"
                      message.pose.position.x="1.5" message.pose.position.y="2"/>
          <RosReceive {stamped} topic="/a" timeout="5" message="{{whole}}" message.pose="{{pose}}"/>
          <RosPublish {stamped} topic="/b" message="{{whole}}" message.pose.position.y="3"/>
          <RosReceive {stamped} topic="/b" timeout="5" message.header.frame_id="{{frame}}"
                      message.pose.position.x="{{x}}" message.pose.position.y="{{y}}"/>
          <Check code="frame == 'map' &amp;&amp; x == 1.5 &amp;&amp; y == 3"/>
          <RosPublish type="geometry_msgs/msg/Pose" topic="/c" qos="latched" message="{{pose}}"/>
          <RosReceive type="geometry_msgs/msg/Pose" topic="/c" qos="latched" timeout="5"
                      message.position.y="{{z}}"/><Check code="z == 2"/></Sequence>""")
        self.assertEqual(run.returncode, 0, run.err)
        self.assertIn("header.frame_id: map, pose.position.x: 1.5", self.recording.read_text())

    def test_objects_between_separate_processes(self):
        pose = 'type="geometry_msgs/msg/PoseArray" qos="latched"'
        run = self.run_tree(f"""<Sequence memory="true">
          <RosPublish {pose} topic="/a" message.header.frame_id="map"
                      message.poses.position.x="1.5;2.5"/>
          <RosReceive {pose} topic="/a" timeout="5" message="{{whole}}"/>
          <RosPublish {pose} topic="/b" message="{{whole}}"/>
          <RosReceive {pose} topic="/b" timeout="5" message.poses.position.x="{{x}}"
                      message.header.frame_id="{{frame}}"/>
          <Check code="frame == 'map'"/></Sequence>""", "--isolate")
        self.assertEqual(run.returncode, 0, run.err)
        self.assertIn('"1.5;2.5"', self.recording.read_text())

    def test_an_object_of_another_type(self):
        run = self.check("""<Sequence memory="true">
          <RosReceive type="geometry_msgs/msg/Pose" topic="/a" message="{it}"/>
          <RosPublish type="geometry_msgs/msg/Point" topic="/b" message="{it}"/></Sequence>""")
        self.assertNotEqual(run.returncode, 0)
        self.assertIn("geometry_msgs/msg/Point", run.stderr)

    def test_an_object_with_sequences(self):
        run = self.run_tree(f"""<Sequence memory="true">
          <RosPublish {self.POSES} message.poses.position.x="1;2;3"/>
          <RosReceive {self.POSES} timeout="5" message="{{all}}"/>
          <RosPublish {self.POSES.replace("/poses", "/again")} message="{{all}}"
                      message.poses.position.y="7"/>
          <RosReceive {self.POSES.replace("/poses", "/again")} timeout="5"
                      message.poses.position.x="{{x}}" message.poses.position.y="{{y}}"/></Sequence>""")
        self.assertEqual(run.returncode, 0, run.err)
        text = self.recording.read_text()
        self.assertIn('"1;2;3"', text)
        self.assertIn('"7;7;7"', text)

    def test_columns_of_lists(self):
        kind = 'type="diagnostic_msgs/msg/DiagnosticArray" topic="/d" qos="latched"'
        run = self.run_tree(f"""<Sequence memory="true">
          <RosPublish {kind} message.status.name="a;b" message.status.level="1;2"/>
          <RosReceive {kind} timeout="5" message.status.name="{{names}}"
                      message.status.level="{{levels}}"/></Sequence>""")
        self.assertEqual(run.returncode, 0, run.err)
        self.assertIn('"a;b"', self.recording.read_text())

    def test_a_column_that_is_not_there(self):
        run = self.check(f'<RosPublish {self.POSES} message.poses.position.u="1"/>')
        self.assertIn("no parameter 'message.poses.position.u'", run.stderr)


class Parameter(World):
    def test_read_and_set(self):
        self.server("--node", "robot")
        run = self.run_tree("""<Sequence memory="true">
          <RosParameter node="/robot" parameter="speed" value="{before}"/>
          <RosParameter node="/robot" parameter="speed" do="set" value="0.25"/>
          <RosParameter node="/robot" parameter="speed" value="{after}"/>
          <RosParameter node="/robot" parameter="label" as="string" value="{label}"/>
          <Check code="before == 0.5 &amp;&amp; after == 0.25 &amp;&amp; label == 'slow'"/>
          </Sequence>""")
        self.assertEqual(run.returncode, 0, run.err)

    def test_what_does_not_work(self):
        self.server("--node", "robot")
        for attributes, words in (('node="/robot" parameter="label" value="{v}"', "not a double"),
                                  ('node="/robot" parameter="none" value="{v}"', "not set"),
                                  ('node="/nobody" parameter="p" timeout="0.3" value="{v}"',
                                   "no node")):
            run = self.run_tree(f"""<Sequence memory="true">
              <Inverter><RosParameter {attributes} error="{{why}}"/></Inverter>
              <Check code="why == '{words}'"/></Sequence>""")
            self.assertEqual(run.returncode, 0, (words, run.err))


class Lifecycle(World):
    """RosLifecycle against a node of rclcpp_lifecycle."""

    @staticmethod
    def change(transition, more=""):
        return f'<RosLifecycle node="/camera" transition="{transition}" {more}/>'

    def test_through_all_states(self):
        names = ["configure", "activate", "deactivate", "cleanup", "configure", "shutdown"]
        server = self.server("camera", program="lifecycle_server")
        run = self.run_tree(f"""<Sequence memory="true">{"".join(map(self.change, names))}
          <RosService type="lifecycle_msgs/srv/GetState" service="/camera/get_state"
                      response.current_state.label="{{state}}"/>
          <Check code="state == 'finalized'"/></Sequence>""")
        self.assertEqual(run.returncode, 0, run.err)
        server.wait_for("shutdown")
        self.assertEqual(server.lines, ["ready", *names])

    def failure(self, node, words):
        run = self.run_tree(f"""<Sequence memory="true"><Inverter>{node}</Inverter>
          <Check code="why == '{words}'"/></Sequence>""")
        self.assertEqual(run.returncode, 0, run.err)

    def test_what_its_state_does_not_allow_is_refused(self):
        self.server("camera", program="lifecycle_server")
        self.failure(self.change("activate", 'error="{why}"'), "refused")

    def test_what_the_node_does_not_do_is_refused(self):
        self.server("camera", "--refuse", program="lifecycle_server")
        self.failure(f"""<Sequence memory="true">{self.change("configure")}
          {self.change("activate", 'error="{why}"')}</Sequence>""", "refused")

    def test_no_node(self):
        self.failure(self.change("configure", 'timeout="0.3" error="{why}"'), "no node")
        run = self.run_tree(self.change("configure", 'timeout="0.3" on_failure="fault"'))
        self.assertIn("configure '/camera': no node", run.err)

    def test_a_transition_that_is_none(self):
        run = self.check(self.change("activat"))
        self.assertIn("activate", run.stderr)
        self.assertNotEqual(run.returncode, 0)
