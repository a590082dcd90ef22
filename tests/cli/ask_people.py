"""A person in the terminal of a run: ask_people.py LOCKSTEP TREES. The run has a pseudo-terminal; nothing sleeps."""
import json
import os
import pty
import re
import select
import signal
import subprocess
import sys
import tempfile
import time

LOCKSTEP, TREES = sys.argv[1:3]
PATIENCE = 30  # s


def wait_until(is_true, run, what):
    end = time.monotonic() + PATIENCE
    while not is_true():
        assert run.poll() is None and time.monotonic() < end, what


class Terminal:
    "A run in a terminal of its own."

    def __init__(self, directory, *options):
        main, side = pty.openpty()
        environment = dict(os.environ, XDG_RUNTIME_DIR=directory, TERM="xterm")
        self.run = subprocess.Popen([LOCKSTEP, "run", *options], stdin=side, stderr=side, stdout=subprocess.PIPE,
                                    env=environment, start_new_session=True,
                                    preexec_fn=lambda: __import__("fcntl").ioctl(0, __import__("termios").TIOCSCTTY, 0))
        os.close(side)
        self.main, self.seen, self.environment = main, "", environment

    def wait_for(self, pattern):
        end = time.monotonic() + PATIENCE
        while not (found := re.search(pattern, self.seen)):
            left = end - time.monotonic()
            if left < 0 or not select.select([self.main], [], [], left)[0]:
                raise AssertionError(f"no {pattern!r} in {self.seen!r}")
            try:
                self.seen += os.read(self.main, 65536).decode()
            except OSError:
                raise AssertionError(f"the run ended, no {pattern!r} in {self.seen!r}")
        self.seen = self.seen[found.end():]
        return found

    def type(self, text):
        os.write(self.main, text.encode() + b"\n")

    def other(self, *words):
        "Another command of the same user."
        return subprocess.run([LOCKSTEP, *words], env=self.environment, capture_output=True, text=True, timeout=PATIENCE)

    def end(self):
        end, out = time.monotonic() + PATIENCE, self.run.stdout.fileno()
        streams, texts = [self.main, out], {self.main: b"", out: b""}
        while streams and time.monotonic() < end:  # a terminal that nobody reads stops who writes
            for stream in select.select(streams, [], [], 1)[0]:
                try:
                    more = os.read(stream, 65536)
                except OSError:
                    more = b""
                texts[stream] += more
                if not more:
                    streams.remove(stream)
        os.close(self.main)
        return self.run.wait(timeout=PATIENCE), texts[out].decode()


def test_answers_in_the_terminal(directory):
    recording = os.path.join(directory, "run.jsonl")
    run = Terminal(directory, os.path.join(TREES, "ask.xml"), "--record", recording)
    run.wait_for(r"Main/Sequence/where asks: Where shall gear 7 go\? \(shelf, table, bin\)")
    run.wait_for(r"1  shelf\r\n  2  table\r\n  3  bin\r\n\(1 to 3\) ")
    run.type("nowhere")
    run.wait_for("'nowhere' is no answer")
    run.type("3")
    run.wait_for(r"Main/Sequence/where: bin \(by terminal\)")
    run.wait_for(r"Really throw gear 7 away")
    run.wait_for(r"\(1 to 2\) ")  # what was typed before is no answer
    run.type("no")
    run.wait_for(r"sure: no \(by terminal\)")
    code, out = run.end()
    assert code == 0 and "success" in out, out
    lines = [json.loads(line) for line in open(recording)]
    answers = [it for line in lines for it in line.get("answers", [])]
    assert [it[1:] for it in answers] == [["bin", "terminal"], ["no", "terminal"]], answers
    header = {node["path"]: node for node in lines[0]["nodes"]}
    where = header["Main/Sequence/where"]
    assert where["options"] == ["shelf", "table", "bin"] and where["default"] == "shelf" and where["timeout_s"] == 10


def test_another_command_answers(directory):
    run = Terminal(directory, os.path.join(TREES, "ask.xml"))
    run.wait_for("where asks")
    listed = run.other("answer")
    assert "Where shall gear 7 go?" in listed.stdout and "shelf, table, bin" in listed.stdout, listed
    wrong = run.other("answer", "tabel")
    assert wrong.returncode == 2 and "did you mean 'table'?" in wrong.stderr, wrong
    given = run.other("answer", "table", str(run.run.pid), "--node", "where", "--by", "maria")
    assert given.returncode == 0, given
    run.wait_for(r"where: table \(by maria\)")
    code, _ = run.end()
    assert code == 0
    assert run.other("answer", "table").returncode == 2
    assert not [name for name in os.listdir(os.path.join(directory, "lockstep")) if name.endswith(".socket")]


def test_a_signal_ends_a_run_that_asks(directory):
    for options in [], ["--break", "where:before"]:
        run = Terminal(directory, os.path.join(TREES, "ask.xml"), *options)
        run.wait_for("for help" if options else r"\(1 to 3\)")
        run.run.send_signal(signal.SIGINT)
        assert run.end()[0] == 130


def test_what_was_typed_before_a_question_is_no_answer_to_it(directory):
    run = Terminal(directory, os.path.join(TREES, "ask.xml"))
    run.wait_for(r"\(1 to 3\)")
    run.type("3\n1")
    run.wait_for(r"Really throw gear 7 away[^?]*\?.*\n(.*\n)*.*\(1 to 2\)")
    run.type("2")
    run.wait_for(r"sure: no \(by terminal\)")
    assert run.end()[0] == 0


def test_the_first_answer_counts(directory):
    run = Terminal(directory, os.path.join(TREES, "ask.xml"), "--rate", "2")
    run.wait_for("where asks")
    both = [subprocess.Popen([LOCKSTEP, "answer", answer, "--by", answer], env=run.environment, stderr=subprocess.PIPE,
                             text=True) for answer in ("shelf", "table")]
    codes = [it.wait(timeout=PATIENCE) for it in both]
    assert sorted(codes) == [0, 2], codes
    assert "answered before" in both[codes.index(2)].stderr.read()
    for it in both:
        it.stderr.close()
    run.run.send_signal(signal.SIGTERM)
    assert run.end()[0] == 143


def test_an_answer_to_a_held_question_that_is_halted_was_not_taken(directory):
    tree = os.path.join(directory, "held.xml")
    with open(tree, "w") as file:
        file.write("""<root lockstep="1"><BehaviorTree ID="Main"><Sequence memory="true"><Fallback memory="true">
<Timeout seconds="3"><ParallelAbsolute barriers="0.1;1"><Sequence memory="true"><AlwaysSuccess/><Ask name="q" text="open?"/>
</Sequence><AlwaysRunning/></ParallelAbsolute></Timeout><AlwaysSuccess/></Fallback><AlwaysRunning/></Sequence></BehaviorTree></root>""")
    run = Terminal(directory, tree, "--rate", "10")
    run.wait_for(r"q asks: open\?")
    given = run.other("answer", "yes", "--by", "maria")
    assert given.returncode == 2, given
    assert "is held, or the run is paused" in given.stderr or "waits for no answer any more" in given.stderr, given
    run.wait_for(r"q: halted before it took the answer yes \(by maria\)")
    run.run.send_signal(signal.SIGTERM)
    assert run.end()[0] == 143


class HeldQuestion:
    "A run that is kept, in which a question is held until another child is at 0.5. The run is cut when all is in its files."

    def __init__(self, directory, other_child):
        self.directory = directory
        self.tree, self.recording, self.checkpoint = (os.path.join(directory, "cut." + it) for it in ("xml", "jsonl", "checkpoint"))
        with open(self.tree, "w") as file:
            file.write(f"""<root lockstep="1"><BehaviorTree ID="Main"><ParallelAbsolute barriers="0.5"><Sequence memory="true">
<AlwaysSuccess/><Ask name="q" text="held?" options="a;b"/></Sequence>{other_child}</ParallelAbsolute></BehaviorTree></root>""")
        self.begin()
        self.run.wait_for(r"q asks: held\? \(a, b\)")
        self.run.wait_for(r"\(1 to 2\) ")  # what was typed before is no answer

    def begin(self):
        self.run = Terminal(self.directory, self.tree, "--checkpoint", self.checkpoint, "--resume", "--record", self.recording)

    def kept_ticks(self):
        return json.loads(self.run.other("checkpoint", self.checkpoint, "--json").stdout)["ticks"]

    def wait_for_tick(self, tick):
        wait_until(lambda: self.kept_ticks() > tick, self.run.run, f"no tick after {tick} is kept")

    def answered_at(self):
        with open(self.recording) as file:
            return next((json.loads(line)["tick"] for line in file if '"answers":' in line), None)

    def cut_and_resume(self):
        self.run.run.kill()
        self.run.end()
        self.begin()
        self.run.wait_for("resumed after")


def test_a_question_that_has_its_answer_is_not_asked_again_after_a_cut(directory):
    held = HeldQuestion(directory, "<AlwaysRunning/>")
    held.run.type("b")
    wait_until(lambda: held.answered_at() is not None, held.run.run, "no answer in the recording")
    held.wait_for_tick(held.answered_at() + 1)
    held.cut_and_resume()
    held.wait_for_tick(held.kept_ticks() + 2)
    listed = held.run.other("answer")
    assert listed.returncode == 0 and listed.stdout == "", listed
    held.run.run.send_signal(signal.SIGTERM)
    assert "asks" not in held.run.wait_for("(?s)(.*)run ends").group(1)
    assert held.run.end()[0] == 143


def test_a_question_that_is_held_at_a_cut_is_asked_again_with_its_text(directory):
    held = HeldQuestion(directory, '<Wait seconds="2"/>')
    held.wait_for_tick(1)
    held.cut_and_resume()
    asked = held.run.wait_for(r"q asks: (.*)\r\n").group(1)
    assert asked == "held? (a, b)", asked
    held.run.wait_for(r"\(1 to 2\) ")
    held.run.type("a")
    held.run.wait_for("run ends: success")
    assert held.run.end()[0] == 0


def test_a_run_with_a_monitor_is_reached_too(directory):
    run = Terminal(directory, os.path.join(TREES, "ask.xml"), "--monitor", "127.0.0.1:0", "--monitor-linger", "0")
    run.wait_for("where asks")
    assert run.other("answer", "shelf").returncode == 0
    assert run.end()[0] == 0


def waiting(directory, seconds):
    tree = os.path.join(directory, "tree.xml")
    with open(tree, "w") as file:
        file.write(f'<root lockstep="1"><BehaviorTree ID="Main"><Wait seconds="{seconds}"/></BehaviorTree></root>')
    return tree


def test_a_terminal_with_a_prompt_has_no_live_view(directory):
    run = Terminal(directory, os.path.join(TREES, "ask.xml"), "--view", "live")
    run.wait_for("--view live: the view is plain, since you can type in this terminal")
    run.wait_for(r"1  shelf\r\n  2  table\r\n  3  bin\r\n\(1 to 3\) ")
    run.type("1")
    run.wait_for(r"Main/Sequence/where: shelf \(by terminal\)")
    code, _ = run.end()
    assert code == 0, code


def test_attended(directory):
    run = Terminal(directory, waiting(directory, 0.6), "--attended", "0.2")
    run.wait_for("paused: unattended for 0.2 s")
    assert run.other("attend", "--once").returncode == 0
    run.wait_for("continues: attended again")
    run.wait_for("paused: unattended")
    attend = subprocess.Popen([LOCKSTEP, "attend"], env=run.environment, stderr=subprocess.PIPE, text=True)
    code, _ = run.end()
    assert code == 0
    assert "the run has ended" in attend.communicate(timeout=PATIENCE)[1] and attend.returncode == 0
    assert run.other("attend").returncode == 2


def test_a_command_at_the_prompt_attends(directory):
    run = Terminal(directory, waiting(directory, 1000), "--attended", "0.3")
    run.wait_for("Enter continues the run, q ends it")
    run.type("")
    run.wait_for("continues: attended again")
    run.wait_for("Enter continues the run, q ends it")
    run.type("q")
    code, _ = run.end()
    assert code == 130, code


with tempfile.TemporaryDirectory() as directory:
    for name, test in list(globals().items()):
        if name.startswith("test_"):
            test(directory)
            print(name)
