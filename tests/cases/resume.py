#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""A run that is killed and resumed writes the same histories, bit by bit.

The run is killed (SIGKILL) several times, at random moments after the first
checkpoint, resumed each time, and its histories and energies are compared with
those of an uninterrupted one as bytes.
"""
import os
import random
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import common  # noqa: E402
from common import Failure  # noqa: E402


def read(output, name):
    with open(os.path.join(output, name), "rb") as stream:
        return stream.read()


def written(checkpoint):
    """A number that changes with every checkpoint; 0: there is none."""
    try:
        return os.stat(checkpoint).st_mtime_ns
    except FileNotFoundError:
        return 0


def kill(words, checkpoint, delay):
    """Starts a run and kills it some time after its first new checkpoint;
    returns False if it finished before."""
    before = written(checkpoint)
    deadline = time.monotonic() + 60
    with tempfile.TemporaryFile(mode="w+") as screen:
        process = subprocess.Popen(words, env=common.environment(),
                                   stdout=screen, stderr=screen)
        while process.poll() is None and written(checkpoint) == before:
            if time.monotonic() > deadline:
                process.kill()
                raise Failure("no checkpoint within 60 s")
            time.sleep(0.005)
        try:
            process.wait(timeout=delay)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()
            return True
        if process.returncode != 0:
            screen.seek(0)
            raise Failure("the run ended with exit status %d:\n%s"
                          % (process.returncode, screen.read()[-1500:]))
    return False


def body():
    parser = common.arguments(__doc__.splitlines()[0])
    parser.add_argument("--kills", type=int, default=3)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    random.seed(options.seed)
    # friction and two stages: the case with the most history
    prm = os.path.join(common.VERIFICATION, "slipping_crack", "case.prm")
    sets = ["Output/Checkpoint interval=0.1", "Histories/Interval=1e-5",
            "Histories/Names=displacement, force, ratio",
            "Histories/ratio/Quantity=unbalanced ratio",
            "Time stepping/Share of critical time step=0.3"]
    start = time.monotonic()
    with tempfile.TemporaryDirectory(prefix="quoin_") as scratch:
        whole = os.path.join(scratch, "whole")
        broken = os.path.join(scratch, "broken")
        seconds = common.run(options.quoin, prm, whole, sets)
        words = common.command(options.quoin, prm, broken, sets)
        killed = 0
        for attempt in range(options.kills):
            delay = random.random() * seconds / (options.kills + 1)
            extra = ["--resume"] if attempt else []
            if not kill(words + extra, os.path.join(
                    broken, "checkpoint", "latest"), delay):
                break
            killed += 1
            print("  killed %.2f s after a checkpoint" % delay)
        if killed == 0:
            raise Failure("the run finished before it could be killed")
        common.run(options.quoin, prm, broken, sets, extra=["--resume"])
        for name in ("histories.csv", "energies.csv"):
            a, b = read(whole, name), read(broken, name)
            if a != b:
                rows = list(zip(a.splitlines(), b.splitlines()))
                row = next((i for i, (x, y) in enumerate(rows) if x != y),
                           len(rows))
                raise Failure(
                    "%s differs from row %d on (%d and %d bytes)\n  %s\n  %s"
                    % (name, row, len(a), len(b),
                       a.splitlines()[row:row + 1],
                       b.splitlines()[row:row + 1]))
    common.write_result(
        common.results_folder(options), "resume",
        title="killed %d times and resumed" % killed,
        reference="uninterrupted run, bitwise", error=0.0, tolerance=0.0,
        seconds=round(time.monotonic() - start, 2), passed=True)
    print("passed: resume: bitwise equal after %d kills" % killed)


if __name__ == "__main__":
    common.main(body)
