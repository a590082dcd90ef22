"""The changes that tests/mutants/mutants.py makes: mutants_test.py."""
import pathlib

import mutants

TEXT = """\
#include <a> // == here
if (a == b && true) return "x == y" + z;  // a < b
const bool is_true = a<b;
"""
found = list(mutants.mutants_of(TEXT))
assert [(line, before, after) for line, _, before, after in found] == [
    (1, " == ", " != "), (1, " && ", " || "), (1, " + ", " - "), (1, "true", "false")], found
for mutant in found:
    text = mutants.changed(TEXT, mutant)
    differing = [(old, new) for old, new in zip(TEXT.splitlines(), text.splitlines()) if old != new]
    assert len(differing) == 1 and text.count("\n") == TEXT.count("\n"), text
assert mutants.changed(TEXT, found[0]).splitlines()[1].startswith("if (a != b && true)")

sources = {"b.cpp": TEXT, "a.cpp": TEXT}
assert mutants.chosen(sources, 5, "seed") == mutants.chosen(dict(reversed(sources.items())), 5, "seed")
assert len(set(mutants.chosen(sources, 100, "seed"))) == 8

rows = mutants.listed(pathlib.Path(mutants.__file__).parent / "resume.txt")
for file, before, after in rows:  # each is of one place
    assert (mutants.SOURCE / file).read_text().count(before) == 1 and before != after, (file, before)
assert len(rows) >= 6
