"What is loaded once: a tree file, its includes, plugins and leaves."
import collections
import ctypes
import logging
import os
import weakref

import lockstep_leaf

from . import _leaves as leaves_
from . import _native as native
from ._error import Error
from ._state import free

Diagnostic = collections.namedtuple("Diagnostic", "severity file line column message hint")
Diagnostic.__doc__ = "What is wrong with a tree, or may be: severity is error, warning or note."
Diagnostic.__str__ = lambda it: "".join(f"{place}:" for place in it[1:4] if place) + (" " if it.file else "") + (
    f"{it.severity}: {it.message}" + (f" ({it.hint})" if it.hint else ""))

_LEVELS = {"debug": logging.DEBUG, "info": logging.INFO, "warning": logging.WARNING}
_logger = logging.getLogger("lockstep")


def log(who, level, text):
    _logger.log(_LEVELS[level], "%s: %s", who, text)


class _Held:
    "The project of the library, until it has no user: a thread may be making a tree of it while another closes it."

    def __init__(self, library, leaves):
        self.handle = library.project_new()
        if not self.handle:
            raise Error(9, library.why())
        weakref.finalize(self, _free_project, library, self.handle, os.getpid(), leaves)


def _free_project(library, handle, process, _leaves):
    free(library.project_free, handle, process)


class Project:
    """A tree file (or `text`) with its includes, plugins and leaves. Trees are made of it: `Tree(project)`.

    `leaves` are classes of lockstep_leaf, and modules that have some. They run in this process, and take the place
    of a <plugin> that has the name of their module. With `groot2`, trees may be shown in Groot2."""

    def __init__(self, tree=None, *, text=None, leaves=(), args=None, set=None, plugins=(), plugin_path=(),
                 main_tree=None, isolate=False, groot2=False):
        if (tree is None) == (text is None):
            raise TypeError("a project has a file or a text, one of the two")
        self._library = library = native.load()
        self._leaves = list(leaves_.plugins_of(leaves))
        self._held = _Held(library, self._leaves)
        try:
            self._configure(args or {}, set or {}, plugins, plugin_path, main_tree, isolate, groot2)
            self._load(tree, text)
        except BaseException:
            self.close()
            raise

    def _configure(self, args, values, plugins, plugin_path, main_tree, isolate, groot2):
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
        if groot2:
            steps.append((library.project_show_groot2,))
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
        return native.text_of(it.key), (index, it.type, native.text_of(it.type_name))

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
