"Where lockstep is installed: the program, and the library."
import ctypes.util
import os
import pathlib
import shutil

try:
    from ._origin import SOURCES  # of a package that pip has installed
except ImportError:
    SOURCES = pathlib.Path(__file__).resolve().parent.parent

_LIBRARY = "liblockstep-runtime.so"


def program():
    "The path of the program lockstep."
    beside = [parent / "bin" / "lockstep" for parent in list(pathlib.Path(SOURCES).parents)[:4]]
    found = os.environ.get("LOCKSTEP") or next((str(it) for it in beside if it.is_file()), None)
    found = found or shutil.which("lockstep")
    if found is None:
        raise FileNotFoundError("lockstep is not found: set the variable LOCKSTEP to its path")
    return found


def library():
    "The path of the library in which trees run in this process."
    given = os.environ.get("LOCKSTEP_LIBRARY")
    if given:
        if not os.path.isfile(given):
            raise FileNotFoundError(f"LOCKSTEP_LIBRARY is '{given}', which is not a file: set it to the path of {_LIBRARY}")
        return given
    for directory in _directories():
        found = sorted(directory.glob(_LIBRARY + "*"))
        if found:
            return str(found[0])
    found = ctypes.util.find_library("lockstep-runtime")
    if found is None:
        raise FileNotFoundError(f"{_LIBRARY} is not found: set the variable LOCKSTEP_LIBRARY to its path, or LOCKSTEP "
                                "to that of the program lockstep of an installation")
    return found


def _directories():
    "Next to the program in a build directory, otherwise in lib, lib64 or lib/x86_64-linux-gnu of its installation."
    try:
        binary = pathlib.Path(program()).resolve().parent
    except FileNotFoundError:
        return
    yield binary
    for name in ("lib", "lib64"):
        yield binary.parent / name
        yield from sorted((binary.parent / name).glob("*-linux-*"))
