# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""What the case tests share: running quoin, reading its tables, results."""
import argparse
import concurrent.futures
import json
import os
import subprocess
import sys
import time

import numpy as np

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(
    os.path.abspath(__file__))))
VERIFICATION = os.path.join(ROOT, "parameter_files", "verification")
MASONRY = os.path.join(ROOT, "parameter_files", "masonry")
SLED = os.path.join(ROOT, "tests", "cases", "sled.prm")
DIG = os.path.join(ROOT, "tests", "cases", "dig.prm")
SLIDE = os.path.join(ROOT, "tests", "cases", "slide.prm")
# Blocks placed, excavated and placed again, and the same in motion.
FILL = os.path.join(VERIFICATION, "fill", "case.prm")
SHORT_FILL = ["Stages/%s/%s" % (stage, value)
              for stage in ("base", "fill", "half", "gone", "concrete")
              for value in ("End=time", "Duration=0.02")]

MPI_ENVIRONMENT = {
    "OMPI_ALLOW_RUN_AS_ROOT": "1",
    "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
    "OMPI_MCA_rmaps_base_oversubscribe": "1",
    "OMPI_MCA_mpi_yield_when_idle": "1",
    # no search for the network of a cluster, a quarter of a second a start
    "OMPI_MCA_pml": "ob1",
}
MOST_RESIDUAL = 1e-4           # of the energy balance, unless a case says more
RUN_FAILED = 2                 # exit status of quoin: its outputs are kept


class Failure(Exception):
    """A test that did not pass; the text is the line a person reads."""


class RunFailed(Failure):
    """A run that quoin itself has ended, with the exit status RUN_FAILED."""


def arguments(description):
    parser = argparse.ArgumentParser(description=description)
    parser.add_argument("--quoin", required=True, help="the executable")
    parser.add_argument("--results", help="folder for the one-line results "
                        "(default: verification_results beside quoin)")
    return parser


def results_folder(options):
    folder = options.results or os.path.join(
        os.path.dirname(os.path.abspath(options.quoin)),
        "verification_results")
    os.makedirs(folder, exist_ok=True)
    return folder


def begin(options, *names):
    """Writes of each name that it has not passed, until write_result() says
    more: the result of an earlier run must not stand for one that crashes.
    Returns the folder of results."""
    folder = results_folder(options)
    for name in names:
        write_result(folder, name, passed=False)
    return folder


def write_result(folder, name, **values):
    with open(os.path.join(folder, name + ".json"), "w") as stream:
        json.dump(dict(case=name, **values), stream)
        stream.write("\n")


def command(quoin, prm, output, sets=(), ranks=1, extra=()):
    words = [os.path.abspath(quoin), prm, "--output", output, "--quiet"]
    for value in sets:
        words += ["--set", value]
    words += list(extra)
    if ranks > 1:
        words = ["mpirun", "--oversubscribe", "-np", str(ranks)] + words
    return words


def environment():
    return dict(os.environ, **MPI_ENVIRONMENT)


def run(quoin, prm, output, sets=(), ranks=1, extra=(), accepted=(0,)):
    """Runs a case, which must end with an accepted exit status; returns the
    seconds it took."""
    start = time.monotonic()
    done = subprocess.run(command(quoin, prm, output, sets, ranks, extra),
                          env=environment(), stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, text=True)
    seconds = time.monotonic() - start
    if done.returncode not in accepted:
        tail = "\n".join(done.stdout.strip().splitlines()[-15:])
        kind = RunFailed if done.returncode == RUN_FAILED else Failure
        raise kind("%s ended with exit status %d:\n%s"
                   % (os.path.relpath(prm, ROOT), done.returncode, tail))
    return seconds


def unexpected_warnings(texts, output, possible=()):
    """Warnings of the log that have none of the texts, and the texts that no
    warning has, those of possible warnings apart."""
    with open(os.path.join(output, "log.txt")) as log:
        warnings = [line for line in log if line.startswith("Warning: ")]
    return (["warns: " + line.strip() for line in warnings
             if not any(text in line for text in [*texts, *possible])]
            + ["does not warn: " + text for text in texts
               if not any(text in line for line in warnings)])


def energy_residual_share(output):
    """Largest residual of the energy balance by the energy throughput; 0 of a
    run without blocks, which has no balance."""
    with open(os.path.join(output, "summary.json")) as stream:
        summary = json.load(stream)
    largest = summary.get("largest energy residual [J]", 0)
    return largest and largest / summary["energy throughput [J]"]


def in_parallel(act, items):
    """The results of @p act, which waits for programs, for each of @p items."""
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as threads:
        return list(threads.map(act, items))


def read_table(path):
    """A CSV file as {name: values}, the unit left off, and {name: unit}."""
    if not os.path.exists(path):
        raise Failure("%s does not exist" % path)
    with open(path) as stream:
        header = stream.readline().strip().split(",")
    data = np.loadtxt(path, delimiter=",", skiprows=1, ndmin=2)
    if data.size == 0:
        raise Failure("%s has no rows" % path)
    columns, units = {}, {}
    for label, values in zip(header, data.T):
        name, _, unit = label.partition(" [")
        columns[name] = values
        units[name] = unit.rstrip("]")
    return columns, units


def cubic(t, x, y):
    """Interpolation by the cubic through the four nearest points."""
    i = np.clip(np.searchsorted(x, t) - 2, 0, len(x) - 4)
    value = np.zeros_like(t, dtype=float)
    for j in range(4):
        weight = np.ones_like(value)
        for k in range(4):
            if k != j:
                weight *= (t - x[i + k]) / (x[i + j] - x[i + k])
        value += weight * y[i + j]
    return value


def strictly_increasing(table, time_name="time"):
    """The rows without repeated times (the last row of a repeated time)."""
    t = table[time_name]
    keep = np.append(np.diff(t) > 0, True)
    return {name: values[keep] for name, values in table.items()}


def main(body):
    """Runs body() and turns a Failure into exit status 1 and its line."""
    try:
        body()
    except Failure as failure:
        print("FAILED: %s" % failure)
        sys.exit(1)
