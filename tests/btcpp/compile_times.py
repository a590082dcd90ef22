#!/usr/bin/env python3
"""How long a source takes to compile over the headers for BehaviorTree.CPP: with liblockstep-btcpp.a, with the headers
alone, and with the library.

    tests/btcpp/compile_times.py [--library CHECKOUT] [--compiler g++] [--runs 3] [SOURCE…]

Prints the shortest time of the processor in seconds, and how many weak functions are in the object."""

import argparse
import os
import pathlib
import resource
import subprocess
import tempfile

SOURCE = pathlib.Path(__file__).resolve().parents[2]
TEMPLATE = SOURCE / "tests/sdk_template/btcpp"
OURS = [SOURCE / "plugins/sdk/btcpp/include", SOURCE / "plugins/sdk", SOURCE / "interpreter/embedding"]


def measure(command, runs, output):
    times = []
    for _ in range(runs):
        before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
        subprocess.run(command, check=True)
        times.append(resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before)
    names = subprocess.run(["nm", output], check=True, capture_output=True, text=True).stdout
    return f"{min(times):5.2f} s {sum(' W ' in line for line in names.splitlines()):6} weak"


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--library", type=pathlib.Path, help="a checkout of BehaviorTree.CPP 4")
    parser.add_argument("--compiler", default=os.environ.get("CXX", "g++"))
    parser.add_argument("--runs", type=int, default=3)
    parser.add_argument("sources", nargs="*", type=pathlib.Path)
    arguments = parser.parse_args()
    ways = {"functions compiled": [*(f"-I{it}" for it in OURS), "-DLOCKSTEP_BTCPP_LIBRARY"],
            "headers alone": [f"-I{it}" for it in OURS]}
    if arguments.library is not None:
        ways["library"] = [f"-I{arguments.library / it}" for it in ("include", "3rdparty")]
    with tempfile.TemporaryDirectory() as folder:
        only = pathlib.Path(folder) / "include_only.cpp"
        only.write_text('#include "behaviortree_cpp/bt_factory.h"\n')
        output = pathlib.Path(folder) / "it.o"
        for source in arguments.sources or [only, TEMPLATE / "nodes.cpp", TEMPLATE / "main.cpp"]:
            for name, flags in ways.items():
                command = [arguments.compiler, "-std=c++17", "-O0", *flags, "-c", source, "-o", output]
                print(f"{source.name:20} {name:20} {measure(command, arguments.runs, output)}", flush=True)


if __name__ == "__main__":
    main()
