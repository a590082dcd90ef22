#!/usr/bin/python3
# Sets ports that the tree may leave out, and says what it reads before and after.
from lockstep_leaf import Action, InOut, Output, Port, serve


class Unbound(Action):
    out: Output[float]
    both: InOut[float] = 0.25
    maybe: InOut[float] = Port(optional=True)

    def start(self):
        self.ticks = 0

    def say(self):
        self.log(f"both {self.both:g}")
        self.log(f"maybe {getattr(self, 'maybe', 'none')}".replace("3.0", "3"))

    def tick(self):
        self.say()
        self.ticks += 1
        if self.ticks == 2:
            return True
        self.out, self.both, self.maybe = 1.0, 2.0, 3.0
        self.say()
        return None


serve()
