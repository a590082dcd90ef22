#!/usr/bin/python3
# Conditions whose answers come at once, late, or not at all.
import json
import os
import signal
import sys
import time


def say(**what):
    print(json.dumps(what), flush=True)


with open(os.environ.get("PIDS", os.devnull), "a") as pids:
    print(os.getpid(), file=pids)
say(lockstep=1, leaves=[{"id": "IsUp", "kind": "condition",
                         "ports": [{"name": "after", "type": "double", "default": 0.0},
                                   {"name": "stops_at", "type": "int", "default": -1},
                                   {"name": "answer", "type": "string", "default": "success"}]}])
ports, ticks = {}, {}
for line in sys.stdin:
    request = json.loads(line)
    do, number = request["do"], request["leaf"]
    ports.setdefault(number, {}).update(request.get("ports", {}))
    if do == "tick":
        ticks[number] = ticks.get(number, 0) + 1
        time.sleep(ports[number]["after"])
        if ticks[number] == ports[number]["stops_at"]:
            os.kill(os.getpid(), signal.SIGSTOP)
        say(leaf=number, status=ports[number]["answer"])
    elif do in ("create", "halt"):
        say(leaf=number, done=True)
