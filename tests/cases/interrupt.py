#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""A run that a signal interrupts can be resumed, bit by bit.

Each run gets SIGINT or SIGTERM, or SIGUSR1 by way of mpirun, at a random moment
of its steps, though it writes checkpoints at the end of stages only. It must
end soon, with 128 and the number of the signal as its exit status, one line in
its log and whole tables; resumed, it writes the same files as the uninterrupted
run.
"""
import json
import os
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import common  # noqa: E402
import resume  # noqa: E402
from common import Failure  # noqa: E402

# name: case of resume.py, signal, further overrides
CASES = {
    "crack": ("crack", signal.SIGTERM, []),
    "sled": ("sled on 2 ranks", signal.SIGUSR1, []),
    "pattern": ("pattern", signal.SIGINT, []),
    "implicit": ("implicit", signal.SIGINT, []),
    "hybrid": ("hybrid", signal.SIGTERM, []),
    "cavity": ("cavity", signal.SIGINT, []),
    "safety": ("safety", signal.SIGINT, []),
    "safety, implicit": ("safety", signal.SIGTERM, ["Solver=implicit"]),
}
PATIENCE = 30                  # [s] a step may take under a full machine


def log_of(output):
    try:
        with open(os.path.join(output, "log.txt")) as stream:
            return stream.read()
    except FileNotFoundError:
        return ""


def seconds_of_steps(output):
    """Wall time of a run, from its summary: what it takes to step."""
    with open(os.path.join(output, "summary.json")) as stream:
        summary = json.load(stream)
    # boundary elements alone have no mesh
    if not 0. <= summary["mesh time [s]"] < summary["set-up time [s]"]:
        raise Failure("the set-up took %g s, the mesh %g s"
                      % (summary["set-up time [s]"], summary["mesh time [s]"]))
    return summary["wall time [s]"]


def has_begun(output):
    """Whether the tables are there, which are made just before the steps."""
    return os.path.exists(os.path.join(output, "used_parameters.prm"))


def start(words, output):
    """A run that is about to step."""
    used = os.path.join(output, "used_parameters.prm")
    before = os.stat(used).st_mtime_ns if has_begun(output) else 0
    with open(output + ".err", "w") as stream:
        process = subprocess.Popen(words, env=common.environment(),
                                   stdout=subprocess.DEVNULL, stderr=stream)
    deadline = time.monotonic() + 60
    while process.poll() is None and (
            not has_begun(output) or os.stat(used).st_mtime_ns == before):
        if time.monotonic() > deadline:
            resume.kill_all(process)
            raise Failure("a run does not begin within 60 s")
        time.sleep(0.002)
    return process


def came_too_early(output):
    """Whether the last signal came before the first step."""
    with open(output + ".err") as stream:
        return "before the first step: nothing was computed" in stream.read()


def interrupt(process, output, number, name, ranks):
    """Sends the signal; False if the run has finished before, None if it has
    not begun to step.

    mpirun passes signals on while its processes run; one that comes after they
    have ended, while it clears up, ends mpirun itself.
    """
    process.send_signal(number)
    try:
        status = process.wait(timeout=PATIENCE)
    except subprocess.TimeoutExpired:
        resume.kill_all(process)
        raise Failure("%s: it goes on %d s after the signal"
                      % (name, PATIENCE))
    if came_too_early(output):
        return None
    if ranks > 1 and status == -number:
        return False
    if status not in (0, 128 + number):
        raise Failure("%s: exit status %d, not %d"
                      % (name, status, 128 + number))
    return status != 0


def check_log(output, number, n, name):
    lines = [line for line in log_of(output).splitlines()
             if line.startswith("interrupted by " + number.name + " at time")
             and "--resume" in line]
    if len(lines) != n:
        raise Failure("%s: %d lines on %d interruptions in log.txt"
                      % (name, len(lines), n))


def interrupt_and_resume(options, name):
    """Interrupts a case twice, resumes it, and compares."""
    case, number, more = CASES[name]
    prm, sets, ranks, _ = resume.CASES[case]
    sets = [value for value in sets + more
            if not value.startswith("Output/Checkpoint interval")] \
        + ["Output/Checkpoint interval=0"]
    chance = random.Random("%d %s" % (options.seed, name))
    with tempfile.TemporaryDirectory(prefix="quoin_") as scratch:
        whole = os.path.join(scratch, "whole")
        broken = os.path.join(scratch, "broken")
        common.run(options.quoin, prm, whole, sets, ranks)
        lasting = seconds_of_steps(whole)
        done = 0
        for attempt in range(12):
            words = common.command(options.quoin, prm, broken, sets, ranks,
                                   ["--resume"] if done else [])
            process = start(words, broken)
            time.sleep(0.5 * chance.random() * lasting)
            ended = interrupt(process, broken, number, name, ranks)
            if ended is None:
                continue
            if not ended:
                lasting /= 2
                done = 0
                shutil.rmtree(broken)
                continue
            done += 1
            check_log(broken, number, done, name)
            if done == 2:
                break
        if done == 0:
            raise Failure("%s finished before it could be interrupted" % name)
        common.run(options.quoin, prm, broken, sets, ranks, ["--resume"])
        resume.compare_tables(name, whole, broken)
        resume.compare_fields(name, whole, broken)
        resume.compare_summaries(name, whole, broken)
    print("  %s: interrupted %d times" % (name, done), flush=True)
    return done


def body():
    parser = common.arguments(__doc__.splitlines()[0])
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--only", help="the case whose name begins so")
    options = parser.parse_args()
    if not options.only:
        results = common.begin(options, "interrupt")
    begin = time.monotonic()
    n = sum(common.in_parallel(
        lambda name: interrupt_and_resume(options, name),
        [name for name in CASES if name.startswith(options.only or "")]))
    if not options.only:
        common.write_result(
            results, "interrupt", title="interrupted %d times by a signal and "
            "resumed" % n, reference="uninterrupted run, bitwise", error=0.0,
            tolerance=0.0, seconds=round(time.monotonic() - begin, 2),
            passed=True)
    print("passed: interrupt: bitwise equal after %d interruptions" % n)


if __name__ == "__main__":
    common.main(body)
