"Classes of lockstep_leaf as leaves of this process: tables of lockstep/leaf.h whose functions call them."
import ctypes
import itertools
import os
import re
import sys
import threading
import types
from ctypes import POINTER, cast, pointer

import lockstep_leaf

from . import _native as native

_KINDS = {"action": 1, "condition": 2}
_DIRECTIONS = {"input": 1, "output": 2, "inout": 3}
_REAL_TIME, _OPTIONAL, _FIXED = 1, 1, 4
_RESULTS = {word: number for number, word in enumerate(native.STATUSES)}

# Whose leaves this thread makes: the state of a tree.
making = threading.local()


class _Ports:
    "The values that a leaf reads: what it has set in this tick, otherwise what the host has."

    def __init__(self, leaf, host, caller, ports, state):
        self.leaf, self.host, self.caller, self.ports, self.state = leaf, host, caller, ports, state

    def get(self, name):
        if name in self.leaf._set:
            return self.leaf._set[name]
        if threading.get_ident() != self.state.thread:
            raise RuntimeError(f"the port '{name}' can be read in the thread that ticks only, during a tick")
        index, type_ = self.ports[name]
        return type_.read(self.host.getters[type_.name], self.caller, index)

    def __setitem__(self, name, value):
        pass  # _Attribute also keeps it in _set


class _Host:
    "The functions of a lockstep_host, looked up once."

    known = {}

    def __init__(self, table):
        self.now, self.set_error, self.random_bits = table.now, table.set_error, table.random_bits
        self.tick_period, self.log = table.tick_period, table.log
        self.place = cast(table.get_extension(b"lockstep.place"), POINTER(native.Place)).contents
        self.say_reason = cast(table.get_extension(b"lockstep.reason"), POINTER(native.Reason)).contents.say
        self.getters = {name: getattr(table, "get_" + native.function_name(it)) for name, it in native.TYPES.items()}
        self.setters = {name: getattr(table, "set_" + native.function_name(it)) for name, it in native.TYPES.items()}

    @classmethod
    def at(cls, table):
        address = ctypes.addressof(table.contents)
        if address not in cls.known:
            cls.known[address] = cls(table.contents)
        return cls.known[address]


class _Element:
    "The ports of elements with the same constants."

    def __init__(self, facts, fixed):
        self.fixed = fixed
        self.ports = {port["name"]: (index, native.TYPES[port["type"]]) for index, port in enumerate(facts)}
        self.kept = [_port(port) for port in facts]
        self.pointers = (POINTER(native.Port) * len(facts))(*map(pointer, self.kept))

    def give_ports(self, table):
        table.port_count, table.ports = len(self.kept), cast(self.pointers, POINTER(POINTER(native.Port)))


class _Class:
    "A class of leaves: its table, and its leaves by their numbers."

    numbers = itertools.count(1)

    def __init__(self, cls):
        self.cls, self.leaves = cls, {}
        fact = cls._fact()
        self.elements = [_Element(fact["ports"], {})]  # those that are described come after it, by their constants:
        self.described, self.describing, self.refusal = {}, threading.Lock(), None
        kind = _KINDS[fact["kind"]]
        self.table = native.sized(
            native.LeafType, kind=kind, id=native.bytes_of(fact["id"]), doc=native.bytes_of(fact["doc"]),
            create=native.CREATE(self.create), destroy=native.CALL(self.destroy),
            start=native.CALL(self.caller_of(lockstep_leaf._start)),
            tick=native.TICK(self.caller_of(self.tick, native.RUNNING)), flags=_REAL_TIME if fact.get("real_time") else 0)
        if hasattr(cls, "halt"):
            self.table.halt = native.CALL(self.caller_of(lockstep_leaf._halt))
        if "pause" in fact:
            self.table.pause = native.CALL(self.caller_of(lambda leaf: lockstep_leaf._call(leaf, "pause")))
            self.table.resume = native.CALL(self.caller_of(lambda leaf: lockstep_leaf._call(leaf, "resume")))
        if "progress" in fact:
            self.table.progress = native.PROGRESS(self.caller_of(lockstep_leaf._done, 0.0))
        if "set_pace" in fact:
            self.table.set_pace = native.SET_PACE(self.caller_of(lockstep_leaf._pace, 1.0))
        if "restore" in fact:
            self.table.save = native.SAVE(self.caller_of(self.save, 0))
            self.table.restore = native.RESTORE(self.caller_of(self.restore, 0))
        said = [(native.bytes_of(word), native.bytes_of(value)) for word, value in fact.get("behavior", {}).items()]
        if said:
            self.table.behavior_count, self.table.behavior = len(said), (native.Behavior * len(said))(*said)
        self.functions = native.LeafType.from_buffer_copy(self.table)
        self.elements[0].give_ports(self.table)
        if "more_ports" in fact:
            self.table.more_ports = native.bytes_of(";".join(fact["more_ports"]))
            self.table.describe = native.DESCRIBE(self.describe)

    def describe(self, fixed, count, why):
        try:
            return self.address_of({fixed[i].port: fixed[i].text for i in range(count)})
        except Exception as error:  # kept until the next one, as the texts of a refusal are
            self.refusal = [native.bytes_of(it) for it in (
                lockstep_leaf._refusal(error), getattr(error, "port", ""), getattr(error, "hint", ""))]
            why.contents.message, why.contents.port, why.contents.hint = self.refusal
            return None

    def address_of(self, texts):
        "That of the table of the elements with these constants."
        key = tuple(texts.items())
        with self.describing:
            if key not in self.described:
                fixed = {name.decode(): _typed(self.cls._ports[name.decode()].fact["type"], text.decode())
                         for name, text in key}
                more = [port.fact for port in self.cls._described(fixed).values()]
                element = _Element([port.fact for port in self.cls._ports.values()] + more, fixed)
                element.table = native.LeafType.from_buffer_copy(self.functions)
                element.table.data = len(self.elements)
                element.give_ports(element.table)
                self.elements.append(element)
                self.described[key] = element
            return ctypes.addressof(self.described[key].table)

    def create(self, table, caller, _context):
        host, state = _Host.at(table), making.state
        number = next(self.numbers)
        leaf = None
        try:
            state.inside = True
            element = self.elements[host.place.data(caller) or 0]
            leaf = lockstep_leaf._new(
                self.cls, number, host.random_bits(caller) >> 11, element.fixed, name=native.text_of(host.place.name(caller)),
                path=native.text_of(host.place.path(caller)), period=host.tick_period(caller), clock=state.clock)
            leaf._host, leaf._caller, leaf._state = host, caller, state
            leaf._values = _Ports(leaf, host, caller, element.ports, state)
            leaf._unbound = [name for name, (index, _) in element.ports.items()
                             if not _is_key(host.place.given(caller, index) or b"")]
            leaf._log = _Log(leaf)
            self.leaves[number] = leaf
            leaf.__init__()
            state.inside = False
        except BaseException as error:
            host.set_error(caller, state.blame(error))
        return number if leaf is not None else None

    def destroy(self, number):
        leaf = self.leaves.pop(number, None)
        if leaf is not None:  # which the program may have kept
            leaf._values = {}
            leaf._log.end()

    # Of Ctrl-C: an exception may come out of any line of the author's, and of none outside of try.
    def caller_of(self, function, otherwise=None):
        leaves = self.leaves

        def call(number, *arguments):
            leaf = leaves[number]
            state = leaf._state
            try:
                state.inside = True
                leaf.now = leaf._host.now(leaf._caller)
                result = function(leaf, *arguments)
                state.inside = False
                return result
            except BaseException as error:
                leaf._host.set_error(leaf._caller, state.blame(error))
                return otherwise
        return call

    def save(self, leaf, to, room):
        kept = lockstep_leaf._kept(leaf).encode()
        ctypes.memmove(to, kept, min(len(kept), room))
        return len(kept)

    def restore(self, leaf, kept, size, cut):
        lockstep_leaf._begin(leaf)
        cut = cut.contents
        wants = {native.SUCCESS: "success", native.FAILURE: "failure"}.get(cut.on_resume, "restart")
        cut = lockstep_leaf.Cut(cut.power, cut.held, cut.gap, cut.lost_ticks, wants)
        after_cut, _ = lockstep_leaf._restore(leaf, ctypes.string_at(kept, size), cut)
        return native.AFTER_CUT.index(after_cut)

    def tick(self, leaf):
        status, reason, _, values = lockstep_leaf._tick(leaf)
        if reason:
            leaf._host.say_reason(leaf._caller, reason.encode())
        for name, value in values.items():
            self.set_port(leaf, name, value)
        return _RESULTS[status]

    def set_port(self, leaf, name, value):
        index, type_ = leaf._values.ports[name]
        done = type_.write(leaf._host.setters[type_.name], leaf._caller, index, value=value)
        # Of two errors the first counts: the host's.
        if not done:
            leaf._host.set_error(leaf._caller, f"set '{name}', which is not bound to an entry that takes it".encode())


_BLANKS = " \t\r\n"
_FLAGS = {**dict.fromkeys(("1", "true", "True", "TRUE"), True), **dict.fromkeys(("0", "false", "False", "FALSE"), False)}
_NUMBER = re.compile(r"(?:\+(?!-))?(-?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?)")


def _typed(type_, text):
    "A constant of a tree, as lockstep reads it; None if it is no value of the type."
    if type_ == "string":
        return text
    if type_ == "list of string":
        return _texts(text)
    if type_.startswith("list of "):
        items = [_typed(type_[len("list of "):], it) for it in re.split("[;, \t\r\n]+", text) if it]
        return None if None in items else items
    text = text.strip(_BLANKS)
    if type_ == "bool":
        return _FLAGS.get(text)
    number = _NUMBER.fullmatch(text)
    try:
        return number and lockstep_leaf._as_type(type_, (int if type_ == "int" else float)(number[1]))
    except ValueError:
        return None


def _texts(text):
    r"The texts of `a;b\;c`. Blanks around each do not count, unless they come after a backslash."
    items, place, end = [], 0, len(text.rstrip(_BLANKS))
    while place < end:
        item, kept = "", 0
        while place < len(text):
            c, place = text[place], place + 1
            if c == ";":
                break
            is_escaped = c == "\\" and place < len(text)
            if c in _BLANKS and not item:
                continue
            item += text[place] if is_escaped else c
            place += is_escaped
            if is_escaped or c not in _BLANKS:
                kept = len(item)
        items.append(item[:kept])
    return items


def _is_key(given):
    return given.startswith(b"{") and given.endswith(b"}") and len(given) > 2


class _Log:
    "What a leaf logs is a line of its run, from any thread, until the leaf is destroyed."

    def __init__(self, leaf):
        self.host, self.caller, self.state, self.path = leaf._host, leaf._caller, leaf._state, leaf.path
        self.guard = threading.RLock()  # of caller

    def end(self):
        with self.guard:
            self.caller = None

    def __call__(self, text, level):
        if self.state.is_ours():
            return self.state.outside(self.write, text, level)
        with self.guard:
            self.write(text, level)

    def write(self, text, level):
        if self.caller is None:
            return self.state.log(self.path, level, text)
        self.host.log(self.caller, native.LEVELS.index(level), text.encode())


def _port(fact):
    least, most = fact.get("min"), fact.get("max")
    if least is not None or most is not None:
        least = -float("inf") if least is None else least
        most = float("inf") if most is None else most
    default, choices = fact.get("default"), fact.get("choices")
    return native.sized(
        native.Port, type=native.TYPES[fact["type"]].number, direction=_DIRECTIONS[fact["direction"]],
        name=native.bytes_of(fact["name"]),
        default_value=None if default is None else native.bytes_of(lockstep_leaf._plain(default)),
        unit=native.bytes_of(fact.get("unit", "")), doc=native.bytes_of(fact.get("doc", "")),
        choices=native.bytes_of(";".join(choices)) if choices else None, min=least or 0, max=most or 0,
        flags=(_OPTIONAL if fact.get("optional") else 0) | (_FIXED if fact.get("fixed") else 0))


def blame(error):
    "What went wrong in a leaf, and where in its author's file."
    return lockstep_leaf._blame(error, os.path.dirname(__file__))


def _class_of(cls):
    if "_native" not in cls.__dict__:
        cls._native = _Class(cls)
    return cls._native


def _classes_of(given):
    "Classes of leaves, from classes and modules."
    for it in given if isinstance(given, (list, tuple, set, frozenset)) else (given,):
        if isinstance(it, types.ModuleType):
            found = [cls for cls in vars(it).values() if _is_leaf(cls) and cls.__module__ == it.__name__]
            if not found:
                raise ValueError(f"the module {it.__name__} has no leaves: subclasses of lockstep_leaf.Action or "
                                 "Condition")
            yield from found
        elif _is_leaf(it):
            yield it
        else:
            raise TypeError(f"{it!r} is no leaf, expected a subclass of lockstep_leaf.Action or Condition, or a "
                            "module with some")


def _is_leaf(it):
    return isinstance(it, type) and issubclass(it, lockstep_leaf._Leaf) and it._kind != "" and (
        it.__module__ != lockstep_leaf.__name__)


def _plugin_name(module):
    "That of its file, as for a program: it takes the place of <plugin name=…> of that name."
    if module == "__main__":
        module = os.path.splitext(os.path.basename(getattr(sys.modules[module], "__file__", None) or "main"))[0]
    name = module.rpartition(".")[2]
    return "".join(it if it.isascii() and (it.isalnum() or it in "_-") else "_" for it in name)


def plugins_of(given):
    "A lockstep_plugin for each module with leaves. Each keeps what it points to."
    modules = {}
    for cls in _classes_of(given):
        modules.setdefault(_plugin_name(cls.__module__), []).append(_class_of(cls))
    for name, classes in modules.items():
        tables = (POINTER(native.LeafType) * len(classes))(*(pointer(it.table) for it in classes))
        plugin = native.sized(native.Plugin, abi_major=1, abi_minor=5, name=native.bytes_of(name),
                              doc=b"Leaves in Python", leaf_type_count=len(classes),
                              leaf_types=cast(tables, POINTER(POINTER(native.LeafType))))
        plugin.kept = tables, classes
        yield plugin
