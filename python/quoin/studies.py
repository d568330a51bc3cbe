# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Runs a case for all combinations of some parameters.

Each run has a folder in that of the study, named by a fingerprint of what was
changed, of the parameter file and of the meshes and tables that it names, with
quoin's output and run.json, which says how it ended. A run whose folder says that it ended is not made again, one that was
interrupted goes on from its checkpoint, and one that another process makes is left
to it; so a study that was stopped, or whose grid has grown, goes on where it was.
"""

import contextlib
import csv
import functools
import hashlib
import itertools
import json
import math
import os
import sys
import time
from concurrent.futures import ThreadPoolExecutor, as_completed

from quoin import run_parameters
from quoin.frames import frame
from quoin.results import read
from quoin.running import RunFailed, Runs, entry, is_under_way, run

RECORD = "run.json"
CHECKPOINT = os.path.join("checkpoint", "latest")


def combinations(grid):
    """[{"Section/Name": value}] of a grid {name: [values]}. Names in a tuple
    change together: {("a", "b"): [(1, 2), (3, 4)]}."""
    axes = []
    for names, values in grid.items():
        together = names if isinstance(names, tuple) else (names,)
        if isinstance(values, str) or not hasattr(values, "__iter__"):
            values = ()
        axis = [value if isinstance(names, tuple) else (value,)
                for value in values]
        if not axis or any(not isinstance(value, (tuple, list))
                           or len(value) != len(together) for value in axis):
            raise ValueError(f"the grid of {', '.join(together)} needs a list "
                             f"of one or more values, each of {len(together)}")
        axes.append([dict(zip(together, value)) for value in axis])
    return [{name: value for part in parts for name, value in part.items()}
            for parts in itertools.product(*axes)]


@functools.lru_cache(maxsize=None)
def contents(path, _changed, _size):
    """Fingerprint of a file, read again if it was changed."""
    with open(path, "rb") as file:
        return hashlib.sha1(file.read()).hexdigest()


def fingerprint(case, overrides, options=()):
    """Fingerprint of a parameter file, those that it includes, what is changed,
    and the meshes, tables and records that these name."""
    words = [line for line in run_parameters.lines_of(case) if line]
    words += sorted(entry(*item) for item in overrides.items())
    words += options
    for path in run_parameters.files_in(os.path.dirname(case), words):
        known = os.stat(path)
        words.append(contents(path, known.st_mtime_ns, known.st_size))
    return hashlib.sha1("\n".join(words).encode()).hexdigest()[:12]


def record_of(folder):
    """Record of how the run in a folder ended, or None if it did not."""
    try:
        with open(os.path.join(folder, RECORD), encoding="utf-8") as file:
            return json.load(file)
    except (OSError, json.JSONDecodeError):
        return None


def make(case, overrides, folder, ranks, quoin, options, runs):
    """One run, or what an interrupted one left to do; returns its record, None
    of a run that another process makes."""
    if is_under_way(folder):
        return None
    path = os.path.join(folder, RECORD)
    goes_on = (record_of(folder) is None
               and os.path.exists(os.path.join(folder, CHECKPOINT)))
    with contextlib.suppress(FileNotFoundError):
        os.remove(path)
    begin = time.monotonic()
    record = {"parameters": overrides, "status": "finished", "message": ""}
    for more in [["--resume"], []] if goes_on else [[]]:
        try:
            run(case, overrides, folder, ranks, quoin, [*options, *more],
                runs=runs)
            break
        except RunFailed as failed:
            if is_under_way(folder):
                return None              # began just before
            if failed.status < 0 or failed.status > 2:
                raise                    # ended from outside: no result
            if failed.status == 2 or not more:
                record.update(status="failed", message=str(failed))
                break
            # the checkpoint is one of another mesh or version
    record["seconds"] = round(time.monotonic() - begin, 3)
    os.makedirs(folder, exist_ok=True)
    with replaced(path) as file:
        json.dump(record, file, indent=2)
    return record


@contextlib.contextmanager
def replaced(path, **how):
    """A file to write that takes the place of another as a whole."""
    with open(path + ".new", "w", encoding="utf-8", **how) as file:
        yield file
    os.replace(path + ".new", path)


def missing_runs(chosen, again):
    """Folders that have no result yet; @p again: nor a failure."""
    ends = ("finished",) if again else ("finished", "failed")
    return [folder for folder in chosen
            if (record_of(folder) or {}).get("status") not in ends]


def study(case, grid, output, collect=None, processes=1, ranks=1, quoin=None,
          options=(), again=False, progress=sys.stderr):
    """Runs a case for each combination of a grid and returns a table of them.

    @p case: path of a parameter file. @p grid: {"Section/Name": [values]}, see
    combinations(). @p output: the folder of the study. @p collect: a function
    of the Results of a finished run that returns {column: value}; it is asked
    at each call, so that it may change without a run being made again. @p
    processes: runs at a time, each on @p ranks. @p again: failed runs are made
    again. @p progress: where a line each run goes, None: nowhere.

    The table, a data frame (see frames.py) and study.csv in the folder, has a
    row each combination: the parameters, "status", finished, failed, in
    study.csv also to come, and under way if another process makes it, "message" of a failure, which does not stop
    the others, "seconds", how many "warnings" the run gave (Results.warnings
    are their texts), "folder" and what collect() gave, nan where it gave
    nothing. study.csv is written after each run. Ctrl-C, and whatever else ends
    the study, ends its runs with their checkpoints. A run is made again where
    the parameter file, a mesh or a table that it names has changed; another
    version of quoin is not noticed: delete the folder of the study then.
    """
    chosen = {
        os.path.join(output, fingerprint(case, overrides, options)): overrides
        for overrides in combinations(grid)}
    missing = missing_runs(chosen, again)
    begin = time.monotonic()
    table = StudyTable(chosen, output, collect)
    under_way = Runs()

    def say(text):
        if progress:
            print(text, file=progress, flush=True)

    say(f"{len(chosen)} runs, {len(chosen) - len(missing)} of them there")
    table.write()
    with ThreadPoolExecutor(processes) as pool:
        runs = {pool.submit(make, case, chosen[folder], folder, ranks, quoin,
                            options, under_way): folder for folder in missing}
        try:
            for done, future in enumerate(as_completed(runs), 1):
                folder, record = runs[future], future.result()
                if record is None:
                    table.elsewhere.add(folder)
                left = (len(runs) - done) * (time.monotonic() - begin) / done
                changed = ", ".join(entry(*item) for item
                                    in chosen[folder].items())
                say(f"{done}/{len(runs)} " + (
                    "under way in another process" if record is None else
                    f"{record['status']} in {record['seconds']:.1f} s")
                    + f", {left:.0f} s to go: {changed}"
                    + (f"\n    {record['message']}"
                       if record and record["message"] else ""))
                table.write()
        except BaseException:
            under_way.stop()
            pool.shutdown(cancel_futures=True)
            raise
    return frame(table.write())


class StudyTable:
    """study.csv; a run is asked once for what it gave."""

    def __init__(self, chosen, output, collect):
        self.chosen = chosen
        self.output = output
        self.collect = collect
        self.found = {}
        self.elsewhere = set()

    def given(self, folder):
        if folder not in self.found:
            results = read(folder)
            self.found[folder] = {
                "warnings": len(results.warnings), "folder": folder,
                **(self.collect(results) if self.collect else {})}
        return self.found[folder]

    def row(self, folder, overrides):
        record = record_of(folder) or {
            "status": "under way" if folder in self.elsewhere else "to come",
            "message": "", "seconds": math.nan}
        known = {key: record[key] for key in ("status", "message", "seconds")}
        if record["status"] == "finished":
            return {**overrides, **known, **self.given(folder)}
        n = (len(read(folder).warnings) if record["status"] == "failed"
             else math.nan)
        return {**overrides, **known, "warnings": n, "folder": folder}

    def write(self):
        """Writes the file; returns its columns."""
        rows = [self.row(*item) for item in self.chosen.items()]
        names = list(dict.fromkeys(name for row in rows for name in row))
        columns = {name: [row.get(name, math.nan) for row in rows]
                   for name in names}
        os.makedirs(self.output, exist_ok=True)
        with replaced(os.path.join(self.output, "study.csv"),
                      newline="") as file:
            writer = csv.writer(file)
            writer.writerow(columns)
            writer.writerows(zip(*columns.values()))
        return columns
