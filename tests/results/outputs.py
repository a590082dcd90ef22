"""The end of what each failed test printed, from the file that `ctest --output-junit` writes: a long log has it far above.

usage: outputs.py FILE [LINES]"""
import sys
import xml.etree.ElementTree as xml


def main(file, most="25"):
    for case in xml.parse(file).getroot().iter("testcase"):
        if case.get("status") != "fail":
            continue
        lines = (case.findtext("system-out") or "").strip().splitlines()
        print(f"failed: {case.get('name')}")
        for line in lines[-int(most):]:
            print("  " + line[:300])


if __name__ == "__main__":
    main(*sys.argv[1:])
