#!/usr/bin/env python3
"""JUnit XML, as continuous integration systems read it.

    ci/junit.py LOGDIR FILE.xml     the verdicts of ci/run-tests, from what it keeps of each command in LOGDIR: NAME.log and NAME.log.result
"""
import glob
import os
import re
import sys
import xml.etree.ElementTree as tree

# XML has no place for control characters, nor for lone surrogates, escaped or not.
FORBIDDEN = re.compile("[^\t\n\r\x20-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")


def case(name, outcome="passed", message="", text="", seconds=None):
    """One test case; outcome: passed, failed, error or skipped."""
    assert outcome in ("passed", "failed", "error", "skipped"), outcome
    return {"name": name, "outcome": outcome, "message": message, "text": text, "seconds": seconds}


def clean(text):
    return FORBIDDEN.sub("?", text)


def write(path, suites):
    """suites: list of (name, cases). The file appears whole or not at all."""
    root = tree.Element("testsuites")
    total = {"tests": 0, "failures": 0, "errors": 0, "skipped": 0}
    for name, cases in suites:
        suite = tree.SubElement(root, "testsuite", name=clean(name))
        counts = {"tests": len(cases), "failures": sum(c["outcome"] == "failed" for c in cases), "errors": sum(c["outcome"] == "error" for c in cases),
                  "skipped": sum(c["outcome"] == "skipped" for c in cases)}
        for key, count in counts.items():
            suite.set(key, str(count))
            total[key] += count
        for c in cases:
            element = tree.SubElement(suite, "testcase", classname=clean(name), name=clean(c["name"]))
            if c["seconds"] is not None:
                element.set("time", f"{c['seconds']:.3f}")
            if c["outcome"] != "passed":
                tag = {"failed": "failure", "error": "error", "skipped": "skipped"}[c["outcome"]]
                tree.SubElement(element, tag, message=clean(c["message"])).text = clean(c["text"]) or None
    for key, count in total.items():
        root.set(key, str(count))
    tree.indent(root)
    tree.ElementTree(root).write(path + ".partial", encoding="utf-8", xml_declaration=True)
    os.replace(path + ".partial", path)


def cmocka_results(log):
    """[(test, passed|failed|skipped, what it said)] of a cmocka program's text output, in order. A test that was begun and says no more is not among them."""
    words = {"OK": "passed", "FAILED": "failed", "SKIPPED": "skipped"}
    running, said, results = None, [], []
    for line in log.splitlines():
        begun = re.fullmatch(r"\[ RUN      \] (.+)", line)
        ended = re.fullmatch(r"\[ +(OK|FAILED|SKIPPED) +\] (.+)", line)
        if begun:
            running, said = begun.group(1), []
        elif ended and ended.group(2) == running:
            results.append((running, words[ended.group(1)], "\n".join(said)))
            running = None
        elif running is not None:
            said.append(line)
    return results


def first_error(text):
    found = re.search(r"^\[  ERROR   \] --- (.+)$", text, re.M)
    return found.group(1) if found else ""


def command_cases(log, passed, failed, skipped, status, seconds):
    """The cases of one command, as many of each outcome as ci/run-tests has counted: what no test stands for has a case of its own."""
    left = {"passed": passed, "failed": failed, "skipped": skipped}
    made = []
    for name, outcome, said in cmocka_results(log):
        if left[outcome] > 0:
            left[outcome] -= 1
            made.append(case(name, outcome, first_error(said), said if outcome == "failed" else ""))
    tail = "\n".join(log.splitlines()[-60:])
    for outcome, count in left.items():
        for _ in range(count):
            made.append(case("the command", outcome, f"exit status {status}" if outcome == "failed" else "", tail if outcome == "failed" else "", seconds))
    return made


def of_logs(folder):
    suites = []
    for path in sorted(glob.glob(os.path.join(folder, "*.log.result"))):
        with open(path, encoding="utf-8") as file:
            name, counts, status, seconds = file.read().rstrip("\n").split("\t")
        with open(path[:-len(".result")], encoding="utf-8", errors="replace") as file:
            log = file.read()
        suites.append((name, command_cases(log, *map(int, counts.split()), int(status), float(seconds))))
    return suites


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    write(sys.argv[2], of_logs(sys.argv[1]))
