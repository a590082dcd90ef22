"What happens around a call into the library that may call Python: exceptions, Ctrl-C, logs."
import os
import signal
import threading

from . import _leaves as leaves_
from . import _native as native


def free(function, handle, process, state=None):
    "When it has no user any more, or at the end. The child of a fork leaves it to its parent."
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


class State:
    """What the functions that lockstep calls need of a tree. It does not keep the tree alive.

    An exception cannot pass through lockstep: it is kept, and raised after the call. For Ctrl-C the handler of
    Python is put off while no code runs out of which the exception could be caught."""

    def __init__(self, log, clock):
        self.log, self.clock = log, clock
        self.guard = threading.Lock()  # of user
        self.user = None               # the user of the tree
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
        try:
            return leaves_.blame(error).encode()
        except BaseException as worse:  # out of here, ctypes would drop it, and what failed would count as done
            return f"an exception that cannot be described: {type(worse).__name__}".encode()

    def is_ours(self):
        "This thread is in a call."
        return threading.get_ident() == self.thread

    def outside(self, work, *arguments):
        "Of a leaf that calls the library, which may call Python: out of that no exception comes."
        was, self.inside = self.inside, False
        work(*arguments)
        self.inside = was
        if was and self.pending is not None:
            pending, self.pending = self.pending, None
            self.handler(*pending)
        if was and self.thrown is not None and not isinstance(self.thrown, Exception):
            raise self.thrown

    def keep(self, work):
        "Of what is no leaf. A leaf may log in its own thread, where no signal comes."
        is_ours = self.is_ours()
        try:
            if is_ours:
                self.inside = True
            work()
            if is_ours:
                self.inside = False
        except BaseException as error:
            if is_ours:
                self.inside = False
            self.thrown = self.thrown or error

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
