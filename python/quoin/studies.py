# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Runs a case for all combinations of some parameters.

Each run has a folder in that of the study, named by a fingerprint of what was
changed and of the parameter file, with quoin's output and run.json, which says
how it ended. A run whose folder says that it ended is not made again, so a study
that was stopped, or whose grid has grown, goes on where it was.
"""

import csv
import hashlib
import itertools
import json
import os
import shutil
import sys
import time
from concurrent.futures import ThreadPoolExecutor, as_completed

from quoin import run_parameters
from quoin.frames import frame
from quoin.results import read
from quoin.running import RunFailed, entry, run

RECORD = "run.json"


def combinations(grid):
    """[{"Section/Name": value}] of a grid {name: [values]}. Names in a tuple
    change together: {("a", "b"): [(1, 2), (3, 4)]}."""
    axes = []
    for names, values in grid.items():
        together = names if isinstance(names, tuple) else (names,)
        axis = [value if isinstance(names, tuple) else (value,)
                for value in values]
        if not axis or any(len(value) != len(together) for value in axis):
            raise ValueError(f"the grid of {', '.join(together)} needs one or "
                             f"more values, each of {len(together)}")
        axes.append([dict(zip(together, value)) for value in axis])
    return [{name: value for part in parts for name, value in part.items()}
            for parts in itertools.product(*axes)]


def fingerprint(case, overrides, options=()):
    """Of a parameter file, those that it includes, and what is changed."""
    words = [line for line in run_parameters.lines_of(case) if line]
    words += sorted(entry(*item) for item in overrides.items())
    words += options
    return hashlib.sha1("\n".join(words).encode()).hexdigest()[:12]


def record_of(folder):
    """How the run in a folder ended, or None if it did not."""
    try:
        with open(os.path.join(folder, RECORD), encoding="utf-8") as file:
            return json.load(file)
    except (OSError, json.JSONDecodeError):
        return None


def make(case, overrides, folder, ranks, quoin, options):
    """One run, from its beginning; returns its record."""
    shutil.rmtree(folder, ignore_errors=True)
    begin = time.monotonic()
    record = {"parameters": overrides, "status": "finished", "message": ""}
    try:
        run(case, overrides, folder, ranks, quoin, options)
    except RunFailed as failed:
        if failed.status < 0 or failed.status > 2:
            raise                        # ended from outside: no result
        record.update(status="failed", message=str(failed))
    record["seconds"] = round(time.monotonic() - begin, 3)
    os.makedirs(folder, exist_ok=True)
    path = os.path.join(folder, RECORD)
    with open(path + ".new", "w", encoding="utf-8") as file:
        json.dump(record, file, indent=2)
    os.replace(path + ".new", path)
    return record


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
    row each combination: the parameters, "status", finished or failed, "message"
    of a failure, which does not stop the others, "seconds", "folder" and what
    collect() gave, nan where it gave nothing. A changed mesh or table is not
    noticed: delete the folder of the study then.
    """
    chosen = {
        os.path.join(output, fingerprint(case, overrides, options)): overrides
        for overrides in combinations(grid)}
    missing = missing_runs(chosen, again)
    begin = time.monotonic()

    def say(text):
        if progress:
            print(text, file=progress, flush=True)

    say(f"{len(chosen)} runs, {len(chosen) - len(missing)} of them there")
    with ThreadPoolExecutor(processes) as pool:
        runs = {pool.submit(make, case, chosen[folder], folder, ranks, quoin,
                            options): folder for folder in missing}
        try:
            for done, future in enumerate(as_completed(runs), 1):
                record = future.result()
                left = (len(runs) - done) * (time.monotonic() - begin) / done
                changed = ", ".join(entry(*item) for item
                                    in record["parameters"].items())
                say(f"{done}/{len(runs)} {record['status']} in "
                    f"{record['seconds']:.1f} s, {left:.0f} s to go: {changed}"
                    + (f"\n    {record['message']}" if record["message"]
                       else ""))
        except BaseException:
            pool.shutdown(cancel_futures=True)
            raise
    return table_of(chosen, output, collect)


def table_of(chosen, output, collect):
    """The table of a study whose runs have all ended."""
    rows = []
    for folder, overrides in chosen.items():
        record = record_of(folder)
        row = dict(overrides)
        row.update({key: record[key] for key in ("status", "message",
                                                 "seconds")}, folder=folder)
        if collect and record["status"] == "finished":
            row.update(collect(read(folder)))
        rows.append(row)
    names = list(dict.fromkeys(name for row in rows for name in row))
    columns = {name: [row.get(name, float("nan")) for row in rows]
               for name in names}
    write_csv(os.path.join(output, "study.csv"), columns)
    return frame(columns)


def write_csv(path, columns):
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow(columns)
        writer.writerows(zip(*columns.values()))
