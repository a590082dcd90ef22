#!/usr/bin/python3
"Leaves that show whatever a leaf can see and do: as a process plugin, and in the process of the run."
from lockstep_leaf import Action, Condition, Failed, Fixed, InOut, Output, Port, Refused, Skipped, Waiting, serve

TYPES = {"flag": bool, "whole": int, "real": float, "text": str, "flags": list[bool], "wholes": list[int],
         "reals": list[float], "texts": list[str]}


class Act(Action):
    "Does a word of its script in each tick."
    script: str
    count: Output[int]
    sum: InOut[float] = 0.0
    behavior = {"ticks": "1..9"}

    def start(self):
        self.words, self.done, self.factor, self.ticks = self.script.split(), 0.0, 1.0, 0
        self.log(f"start {self.now} {self.random.random()}")
        if self.words[0] == "E":
            raise OSError("cannot start")

    def tick(self):
        word = self.words[min(self.ticks, len(self.words) - 1)]
        self.ticks += 1
        self.count, self.sum = self.ticks, self.sum + 0.5
        self.log(f"{word} {self.now} {self.count} {self.sum}", "debug" if self.ticks % 2 else "warning")
        if word[0] in "SFX":
            return {"S": True, "F": False, "X": Skipped}[word[0]]
        if word == "raise":
            raise Failed("raised")
        if word == "fail":
            return Failed("returned")
        if word == "error":
            raise KeyError("error")
        if word == "odd":
            return "odd"
        self.done += float(word) * self.factor
        return Waiting(f"at {self.done}") if self.ticks % 2 else None

    def progress(self):
        if self.done is None:
            raise ValueError("progress of a leaf that does not run")
        return min(max(self.done, 0.0), 1.0)

    def set_pace(self, factor):
        self.factor = factor
        self.log(f"pace {factor!r}")

    def pause(self):
        self.log("pause")

    def resume(self):
        self.log("resume")

    def halt(self):
        self.log(f"halt {self.ticks}")


class Ends(Action):
    "Has no progress when it has ended."
    ok: bool = True

    def start(self):
        self.left = 3

    def tick(self):
        self.left -= 1
        if self.left == 0:
            self.left = None
            return self.ok
        return None

    def progress(self):
        return 1 - self.left / 3


class Is(Condition):
    "A letter of its script in each tick."
    script: str

    def __init__(self):
        self.at = 0

    def tick(self):
        letter = self.script[self.at % len(self.script)]
        self.at += 1
        return {"S": True, "F": False, "N": None}.get(letter, letter)


class Pass(Action):
    "Logs the values of its inputs, and sets its outputs to them."
    flag: bool = True
    whole: int = 0
    real: float = 0.0
    text: str = ""
    flags: list[bool] = []
    wholes: list[int] = []
    reals: list[float] = []
    texts: list[str] = []
    to_flag: Output[bool]
    to_whole: Output[int]
    to_real: Output[float]
    to_text: Output[str]
    to_flags: Output[list[bool]]
    to_wholes: Output[list[int]]
    to_reals: Output[list[float]]
    to_texts: Output[list[str]]

    def start(self):
        self.ticks = 0

    def tick(self):
        self.ticks += 1
        for name in TYPES:
            value = getattr(self, name)
            self.log(f"{name} {value!r}")
            if isinstance(value, list):
                value.append(value[0] if value else TYPES[name].__args__[0]())  # of a copy, which is its own
                self.log(f"{name} {getattr(self, name)!r}")
                value = tuple(value)
            setattr(self, "to_" + name, value)
            if getattr(self, "to_" + name) != (list(value) if isinstance(value, tuple) else value):
                return False
        return True if self.ticks == 2 else None


class Defaults(Action):
    "Logs its defaults, which it needs as they are here."
    none: list[str] = []
    empty: list[str] = [""]
    blanks: list[str] = [" x ", "\t", "y z", ""]
    marks: list[str] = ["p;q", "r\\", "\\;", "{x}"]
    numbers: list[float] = (1e300, -0.0, 3)
    real: float = 1e-7
    whole: int = 2**62
    text: str = " lead \\ ;"

    def tick(self):
        values = [self.none, self.empty, self.blanks, self.marks, self.numbers, self.real, self.whole, self.text]
        self.log(repr(values))
        return values == [[], [""], [" x ", "\t", "y z", ""], ["p;q", "r\\", "\\;", "{x}"], [1e300, 0, 3], 1e-7, 2**62,
                          " lead \\ ;"]


class Sets(Action):
    "Sets an output to what it evaluates, and logs what it reads then and later."
    value: str
    flag: Output[bool]
    whole: Output[int]
    real: Output[float]
    text: Output[str]
    reals: Output[list[float]]
    limited: Output[int] = Port(min=0, max=9)
    port: str

    def start(self):
        self.ticks = 0

    def tick(self):
        self.ticks += 1
        if self.ticks == 1:
            setattr(self, self.port, eval(self.value))
        self.log(repr(getattr(self, self.port)))
        return True if self.ticks == 2 else None


class Says(Action):
    "Logs what it evaluates."
    text: str
    level: str = "info"
    how: str = "log"

    def tick(self):
        text = eval(self.text)
        if self.how == "log":
            self.log(text, self.level)
        elif self.how == "failed":
            return Failed(text)
        elif self.how == "waiting":
            return Waiting(text)
        elif self.how == "error":
            raise RuntimeError(text)
        return True


class Fault(Action):
    "Does something wrong in one of its functions."
    where: str

    def __init__(self):
        self.check("__init__")

    def check(self, where):
        if where == "__init__":
            return
        if self.where == where:
            raise ZeroDivisionError(where)

    def start(self):
        self.ticks = 0
        self.check("start")

    def tick(self):
        self.ticks += 1
        self.check("tick")
        if self.where == "no port":
            return self["no.port"]
        if self.where == "input":
            self.where = "x"
        return None if self.ticks < 3 else True

    def progress(self):
        self.check("progress")
        return {"none": None, "nan": float("nan"), "text": "1"}.get(self.where, 0.1 * self.ticks)

    def set_pace(self, factor):
        self.check("set_pace")
        return "fast" if self.where == "pace" else None

    def pause(self):
        self.check("pause")

    def resume(self):
        self.check("resume")

    def halt(self):
        self.log("halt")
        self.check("halt")


class Form(Action):
    "Has a port with what describe was given. Its constants are there from the beginning."
    more_ports = ["x.*"]
    flag: Fixed[bool] = False
    whole: Fixed[int] = 3
    real: Fixed[float] = 1
    text: Fixed[str] = "-"
    flags: Fixed[list[bool]] = []
    wholes: Fixed[list[int]] = []
    reals: Fixed[list[float]] = [1]
    texts: Fixed[list[str]] = []

    @classmethod
    def describe(cls, **given):
        if given["text"] == "refused":
            raise Refused("it is refused", port="text", hint="write another one")
        if given["text"] == "wrong":
            raise ValueError("cannot be described")
        return {"x.given": (str, Port(repr(given).encode().hex())), "x.real": (float, 2), "x.out": Output[list[float]]}

    def __init__(self):
        self.made_with = repr({name: getattr(self, name) for name in TYPES})

    def tick(self):
        given = repr({name: getattr(self, name) for name in TYPES})
        self.log(bytes.fromhex(self["x.given"]).decode())
        self["x.out"] = [self["x.real"]]
        return bytes.fromhex(self["x.given"]).decode() == given == self.made_with


serve()
