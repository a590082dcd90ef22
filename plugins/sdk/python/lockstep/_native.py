"lockstep/runtime.h and lockstep/leaf.h for ctypes: structs, functions, and values that cross over."
import ctypes
import functools
from ctypes import (CFUNCTYPE, POINTER, Structure, byref, c_bool, c_char_p, c_double, c_int32, c_int64, c_size_t,
                    c_uint8, c_uint32, c_uint64, c_void_p)

from lockstep_leaf import _LEVELS as LEVELS
from lockstep_leaf import _as_bool, _as_float, _as_int, _as_str

from ._error import Error
from ._program import library

RUNNING, SUCCESS, FAILURE, SKIPPED = 1, 2, 3, 4
STATUSES = ("idle", "running", "success", "failure", "skipped")
REASONS = ("completed", "fault", "timeout", "max_ticks", "stopped", "overrun")
SEVERITIES = ("error", "warning", "note")


class Text(Structure):
    _fields_ = [("text", c_void_p), ("length", c_size_t)]


class Port(Structure):
    _fields_ = [("struct_size", c_uint32), ("type", c_int32), ("direction", c_int32), ("name", c_char_p),
                ("default_value", c_char_p), ("unit", c_char_p), ("doc", c_char_p), ("choices", c_char_p),
                ("min", c_double), ("max", c_double), ("object", c_void_p), ("flags", c_uint64)]


def _get(*types):
    return CFUNCTYPE(c_bool, c_void_p, c_uint32, *map(POINTER, types))


def _set(*types):
    return CFUNCTYPE(c_bool, c_void_p, c_uint32, *types)


class Host(Structure):
    _fields_ = [("abi_major", c_uint32), ("abi_minor", c_uint32), ("struct_size", c_uint32), ("name", c_char_p),
                ("version", c_char_p), ("get_bool", _get(c_bool)), ("get_int", _get(c_int64)),
                ("get_double", _get(c_double)), ("get_string", _get(c_void_p, c_size_t)),
                ("get_double_list", _get(POINTER(c_double), c_size_t)), ("set_bool", _set(c_bool)),
                ("set_int", _set(c_int64)), ("set_double", _set(c_double)), ("set_string", _set(c_char_p, c_size_t)),
                ("set_double_list", _set(POINTER(c_double), c_size_t)),
                ("set_error", CFUNCTYPE(None, c_void_p, c_char_p)), ("now", CFUNCTYPE(c_double, c_void_p)),
                ("tick_period", CFUNCTYPE(c_double, c_void_p)), ("random_bits", CFUNCTYPE(c_uint64, c_void_p)),
                ("random", CFUNCTYPE(c_double, c_void_p)), ("log", CFUNCTYPE(None, c_void_p, c_int32, c_char_p)),
                ("get_extension", CFUNCTYPE(c_void_p, c_char_p)), ("get_int_list", _get(POINTER(c_int64), c_size_t)),
                ("get_bool_list", _get(POINTER(c_bool), c_size_t)), ("get_string_list", _get(POINTER(Text), c_size_t)),
                ("set_int_list", _set(POINTER(c_int64), c_size_t)), ("set_bool_list", _set(POINTER(c_bool), c_size_t)),
                ("set_string_list", _set(POINTER(Text), c_size_t))]  # and objects


class Place(Structure):
    _fields_ = [("struct_size", c_uint32), ("name", CFUNCTYPE(c_char_p, c_void_p)),
                ("path", CFUNCTYPE(c_char_p, c_void_p)), ("id", CFUNCTYPE(c_char_p, c_void_p)), ("child_id", c_void_p),
                ("child_name", c_void_p), ("given", CFUNCTYPE(c_char_p, c_void_p, c_uint32)),
                *((name, c_void_p) for name in ("value_type", "get_object", "set_object", "open", "unset", "ask_for_tick",
                                                "wake")),
                ("data", CFUNCTYPE(c_void_p, c_void_p))]


class Reason(Structure):
    _fields_ = [("struct_size", c_uint32), ("say", CFUNCTYPE(None, c_void_p, c_char_p))]


class Behavior(Structure):
    _fields_ = [("word", c_char_p), ("value", c_char_p)]


CREATE = CFUNCTYPE(c_void_p, POINTER(Host), c_void_p, c_void_p)
CALL = CFUNCTYPE(None, c_void_p)
TICK = CFUNCTYPE(c_int32, c_void_p)
PROGRESS = CFUNCTYPE(c_double, c_void_p)
SET_PACE = CFUNCTYPE(c_double, c_void_p, c_double)


class FixedText(Structure):
    _fields_ = [("port", c_char_p), ("text", c_char_p)]


class Refusal(Structure):
    _fields_ = [("struct_size", c_uint32), ("port", c_char_p), ("message", c_char_p), ("hint", c_char_p)]


class Cut(Structure):
    _fields_ = [("struct_size", c_uint32), ("power", c_bool), ("held", c_bool), ("on_resume", c_uint8),
                ("gap", c_double), ("lost_ticks", c_uint64)]


SAVE = CFUNCTYPE(c_size_t, c_void_p, c_void_p, c_size_t)
RESTORE = CFUNCTYPE(c_int32, c_void_p, c_void_p, c_size_t, POINTER(Cut))
AFTER_CUT = ("starts again", "continues", "cannot continue")
DESCRIBE = CFUNCTYPE(c_void_p, POINTER(FixedText), c_uint32, POINTER(Refusal))


class LeafType(Structure):
    _fields_ = [("struct_size", c_uint32), ("kind", c_int32), ("id", c_char_p), ("doc", c_char_p),
                ("port_count", c_uint32), ("ports", POINTER(POINTER(Port))), ("create", CREATE), ("destroy", CALL),
                ("start", CALL), ("tick", TICK), ("halt", CALL), ("pause", CALL), ("resume", CALL),
                ("progress", PROGRESS), ("get_extension", c_void_p), ("flags", c_uint64), ("min_children", c_uint32),
                ("max_children", c_uint32), ("start_unreset", c_void_p), ("behavior_count", c_uint32),
                ("behavior", POINTER(Behavior)), ("more_ports", c_char_p), ("describe", DESCRIBE), ("data", c_void_p),
                ("set_pace", SET_PACE), ("save", SAVE), ("restore", RESTORE)]


class Plugin(Structure):
    _fields_ = [("abi_major", c_uint32), ("abi_minor", c_uint32), ("struct_size", c_uint32), ("name", c_char_p),
                ("version", c_char_p), ("doc", c_char_p), ("leaf_type_count", c_uint32),
                ("leaf_types", POINTER(POINTER(LeafType))), ("init", c_void_p), ("deinit", c_void_p),
                ("create_run", c_void_p), ("destroy_run", c_void_p), ("get_extension", c_void_p),
                ("describe", c_void_p)]


class Diagnostic(Structure):
    _fields_ = [("struct_size", c_uint32), ("severity", c_int32), ("file", c_char_p), ("line", c_uint32),
                ("column", c_uint32), ("message", c_char_p), ("hint", c_char_p)]


class Node(Structure):
    _fields_ = [("struct_size", c_uint32), ("parent", c_uint32), ("end", c_uint32), ("path", c_char_p),
                ("name", c_char_p), ("id", c_char_p)]


class Entry(Structure):
    _fields_ = [("struct_size", c_uint32), ("type", c_int32), ("key", c_char_p), ("type_name", c_char_p)]


class NodeState(Structure):
    _fields_ = [("struct_size", c_uint32), ("status", c_int32), ("progress", c_double), ("held", c_bool),
                ("ticked", c_bool)]


LOG = CFUNCTYPE(None, c_void_p, c_char_p, c_int32, c_char_p)
OBSERVE = CFUNCTYPE(None, c_void_p, c_void_p, c_uint64, c_double, c_int32)
STOP = CFUNCTYPE(c_bool, c_void_p)
HANG = CFUNCTYPE(None, c_void_p, c_char_p, c_char_p, c_double)


class RunOptions(Structure):
    _fields_ = [("struct_size", c_uint32), ("on_fault", c_int32), ("seed", c_uint64), ("tick_period", c_double),
                ("virtual_time", c_bool), ("log", LOG), ("user", c_void_p), ("prepare", c_void_p),
                ("wake", c_void_p), ("tick_budget", c_double), ("hang_limit", c_double), ("hang", HANG)]


class KeepOptions(Structure):
    _fields_ = [("struct_size", c_uint32), ("resume", c_bool), ("on_resume", c_int32), ("resume_limit", c_uint32),
                ("sync", c_double), ("version", c_char_p)]


class Resumed(Structure):
    _fields_ = [("struct_size", c_uint32), ("resumed", c_bool), ("ticks", c_uint64), ("seconds", c_double),
                ("gap", c_double), ("text", c_char_p)]


class ResumedLeaf(Structure):
    _fields_ = [("struct_size", c_uint32), ("node", c_uint32), ("status", c_int32), ("asked", c_bool),
                ("progress", c_double)]


class LoopOptions(Structure):
    _fields_ = [("struct_size", c_uint32), ("overrun", c_int32), ("max_ticks", c_uint64), ("timeout", c_double),
                ("virtual_clock", c_bool), ("stop", STOP), ("user", c_void_p)]


class LoopResult(Structure):
    _fields_ = [("struct_size", c_uint32), ("reason", c_int32), ("status", c_int32), ("ticks", c_uint64),
                ("overruns", c_uint64), ("seconds", c_double)]


def sized(struct, **values):
    return struct(struct_size=ctypes.sizeof(struct), **values)


_FUNCTIONS = {
    "runtime_version": (c_uint32,), "last_error": (c_char_p,), "project_new": (c_void_p,),
    "project_free": (None, c_void_p), "project_add_plugin_path": (c_bool, c_void_p, c_char_p),
    "project_add_plugin": (c_bool, c_void_p, c_char_p), "project_add_leaves": (c_bool, c_void_p, POINTER(Plugin)),
    "project_set_argument": (c_bool, c_void_p, c_char_p, c_char_p),
    "project_set_value": (c_bool, c_void_p, c_char_p, c_char_p),
    "project_set_main_tree": (c_bool, c_void_p, c_char_p), "project_isolate_all": (c_bool, c_void_p),
    "project_load_file": (c_bool, c_void_p, c_char_p),
    "project_load_text": (c_bool, c_void_p, c_char_p, c_char_p, c_size_t),
    "project_diagnostic_count": (c_uint32, c_void_p),
    "project_diagnostic": (c_bool, c_void_p, c_uint32, POINTER(Diagnostic)),
    "project_node_count": (c_uint32, c_void_p), "project_node": (c_bool, c_void_p, c_uint32, POINTER(Node)),
    "project_entry_count": (c_uint32, c_void_p), "project_entry": (c_bool, c_void_p, c_uint32, POINTER(Entry)),
    "run_new": (c_void_p, c_void_p, POINTER(RunOptions)), "run_free": (None, c_void_p),
    "run_restart": (c_bool, c_void_p, c_uint64), "run_tick": (c_int32, c_void_p, c_double),
    "run_halt": (None, c_void_p), "run_fault": (c_char_p, c_void_p, POINTER(c_uint32)),
    "run_node": (c_bool, c_void_p, c_uint32, POINTER(NodeState)), "run_value_type_at": (c_int32, c_void_p, c_uint32),
    "run_question": (c_char_p, c_void_p, c_uint32), "run_answer": (c_bool, c_void_p, c_uint32, c_char_p, c_char_p),
    "run_get_sized_text_at": (c_bool, c_void_p, c_uint32, POINTER(Text)),
    "run_set_sized_text_at": (c_bool, c_void_p, c_uint32, c_char_p, c_size_t),
    "run_observe": (c_bool, c_void_p, OBSERVE, c_void_p), "run_record": (c_bool, c_void_p, c_char_p),
    "run_monitor": (c_char_p, c_void_p, c_char_p), "run_groot2": (c_bool, c_void_p, c_char_p),
    "run_keep": (c_bool, c_void_p, c_char_p, POINTER(KeepOptions), POINTER(Resumed)),
    "run_resumed_leaf": (c_bool, c_void_p, c_uint32, POINTER(ResumedLeaf)), "run_not_kept": (c_char_p, c_void_p),
    "project_show_groot2": (c_bool, c_void_p),
    "run_loop": (c_bool, c_void_p, POINTER(LoopOptions), POINTER(LoopResult)),
}
for _name, _item in (("bool", c_bool), ("int", c_int64), ("double", c_double), ("text", Text)):
    if _name != "text":
        _FUNCTIONS[f"run_get_{_name}_at"] = (c_bool, c_void_p, c_uint32, POINTER(_item))
        _FUNCTIONS[f"run_set_{_name}_at"] = (c_bool, c_void_p, c_uint32, _item)
    _FUNCTIONS[f"run_get_{_name}_list_at"] = (c_bool, c_void_p, c_uint32, POINTER(POINTER(_item)), POINTER(c_size_t))
    _FUNCTIONS[f"run_set_{_name}_list_at"] = (c_bool, c_void_p, c_uint32, POINTER(_item), c_size_t)


class Library:
    "The functions of lockstep/runtime.h, without their prefix."

    def __init__(self, path):
        loaded = ctypes.CDLL(path)
        loaded.lockstep_runtime_version.restype = c_uint32
        if loaded.lockstep_runtime_version() < (1 << 16 | 5):
            raise Error(2, f"'{path}' is older than this package: install both from one version of lockstep")
        for name, (result, *arguments) in _FUNCTIONS.items():
            function = getattr(loaded, "lockstep_" + name)
            function.restype, function.argtypes = result, arguments
            setattr(self, name, function)

    def why(self):
        return text_of(self.last_error())


@functools.lru_cache(maxsize=None)
def load():
    return Library(library())


# Texts are UTF-8; bytes that are not, and come from a plugin, come back as they were.
def text_of(data):
    return (data or b"").decode("utf-8", "surrogateescape")


def text_of_sized(text):
    return text_of(ctypes.string_at(text.text, text.length))


def bytes_of(text):
    data = text.encode("utf-8", "surrogateescape")
    if b"\0" in data:
        raise ValueError(f"{text!r} has a NUL in it")
    return data


def as_text(value):
    return _as_str(value).encode("utf-8", "surrogateescape")


class _Scalar:
    "A type of values, and how one is read and written with the functions of a host or of a run."

    def __init__(self, number, name, of, convert):
        self.number, self.name, self.of, self.convert = number, name, of, convert

    def read(self, get, *where):
        value = self.of()
        return value.value if get(*where, byref(value)) else None

    def write(self, set_, *where, value):
        return set_(*where, self.convert(value))


class _String(_Scalar):
    def read(self, get, *where):
        text, length = c_void_p(), c_size_t()
        return text_of(ctypes.string_at(text, length.value)) if get(*where, byref(text), byref(length)) else None

    def write(self, set_, *where, value):
        data = self.convert(value)
        return set_(*where, data, len(data))


class _List(_Scalar):
    def read(self, get, *where):
        items, count = POINTER(self.of)(), c_size_t()
        if not get(*where, byref(items), byref(count)):
            return None
        return [self.item(it) for it in items[:count.value]]

    def write(self, set_, *where, value):
        if isinstance(value, (str, bytes)) or not hasattr(value, "__iter__"):
            raise TypeError
        items = [self.convert(it) for it in value]
        if self.of is Text:
            kept = [ctypes.create_string_buffer(it, len(it) + 1) for it in items]
            items = [Text(ctypes.addressof(buffer), len(it)) for buffer, it in zip(kept, items)]
        return set_(*where, (self.of * len(items))(*items), len(items))

    def item(self, it):
        return text_of_sized(it) if self.of is Text else it


TYPES = {it.name: it for it in (
    _Scalar(1, "bool", c_bool, _as_bool), _Scalar(2, "int", c_int64, _as_int),
    _Scalar(3, "double", c_double, _as_float), _String(4, "string", None, as_text),
    _List(5, "list of double", c_double, _as_float), _List(6, "list of int", c_int64, _as_int),
    _List(7, "list of bool", c_bool, _as_bool), _List(8, "list of string", Text, as_text))}
OBJECT, NUMBER, ANY = 9, 100, 101


def function_name(type_, text="string"):
    "The part of a function's name that names the type: double_list."
    *is_list, item = type_.name.split(" of ")
    return (text if item == "string" else item) + ("_list" if is_list else "")
