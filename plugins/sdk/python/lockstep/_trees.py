"Trees that run in this process, over lockstep/runtime.h."
import ctypes
import os
import threading
import time
import weakref

from . import _native as native
from ._error import Error
from ._nodes import Entries, Node, hint
from ._project import Project, log as log_
from ._state import State, free


class ResumedLeaf:
    """A leaf that ran at the cut. `does` is "continues", "restart" (in its next tick), or the "success" or "failure" of
    its next tick; `asked`: the leaf has decided so."""

    def __init__(self, path, does, asked, progress):
        self.path, self.does, self.asked, self.progress = path, does, asked, progress


class Resumed:
    """How a tree continues after a cut: `ticks` that were before it, the `time_s` of the last one, the `gap_s` since
    then, `text` for people, and the `leaves` that ran at the cut."""

    def __init__(self, ticks, time_s, gap_s, text, leaves):
        self.ticks, self.time_s, self.gap_s, self.text, self.leaves = ticks, time_s, gap_s, text, leaves


class Tree:
    """A run of a tree in this process.

        with lockstep.Tree("tree.xml", leaves=[Grip], seed=3) as tree:
            while tree.tick() == "running":
                print(tree.root.progress, dict(tree.entries))

    `tree` is a file or a Project; the other keywords of a Project may be given with a file. `clock` is "virtual", on
    which ticks come as fast as they can and a leaf sees times that are `period` apart, or "wall". `on_fault` is
    "stop" or "fail": the leaf fails, and the tree continues. `log(path, level, text)` gets what leaves log; without it
    the logger "lockstep" of logging does.

    In seconds, 0 for none: a call of a leaf that takes longer than `tick_budget` is reported to `log`, at most once a second;
    one that lasts longer than `hang_limit` and has not returned, once to `on_hang(who, function, seconds)`, from another
    thread, or to `log` without it."""

    def __init__(self, tree=None, *, seed=0, period=0.01, clock="virtual", on_fault="stop", log=None,
                 tick_budget=0, hang_limit=0, on_hang=None, **project):
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
        self._on_fault, self._tick_budget, self._hang_limit = on_fault, tick_budget, hang_limit
        self._state = state = State(log or log_, clock)
        self._callbacks = (native.LOG(state.on_log), native.OBSERVE(state.on_tick), native.STOP(state.stops),
                           native.HANG(_hang(on_hang, state.log)))
        self._begin(project, held)
        self.nodes = [Node(self, it) for it in project.nodes]
        self._by_path = {it.path: it for it in self.nodes}
        self.entries = Entries(self)

    def _begin(self, project, held):
        library, state = self._library, self._state
        options = native.sized(native.RunOptions, on_fault=int(self._on_fault == "fail"), seed=_seed(self._seed),
                               tick_period=self._period, virtual_time=self._clock == "virtual",
                               log=self._callbacks[0], tick_budget=self._tick_budget,
                               hang_limit=self._hang_limit, hang=self._callbacks[3])
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
        self._ticks, self._before, self._last, self._start = 0, 0, 0.0, None
        self._anchor = 0.0, 0  # a time, and the number of the tick that has it: the others are periods apart

    root = property(lambda self: self.nodes[0])
    status = property(lambda self: self.root.status, doc="of the root")
    progress = property(lambda self: self.root.progress, doc="of the root")
    closed = property(lambda self: self._handle is None)

    def node(self, path):
        "The node with this path: Main/pull/arm."
        try:
            return self._by_path[path]
        except KeyError:
            raise KeyError(f"there is no node '{path}'" + hint(path, self._by_path)) from None

    def tick(self, seconds=None):
        """One tick, and the status of the root after it. After success or failure the next one begins the tree
        again. `seconds` is the time since the tree began; without it that of the clock."""
        return self._using(self._tick, seconds)

    def _tick(self, handle, seconds):
        is_given = seconds is not None
        seconds = seconds if is_given else self._time()
        if not (isinstance(seconds, (int, float)) and self._last <= seconds <= 9e9):  # which NaN is not
            raise ValueError(f"the time of a tick is {seconds!r}, expected seconds, and not before the last tick "
                             f"({self._last:g})")
        if is_given:
            self._anchor = seconds, self._ticks
        self._last, self._ticks = seconds, self._ticks + 1
        return native.STATUSES[self._call_or_refuse(handle, self._library.run_tick, seconds)]

    def _time(self):
        if self._clock == "virtual":
            time_s, tick = self._anchor
            return max(self._last, time_s + (self._ticks - tick) * self._period)
        if self._start is None:
            self._start = time.monotonic() - self._last
        return time.monotonic() - self._start

    def run(self, *, max_ticks=None, timeout=None):
        """Ticks once in each period until the tree completes, or until a limit. A tree that was ticked begins
        again. `max_ticks` is 1 or more. `timeout` is in seconds of the run; 0 is over before the first tick. The result
        has `result`, `reason`, `ticks`, `time_s` and `overruns`."""
        is_count = isinstance(max_ticks, int) and not isinstance(max_ticks, bool) and 1 <= max_ticks < 2**64
        if max_ticks is not None and not is_count:
            raise ValueError(f"max_ticks is {max_ticks!r}, expected a whole number from 1 on")
        if timeout is not None and not (isinstance(timeout, (int, float)) and 0 <= timeout <= 9e9):
            raise ValueError(f"the timeout is {timeout!r}, expected seconds")
        return self._using(self._run, max_ticks or 0, timeout)

    def _run(self, handle, max_ticks, timeout):
        from . import Run
        if self._ticks != self._before:
            self._restart(handle, self._seed)
        if timeout == 0:  # which is none for the library
            return Run({"result": "stopped", "reason": "timeout", "ticks": self._ticks, "time_s": self._last, "overruns": 0},
                       124, "")
        options = native.sized(native.LoopOptions, max_ticks=max_ticks, timeout=timeout or 0.0,
                               virtual_clock=self._clock == "virtual", stop=self._callbacks[2])
        end = native.sized(native.LoopResult)
        self._ticks += 1  # also when it ends in an exception
        if not self._call(handle, self._library.run_loop, options, end):
            raise ValueError(self._library.why())
        self._ticks, self._last = end.ticks, end.seconds
        reason, result = native.REASONS[end.reason], native.STATUSES[end.status]
        completed = reason == "completed"
        summary = {"result": result if completed else "stopped", "reason": reason, "ticks": end.ticks,
                   "time_s": end.seconds, "overruns": end.overruns}
        return Run(summary, _CODES.get(result, 124) if completed else 124, "")

    def keep(self, file, *, resume=True, on_resume="restart", resume_limit=3, sync=0.1, version=""):
        """Keeps the state of the tree in a file, from before its first tick until it is closed or begins again. If the
        process of the run in the file was killed, or the power failed, the tree continues from there, and a Resumed
        is returned: `lockstep docs resume`. `on_resume` is what leaves do that ran then and keep nothing: "restart",
        "failure" or "success". A file of another run or another `version` of the program is an error."""
        if on_resume not in _ON_RESUME:
            raise ValueError(f"on_resume is {on_resume!r}, expected {', '.join(_ON_RESUME)}")
        options = native.sized(native.KeepOptions, resume=resume, on_resume=_ON_RESUME[on_resume],
                               resume_limit=resume_limit, sync=sync, version=native.bytes_of(version) or None)
        return self._using(self._keep, os.fsencode(file), options)

    def _keep(self, handle, file, options):
        resumed, leaf, leaves = native.sized(native.Resumed), native.sized(native.ResumedLeaf), []
        if not self._call(handle, self._library.run_keep, file, options, resumed):
            raise Error(2, self._library.why())
        if not resumed.resumed:
            return None
        self._ticks = self._before = resumed.ticks
        self._last = resumed.seconds
        if abs(resumed.seconds - (resumed.ticks - 1) * self._period) > 1e-9:  # a program gave the times
            self._anchor = resumed.seconds, resumed.ticks - 1
        while self._library.run_resumed_leaf(handle, len(leaves), leaf):
            leaves.append(ResumedLeaf(self.nodes[leaf.node].path, _DOES[leaf.status], leaf.asked, leaf.progress))
        return Resumed(resumed.ticks, resumed.seconds, resumed.gap, native.text_of(resumed.text), leaves)

    @property
    def not_kept(self):
        "Why nothing is kept any more, such as on a full disk; None: all is."
        why = self._read(lambda library, handle: library.run_not_kept(handle))
        return None if why is None else native.text_of(why)

    def record(self, file):
        "Records the tree to a file, from its first tick until it is closed or begins again: lockstep replay, log."
        self._using(self._watch, self._library.run_record, os.fsencode(file))

    def monitor(self, address="0"):
        """Shows the tree in browsers, from its first tick until it is closed or begins again. Returns the link.
        `address` is "8080", "0.0.0.0:8080", or "0" for a free port."""
        return native.text_of(self._using(self._watch, self._library.run_monitor, native.bytes_of(address)))

    def groot2(self, address="1667"):
        "Shows the tree in Groot2, which may only look. Of a project with groot2=True."
        self._using(self._watch, self._library.run_groot2, native.bytes_of(address))

    def _watch(self, handle, function, where):
        answer = function(handle, where)
        if not answer:
            raise Error(2, self._library.why())
        return answer

    def halt(self):
        "Halts every leaf that runs, in the order of the tree. The next tick begins the tree again."
        self._using(self._call_or_refuse, self._library.run_halt)

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
        self._refuse_closed()
        self._state.observers.append(observe)
        return observe

    def close(self):
        "Halts what runs and ends the leaves. Without it that happens when the tree has no user any more."
        if self._handle is not None:
            self._using(self._forget_handle)
            self._finalizer()

    def _forget_handle(self, _handle):
        self._handle = None

    def __enter__(self):
        self._refuse_closed()
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
                self._refuse_closed()
                if state.user is not None:
                    raise Error(2, "the tree is in use: it is being ticked, here or in another thread")
                state.user = me
            return work(self._handle, *arguments)
        finally:
            if state.user is me:
                state.user = None

    def _refuse_closed(self):
        if self._handle is None:
            raise Error(2, "the tree is closed")

    def _is_observed(self):
        return self._state.observes and self._state.thread == threading.get_ident()

    def _read(self, work):
        read = lambda handle: work(self._library, handle)
        return read(self._handle) if self._is_observed() else self._using(read)

    def _ask(self, index, answer):
        "For the state of a node. The progress is read from the leaves, and may have a fault."
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

    def _call_or_refuse(self, handle, function, *arguments):
        "Of what has no result for it: in a child of a fork, the tree is its parent's."
        result = self._call(handle, function, *arguments)
        why = self._library.why()
        if why:
            raise Error(2, why)
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


def _hang(on_hang, log):
    "What the library calls. An exception ends here: no caller waits for the call."
    def told(_, who, function, seconds):
        who, function = native.text_of(who), native.text_of(function)
        if on_hang is not None:
            on_hang(who, function, seconds)
        else:
            log(who, "warning", f"{function} has not returned after {seconds:.3g} s")
    return told


def _free_run(library, handle, process, state, _kept):
    free(library.run_free, handle, process, state)


_ON_RESUME = {"restart": 0, "success": native.SUCCESS, "failure": native.FAILURE}
_DOES = {0: "restart", native.RUNNING: "continues", native.SUCCESS: "success", native.FAILURE: "failure"}
_CODES = {"success": 0, "failure": 1}


def _seed(seed):
    if not (isinstance(seed, int) and 0 <= seed < 2**64):
        raise ValueError(f"the seed is {seed!r}, expected a whole number from 0, below 2^64")
    return seed
