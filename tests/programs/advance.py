#!/usr/bin/python3
# Advance of the plugin motion, as a program: the same numbers, and so the same recording.
import json
import sys


def say(**what):
    print(json.dumps(what), flush=True)


say(lockstep=1, leaves=[{"id": "Advance", "progress": True, "ports": [
    {"name": "step", "type": "double", "default": 0.01}]}])
leaves = {}
for line in sys.stdin:
    request = json.loads(line)
    number = request["leaf"]
    if request["do"] == "start":
        leaves[number] = (0.0, request["ports"]["step"])
    elif request["do"] == "tick":
        done, step = leaves[number]
        done = min(1.0, done + step)
        leaves[number] = (done, step)
        say(leaf=number, status="success" if done >= 1 - 1e-9 else "running", progress=done)
    elif request["do"] in ("create", "halt"):
        say(leaf=number, done=True)
