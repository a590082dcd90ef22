"""Robots in step on two machines: two network namespaces, joined by a cable that is pulled out, is slow and loses words.
Both robots run trees/carry_together/carry.xml. Their recordings are compared on the clock of this machine: no child may be
ticked beyond a barrier before the other robot was at it.

  namespaces_test.py LOCKSTEP TREE

The namespaces and all processes in them end with this program. It needs the right to make them: as root, or where users may have namespaces."""
import contextlib
import fcntl
import heapq
import json
import os
import random
import select
import signal
import struct
import subprocess
import sys
import threading
import time

import robots

LOCKSTEP, TREE = sys.argv[1:3]
RATE = 75  # Hz: the lift takes 1.3 s
BARRIERS = (0.25, 0.5, 0.75)
ADDRESSES = {"left": "10.20.0.1", "right": "10.20.0.2"}
IN_NAMESPACE = "LOCKSTEP_TEST_HAS_NAMESPACE"


def enter_namespace():
    """This program begins again in a network namespace of its own, which is the machine 'left'."""
    if IN_NAMESPACE in os.environ:
        return
    for rights in ([], ["--map-root-user"]):
        command = ["unshare", "--net", *rights, "--pid", "--fork", "--kill-child", "--mount-proc"]
        with contextlib.suppress(FileNotFoundError):
            if subprocess.run([*command, "ip", "link", "set", "lo", "up"], capture_output=True).returncode == 0:
                os.execvpe("unshare", [*command, sys.executable, *sys.argv], {**os.environ, IN_NAMESPACE: "1"})
    print("skipped: no network namespace may be made here, or there is no unshare or ip")
    sys.exit(77)


class Network:
    def __init__(self):
        self.right = subprocess.Popen(["unshare", "--net", "sh", "-c", "echo; exec sleep infinity"], stdout=subprocess.PIPE)
        self.right.stdout.readline()  # it is in its namespace
        for machine in ADDRESSES:
            self.on(machine, "ip link set lo up")

    def close(self):
        self.right.kill()
        self.right.wait()

    def command(self, machine, *command):
        return [*([] if machine == "left" else ["nsenter", f"--net=/proc/{self.right.pid}/ns/net"]), *command]

    def on(self, machine, command):
        subprocess.run(self.command(machine, *command.split()), check=True)

    def plug_in(self):
        """A new cable, with an interface at each end."""
        self.on("left", f"ip link add net0 type veth peer name net0 netns {self.right.pid}")
        self.address()

    def address(self):
        for machine, address in ADDRESSES.items():
            self.on(machine, f"ip address add {address}/24 dev net0")
            self.on(machine, "ip link set net0 up")

    def remove(self):
        self.on("left", "ip link delete net0")


class SlowCable:
    """Copies what is sent from one machine to the other, after a delay and not always."""
    DELAY, JITTER, LOSS = 0.01, 0.02, 0.1  # s, s, a fraction

    def __init__(self, network):
        self.random = random.Random(1)
        self.ends = [self.tap(name) for name in ("net0", "net1")]
        network.on("left", f"ip link set net1 netns {network.right.pid} name net0")
        network.address()
        stopped, self.stop = os.pipe()
        self.thread = threading.Thread(target=self.copy, args=[stopped])
        self.thread.start()

    @staticmethod
    def tap(name):
        TUNSETIFF, IFF_TAP, IFF_NO_PI = 0x400454CA, 0x0002, 0x1000
        end = os.open("/dev/net/tun", os.O_RDWR | os.O_NONBLOCK)
        fcntl.ioctl(end, TUNSETIFF, struct.pack("16sH22x", name.encode(), IFF_TAP | IFF_NO_PI))
        return end

    def copy(self, stopped):
        waiting, count = [], 0
        while True:
            until = max(0, waiting[0][0] - time.monotonic()) if waiting else None
            ready = select.select([*self.ends, stopped], [], [], until)[0]
            if stopped in ready:
                return
            for end in ready:
                frame = os.read(end, 65536)
                if self.random.random() >= self.LOSS:
                    other = self.ends[1 - self.ends.index(end)]
                    at = time.monotonic() + self.DELAY + self.JITTER * self.random.random()
                    heapq.heappush(waiting, (at, count := count + 1, other, frame))
            while waiting and waiting[0][0] <= time.monotonic():
                _, _, end, frame = heapq.heappop(waiting)
                with contextlib.suppress(OSError):  # its interface is down
                    os.write(end, frame)

    def close(self):
        """Its interfaces go with it."""
        os.write(self.stop, b".")
        self.thread.join()
        for end in self.ends:
            os.close(end)


class Robot(robots.Robot):
    def __init__(self, name, folder, *more):
        run = [LOCKSTEP, "run", TREE, "--arg", f"me={name}", "--rate", str(RATE), *more]
        super().__init__(network.command(name, *run), f"{folder}/{name}-{time.monotonic_ns()}.jsonl")
        self.name, self.other = name, "right" if name == "left" else "left"

    def holds(self):
        self.wait_for(f"{self.other}: failure: not heard for")

    def continues(self):
        self.wait_for("lift: continues")

    def ticks(self):
        """Time, progress of the own child, whether it was ticked, and what was heard of the other one: at each tick."""
        with open(self.record, encoding="utf-8") as lines:
            names = [node["name"] for node in json.loads(next(lines))["nodes"]]
            nodes = {name: ["idle", 0, 0] for name in names}
            for line in lines:
                if not line.endswith("\n"):
                    return  # it was killed
                line = json.loads(line)
                for index, status, progress, ticked, _ in line.get("nodes", []):
                    before = nodes[names[index]]
                    nodes[names[index]] = [status, 1 if "success" in (before[0], status) else progress, ticked]
                if "tick" in line:
                    _, progress, ticked = nodes["lift"]
                    yield self.zero + line["time_s"], progress, ticked, nodes[self.other][1]


def judge(lefts, rights):
    """The recordings of all processes of each robot: none was beyond a barrier that the other one had not reached."""
    for some, others in ((lefts, rights), (rights, lefts)):
        reached = {barrier: min((at for other in others for at, progress, _, _ in other.ticks() if progress >= barrier),
                                default=float("inf")) for barrier in BARRIERS}
        for robot in some:
            for at, progress, ticked, heard in robot.ticks():
                for barrier in BARRIERS:
                    if not ticked or progress < barrier:
                        continue
                    assert heard >= barrier, f"{robot.name} was at {progress} when it had heard {heard}"
                    # Both times are as exact as their robots' lines were read.
                    assert at > reached[barrier] - 1 / RATE, \
                        f"{robot.name} was beyond {barrier} at {at} s, and the other one was there at {reached[barrier]} s"


def pair(folder, *more):
    """Both robots, in motion."""
    both = [Robot(name, folder, *more) for name in ADDRESSES]
    for robot in both:
        robot.wait_for("lift: started")
    return both


def end(left, right, *before):
    left.succeeds()
    right.succeeds()
    judge([left], [right, *before])


def test_a_cable_that_is_pulled_out(folder):
    left, right = pair(folder)
    network.on("right", "ip link set net0 down")
    left.holds()
    right.holds()
    network.on("right", "ip link set net0 up")
    left.continues()
    right.continues()
    end(left, right)


def test_an_interface_that_is_made_again(folder):
    left, right = pair(folder)
    network.remove()
    left.holds()
    right.holds()
    for robot in (left, right):
        robot.wait_for("the addresses of this machine have changed")
    network.plug_in()
    left.continues()
    right.continues()
    end(left, right)


def test_a_machine_that_gets_another_address(folder):
    left, right = pair(folder)
    network.on("left", "ip address flush dev net0")
    left.holds()
    right.holds()
    network.on("left", "ip address add 10.20.0.3/24 dev net0")
    left.wait_for("the addresses of this machine have changed")
    left.continues()
    right.continues()
    end(left, right)
    network.remove()
    network.plug_in()


def test_a_robot_that_is_killed_and_started_again(folder):
    left, right = pair(folder)
    right.kill()
    left.holds()
    again = Robot("right", folder)
    left.continues()
    end(left, again, right)


def test_a_robot_that_hangs(folder):
    left, right = pair(folder)
    right.kill(signal.SIGSTOP)
    left.holds()
    right.kill(signal.SIGCONT)
    left.continues()
    end(left, right)


def test_a_network_that_is_slow_and_loses_words(folder):
    network.remove()
    try:
        cable = SlowCable(network)
    except OSError as error:
        network.plug_in()
        print(f"(left out: no tap device: {error.strerror})", end=" ")
        return
    try:
        end(*pair(folder))
    finally:
        cable.close()
        network.plug_in()


enter_namespace()
network = Network()
try:
    network.plug_in()
    robots.run_tests(globals())
finally:
    network.close()
