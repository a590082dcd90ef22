"Trees that run in this process, over lockstep/runtime.h."
import collections
import collections.abc
import ctypes
import difflib
import logging
import os
import signal
import threading
import time
import weakref

import lockstep_leaf

from . import _leaves as leaves_
from . import _native as native
from ._error import Error

Diagnostic = collections.namedtuple("Diagnostic", "severity file line column message hint")
Diagnostic.__doc__ = "What is wrong with a tree, or may be: severity is error, warning or note."
Diagnostic.__str__ = lambda it: "".join(f"{place}:" for place in it[1:4] if place) + (" " if it.file else "") + (
    f"{it.severity}: {it.message}" + (f" ({it.hint})" if it.hint else ""))

_LEVELS = {"debug": logging.DEBUG, "info": logging.INFO, "warning": logging.WARNING}
_logger = logging.getLogger("lockstep")


def _log(who, level, text):
    _logger.log(_LEVELS[level], "%s: %s", who, text)


class _Held:
    "The project of the library, until nobody has it: a thread may be making a tree of it while another closes it."

    def __init__(self, library, leaves):
        self.handle = library.project_new()
        if not self.handle:
            raise Error(9, library.why())
        weakref.finalize(self, _free_project, library, self.handle, os.getpid(), leaves)


class Project:
    """A tree file (or `text`) with its includes, plugins and leaves. Trees are made of it: `Tree(project)`.

    `leaves` are classes of lockstep_leaf, and modules that have some. They run in this process, and take the place
    of a <plugin> that has the name of their module."""

    def __init__(self, tree=None, *, text=None, leaves=(), args=None, set=None, plugins=(), plugin_path=(),
                 main_tree=None, isolate=False):
        if (tree is None) == (text is None):
            raise TypeError("a project has a file or a text, one of the two")
        self._library = library = native.load()
        self._leaves = list(leaves_.plugins_of(leaves))
        self._held = _Held(library, self._leaves)
        try:
            self._configure(args or {}, set or {}, plugins, plugin_path, main_tree, isolate)
            self._load(tree, text)
        except BaseException:
            self.close()
            raise

    def _configure(self, args, values, plugins, plugin_path, main_tree, isolate):
        library, handle = self._library, self._held.handle
        steps = [(library.project_add_leaves, ctypes.byref(it)) for it in self._leaves]
        steps += [(library.project_add_plugin_path, os.fsencode(it)) for it in _list(plugin_path)]
        steps += [(library.project_add_plugin, os.fsencode(it)) for it in _list(plugins)]
        for function, dictionary in ((library.project_set_argument, args), (library.project_set_value, values)):
            steps += [(function, native.bytes_of(name), native.bytes_of(lockstep_leaf._plain(it)))
                      for name, it in dictionary.items()]
        if main_tree is not None:
            steps.append((library.project_set_main_tree, native.bytes_of(main_tree)))
        if isolate:
            steps.append((library.project_isolate_all,))
        for function, *arguments in steps:
            if not function(handle, *arguments):
                raise Error(4, library.why())

    def _load(self, tree, text):
        library, handle = self._library, self._held.handle
        if text is None:
            good = library.project_load_file(handle, os.fsencode(tree))
        else:
            data = text.encode("utf-8", "surrogateescape")
            good = library.project_load_text(handle, b"text", data, len(data))
        self.diagnostics = [self._diagnostic(i) for i in range(library.project_diagnostic_count(handle))]
        if not good:
            errors = [it for it in self.diagnostics if it.severity == "error"]
            raise Error(3, "\n".join(map(str, errors)) or library.why(), self.diagnostics)
        for it in self.diagnostics:
            _logger.log(logging.WARNING if it.severity == "warning" else logging.INFO, "%s", it)
        self.nodes = [self._node(i) for i in range(library.project_node_count(handle))]
        self.entries = dict(self._entry(i) for i in range(library.project_entry_count(handle)))

    def _diagnostic(self, index):
        it = native.sized(native.Diagnostic)
        self._library.project_diagnostic(self._held.handle, index, it)
        return Diagnostic(native.SEVERITIES[it.severity], native.text_of(it.file), it.line, it.column,
                          native.text_of(it.message), native.text_of(it.hint))

    def _node(self, index):
        it = native.sized(native.Node)
        self._library.project_node(self._held.handle, index, it)
        return _Fact(index, it.parent, it.end, *map(native.text_of, (it.path, it.name, it.id)))

    def _entry(self, index):
        it = native.sized(native.Entry)
        self._library.project_entry(self._held.handle, index, it)
        return native.text_of(it.key), (it.type, native.text_of(it.type_name))

    def close(self):
        "Its trees live on."
        self._held = None

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()


_Fact = collections.namedtuple("_Fact", "index parent end path name id")


def _list(given):
    return [given] if isinstance(given, (str, bytes, os.PathLike)) else given


def _free(function, handle, process, state=None):
    "When nobody has it any more, or at the end. The child of a fork leaves it to its parent."
    if os.getpid() != process:
        return
    if state is None:
        return function(handle)
    with state.guard:
        if state.user is not None:
            return  # a thread ticks it while the process ends
        state.user = "the end"
    with state:
        function(handle)


class _State:
    """What the functions that lockstep calls need of a tree. It does not keep the tree alive.

    An exception cannot pass through lockstep: it is kept, and raised after the call. For Ctrl-C the handler of
    Python is put off while no code runs out of which the exception could be caught."""

    def __init__(self, log, clock):
        self.log, self.clock = log, clock
        self.guard = threading.Lock()  # of user
        self.user = None               # who uses the tree
        self.thread = None      # that is in a call
        self.observers = []
        self.observes = False   # observers are being called
        self.thrown = None      # to be raised after the call
        self.cause = None       # the exception of the leaf that has a fault
        self.inside = False     # an exception would be caught
        self.pending = None     # a signal that was put off
        self.handler = None     # of Python, for SIGINT
        self.own_handler = self.on_signal

    # Around each call that may call leaves. Ctrl-C may come out of every line before the handler is changed, and after
    # it is what it was.
    def __enter__(self):
        self.handler, self.thrown, self.cause, self.pending = None, None, None, None
        if threading.get_ident() == threading.main_thread().ident:
            handler = signal.getsignal(signal.SIGINT)
            if callable(handler):
                self.handler = handler
                signal.signal(signal.SIGINT, self.own_handler)
        self.thread = threading.get_ident()
        self.outer, leaves_.making.state = getattr(leaves_.making, "state", None), self

    def __exit__(self, *_):
        leaves_.making.state, self.thread, self.outer = self.outer, None, None
        if self.handler is not None and signal.getsignal(signal.SIGINT) is self.own_handler:
            signal.signal(signal.SIGINT, self.handler)
        if self.pending is not None:
            self.handler(*self.pending)
        if self.thrown is not None:
            thrown, self.thrown = self.thrown, None
            raise thrown

    def on_signal(self, number, frame):
        if self.inside:
            self.handler(number, frame)
        else:
            self.pending = (number, frame)

    def blame(self, error):
        "For lockstep: what is wrong with a leaf that has raised it."
        self.inside = False
        if not isinstance(error, Exception):
            self.thrown = self.thrown or error
        elif self.cause is None:
            self.cause = error
        return leaves_.blame(error).replace("\0", "").encode("utf-8", "replace")

    def keep(self, work):
        "Of what is no leaf."
        try:
            self.inside = True
            work()
            self.inside = False
        except BaseException as error:
            self.inside = False
            self.thrown = self.thrown or error

    def log_of(self, who):
        def log(text, level):
            if level not in native.LEVELS:
                raise ValueError(f"the level is {level!r}, expected debug, info or warning")
            self.log(who, level, text)
        return log

    # What lockstep calls.

    def on_log(self, _user, who, level, text):
        self.keep(lambda: self.log(native.text_of(who), native.LEVELS[level], native.text_of(text)))

    def on_tick(self, _user, _run, tick, seconds, status):
        self.observes = True
        for observe in self.observers:
            self.keep(lambda: observe(tick, seconds, native.STATUSES[status]))
        self.observes = False

    def stops(self, _user):
        return self.pending is not None or self.thrown is not None


class Node:
    "A node of a tree: what it is, and how it is now."

    __slots__ = ("_tree", "_fact")

    def __init__(self, tree, fact):
        self._tree, self._fact = tree, fact

    index = property(lambda self: self._fact.index, doc="its place in the order of the tree; the root is 0")
    path = property(lambda self: self._fact.path, doc="Main/pull/arm")
    name = property(lambda self: self._fact.name, doc="arm; without a name in the tree, its id")
    id = property(lambda self: self._fact.id, doc="the tag: MoveArm")
    status = property(lambda self: native.STATUSES[self._state().status],
                      doc="idle, running, success, failure or skipped")
    progress = property(lambda self: self._state().progress, doc="from 0 to 1; its leaves are asked")
    held = property(lambda self: self._state().held, doc="a synchronized node withholds its ticks")
    ticked = property(lambda self: self._state().ticked, doc="it was, in the last tick")

    @property
    def parent(self):
        "None for the root."
        nodes = self._tree.nodes
        return nodes[self._fact.parent] if self._fact.parent != self.index else None

    @property
    def children(self):
        found, index = [], self.index + 1
        while index < self._fact.end:
            found.append(self._tree.nodes[index])
            index = found[-1]._fact.end
        return found

    def _state(self):
        it = native.sized(native.NodeState)
        self._tree._ask(self.index, it)
        return it

    def __repr__(self):
        return f"<{self.id} {self.path}>"


class Entries(collections.abc.Mapping):
    """The entries of the blackboard, as a mapping of those that have a value. They are read and written between
    ticks; observers may read them."""

    def __init__(self, tree):
        self._tree = tree

    def _declared(self, key):
        types = self._tree._entries
        if key in types:
            return types[key]
        raise KeyError(f"no node uses an entry '{key}'" + _hint(key, types))

    def __getitem__(self, key):
        self._declared(key)
        value = self._tree._read(lambda library, handle: _read_entry(library, handle, native.bytes_of(key)))
        if value is None:
            raise KeyError(f"nothing has written the entry '{key}'")
        return value

    def get(self, key, default=None):
        self._declared(key)
        try:
            return self[key]
        except KeyError:
            return default

    def __setitem__(self, key, value):
        number, name = self._declared(key)
        type_ = _type_for(value, number, name)
        data, library = native.bytes_of(key), self._tree._library

        def write(handle):
            if type_ is None:
                return library.run_set_text(handle, data, native.bytes_of(value))
            set_ = getattr(library, "run_set_" + native.function_name(type_, "text"))
            return type_.write(set_, handle, data, value=value)

        try:
            good = self._tree._using(write)
        except TypeError:
            raise TypeError(f"the entry '{key}' is of type {name}, not {value!r}") from None
        if not good:
            raise ValueError(library.why())

    def __iter__(self):
        types = self._tree._entries
        return (key for key in types if self._tree._read(
            lambda library, handle: library.run_value_type(handle, native.bytes_of(key))))

    def __len__(self):
        return sum(1 for _ in self)

    def __contains__(self, key):
        return any(it == key for it in self)

    def __repr__(self):
        return repr(dict(self))


def _read_entry(library, handle, key):
    number = library.run_value_type(handle, key)
    if number in (native.OBJECT, 4):
        return native.text_of(library.run_get_text(handle, key))
    for type_ in native.TYPES.values():
        if type_.number == number:
            return type_.read(getattr(library, "run_get_" + native.function_name(type_, "text")), handle, key)
    return None


def _type_for(value, number, name):
    "Of a value that is to be written; None: as a text."
    if isinstance(value, str) or number == native.OBJECT:
        if isinstance(value, str):
            return None
        raise TypeError(f"an entry of type {name} is written as a text, not as {value!r}")
    if name in native.TYPES:
        return native.TYPES[name]
    first = value[0] if isinstance(value, (list, tuple)) and value else value
    item = "bool" if isinstance(first, bool) else "int" if isinstance(first, int) else (
        "string" if isinstance(first, str) else "double")
    return native.TYPES[("list of " if isinstance(value, (list, tuple)) else "") + item]


def _hint(name, names):
    near = difflib.get_close_matches(name, list(names), 1)
    return f"; did you mean '{near[0]}'?" if near else ""


class Tree:
    """A run of a tree in this process.

        with lockstep.Tree("tree.xml", leaves=[Grip], seed=3) as tree:
            while tree.tick() == "running":
                print(tree.root.progress, dict(tree.entries))

    `tree` is a file or a Project; the other keywords of a Project may be given with a file. `clock` is "virtual", on
    which ticks come as fast as they can and a leaf sees times that are `period` apart, or "wall". `on_fault` is
    "stop" or "fail": the leaf fails, and the tree goes on. `log(path, level, text)` gets what leaves log; without it
    the logger "lockstep" of logging does."""

    def __init__(self, tree=None, *, seed=0, period=0.01, clock="virtual", on_fault="stop", log=None, **project):
        if clock not in ("virtual", "wall"):
            raise ValueError(f"the clock is {clock!r}, expected virtual or wall")
        if on_fault not in ("stop", "fail"):
            raise ValueError(f"on_fault is {on_fault!r}, expected stop or fail")
        if not (isinstance(period, (int, float)) and 1e-9 <= period <= 9e9):
            raise ValueError(f"the period is {period!r}, expected seconds")
        if isinstance(tree, Project):
            if project:
                raise TypeError(f"{', '.join(project)}: of a project that is loaded already")
            project = tree
        else:
            project = Project(tree, **project)
        held = project._held
        if held is None:
            raise Error(2, "the project is closed")
        self._library, self._handle = project._library, None
        self._entries, self._seed, self._period, self._clock = project.entries, seed, period, clock
        self._on_fault = on_fault
        self._state = state = _State(log or _log, clock)
        self._callbacks = native.LOG(state.on_log), native.OBSERVE(state.on_tick), native.STOP(state.stops)
        self._begin(project, held)
        self.nodes = [Node(self, it) for it in project.nodes]
        self._by_path = {it.path: it for it in self.nodes}
        self.entries = Entries(self)

    def _begin(self, project, held):
        library, state = self._library, self._state
        options = native.sized(native.RunOptions, on_fault=int(self._on_fault == "fail"), seed=_seed(self._seed),
                               tick_period=self._period, virtual_time=self._clock == "virtual",
                               log=self._callbacks[0])
        with state:
            handle = library.run_new(held.handle, options)
        if not handle:
            raise Error(5, library.why()) from state.cause
        self._handle = handle
        # What lockstep has pointers to lives as long as the run.
        kept = self._callbacks, project._leaves
        self._finalizer = weakref.finalize(self, _free_run, library, handle, os.getpid(), state, kept)
        library.run_observe(handle, self._callbacks[1], None)
        self._forget()

    def _forget(self):
        self._ticks, self._last, self._start = 0, 0.0, None

    root = property(lambda self: self.nodes[0])
    status = property(lambda self: self.root.status, doc="of the root")
    progress = property(lambda self: self.root.progress, doc="of the root")
    closed = property(lambda self: self._handle is None)

    def node(self, path):
        "The node with this path: Main/pull/arm."
        try:
            return self._by_path[path]
        except KeyError:
            raise KeyError(f"there is no node '{path}'" + _hint(path, self._by_path)) from None

    def tick(self, seconds=None):
        """One tick, and the status of the root after it. After success or failure the next one begins the tree
        again. `seconds` is the time since the tree began; without it that of the clock."""
        return self._using(self._tick, seconds)

    def _tick(self, handle, seconds):
        seconds = self._time() if seconds is None else seconds
        if not (isinstance(seconds, (int, float)) and self._last <= seconds <= 9e9):  # which NaN is not
            raise ValueError(f"the time of a tick is {seconds!r}, expected seconds, and not before the last tick "
                             f"({self._last:g})")
        self._last, self._ticks = seconds, self._ticks + 1
        return native.STATUSES[self._call(handle, self._library.run_tick, seconds)]

    def _time(self):
        if self._clock == "virtual":
            return max(self._last, self._ticks * self._period)
        if self._start is None:
            self._start = time.monotonic() - self._last
        return time.monotonic() - self._start

    def run(self, *, max_ticks=None, timeout=None):
        """Ticks once in each period until the tree completes, or until a limit. A tree that was ticked begins
        again. The result has `result`, `reason`, `ticks`, `time_s` and `overruns`."""
        return self._using(self._run, max_ticks or 0, timeout or 0.0)

    def _run(self, handle, max_ticks, timeout):
        from . import Run
        if self._ticks:
            self._restart(handle, self._seed)
        options = native.sized(native.LoopOptions, max_ticks=max_ticks, timeout=timeout,
                               virtual_clock=self._clock == "virtual", stop=self._callbacks[2])
        end = native.sized(native.LoopResult)
        self._ticks = 1  # also when it ends in an exception
        if not self._call(handle, self._library.run_loop, options, end):
            raise ValueError(self._library.why())
        self._ticks, self._last = end.ticks, end.seconds
        reason, result = native.REASONS[end.reason], native.STATUSES[end.status]
        completed = reason == "completed"
        summary = {"result": result if completed else "stopped", "reason": reason, "ticks": end.ticks,
                   "time_s": end.seconds, "overruns": end.overruns}
        return Run(summary, _CODES.get(result, 124) if completed else 124, "")

    def halt(self):
        "Halts every leaf that runs, in the order of the tree. The next tick begins the tree again."
        self._using(self._call, self._library.run_halt)

    def restart(self, seed=None):
        "Begins as a new tree would, with this seed or that of before."
        self._using(self._restart, self._seed if seed is None else seed)

    def _restart(self, handle, seed):
        with self._state:
            good = self._library.run_restart(handle, _seed(seed))
        if not good:
            raise Error(5, self._library.why()) from self._state.cause
        self._seed = seed
        self._forget()

    def on_tick(self, observe):
        "`observe(tick, seconds, status)` is called after each tick. It may read the tree."
        self._state.observers.append(observe)
        return observe

    def close(self):
        "Halts what runs and ends the leaves. Without it that happens when nobody has the tree any more."
        if self._handle is not None:
            self._using(self._forget_handle)
            self._finalizer()

    def _forget_handle(self, _handle):
        self._handle = None

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def __repr__(self):
        return "<lockstep tree, closed>" if self.closed else f"<lockstep tree: {self.nodes[0].path}>"

    def _using(self, work, *arguments):
        "work(handle, …), for one user at a time. Nothing is called in `finally`: out of a call Ctrl-C may come."
        state, me = self._state, object()
        try:
            with state.guard:
                if state.user is not None:
                    raise Error(2, "the tree is in use: it is being ticked, here or in another thread")
                state.user = me
            if self._handle is None:
                raise Error(2, "the tree is closed")
            return work(self._handle, *arguments)
        finally:
            if state.user is me:
                state.user = None

    def _is_observed(self):
        return self._state.observes and self._state.thread == threading.get_ident()

    def _read(self, work):
        read = lambda handle: work(self._library, handle)
        return read(self._handle) if self._is_observed() else self._using(read)

    def _ask(self, index, answer):
        "For the state of a node. Leaves are asked for their progress, and may have a fault."
        if self._is_observed():
            self._library.run_node(self._handle, index, answer)
        else:
            self._using(self._ask_alone, index, answer)

    def _ask_alone(self, handle, index, answer):
        with self._state:
            self._library.run_node(handle, index, answer)
        if self._state.cause is not None:
            self._raise_fault(handle)

    def _call(self, handle, function, *arguments):
        "A call that ticks or halts."
        try:
            with self._state:
                result = function(handle, *arguments)
        except BaseException:  # Ctrl-C in a leaf
            self._halt_after_fault(handle)
            raise
        self._raise_fault(handle)
        return result

    def _raise_fault(self, handle):
        cause = self._state.cause
        error = self._halt_after_fault(handle)
        if error is not None:
            raise error from cause

    def _halt_after_fault(self, handle):
        "When a leaf has a fault, halts everything."
        fault = self._library.run_fault(handle, None)
        if fault is None:
            return None
        node = ctypes.c_uint32()
        fault = self._library.run_fault(handle, node)
        error = Error(5, native.text_of(fault), node=self.nodes[node.value].path)
        with self._state:
            self._library.run_halt(handle)
        return error


def _free_project(library, handle, process, _leaves):
    _free(library.project_free, handle, process)


def _free_run(library, handle, process, state, _kept):
    _free(library.run_free, handle, process, state)


_CODES = {"success": 0, "failure": 1}


def _seed(seed):
    if not (isinstance(seed, int) and 0 <= seed < 2**64):
        raise ValueError(f"the seed is {seed!r}, expected a whole number from 0, below 2^64")
    return seed
