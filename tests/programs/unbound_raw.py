#!/usr/bin/python3
# The same without the helper: it knows what lockstep says.
import json
import sys


def say(**what):
    print(json.dumps(what), flush=True)


say(lockstep=1, leaves=[{"id": "Unbound", "ports": [
    {"name": "out", "type": "double", "direction": "output"},
    {"name": "both", "type": "double", "direction": "inout", "default": 0.25},
    {"name": "maybe", "type": "double", "direction": "inout", "optional": True}]}])
for line in sys.stdin:
    request = json.loads(line)
    leaf, do = request["leaf"], request["do"]
    if do == "create":
        unbound = request.get("unbound", [])
    if do in ("create", "halt"):
        say(leaf=leaf, done=True)
    if do == "start":
        ticks, ports = 0, {}
    ports = {**ports, **request.get("ports", {})} if do != "create" else {}
    if do != "tick":
        continue
    ticks += 1
    for name in ("both", "maybe"):
        value = ports.get(name)
        say(leaf=leaf, log=f"{name} " + ("none" if value is None else f"{value:g}"))
    if ticks == 2:
        say(leaf=leaf, status="success")
        continue
    values = {"out": 1, "both": 2, "maybe": 3}
    for name in ("both", "maybe"):  # what a tick sets is there at once where it is bound
        value = ports.get(name) if name in unbound else values[name]
        say(leaf=leaf, log=f"{name} " + ("none" if value is None else f"{value:g}"))
    say(leaf=leaf, status="running", set=values)
