#!/usr/bin/python3
# Advance of the plugin motion, with lockstep_leaf.
from lockstep_leaf import Action, serve


class Advance(Action):
    step: float = 0.01

    def start(self):
        self.done = 0.0

    def tick(self):
        self.done = min(1.0, self.done + self.step)
        return True if self.done >= 1 - 1e-9 else None

    def progress(self):
        return self.done

    def pause(self):
        pass  # it stands still between ticks


serve()
