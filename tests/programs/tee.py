#!/usr/bin/python3
# Passes what lockstep and $PROGRAM, or steady.py, say to each other on, and appends it to the file $LINES.
import os
import subprocess
import sys
import threading

program = subprocess.Popen([os.path.join(os.path.dirname(__file__), os.environ.get("PROGRAM", "steady.py"))],
                           stdin=subprocess.PIPE, stdout=subprocess.PIPE)
lines = open(os.environ["LINES"], "ab", buffering=0)


def copy(source, sink):
    for line in source:
        lines.write(line)
        sink.write(line)
        sink.flush()


answers = threading.Thread(target=copy, args=(program.stdout, sys.stdout.buffer))
answers.start()
copy(sys.stdin.buffer, program.stdin)
program.stdin.close()
answers.join()
