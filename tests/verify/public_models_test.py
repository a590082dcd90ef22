"""`verify` against verdicts and probabilities that a statistical model checker has of such trees: public_models_test.py LOCKSTEP

The trees and leaf models in public_models/ are written anew, in own words, after examples of AS2FM, whose tests state a verdict for
each: a snack that is served after at most five attempts (0.954 within 0.015), a dock that charges or never does (1 and 0), an
assembly that recovers or does not (1 and 0.7), and a mission that sweeps once or sometimes twice (1 and 0.96). The chances are
such that each number can be computed by hand. A tree with a mistake must be refuted by a run that breaks the property
when it is read again from its recording, and the tree without it proved."""
import json
import pathlib
import subprocess
import sys
import tempfile

MODELS = pathlib.Path(__file__).parent / "public_models"
LOCKSTEP = sys.argv[1]


def served():
    """At most four failures before three motions succeeded, with chances of 0.7, 0.6 and 0.7."""
    chances = [1.0]  # of 0, 1, 2, … failures
    for success in (0.7, 0.6, 0.7):
        chances = [sum(chances[i] * success * (1 - success) ** (count - i) for i in range(count + 1) if i < len(chances))
                   for count in range(5)]
    return sum(chances)


# Tree, leaf model, property, its probability, and whether its verdict is examined: it has no chance of being wrong.
CASES = [
    ("fetch", "fetch", "sometimes {fact:served} == true", served(), False),
    ("dock", "dock", "sometimes IsCharging.success", 1, False),
    ("dock", "dock_too_early", "sometimes IsCharging.success", 0, False),
    ("dock", "dock", "never IsCharging.failure", 1, True),
    ("dock", "dock_too_early", "never IsCharging.failure", 0, True),
    ("assembly", "assembly", "Place.failure leads to PickUp.ticked", 1, True),
    ("assembly_once", "assembly", "Place.failure leads to PickUp.ticked", 0.7, True),
    ("mission", "mission", "never {misses} == 2", 1, True),
    ("mission_again", "mission", "never {misses} == 2", 0.96, True),
]


def lockstep(*words):
    return subprocess.run([LOCKSTEP, *map(str, words)], capture_output=True, text=True, timeout=120)


def verify(tree, leaves, text, *more):
    return lockstep("verify", MODELS / f"{tree}.xml", "--mock", "--leaves", MODELS / f"{leaves}.leaves.xml",
                    "--property", f"wanted: {text}", *more)


def check_probability(tree, leaves, text, wanted):
    done = verify(tree, leaves, text, "--probability", "--json")
    assert done.returncode == 0, done.stderr
    found = next(it for it in json.loads(done.stdout)["probabilities"] if it["name"] == "property 'wanted'")
    for low, high in (found["least"], found["most"]):
        assert low - 1e-12 <= wanted <= high + 1e-12 and high - low < 1e-8, (tree, text, wanted, found)


def check_verdict(tree, leaves, text, holds):
    with tempfile.TemporaryDirectory() as out:
        done = verify(tree, leaves, text, "--only", "property/wanted", "--out", out)
        assert done.returncode == (0 if holds else 1), (tree, leaves, text, done.stdout, done.stderr)
        recordings = list(pathlib.Path(out).glob("*.property.wanted.jsonl"))
        assert len(recordings) == (0 if holds else 1), done.stdout
        for it in recordings:
            checked = lockstep("log", "check", it, "--property", f"wanted: {text}")
            assert checked.returncode == 1, (tree, checked.stdout, checked.stderr)


assert abs(served() - 0.954) < 0.015
for tree, leaves, text, probability, has_verdict in CASES:
    check_probability(tree, leaves, text, probability)
    if has_verdict:
        check_verdict(tree, leaves, text, probability == 1)
print(f"{len(CASES)} probabilities, {sum(it[4] for it in CASES)} verdicts")
