#!/usr/bin/python3
# A program that describes its elements wrongly: as the element says.
import json
import sys

ANSWERS = {"wrong": {"done": True}, "bad": {"ports": [{"name": "size.x", "type": "thing"}]},
           "round": {"ports": [{"name": "size.x", "type": "double"}]}}


def say(**what):
    print(json.dumps(what, separators=(",", ":")), flush=True)


say(lockstep=1, leaves=[{"id": "Hull", "more_ports": ["size.*"],
                         "ports": [{"name": "kind", "type": "string", "fixed": True},
                                   {"name": "count", "type": "int", "fixed": True, "default": 1}]}])
for line in sys.stdin:
    request = json.loads(line)
    if request["do"] == "describe":
        if request["fixed"]["kind"] == "ends":
            sys.exit(3)
        say(**ANSWERS[request["fixed"]["kind"]])
    elif request["do"] in ("create", "halt"):
        say(leaf=request["leaf"], done=True)
    elif request["do"] == "tick":
        say(leaf=request["leaf"], status="success")
