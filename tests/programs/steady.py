#!/usr/bin/python3
# A leaf that says what happens to it.
import json
import os
import sys


def say(**what):
    print(json.dumps(what), flush=True)


with open(os.environ.get("PIDS", os.devnull), "a") as pids:
    print(os.getpid(), file=pids)
say(lockstep=1, leaves=[{"id": "Steady", "pause": True, "progress": True}])
ticks = 0
for line in sys.stdin:
    request = json.loads(line)
    do, number = request["do"], request["leaf"]
    if do == "tick":
        ticks += 1
        say(leaf=number, status="running", progress=min(1, ticks / 1000))
        continue
    if do != "create":
        say(leaf=number, log={"start": "started", "halt": "halted", "pause": "paused",
                              "resume": "resumed", "destroy": "destroyed"}[do])
    if do in ("create", "halt"):
        say(leaf=number, done=True)
