#!/usr/bin/python3
# The same as shapes.py with lockstep_leaf.
from lockstep_leaf import Action, Fixed, Output, Port, Refused, serve

FACTORS = {"round": ("size.radius", 3.0), "square": ("size.side", 1.0)}


class Shape(Action):
    "computes an area"
    more_ports = ["size.*", "out.*"]
    kind: Fixed[str] = Port(doc="which shape")

    @classmethod
    def describe(cls, kind):
        if kind not in FACTORS:
            raise Refused("there is no such shape", port="kind", hint="use round or square")
        return {"out.area": Output[float], "out.text": Output[str],
                FACTORS[kind][0]: (float, Port(unit="m", min=0, max=100))}

    def start(self):
        self.size, self.factor = FACTORS[self.kind]

    def tick(self):
        size = self[self.size]
        self["out.area"] = self.factor * size * size
        self["out.text"] = f"{self.kind} of {size:g}"
        return True


class Box(Shape):
    kind: Fixed[str] = Port(choices=list(FACTORS))


serve()
