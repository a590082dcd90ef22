#!/usr/bin/python3
# Does in its third tick what its port says.
import json
import os
import signal
import subprocess
import sys
import time


def say(**what):
    print(json.dumps(what), flush=True)


def garbage(number):
    print("Traceback (most recent call last):", flush=True)


def half(number):
    sys.stdout.write('{"leaf":%d,"sta' % number)
    sys.stdout.flush()
    os._exit(3)


def endless(number):
    while True:
        sys.stdout.write("x" * 65536)


def twice(number):
    say(leaf=number, status="running")
    say(leaf=number, status="running")


def wrong_order(number):
    say(leaf=number, done=True)


def foreign(number):
    say(leaf=77, status="running")


def status(number):
    say(leaf=number, status="fine")


def list_(number):
    print("[1,2]", flush=True)


def closed(number):
    os.close(1)
    time.sleep(100)


def die(number):
    os.kill(os.getpid(), signal.SIGSEGV)


def end(number):
    os._exit(3)


def silent(number):
    time.sleep(100)


def error(number):
    say(leaf=number, error="the driver is gone")


def empty_error(number):
    say(leaf=number, error="")


def own_error(number):
    say(error="the bus is gone")


def wrong_type(number):
    say(leaf=number, status="running", set={"width": "wide"})


def no_port(number):
    say(leaf=number, status="running", set={"depth": 1})


def progress(number):
    say(leaf=number, status="running", progress="half")


def nothing(number):
    say(leaf=number)


def deep(number):
    print("[" * 100000, flush=True)


def children(number):
    # One in the group, one that has left it.
    for setsid in (False, True):
        child = subprocess.Popen(["sleep", "1000"], start_new_session=setsid)
        with open(os.environ["PIDS"], "a") as pids:
            print(child.pid, file=pids)
    say(leaf=number, log="children are there")
    say(leaf=number, status="running")


def stop_at(what):
    "Stops lockstep and itself, once."
    if os.environ.get("STOPS_AT") == what:
        del os.environ["STOPS_AT"]
        time.sleep(0.05)  # lockstep waits by then
        with open(f"/proc/{os.getppid()}/stat") as guardian:
            os.kill(int(guardian.read().rpartition(")")[2].split()[1]), signal.SIGSTOP)
        os.kill(os.getpid(), signal.SIGSTOP)


def slow(number):
    time.sleep(1)
    say(leaf=number, status="running", progress=0.5)


misdeeds = {"list": list_, **{name: thing for name, thing in list(globals().items()) if callable(thing)}}
with open(os.environ.get("PIDS", os.devnull), "a") as pids:
    print(os.getpid(), file=pids)
stop_at("hello")
say(lockstep=1, leaves=[
    {"id": "Misbehave", "progress": True, "ports": [
        {"name": "how", "type": "string"},
        {"name": "width", "type": "double", "direction": "output"}]}])
hows, ticks = {}, {}
if "STUBBORN" in os.environ:
    signal.signal(signal.SIGTERM, signal.SIG_IGN)
for line in sys.stdin:
    request = json.loads(line)
    do, number = request["do"], request["leaf"]
    stop_at(do)
    if do == "create":
        ticks[number] = 0
        say(leaf=number, done=True)
    elif do == "start":
        hows[number] = request["ports"].get("how", "")
    elif do == "tick":
        ticks[number] += 1
        if ticks[number] == 3 and hows[number] in misdeeds:
            misdeeds[hows[number]](number)
        else:
            say(leaf=number, status="running")
    elif do == "halt":
        if hows[number] == "deaf":
            time.sleep(1000)
        say(leaf=number, done=True)
stop_at("end")
if "STUBBORN" in os.environ:
    time.sleep(1000)
while "FLOOD" in os.environ:
    os.write(1, b'{"leaf":1,"progress":0.5}\n' * 10000)
