#!/usr/bin/python3
# Is at 0.6 from its first tick on, and does what its port says when it is held. With ANSWERS=1 it answers `pause`.
import json
import os
import sys

answers = os.environ.get("ANSWERS") == "1"


def say(**what):
    print(json.dumps(what), flush=True)


with open(os.environ.get("PIDS", os.devnull), "a") as pids:
    print(os.getpid(), file=pids)
say(lockstep=1, leaves=[{"id": "Held", "progress": True, "pause": True, "answers_pause": answers,
                         "ports": [{"name": "how", "type": "string"}]}])
for line in sys.stdin:
    request = json.loads(line)
    do, number = request["do"], request["leaf"]
    if do == "start":
        how = request["ports"]["how"]
    elif do == "tick":
        say(leaf=number, status="running", progress=0.6)
    elif do == "pause":
        if how == "end":
            os._exit(3)
        if how == "error":
            say(leaf=number, error="the brake is broken")
        elif answers and how != "silent":
            say(leaf=number, done=True)
    elif do in ("create", "halt"):
        say(leaf=number, done=True)
