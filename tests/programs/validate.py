#!/usr/bin/python3
# validate.py SCHEMA LINES: each line keeps the schema, and the schema refuses what is no line.
import json
import sys

import jsonschema

with open(sys.argv[1]) as file:
    schema = json.load(file)
jsonschema.Draft7Validator.check_schema(schema)
validator = jsonschema.Draft7Validator(schema)
kinds = set()
with open(sys.argv[2]) as file:
    for line in file:
        message = json.loads(line)
        validator.validate(message)
        kinds.add(message.get("do") or next(k for k in ("lockstep", "status", "done", "log", "ports") if k in message))
wrong = [{"leaf": 1, "status": "fine"}, {"leaf": 0, "done": True}, {"do": "stop", "leaf": 1}, {"leaf": 1},
         {"lockstep": 2, "leaves": []}, {"do": "create", "leaf": 1}, {"status": "running"}]
print(*sorted(kinds), sum(not validator.is_valid(message) for message in wrong) == len(wrong))
