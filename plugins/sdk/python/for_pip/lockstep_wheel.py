"""What pip asks of a package's sources (PEP 517): it packs the package itself.

So an installation needs neither setuptools nor wheel nor a network, with any Python. Nothing is written beside the
sources, which are in an installation of lockstep, and the package knows where that is."""
import base64
import hashlib
import os
import pathlib
import re
import zipfile

_SOURCES = pathlib.Path.cwd()  # pip calls there
_PROJECT = (_SOURCES / "pyproject.toml").read_text(encoding="utf-8")


def _field(name):
    return re.search(rf'^{name} = "(.*)"$', _PROJECT, re.MULTILINE).group(1)


_NAME, _VERSION = _field("name"), _field("version")
_INFO = f"{_NAME}-{_VERSION}.dist-info"


def _files():
    "What the wheel has: its names and contents."
    for path in [_SOURCES / "lockstep_leaf.py", *sorted((_SOURCES / "lockstep").glob("*.py"))]:
        yield path.relative_to(_SOURCES).as_posix(), path.read_bytes()
    yield "lockstep/_origin.py", f'"The installation that this package came from."\nSOURCES = {str(_SOURCES)!r}\n'.encode()
    yield f"{_INFO}/METADATA", (f"Metadata-Version: 2.1\nName: {_NAME}\nVersion: {_VERSION}\n"
                                f"Summary: {_field('description')}\n"
                                f"Requires-Python: {_field('requires-python')}\n").encode()
    yield f"{_INFO}/entry_points.txt", b"[pytest11]\nlockstep = lockstep.pytest_plugin\n"
    yield f"{_INFO}/WHEEL", b"Wheel-Version: 1.0\nGenerator: lockstep\nRoot-Is-Purelib: true\nTag: py3-none-any\n"


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    record = ""
    wheel = f"{_NAME}-{_VERSION}-py3-none-any.whl"
    with zipfile.ZipFile(os.path.join(wheel_directory, wheel), "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in _files():
            archive.writestr(name, content)
            digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()
            record += f"{name},sha256={digest},{len(content)}\n"
        archive.writestr(f"{_INFO}/RECORD", f"{record}{_INFO}/RECORD,,\n")
    return wheel


def build_sdist(sdist_directory, config_settings=None):
    raise NotImplementedError("lockstep is installed from its sources, or from share/lockstep/python of an installation")


def _leave_nothing():
    "Python has written this module's code beside it."
    cached = pathlib.Path(__spec__.cached)
    try:
        cached.unlink()
        cached.parent.rmdir()
    except OSError:  # it may not write there, or others have
        pass


_leave_nothing()
