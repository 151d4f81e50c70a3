# SPDX-FileCopyrightText: 2026 The Rakelight authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Times `rakelight refine` as a whole process beside OpenCV decoding the stack's PNGs in one thread, and a scan with the
virtual rig, refined: from nothing to a surface.

    whole_commands.py RAKELIGHT STACK ...
"""
import os
import pathlib
import sys
import tempfile
import time

import cv2

RUNS = 3
METHODS = {"multi-light": [], "rgb-ratio": ["--method", "rgb-ratio"], "fusion-like": ["--method", "fusion-like"],
           "rgbd-fusion": ["--method", "rgbd-fusion"]}


def run(command):
    """Exit code, wall seconds, CPU seconds and peak megabytes of a process; its output is dropped."""
    begin = time.perf_counter()
    child = os.fork()
    if child == 0:
        silence = os.open(os.devnull, os.O_WRONLY)
        os.dup2(silence, 1)
        os.dup2(silence, 2)
        os.execv(command[0], command)
    _, status, usage = os.wait4(child, 0)
    return (os.waitstatus_to_exitcode(status), time.perf_counter() - begin, usage.ru_utime + usage.ru_stime,
            usage.ru_maxrss / 1024)


def decoding(stack):
    """Seconds that OpenCV takes for the stack's PNGs in one thread, and the megabytes they decode to."""
    cv2.setNumThreads(1)
    files = [file.read_bytes() for file in sorted(pathlib.Path(stack).rglob("*.png")) if "truth" not in file.parts]
    best, size = float("inf"), 0
    for _ in range(RUNS):
        begin = time.perf_counter()
        size = sum(cv2.imdecode(memory(file), cv2.IMREAD_UNCHANGED).nbytes for file in files)
        best = min(best, time.perf_counter() - begin)
    return best, size / 2**20


def memory(file):
    import numpy
    return numpy.frombuffer(file, numpy.uint8)


def scan(program):
    """Best of some scans that are refined; nothing where the program is built without sensors."""
    with tempfile.TemporaryDirectory() as home:
        runs = [run([program, "scan", "-o", os.path.join(home, f"scan{k}"), "--refine", os.path.join(home, f"out{k}")])
                for k in range(RUNS)]
    if any(code != 0 for code, *_ in runs):
        return
    wall, cpu, peak = (min(column) for column in list(zip(*runs))[1:])
    print(f"| virtual rig | scan --refine | {wall:.2f} | {cpu:.2f} | | {peak:.0f} | |")


def main(program, stacks):
    print("| stack | method | wall s | CPU s | / decoding | peak MB | / decoded stack |")
    print("| --- | --- | --- | --- | --- | --- | --- |")
    for stack in stacks:
        seconds, megabytes = decoding(stack)
        for method, options in METHODS.items():
            with tempfile.TemporaryDirectory() as home:
                command = [program, "refine", stack, "-o", os.path.join(home, "out"), *options]
                runs = [run(command) for _ in range(RUNS)]
            if any(code != 0 for code, *_ in runs):
                print(f"| {pathlib.Path(stack).name} | {method} | does not apply | | | | |")
                continue
            wall, cpu, peak = (min(column) for column in list(zip(*runs))[1:])
            print(f"| {pathlib.Path(stack).name} | {method} | {wall:.2f} | {cpu:.2f} | {wall / seconds:.1f} | {peak:.0f} | "
                  f"{peak / megabytes:.1f} |")
    scan(program)


main(sys.argv[1], sys.argv[2:])
