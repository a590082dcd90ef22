"""Leaves of lockstep in Python: a class for each type of leaf, and `serve()` at the end of the file.

    #!/usr/bin/python3
    from lockstep_leaf import Action, serve

    class Sweep(Action):
        "Sweeps the floor."
        step: float = 0.01               # a port, with its default

        def start(self):
            self.done = 0.0

        def tick(self):
            self.done += self.step
            return True if self.done >= 1 else None    # True, False: success, failure; None: running

        def progress(self):
            return min(self.done, 1.0)

    serve()

docs/programs.md has the rest. `python3 -m lockstep_leaf sweep.py` tries the leaves by hand.
"""
import os
import sys

# A program may have the name of a module of Python, such as select.py: what is imported here must not take it for that module.
_beside = os.path.dirname(os.path.realpath((getattr(sys, "argv", None) or [""])[0]))  # a program in C may have set no argv
_path, sys.path = sys.path, [it for it in sys.path if os.path.realpath(it or ".") != _beside]
import atexit
import json
import math
import random
import threading
import traceback

sys.path = _path

__all__ = ["Action", "Condition", "Cut", "Failed", "Fixed", "InOut", "Output", "Port", "Refused", "Skipped", "Waiting", "say",
           "serve"]

PROTOCOL = 1
_TYPES = {bool: "bool", int: "int", float: "double", str: "string", list[bool]: "list of bool",
          list[int]: "list of int", list[float]: "list of double", list[str]: "list of string"}


class Skipped:
    "What a tick may return in a tree for BehaviorTree.CPP: as if the leaf were not there."


def _one_text(of, texts):
    if len(texts) > 1:
        raise TypeError(f"{of.__name__} takes one text, not {len(texts)}: {of.__name__}({texts[0]!r})")


class Failed(Exception):
    """A failure and its reason, which `lockstep log why` shows: `raise Failed("no object at the door")`, also from a
    function that tick calls. It may also be returned."""

    def __init__(self, *text):
        _one_text(Failed, text)
        super().__init__(*text)


class Waiting(str):
    'What a tick that runs may return: what it waits for. `return Waiting("force 3 of 10 N")`'

    def __new__(cls, *text):
        _one_text(Waiting, text)
        return super().__new__(cls, *text)


class Cut:
    """How the process of the run ended before this one: whether the machine was off (power), whether the leaf got no
    ticks then (held), how many seconds ago (gap), and how many ticks the run may have forgotten (lost_ticks). on_resume is
    what the tree wants of a leaf that finds later that it cannot continue: "restart", "failure" or "success"."""

    def __init__(self, power, held, gap, lost_ticks, on_resume="restart"):
        self.power, self.held, self.gap, self.lost_ticks, self.on_resume = power, held, gap, lost_ticks, on_resume


class Port:
    """The default of a port, and its other facts:
    `force: float = Port(10.0, unit="N", min=0, doc="how hard")`."""

    def __init__(self, default=None, *, unit="", doc="", min=None, max=None, choices=None,
                 optional=False):
        self.default, self.optional = default, optional
        self.facts = {"unit": unit, "doc": doc, "min": min, "max": max, "choices": choices}


class Refused(Exception):
    "Why an element has no ports; `port` is the fixed port whose text is wrong. Raised by `describe`."

    def __init__(self, message, port="", hint=""):
        super().__init__(message)
        self.port, self.hint = port, hint


def _as_bool(value):
    if isinstance(value, bool):
        return value
    raise TypeError


def _as_int(value):
    if isinstance(value, bool) or not hasattr(value, "__index__"):
        raise TypeError
    value = value.__index__()
    if not -2**63 <= value < 2**63:
        raise ValueError(f"{value} does not fit 64 bits")
    return value


def _as_float(value):
    if isinstance(value, (bool, str)) or not hasattr(value, "__float__"):
        raise TypeError
    return float(value)


def _as_str(value):
    if isinstance(value, str):
        return str.__str__(value)  # of an Enum: its value
    raise TypeError


_ITEMS = {"bool": _as_bool, "int": _as_int, "double": _as_float, "string": _as_str}


def _as_type(type_, value):
    "A value of this type, which is not one that others have: numbers that fit are converted. TypeError: it is none."
    if not type_.startswith("list of "):
        return _ITEMS[type_](value)
    if isinstance(value, (str, bytes)) or not hasattr(value, "__iter__"):
        raise TypeError
    return [_ITEMS[type_[len("list of "):]](it) for it in value]


def _text(text, most=4096):
    "A text for people, as lockstep takes it: UTF-8, which a name of a file may not be, without NUL, and of so many bytes."
    return str(text).replace("\0", "").encode("utf-8", "replace")[:most].decode("utf-8", "ignore")


class _Directed:
    "Output[float], InOut[float], Fixed[str]"

    def __init__(self, direction, type_=None, fixed=False):
        self.direction, self.type, self.fixed = direction, type_, fixed

    def __getitem__(self, type_):
        return _Directed(self.direction, type_, self.fixed)


Output = _Directed("output")
InOut = _Directed("inout")
Fixed = _Directed("input", fixed=True)  # an input that a tree gives as a constant: `describe` gets it


def _plain(value):
    "A value as it is written in a tree."
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (list, tuple)):
        return ";".join(_plain_item(it) if isinstance(it, str) else _plain(it) for it in value) + (
            ";" if len(value) > 0 and value[-1] == "" else "")
    return str(value)


def _plain_item(text):
    "A text of a list: its first and last character may be a blank that counts."
    ends = (0, len(text) - 1)
    return "".join("\\" + it if it in "\\;" or (at in ends and it in " \t\r\n") else it for at, it in enumerate(text))


# What a leaf has in addition to its ports.
_TAKEN = {"behavior", "clock", "describe", "halt", "log", "more_ports", "name", "now", "path", "pause",
          "period", "progress", "random", "real_time", "restore", "resume", "save", "set_pace", "start", "tick"}


class _Attribute:
    "A port of a class: what its leaves read is what lockstep sent last."

    def __init__(self, name, annotation, default):
        directed = annotation if isinstance(annotation, _Directed) else _Directed("input", annotation)
        port = default if isinstance(default, Port) else Port(default)
        if directed.type not in _TYPES:
            raise TypeError(f"the port '{name}' is a {directed.type}, expected bool, int, float, str "
                            "or a list of them: list[float]")
        if name in _TAKEN:
            raise TypeError(f"a port cannot be called '{name}', as leaves have a {name} already")
        self.name, self.direction, self.type = name, directed.direction, _TYPES[directed.type]
        self.fact = {"name": name, "type": self.type, "direction": self.direction}
        if port.default is not None:
            default = port.default
            self.fact["default"] = _plain(default) if isinstance(default, (list, tuple)) else default
        if port.optional:
            self.fact["optional"] = True
        if directed.fixed:
            self.fact["fixed"] = True
        self.fact.update({key: value for key, value in port.facts.items() if value not in (None, "")})

    def __get__(self, leaf, owner=None):
        if leaf is None:
            return self
        value = leaf._values.get(self.name)
        if value is None:
            raise AttributeError(f"the port '{self.name}' has no value" +
                                 ("" if leaf._has_ports else " yet: start and tick can read it"))
        return list(value) if isinstance(value, list) else value

    def __set__(self, leaf, value):
        if self.direction == "input":
            raise AttributeError(f"the port '{self.name}' is an input")
        try:
            value = _as_type(self.type, value)
        except TypeError:
            raise TypeError(f"set '{self.name}', a port of type {self.type}, to {value!r}") from None
        for number in value if isinstance(value, list) else (value,):
            if isinstance(number, float) and not math.isfinite(number):
                raise ValueError(f"the port '{self.name}' cannot be {number}: expected a finite number")
        if self.name not in leaf._unbound:  # else it is discarded, as in C++
            leaf._values[self.name] = leaf._set[self.name] = value


class _Leaf:
    _kind = ""
    real_time = False  # it works in real time, whether ticks come or not
    more_ports = ()  # names that an element may have in addition to these: ["goal.*"]; `describe` returns them
    behavior = {}  # what it does, for `lockstep verify`, in the words of a leaf model: {"ticks": "2..40"}

    # What lockstep sends: about the run, and of this tick.
    name = path = clock = ""
    period = now = 0.0

    def __init_subclass__(cls):
        cls._ports = dict(getattr(cls, "_ports", {}))
        for name, annotation in cls.__dict__.get("__annotations__", {}).items():
            if isinstance(annotation, str):
                annotation = eval(annotation, vars(sys.modules[cls.__module__]))
            cls._ports[name] = _Attribute(name, annotation, cls.__dict__.get(name))
            setattr(cls, name, cls._ports[name])
        for name, value in vars(cls).items():
            if isinstance(value, Port):
                raise TypeError(f"the port '{name}' has no type: {name}: float = Port(…)")
        if cls.__module__ != __name__:
            _classes[cls.__name__] = cls

    def tick(self):
        raise NotImplementedError(f"{type(self).__name__} has no tick")

    # Ports that `describe` has given to the element, by their names: self["goal.x"].
    def __getitem__(self, name):
        return self._port_named(name).__get__(self)

    def __setitem__(self, name, value):
        self._port_named(name).__set__(self, value)

    def __contains__(self, name):
        "Whether the port has a value."
        return name in self._own_ports and self._values.get(name) is not None

    def _port_named(self, name):
        if name not in self._own_ports:
            raise KeyError(f"there is no port '{name}'")
        return self._own_ports[name]

    @classmethod
    def _described(cls, fixed):
        "The ports that an element with these constants has in addition to those of the class, by their names."
        if not cls.more_ports:
            return {}
        given = {name: _received(cls._ports[name], value) for name, value in fixed.items() if name in cls._ports}
        return {name: _Attribute(name, *(it if isinstance(it, tuple) else (it, None)))
                for name, it in cls.describe(**given).items()}

    def log(self, text, level="info"):
        if level not in _LEVELS:
            raise ValueError(f"the level is {level!r}, expected debug, info or warning")
        self._log(_text(text, 32768), level)

    def _log(self, text, level):
        say(leaf=self._number, log=text, level=level)

    @classmethod
    def _pauses(cls):
        return hasattr(cls, "pause") or hasattr(cls, "resume")

    @classmethod
    def _is_kept(cls):
        if hasattr(cls, "save") != hasattr(cls, "restore"):
            raise TypeError(f"{cls.__name__} has one of save and restore: a leaf that continues after a cut has both")
        return hasattr(cls, "save")

    @classmethod
    def _fact(cls):
        fact = {"id": cls.__name__, "kind": cls._kind, "doc": " ".join((cls.__doc__ or "").split()),
                "ports": [port.fact for port in cls._ports.values()]}
        if cls.more_ports:
            fact["more_ports"] = [cls.more_ports] if isinstance(cls.more_ports, str) else list(cls.more_ports)
        flags = {"progress": hasattr(cls, "progress"), "set_pace": hasattr(cls, "set_pace"), "real_time": cls.real_time,
                 "restore": cls._is_kept(), "pause": cls._pauses(), "answers_pause": cls._pauses()}
        said = {"behavior": {word: str(value) for word, value in cls.behavior.items()}} if cls.behavior else {}
        return fact | {name: True for name, is_set in flags.items() if is_set} | said


_classes = {}


class Action(_Leaf):
    _kind = "action"


class Condition(_Leaf):
    _kind = "condition"


_ANSWERS = {None: "running", True: "success", False: "failure", Skipped: "skipped",
            "running": "running", "success": "success", "failure": "failure", "skipped": "skipped"}


def _status(leaf, result):
    "The word for what a tick has returned."
    running = "" if leaf._kind == "condition" else "None (running), "
    try:
        status = _ANSWERS[result]
    except (KeyError, TypeError):
        status = None
    if status is None or (running == "" and status == "running"):
        raise ValueError(f"tick returned {result!r}, expected {running}True (success) or False (failure)")
    return status


def _done(leaf):
    done = leaf.progress()
    if not hasattr(done, "__float__"):
        raise TypeError(f"progress returned {done!r}, expected a number from 0 to 1")
    if not math.isfinite(done):
        raise ValueError(f"progress returned {float(done)}, expected a number from 0 to 1")
    return float(done)


def _progress(leaf):
    return {"progress": _done(leaf)} if hasattr(leaf, "progress") else {}


# A leaf in the process of the run does what follows, too: lockstep/_leaves.py. What is done here is the same in both.

_LEVELS = ("debug", "info", "warning")


def _received(port, value):
    "The value of a port that lockstep has sent, where 1 may be a float."
    try:
        return None if value is None else _as_type(port.type, value)
    except TypeError:
        raise TypeError(f"the port '{port.name}' is of type {port.type}, not {value!r}") from None


def _new(cls, number, seed, fixed={}, **facts):
    "A leaf whose __init__ is still to be called: it may use what lockstep has sent."
    leaf = cls.__new__(cls)
    leaf._own_ports = cls._ports | cls._described(fixed)
    leaf._number, leaf._values, leaf._set, leaf._has_ports, leaf._has_started = number, {}, {}, False, False
    leaf._unbound = ()
    for name, value in facts.items():
        setattr(leaf, name, value)
    leaf.random = random.Random(seed)
    return leaf


def _begin(leaf):
    "Before the first function of an activation."
    leaf._set, leaf._has_started, leaf._has_ports = {}, False, True


def _call(leaf, function):
    if hasattr(leaf, function):
        getattr(leaf, function)()


def _start(leaf):
    _begin(leaf)
    _call(leaf, "start")
    leaf._has_started = True


def _tick(leaf):
    """The status after a tick, why it is so or what it waits for, the progress of a leaf that runs, and the values that
    were set since the last tick."""
    try:
        result = leaf.tick()
    except Failed as failed:
        result = failed
    reason = _text(result) if isinstance(result, (Failed, Waiting)) else ""
    if isinstance(result, (Failed, Waiting)):
        result = False if isinstance(result, Failed) else None
    status = _status(leaf, result)
    progress = _progress(leaf) if status == "running" else {}
    values, leaf._set = leaf._set, {}
    return status, reason, progress, values


def _halt(leaf):
    if leaf._has_started:  # there is nothing to halt when its start has failed
        _call(leaf, "halt")


def _pace(leaf, factor):
    "The pace that it takes up when it is to have this one."
    taken = leaf.set_pace(factor)
    if taken is None:
        return factor
    if isinstance(taken, bool) or not hasattr(taken, "__float__") or math.isnan(taken):
        raise ValueError(f"set_pace returned {taken!r}, expected None, or the least pace that it can have")
    return min(max(float(taken), factor), 1.0)


def _json(what):
    "Its bytes. A half of a surrogate pair is no UTF-8, and becomes what JSON escapes it to: \\udcff."
    text = json.dumps(what, separators=(",", ":"), allow_nan=False, ensure_ascii=False)
    return text.encode("utf-8", "backslashreplace")


def _kept(leaf):
    "The text that a leaf keeps for another process."
    return _json(leaf.save()).decode()


def _restore(leaf, kept, cut):
    "Of a leaf that has begun: whether it continues with this text, and then its progress."
    try:
        goes_on = leaf.restore(json.loads(kept), cut)
    except Failed:
        return "cannot continue", {}
    if goes_on not in (True, False):
        raise ValueError(f"restore returned {goes_on!r}, expected True (it continues) or False (it starts again)")
    leaf._has_started = bool(goes_on)
    return ("continues", _progress(leaf)) if goes_on else ("starts again", {})


class _Server:
    "One process: its leaves by their numbers, and an answer to each request."

    def __init__(self):
        self.leaves = {}
        self.broken = set()  # those that had an error; the next start mends it

    def create(self, number, request):
        leaf = _new(_classes[request["type"]], number, request["seed"], request.get("fixed", {}),
                    period=float(request["period"]), **{name: request[name] for name in ("name", "path", "clock")})
        leaf._unbound = request.get("unbound", ())
        self.update(leaf, request.get("fixed", {}))
        self.leaves[number] = leaf
        leaf.__init__()
        say(leaf=number, done=True)

    def begin(self, leaf, request):
        self.broken.discard(leaf._number)
        leaf._values, leaf._kept = {}, None
        self.update(leaf, request.get("ports", {}))

    def start(self, leaf, request):
        self.begin(leaf, request)
        _start(leaf)

    def restore(self, leaf, request):
        self.begin(leaf, request)
        _begin(leaf)
        cut = Cut(**{name: request[name] for name in ("power", "held", "gap", "lost_ticks", "on_resume") if name in request})
        cut.gap = float(cut.gap)
        after_cut, progress = _restore(leaf, request["kept"], cut)
        say(leaf=leaf._number, done=True, after_cut=after_cut, **progress)

    @staticmethod
    def kept(leaf):
        "What is to be kept of it, if that has changed."
        if not hasattr(leaf, "save"):
            return {}
        kept = _kept(leaf)
        if kept == leaf._kept:
            return {}
        leaf._kept = kept
        return {"kept": kept}

    def tick(self, leaf, request):
        self.update(leaf, request.get("ports", {}))
        status, reason, progress, values = _tick(leaf)
        answer = {"leaf": leaf._number, "status": status}
        if reason:
            answer["reason"] = reason
        answer |= progress
        if status == "running":
            answer |= self.kept(leaf)
        if values:
            answer["set"] = {name: _utf8(value) for name, value in values.items()}
        say(**answer)

    def halt(self, leaf, request):
        _halt(leaf)
        say(leaf=leaf._number, done=True)

    def pause(self, leaf, request):
        if leaf._number not in self.broken:
            _call(leaf, "pause")
        if leaf._pauses():
            say(leaf=leaf._number, done=True, **self.kept(leaf))

    def resume(self, leaf, request):
        _call(leaf, "resume")

    def set_pace(self, leaf, request):
        factor = float(request["factor"])
        taken = _pace(leaf, factor)
        if taken > factor:
            say(leaf=leaf._number, pace=taken)

    def destroy(self, leaf, request):
        del self.leaves[leaf._number]

    @staticmethod
    def update(leaf, ports):
        own = leaf._own_ports
        leaf._values.update({name: _received(own[name], value) for name, value in ports.items() if name in own})

    @staticmethod
    def describe(request):
        try:
            ports = _classes[request["type"]]._described(request["fixed"])
            say(ports=[port.fact for port in ports.values()])
        except Exception as error:
            say(refused=_refusal(error), **{key: getattr(error, key, "") for key in ("port", "hint")})

    def answer(self, request):
        if request["do"] == "describe":
            return self.describe(request)
        do, number = request["do"], request["leaf"]
        try:
            if do == "create":
                return self.create(number, request)
            leaf = self.leaves[number]
            leaf.now = float(request.get("now", leaf.now))
            if number in self.broken and do in ("tick", "resume", "set_pace"):
                return None
            handler = getattr(self, do, None)  # requests of a later version are ignored
            return handler and handler(leaf, request)
        except Exception as error:
            self.broken.add(number)
            say(leaf=number, error=_blame(error))


def _blame(error, folder=None):
    "What went wrong, and where in the author's file; the files in `folder` are lockstep's, as this one is."
    mine = [frame for frame in traceback.extract_tb(error.__traceback__)
            if frame.filename != __file__ and os.path.dirname(frame.filename) != folder]
    where = f" ({os.path.basename(mine[-1].filename)}:{mine[-1].lineno})" if mine else ""
    try:
        message = str(error)
    except BaseException as worse:
        message = f"its __str__ raised {type(worse).__name__}"
    return _text(f"{type(error).__name__}: {message}{where}")


def _refusal(error):
    return _text(error) if isinstance(error, Refused) else _blame(error)


def _utf8(value):
    "A value without what a line cannot have: bytes of a name of a file that are no UTF-8."
    if isinstance(value, list):
        return [_utf8(it) for it in value]
    return value.encode("utf-8", "surrogateescape").decode("utf-8", "replace") if isinstance(value, str) else value


_MOST = 1 << 20  # bytes of a line


def _line(what):
    return _json(what) + b"\n"


def _refuse_long(what):
    "Names what is too long to be sent, in place of sending what ends the conversation."
    parts = {f"the port '{name}'": value for name, value in what.get("set", {}).items()}
    if "kept" in what:
        parts["what save has returned"] = what["kept"]
    sizes = {part: len(_line(value)) - 1 for part, value in parts.items()}
    part = max(sizes, key=sizes.get, default="an answer")
    size = f" of {sizes[part]} bytes as JSON" if sizes else ""
    raise ValueError(f"{part}{size} does not fit a line to lockstep, which has at most 1 MiB")


_out = 1
_writing = threading.Lock()  # a line that two threads write at once is none


def say(**what):
    """Writes a line of the protocol, from any thread: `say(leaf=1, progress=0.5)`. For programs that speak it
    themselves; leaves have `log`."""
    line = memoryview(_line(what))
    if len(line) - 1 > _MOST:
        _refuse_long(what)
    with _writing:
        while line:
            line = line[os.write(_out, line):]



def serve(version="", doc=""):
    "Speaks to lockstep until it ends the conversation. At the end of the author's file."
    global _out, _is_served
    _is_served = True
    caller = sys._getframe(1)
    if _by_hand or (caller.f_code.co_name == "<module>" and caller.f_globals.get("__name__") != "__main__"):
        return  # the file is imported: its leaves are for this process
    if sys.stdin.isatty():
        return _Prompt().run()
    # What the leaves print is for people.
    _out = os.dup(1)
    os.dup2(2, 1)
    sys.stdout = sys.stderr
    hello = {"lockstep": PROTOCOL, "leaves": [cls._fact() for cls in _classes.values()]}
    say(**hello, **{key: text for key, text in (("version", version), ("doc", doc)) if text})
    server = _Server()
    for line in sys.stdin.buffer:
        server.answer(json.loads(line))


_by_hand = _is_served = False


@atexit.register
def _remind():
    "Of what is forgotten easily; a file that uses the package lockstep ticks its leaves itself."
    is_program = any(cls.__module__ == "__main__" for cls in _classes.values()) and not hasattr(sys, "ps1")
    is_program = is_program and not hasattr(sys, "last_type")  # an exception that ended it was reported
    if is_program and not _is_served and "lockstep" not in sys.modules:
        print("lockstep_leaf: this file has leaves, but does not call serve() at its end", file=sys.stderr)


class _Prompt:
    "Requests from a person, in place of lockstep."

    def __init__(self):
        self.server, self.now, self.number, self.cls = _Server(), 0.0, 0, None

    def ask(self, do, **fields):
        print("->", json.dumps({"do": do, "leaf": self.number, "now": round(self.now, 9), **fields}),
              flush=True)
        self.server.answer({"do": do, "leaf": self.number, "now": self.now, **fields})

    def start(self, words):
        if words and words[0] in _classes:
            self.cls, self.number = _classes[words.pop(0)], self.number + 1
            given = self.values(words, self.cls._ports)
            fixed = {name: given[name] for name, it in self.cls._ports.items() if "fixed" in it.fact and name in given}
            self.ask("create", type=self.cls.__name__, name=self.cls.__name__, path=self.cls.__name__,
                     period=0.01, clock="virtual", seed=0, **({"fixed": fixed} if fixed else {}))
        if self.cls is None:
            return print("start what? one of:", ", ".join(_classes))
        if self.number in self.server.leaves:
            self.ask("start", ports=self.values(words, self.server.leaves[self.number]._own_ports))

    @staticmethod
    def values(words, of):
        ports = {name: port.fact["default"] for name, port in of.items() if "default" in port.fact}
        for word in words:
            name, _, value = word.partition("=")
            try:
                ports[name] = json.loads(value)
            except ValueError:
                ports[name] = value
        return ports

    def obey(self, line):
        do, *words = line.split()
        if do == "start":
            self.start(words)
        elif do in ("tick", "halt", "pause", "resume") and self.number in self.server.leaves:
            for _ in range(int(words[0]) if words else 1):
                self.ask(do)
                self.now += 0.01
        else:
            print("start LEAF [PORT=VALUE…] · tick [TIMES] · pause · resume · halt · quit")

    def run(self):
        for cls in _classes.values():
            ports = " ".join(f"{port['name']}:{port['type']}" for port in cls._fact()["ports"])
            print(f"{cls.__name__} ({cls._kind}) {ports}")
        while True:
            print("> ", end="", flush=True)
            line = sys.stdin.readline()
            if not line or line.strip() == "quit":
                return
            if line.strip():
                self.obey(line)


def main():
    if len(sys.argv) != 2:
        sys.exit("usage: python3 -m lockstep_leaf FILE.py")
    import runpy
    module = sys.modules["lockstep_leaf"] = sys.modules["__main__"]
    module._by_hand = True
    sys.argv = sys.argv[1:]
    sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))
    runpy.run_path(sys.argv[0], run_name="__lockstep__")
    module._Prompt().run()


if __name__ == "__main__":
    main()
