#!/usr/bin/python3
# A leaf whose ports depend on its element, by the protocol alone: <Shape kind="round" size.radius="2"/>.
import json
import sys

FACTORS = {"round": ("size.radius", 3.0), "square": ("size.side", 1.0)}


def say(**what):
    print(json.dumps(what), flush=True)


def describe(fixed):
    if fixed["kind"] == "nameless":
        return say(refused="")
    if fixed["kind"] not in FACTORS:
        return say(refused="there is no such shape", port="kind", hint="use round or square")
    say(log="describes " + fixed["kind"])
    say(ports=[{"name": "out.area", "type": "double", "direction": "output", "doc": "its area"},
               {"name": "out.text", "type": "string", "direction": "output"},
               {"name": FACTORS[fixed["kind"]][0], "type": "number", "unit": "m", "min": 0, "max": 100}])


say(lockstep=1, doc="for tests", leaves=[
    {"id": "Shape", "doc": "computes an area", "more_ports": ["size.*", "out.*"],
     "ports": [{"name": "kind", "type": "string", "fixed": True, "doc": "which shape"}]}])
kinds, ports = {}, {}
for line in sys.stdin:
    request = json.loads(line)
    leaf = request.get("leaf")
    if request["do"] == "describe":
        describe(request["fixed"])
    elif request["do"] == "create":
        kinds[leaf], ports[leaf] = request["fixed"]["kind"], {}
    elif "ports" in request:
        ports[leaf].update(request["ports"])
    if request["do"] == "tick":
        name, factor = FACTORS[kinds[leaf]]
        size = ports[leaf][name]
        say(leaf=leaf, status="success", set={"out.area": factor * size * size, "out.text": f"{kinds[leaf]} of {size:g}"})
    elif request["do"] in ("create", "halt"):
        say(leaf=leaf, done=True)
