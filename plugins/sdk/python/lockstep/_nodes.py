"The nodes and the entries of a tree, as they are now."
import collections.abc
import difflib

from . import _native as native


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
    progress = property(lambda self: self._state().progress, doc="from 0 to 1; read from its leaves")
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

    @property
    def question(self):
        "What it asks a person at this moment; None: nothing."
        text = self._tree._read(lambda library, handle: library.run_question(handle, self.index))
        return None if text is None else native.text_of(text)

    def answer(self, answer, who="program"):
        "One of the options of its question. It counts in the next tick."
        def give(library, handle):
            if not library.run_answer(handle, self.index, native.bytes_of(answer), native.bytes_of(who)):
                raise ValueError(library.why())
        self._tree._read(give)

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
        raise KeyError(f"no node uses an entry '{key}'" + hint(key, types))

    def __getitem__(self, key):
        index, _, _ = self._declared(key)
        value = self._tree._read(lambda library, handle: _read_entry(library, handle, index))
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
        index, number, name = self._declared(key)
        type_ = _type_for(value, number, name)
        library = self._tree._library

        def write(handle):
            if type_ in (None, native.TYPES["string"]):
                data = native.as_text(value)
                return library.run_set_sized_text_at(handle, index, data, len(data))
            set_ = getattr(library, f"run_set_{native.function_name(type_, 'text')}_at")
            return type_.write(set_, handle, index, value=value)

        try:
            good = self._tree._using(write)
        except TypeError:
            raise TypeError(f"the entry '{key}' is of type {name}, not {value!r}") from None
        if not good:
            raise ValueError(library.why())

    def __iter__(self):
        types = self._tree._entries
        return (key for key, (index, _, _) in types.items() if self._tree._read(
            lambda library, handle: library.run_value_type_at(handle, index)))

    def __len__(self):
        return sum(1 for _ in self)

    def __contains__(self, key):
        return any(it == key for it in self)

    def __repr__(self):
        return repr(dict(self))


def _read_entry(library, handle, index):
    number = library.run_value_type_at(handle, index)
    if number in (native.OBJECT, 4):
        text = native.Text()
        return native.text_of_sized(text) if library.run_get_sized_text_at(handle, index, text) else None
    for type_ in native.TYPES.values():
        if type_.number == number:
            return type_.read(getattr(library, f"run_get_{native.function_name(type_, 'text')}_at"), handle, index)
    return None


def _type_for(value, number, name):
    "Of a value to write; None: as a text."
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


def hint(name, names):
    near = difflib.get_close_matches(name, list(names), 1)
    return f"; did you mean '{near[0]}'?" if near else ""
