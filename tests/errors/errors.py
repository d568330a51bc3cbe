#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""What quoin says and does when something is wrong.

errors.json lists wrong inputs: exit status 1, a message with the words under
"says", and nothing written; with "status": 2 they fail in the second stage, and
what the first one wrote is kept; with "warns" they are right, but --check warns
of one thing, with these words. The functions below are failures of other kinds.
"""
import argparse
import collections
import concurrent.futures
import glob
import json
import math
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import time

HERE = os.path.dirname(os.path.abspath(__file__))
ENVIRONMENT = dict(os.environ, OMPI_ALLOW_RUN_AS_ROOT="1",
                   OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1",
                   OMPI_MCA_rmaps_base_oversubscribe="1",
                   OMPI_MCA_mpi_yield_when_idle="1")


class Failure(Exception):
    pass


class Skip(Exception):
    pass


class ManyRuns:
    """quoin, run by the program many_runs: one of them for each thread. The program
    quoin_gmsh beside it asks gmsh once for each mesh, see gmsh_once.cc."""

    def __init__(self, program, quoin):
        self.program, self.quoin = os.path.abspath(program), quoin
        self.of_thread = threading.local()
        self.answers = tempfile.TemporaryDirectory(prefix="quoin_")
        self.environment = dict(ENVIRONMENT,
                                QUOIN_GMSH_ANSWERS=self.answers.name)

    def run(self, words):
        """Exit status and everything printed; it ends what takes 120 s."""
        own = self.of_thread
        if not hasattr(own, "process"):
            own.process = subprocess.Popen(
                [self.program], env=self.environment, stdin=subprocess.PIPE,
                stdout=subprocess.PIPE)
        with tempfile.NamedTemporaryFile(prefix="quoin_") as printed:
            own.process.stdin.write(b"".join(
                os.fsencode(word) + b"\0" for word in [printed.name, *words, ""]))
            own.process.stdin.flush()
            status = int(own.process.stdout.readline())
            if status == -signal.SIGALRM:
                raise subprocess.TimeoutExpired(words, 120)
            return status, printed.read().decode()


many_runs = None


def run(words, **more):
    """Exit status and everything printed."""
    if many_runs and words[0] == many_runs.quoin and not more:
        return many_runs.run(words)
    done = subprocess.run(words, env=ENVIRONMENT, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, text=True, timeout=120,
                          **more)
    return done.returncode, done.stdout


def prepare(folder, edit=None):
    """Copies the base cases; returns the parameter file of blocks."""
    for name in ("base.geo", "crack.geo", "boundary.prm", "hybrid.prm",
                 "space.geo", "space.prm", "gap.geo", "open_end.geo",
                 "blocks.obj", "open.obj", "overlap.geo", "apart.geo",
                 "unmatched.geo", "quake.AT2"):
        shutil.copy(os.path.join(HERE, name), folder)
    with open(os.path.join(HERE, "base.prm")) as stream:
        text = stream.read()
    if edit:
        if edit[0] not in text:
            raise Failure("the base case has no '%s' to replace" % edit[0])
        text = text.replace(edit[0], edit[1], 1)
    path = os.path.join(folder, "case.prm")
    with open(path, "w") as stream:
        stream.write(text)
    return path


def expect(status, printed, wanted_status, words):
    if status != wanted_status:
        raise Failure("exit status %d, not %d; it printed:\n%s"
                      % (status, wanted_status, printed.strip()[-1500:]))
    missing = [word for word in words
               if word.lower() not in printed.lower()]
    if missing:
        raise Failure("the message lacks %s; it is:\n%s"
                      % (", ".join("'%s'" % word for word in missing),
                         printed.strip()[-1500:]))
    for alien in ("terminate called", "Aborted", "Segmentation",
                  "Additional information", "An error occurred in line",
                  "Signal:", "Message:  <"):
        if alien in printed:
            raise Failure("the message is a crash report:\n%s"
                          % printed.strip()[-1500:])


def settings(case):
    words = []
    for value in case.get("set", []):
        words += ["--set", value]
    return words


def wrong_input(quoin, case, folder):
    prm = prepare(folder, case.get("edit"))
    if "prm" in case:
        prm = os.path.join(folder, case["prm"])
    before = set(os.listdir(folder))
    output = os.path.join(folder, "output")
    status, printed = run([quoin, prm, "--output", output] + settings(case))
    expect(status, printed, 1, case["says"])
    if os.path.exists(os.path.join(output, "histories.csv")):
        raise Failure("histories.csv was written all the same")
    stray = set(os.listdir(folder)) - before - {"output"}
    if stray:
        raise Failure("it left behind %s" % ", ".join(sorted(stray)))
    return printed


def failed_run(quoin, case, folder):
    """A run that fails in its second stage: the tables are whole, and from the
    checkpoint it fails in the same way."""
    prm = prepare(folder, case.get("edit"))
    if "prm" in case:
        prm = os.path.join(folder, case["prm"])
    output = os.path.join(folder, "output")
    words = [quoin, prm, "--quiet", "--output", output] + settings(case)
    status, printed = run(words)
    expect(status, printed, 2, case["says"])
    for name in ("histories.csv", "energies.csv"):
        with open(os.path.join(output, name)) as stream:
            lines = stream.read().splitlines()
        columns = len(lines[0].split(","))
        for line in lines[1:]:
            values = [float(value) for value in line.split(",")]
            if len(values) != columns or not all(map(math.isfinite, values)):
                raise Failure("%s has the row '%s'" % (name, line))
        if len(lines) < 2:
            raise Failure("%s is empty" % name)
    with open(os.path.join(output, "summary.json")) as stream:
        if json.load(stream)["finished"]:
            raise Failure("summary.json says that the run has finished")
    status, again = run(words + ["--resume"])
    expect(status, again, 2, case["says"])
    # a stage that is over warns once
    printed = "".join(line for line in printed.splitlines(keepends=True)
                      if not line.startswith("Warning: stage first:"))
    if again != printed:
        raise Failure("resumed, it says:\n%s\ninstead of:\n%s"
                      % (again.strip(), printed.strip()))
    return printed


def warned_of(quoin, case, folder):
    """--check warns of this and of nothing else; of nothing at all if the list
    is empty."""
    prm = prepare(folder, case.get("edit"))
    if "prm" in case:
        prm = os.path.join(folder, case["prm"])
    status, printed = run([quoin, prm, "--check"] + settings(case))
    expect(status, printed, 0, [])
    warnings = [line for line in printed.splitlines()
                if line.startswith("Warning: ")]
    wanted = 1 if case["warns"] else 0
    if len(warnings) != wanted:
        raise Failure("%d warnings, not %d:\n%s"
                      % (len(warnings), wanted, "\n".join(warnings)))
    expect(0, "".join(warnings), 0, case["warns"])
    return "".join(warnings)


# -- failures of another kind -------------------------------------------------

def base_case_runs(quoin, folder):
    """The base case itself is right, or the others would prove nothing."""
    prm = prepare(folder)
    status, printed = run([quoin, prm, "--quiet"])
    expect(status, printed, 0, [])
    output = os.path.join(folder, "output")
    if not os.path.exists(os.path.join(output, "histories.csv")):
        raise Failure("no output/histories.csv beside the parameter file")
    times = [[row[0] for row in rows] for rows in tables(output)[0].values()]
    if times[0] != times[1]:
        raise Failure("the tables have rows of other times")


def quiet_run(quoin, folder):
    """--quiet leaves warnings on the screen; the log has all."""
    prm = prepare(folder)
    status, printed = run([quoin, prm, "--quiet"])
    expect(status, printed, 0, ["Warning: stage first: local damping"])
    for line in printed.splitlines():
        if not line.startswith("Warning: "):
            raise Failure("it printed: %s" % line)
    with open(os.path.join(folder, "output", "log.txt")) as stream:
        log = stream.read()
    expect(0, log, 0, printed.splitlines() + ["finished: "])
    status, printed = run([quoin, prm, "--quiet", "--check"])
    if status != 0 or printed:
        raise Failure("exit status %d; it printed:\n%s" % (status, printed))


def boundary_begins_in_motion(quoin, folder):
    """A boundary that absorbs keeps the forces of waves that are under way when
    it begins, and says so; but not if it goes on, or the model has settled."""
    prm = prepare(folder)
    words = [quoin, prm, "--quiet"]
    for setting in ("Loads/Names=base, push, out",
                    "Loads/out/Type=viscous boundary",
                    "Loads/out/Boundary=right", "Stages/first/Damping=none",
                    "Stages/second/Loads=base, push, out"):
        words += ["--set", setting]
    warning = ["Warning: stage second: the model moves", "when the load out "
               "begins", "Let one load act in this stage and the one before"]
    status, printed = run(words)
    expect(status, printed, 0, warning)
    for settings in (["Stages/first/Loads=base, push, out"],
                     ["Stages/first/End=static ratio",
                      "Stages/first/Damping=local"]):
        more = [word for setting in settings for word in ("--set", setting)]
        status, printed = run(words + more)
        expect(status, printed, 0, [])
        if "the model moves" in printed:
            raise Failure("a warning without need:\n%s" % printed)


def boundary_case_runs(quoin, folder):
    """The base case of boundary elements likewise; it ends where it should,
    and a value that is no number ends it earlier."""
    prepare(folder)
    words = [quoin, os.path.join(folder, "boundary.prm"), "--quiet"]
    status, printed = run(words)
    expect(status, printed, 0, [])
    for name in ("histories.csv", "boundary.pvd", "field.pvd",
                 "summary.json"):
        if not os.path.exists(os.path.join(folder, "output", name)):
            raise Failure("no output/%s" % name)
    status, printed = run(words + [
        "--set", "Boundary elements/hole/Pressure=sqrt(0.5e-3 - t)"])
    expect(status, printed, 2, ["hole", "time", "finite"])


def check_writes_nothing(quoin, folder):
    """--check reads and builds everything and writes nothing."""
    prm = prepare(folder)
    before = set(os.listdir(folder))
    status, printed = run([quoin, prm, "--check"])
    expect(status, printed, 0, [
        "material stone: 2 blocks", "P waves 3098 m/s", "joints bed: 1 m",
        "load push: traction on 5 nodes of top", "vertical -1e+05 Pa",
        "stage second: about", "memory: ", "disk: 2 output times of fields"])
    if "Warning" in printed:
        raise Failure("--check warns of the base case:\n%s" % printed)
    stray = set(os.listdir(folder)) - before
    if stray:
        raise Failure("--check left behind %s" % ", ".join(sorted(stray)))


def error_in_an_included_file(quoin, folder):
    """The message names the file that is included, and the line there."""
    prm = prepare(folder)
    with open(os.path.join(folder, "inner.inc"), "w") as stream:
        stream.write("# a comment\nsubsection Joints\n  subsection bed\n"
                     "    set Cohesionn = 1e5\n  end\nend\n")
    with open(os.path.join(folder, "outer.inc"), "w") as stream:
        stream.write("set Title = x\ninclude inner.inc\n")
    with open(prm) as stream:
        text = stream.read()
    with open(prm, "w") as stream:
        stream.write("include outer.inc\n" + text)
    status, printed = run([quoin, prm, "--check"])
    expect(status, printed, 1, [
        "inner.inc, line 4, section 'Joints/bed'", "Cohesionn",
        "nearest known one is 'Cohesion'"])
    # a value out of range
    with open(os.path.join(folder, "range.inc"), "w") as stream:
        stream.write("subsection Joints\n  subsection bed\n"
                     "    set Friction angle = 95\n  end\nend\n")
    with open(prm, "w") as stream:
        stream.write(text + "include range.inc\n")
    status, printed = run([quoin, prm, "--check"])
    expect(status, printed, 1, ["range.inc, line 3, section 'Joints/bed'",
                                "Friction angle = 95"])
    # a value that only the mesh or another section shows to be wrong
    for text_of_file, words in [
            ("subsection Loads\n  subsection push\n"
             "    set Boundary = tops\n  end\nend\n",
             ["range.inc, line 3, section 'Loads/push'", "tops", "'top'"]),
            ("subsection Stages\n  subsection first\n"
             "    set Loads = pusch\n  end\nend\n",
             ["range.inc, line 3, section 'Stages/first'", "pusch", "'push'"])]:
        with open(os.path.join(folder, "range.inc"), "w") as stream:
            stream.write(text_of_file)
        status, printed = run([quoin, prm, "--check"])
        expect(status, printed, 1, words)
    with open(prm, "w") as stream:
        stream.write("include outer.inc\n" + text)
    # what comes after it is numbered as in its own file
    status, printed = run([quoin, prm, "--check", "--set", "Title=y"])
    with open(prm, "w") as stream:
        stream.write("set Title = y\n" + text + "set Titel = z\n")
    n = text.count("\n") + 2
    status, printed = run([quoin, prm, "--check"])
    expect(status, printed, 1, ["case.prm, line %d, outside of all sections" % n])
    with open(prm, "w") as stream:
        stream.write("include nothing.inc\n" + text)
    status, printed = run([quoin, prm, "--check"])
    expect(status, printed, 1, ["case.prm, line 1", "nothing.inc", "no file"])
    with open(os.path.join(folder, "open.inc"), "w") as stream:
        stream.write("subsection Joints\n")
    with open(prm, "w") as stream:
        stream.write("include open.inc\n" + text)
    status, printed = run([quoin, prm, "--check"])
    expect(status, printed, 1, ["open.inc", "'Joints' of line 1 open"])
    return printed


def schema(quoin, folder):
    """The schema has all entries of the reference, with type, unit, default
    and range."""
    status, printed = run([quoin, "--print-schema"])
    expect(status, printed, 0, [])
    schema = json.loads(printed)
    groups = {"": schema["entries"]}
    for section in schema["sections"]:
        groups[section["name"]] = section["entries"]
        groups[section["name"] + "/"] = section.get("each", [])
    entries = [entry for group in groups.values() for entry in group]
    reference = run([quoin, "--print-parameters"])[1]
    names = re.findall(r"^ *set (.*?) *=", reference, re.M)
    if sorted(names) != sorted(entry["name"] for entry in entries):
        raise Failure("the schema has other entries than the reference")
    for entry in entries:
        if not {"name", "type", "default", "description"} <= set(entry):
            raise Failure("incomplete: %s" % entry)
    for group, wanted in (
            ("", {"name": "Thickness", "type": "number", "above": 0.0,
                  "unit": "m", "default": "1"}),
            ("", {"name": "Solver", "type": "choice",
                  "choices": ["explicit", "implicit"]}),
            ("Output", {"name": "Checkpoint interval", "type": "number",
                        "minimum": 0.0, "unit": "s", "default": "60"}),
            ("Output", {"name": "Measure bandwidth", "type": "flag",
                        "default": "no"}),
            ("Time stepping", {"name": "Share of critical time step",
                               "minimum": 1e-6, "maximum": 1.0, "unit": "-"}),
            ("Loads", {"name": "Names", "type": "text", "default": ""}),
            ("Loads/", {"name": "Boundary", "type": "list", "default": ""}),
            ("Materials/", {"name": "Density", "type": "number",
                            "unit": "kg/m^3"}),
            ("Stages/", {"name": "Maximum steps", "type": "integer"})):
        if not any(wanted.items() <= entry.items() for entry in groups[group]):
            raise Failure("section '%s' has no entry %s" % (group, wanted))


def no_arguments(quoin, folder):
    """No parameter file at all: how to call it."""
    status, printed = run([quoin])
    if status == 0:
        raise Failure("exit status 0 without a parameter file")
    expect(status, printed, 1, [".prm"])


def unknown_option(quoin, folder):
    """An unknown option is named."""
    status, printed = run([quoin, prepare(folder), "--frobnicate"])
    expect(status, printed, 1, ["--frobnicate"])


def output_below_a_file(quoin, folder):
    """An output directory that cannot be made."""
    prm = prepare(folder)
    blocked = os.path.join(folder, "file")
    open(blocked, "w").close()
    output = os.path.join(blocked, "output")
    status, printed = run([quoin, prm, "--output", output])
    expect(status, printed, 1, [output])


def read_only_output_on_two_ranks(quoin, folder):
    """A file that cannot be written stops both ranks."""
    if not shutil.which("mpirun"):
        raise Skip("no mpirun")
    prm = prepare(folder)
    output = os.path.join(folder, "out")
    os.makedirs(os.path.join(output, "log.txt"))  # in the way of the log
    status, printed = run(["mpirun", "--oversubscribe", "-np", "2", quoin, prm,
                           "--quiet", "--output", output])
    expect(status, printed, 2, ["log.txt"])


def fill_disk(quoin, folder, ranks):
    """The end of a run with many columns on a disk that fills up."""
    if os.geteuid() != 0 or not shutil.which("unshare"):
        raise Skip("needs root and unshare")
    if ranks > 1 and not shutil.which("mpirun"):
        raise Skip("no mpirun")
    tiny = os.path.join(folder, "tiny")
    os.mkdir(tiny)
    mount = "mount -t tmpfs -o size=256k tmpfs '%s'" % tiny
    if run(["unshare", "-m", "sh", "-c", mount])[0] != 0:
        raise Skip("no mount namespace here")
    prm = prepare(folder)
    script = "%s && exec %s '%s' '%s' --output '%s/output' " \
        "--set Stages/first/Duration=2 --set Histories/Interval=0 " \
        "--set 'Histories/Names=%s'" % (
            mount, "mpirun --oversubscribe -np %d" % ranks if ranks > 1 else "",
            quoin, prm, tiny, ", ".join(["u"] + ["u%d" % i for i in range(99)]))
    status, printed = run(["unshare", "-m", "sh", "-c", script])
    expect(status, printed, 2, [tiny + "/output", "space"])
    return printed


def full_disk(quoin, folder):
    """A disk that fills up: the file is named, the run ends with 2."""
    return fill_disk(quoin, folder, 1)


def fail_and_resume(quoin, folder, end):
    prm = prepare(folder)
    output = os.path.join(folder, "output")
    words = [quoin, prm, "--output", output, "--set",
             "Loads/push/Vertical=if(T > 1.5e-3, sqrt(1.5e-3 - T), -1e5)",
             "--set", "Stages/second/Duration=%g" % end]
    status, printed = run(words)
    expect(status, printed, 2, ["time"])
    if "block" not in printed.lower() and "push" not in printed.lower():
        raise Failure("neither the block nor the load is named:\n%s"
                      % printed[-1500:])
    if not os.path.exists(os.path.join(output, "histories.csv")):
        raise Failure("the histories are gone")
    # what was kept is the end of the first stage: it fails in the same way
    status, again = run(words + ["--resume"])
    expect(status, again, 2, ["time"])


def no_number(quoin, folder):
    """A load that is no number: block or load, time, intact checkpoint."""
    fail_and_resume(quoin, folder, 0.1)


def no_number_at_the_end(quoin, folder):
    """Fails a few steps before the end of a stage, and resumes."""
    fail_and_resume(quoin, folder, 1e-3)


def runaway(quoin, folder):
    """A block that accelerates without bound ends the run with its name."""
    prm = prepare(folder)
    status, printed = run([
        quoin, prm, "--output", os.path.join(folder, "output"),
        "--set", "Loads/push/Vertical=-1e5*exp(1e6*t)"])
    expect(status, printed, 2, ["block", "time"])


def other_ranks(quoin, folder):
    """A checkpoint of one rank is resumed with two, which are told."""
    if not shutil.which("mpirun"):
        raise Skip("no mpirun")
    prm = prepare(folder)
    output = os.path.join(folder, "output")
    status, printed = run([quoin, prm, "--output", output])
    expect(status, printed, 0, [])
    status, printed = run([
        "mpirun", "--oversubscribe", "-np", "2", quoin, prm, "--output",
        output, "--resume"])
    expect(status, printed, 0, ["written on 1 rank", "to rounding",
                                "nothing is left"])


def failure_of_one_rank(quoin, folder):
    """Checks that an error found by one rank alone ends the other one, too."""
    if not shutil.which("mpirun"):
        raise Skip("no mpirun")
    prm = prepare(folder)
    rank = ["-np", "1", quoin]
    status, printed = run(["mpirun", "--oversubscribe"] + rank
                          + [prm, "--quiet", ":"] + rank
                          + [os.path.join(folder, "nowhere.prm"), "--quiet"])
    expect(status, printed, 1, ["nowhere.prm", "cannot be read"])
    return printed


def more_ranks_than_rigid_blocks(quoin, folder):
    """Rigid blocks stay whole: one of three processes has none, and the user is
    told."""
    if not shutil.which("mpirun"):
        raise Skip("no mpirun")
    status, printed = run(["mpirun", "--oversubscribe", "-np", "3", quoin,
                           prepare(folder),
                           "--set", "Materials/stone/Law=rigid",
                           "--set", "Loads/base/Type=traction",
                           "--set", "Histories/u/Point=0.5, 0.75"])
    expect(status, printed, 0, ["2 blocks", "3 MPI processes",
                                "Fewer processes", "finished"])
    return printed


def other_parameters(quoin, folder):
    """A checkpoint of other parameters."""
    prm = prepare(folder)
    output = os.path.join(folder, "output")
    status, printed = run([quoin, prm, "--output", output])
    expect(status, printed, 0, [])
    status, printed = run([quoin, prm, "--output", output, "--resume",
                           "--set", "Joints/bed/Friction angle=20"])
    expect(status, printed, 1, [
        "'Joints/bed/Friction angle' was '30' and is '20'",
        "without --resume"])
    return printed


def nothing_to_resume(quoin, folder):
    """--resume without a checkpoint; it leaves no folder behind."""
    prm = prepare(folder)
    output = os.path.join(folder, "output")
    status, printed = run([quoin, prm, "--resume", "--output", output])
    expect(status, printed, 1, ["checkpoint", "--resume"])
    if os.path.exists(output):
        raise Failure("it leaves the folder of the output behind")


LEAVING = ["Contact/Displacements=large", "Joints/bed/Curves=bed",
           "Joints/bed/New contacts between=all", "Contact/Box=-1, -1, 2, 1.5",
           "Loads/push/Vertical=-1e5 + if(T > 1e-3, 1e10 * (T - 1e-3), 0)",
           "Stages/second/Duration=2e-2", "Histories/Interval=1e-4",
           "Histories/Names=u, drift, outside",
           "Histories/drift/Quantity=relative displacement y",
           "Histories/drift/Point=0.5, 0", "Histories/drift/Second point=0.5, 1",
           "Histories/outside/Quantity=blocks outside"]


def leaving(outside):
    return settings({"set": LEAVING + ["Contact/Outside the box=" + outside]})


def tables(output):
    """Contents of histories.csv, energies.csv and the summary."""
    rows = {}
    for name in ("histories.csv", "energies.csv"):
        with open(os.path.join(output, name)) as stream:
            rows[name] = [[float(value) for value in line.split(",")]
                          for line in stream.read().splitlines()[1:]]
    with open(os.path.join(output, "summary.json")) as stream:
        return rows, json.load(stream)


def reported_block(quoin, folder):
    """A block that leaves the box is named once, and the run goes on."""
    output = os.path.join(folder, "output")
    status, printed = run([quoin, prepare(folder), "--output", output]
                          + leaving("report"))
    expect(status, printed, 0, ["Warning: block 1, at (", "left the box",
                                "time"])
    if printed.count("left the box") != 1:
        raise Failure("it is not said once:\n%s" % printed)
    if tables(output)[1]["blocks outside the box"] != 1:
        raise Failure("summary.json does not count it")
    return printed


def flight_until_deleted(output, histories):
    """The block of 0.5 m leaves the box with the velocity that the traction
    -1e5 + 1e10 (T - 1e-3), less the 80 % that local damping takes of it, gives
    to its 1250 kg, from where that pulls; from then on it is counted and its
    histories have no value."""
    with open(os.path.join(output, "blocks_outside.csv")) as stream:
        lines = stream.read().splitlines()
    if len(lines) != 2:
        raise Failure("blocks_outside.csv has not one row:\n%s"
                      % "\n".join(lines))
    row = dict(zip([name.split(" [")[0] for name in lines[0].split(",")],
                   map(float, lines[1].split(","))))
    pulled = row["time"] - 1.01e-3
    growth = 0.2 * 1e10 / 1250
    wanted = {"block": 1, "deleted": 1, "x": 0.5,
              "y": 0.75 + growth * pulled**3 / 6,
              "velocity y": growth * pulled**2 / 2}
    for name, value in wanted.items():
        if not abs(row[name] - value) <= 0.02 * value:
            raise Failure("%s is %g, not %g" % (name, row[name], value))
    for time, u, drift, outside in histories:
        if math.isnan(u) != (time > row["time"]) or \
                math.isnan(drift) != math.isnan(u) or \
                outside != (1 if time > row["time"] else 0):
            raise Failure("at %g s: u %g, drift %g, %g blocks outside"
                          % (time, u, drift, outside))


def deleted_block(quoin, folder):
    """A block that is deleted: the energy balance holds, also on two ranks."""
    prm = prepare(folder)
    outputs = {name: os.path.join(folder, name)
               for name in ("one", "two")}
    words = [quoin, prm] + leaving("delete")
    status, printed = run(words + ["--output", outputs["one"]])
    expect(status, printed, 0, ["Warning: block 1, at (", "left the box",
                                "is deleted: histories in it are 'nan'",
                                "from now on: u, drift"])
    rows, summary = tables(outputs["one"])
    flight_until_deleted(outputs["one"], rows["histories.csv"])
    if summary["blocks deleted"] != 1:
        raise Failure("summary.json does not count it")
    share = summary["largest energy residual [J]"] \
        / max(abs(row[1]) for row in rows["energies.csv"])
    if not share < 1e-6:
        raise Failure("the energy residual is %g of the kinetic" % share)

    if shutil.which("mpirun"):
        status, printed = run(["mpirun", "--oversubscribe", "-np", "2"] + words
                              + ["--output", outputs["two"]])
        expect(status, printed, 0, ["is deleted"])
        two = tables(outputs["two"])[0]
        for name, table in rows.items():
            for row, other in zip(table, two[name]):
                for column, (a, b) in enumerate(zip(row, other)):
                    if math.isnan(a) and math.isnan(b):
                        continue
                    scale = max(abs(r[column]) for r in table
                                if not math.isnan(r[column]))
                    if name == "energies.csv":
                        scale = max(abs(r[1]) for r in table)
                    if not abs(a - b) <= 1e-9 * scale:
                        raise Failure("%s on two ranks: %r instead of %r"
                                      % (name, b, a))
    return printed


SAFETY = ["Stages/second/End=factor of safety", "Stages/second/Damping=local",
          "Stages/second/Lowest factor=3", "Stages/second/First factor=3",
          "Stages/Names=first, second, third", "Stages/third/Loads=base, push",
          "Stages/third/Duration=1e-3", "Stages/third/Damping=local"]


def failing_block_leaves(quoin, folder):
    """A block that leaves the box as a factor is tried: the factor fails, the
    mechanism is that of what is left, and no block is lost after it."""
    sys.path.insert(0, os.path.join(HERE, "..", "..", "python"))
    from quoin.vtu import read_at
    # the lower block hangs from the upper one, by a soft joint
    hangs = ["Contact/Displacements=large", "Contact/Box=-1, 0.4, 2, 2",
             "Joints/bed/Curves=bed", "Joints/bed/New contacts between=all",
             "Joints/bed/Normal stiffness=1e8", "Joints/bed/Shear stiffness=1e8",
             "Joints/bed/Tensile strength=1e5", "Joints/bed/Cohesion=1e6",
             "Loads/base/Boundary=top", "Loads/push/Boundary=bottom",
             "Loads/push/Vertical=-5e4", "Stages/first/End=static ratio",
             "Stages/first/Static ratio=1e-3",
             "Stages/second/Failure displacement=10"]
    prm = prepare(folder)
    for outside, says in (("stop", "has left"), ("delete", "is failing")):
        output = os.path.join(folder, outside)
        status, printed = run(
            [quoin, prm, "--output", output]
            + settings({"set": hangs + SAFETY
                        + ["Contact/Outside the box=" + outside]}))
        expect(status, printed, 0, ["factor 3", says, "even the lowest"])
        if "Warning: block" in printed:
            raise Failure("a block is lost after the trial:\n%s" % printed)
    grid = read_at(os.path.join(output, "mechanism", "blocks.pvd"))
    moved = abs(grid.point_data["displacement"]).max()
    if not moved < 1e-5:
        raise Failure("what is left has moved by %g m" % moved)
    return printed


def safety_changes_nothing(quoin, folder):
    """A stage after a factor of safety is what it is before it."""
    prm = prepare(folder)
    rows = []
    for names in ("first, second, third", "first, third, second"):
        output = os.path.join(folder, names[-5:].strip())
        status, printed = run(
            [quoin, prm, "--output", output] + settings({"set": SAFETY + [
                "Stages/Names=" + names,
                "Materials/stone/Law=Mohr-Coulomb", "Materials/stone/Cohesion=1e4",
                # one whose arc tangent of the tangent is another number
                "Materials/stone/Friction angle=26.58",
                "Materials/stone/Dilation angle=26.58",
                "Loads/push/Vertical=-1e5*min(1, T/1e-3)"]}))
        expect(status, printed, 0, [])
        rows.append(tables(output)[0]["histories.csv"])
    if rows[0] != rows[1]:
        raise Failure("after it the stage ends with\n%s\ninstead of\n%s"
                      % (rows[0][-1], rows[1][-1]))


def failure_displacement_of_what_is_there(quoin, folder):
    """Blocks that are not there have no part in the displacement at which trials
    fail, whatever they weigh."""
    prm = prepare(folder)
    limits = []
    for density in ("2500", "25000"):
        status, printed = run(
            [quoin, prm] + settings({"set": SAFETY + [
                "Materials/Names=stone, lid", "Materials/stone/Groups=rock",
                "Materials/lid/Groups=lid", "Materials/lid/Density=" + density,
                "Materials/lid/Young's modulus=20e9",
                "Loads/Names=base, push, weight", "Loads/push/Boundary=left",
                "Loads/weight/Type=gravity", "Loads/weight/Vertical=-9.81",
                "Stages/first/Loads=base, weight",
                "Stages/first/End=static ratio",
                "Stages/second/Loads=base, weight",
                "Stages/second/Highest factor=3",
                "Stages/third/Loads=base, weight, push",
                "Stages/third/Fill=lid", "Histories/u/Point=0.5, 0.4"]}))
        expect(status, printed, 0, ["stage second: trials may fail beyond "])
        limits.append(re.search(r"may fail beyond (\S+) m", printed)[1])
    if limits[0] != limits[1]:
        raise Failure("%s m with a light block that is placed later, %s m with a "
                      "heavy one" % tuple(limits))


def failure_displacement_of_growing_loads(quoin, folder):
    """Weight of which half is there where the search begins counts in whole."""
    prm = prepare(folder)
    limits = []
    for duration in ("0.01", "0.02"):
        status, printed = run(
            [quoin, prm] + settings({"set": SAFETY + [
                "Stages/second/Highest factor=3", "Stages/third/Loads=base, weight",
                "Loads/Names=base, weight", "Loads/weight/Type=gravity",
                "Loads/weight/Vertical=-9.81", "Loads/weight/Ramp duration=0.02",
                "Stages/first/Loads=base, weight",
                "Stages/second/Loads=base, weight",
                "Stages/first/Duration=" + duration]}))
        expect(status, printed, 0, ["stage second: trials may fail beyond "])
        limits.append(float(
            re.search(r"may fail beyond (\S+) m", printed)[1]))
    if not abs(limits[0] / limits[1] - 1) < 0.05:
        raise Failure("%g m where half of the weight is there, %g m where all of "
                      "it is" % tuple(limits))


def unloaded_model_comes_to_rest(quoin, folder):
    """A stage without loads ends, by the forces that it began with: after 3
    times the steps of loading, or 14 and 24 times by those that are left."""
    prm = prepare(folder)
    for damping in ("local", "adaptive"):
        status, printed = run([quoin, prm] + settings({"set": [
            "Stages/first/End=static ratio", "Stages/second/End=static ratio",
            "Stages/second/Loads=base", "Stages/second/Damping=" + damping]}))
        expect(status, printed, 0, [])
        first, second = (int(n) for n in re.findall(
            r"^(?:first|second): ended .* after (\d+) steps", printed, re.M))
        if not second < 5 * first:
            raise Failure("%d steps without loads, %d to load it, %s damping"
                          % (second, first, damping))
    return printed


def search_leaves_adaptive_damping(quoin, folder):
    """A block that creeps under adaptive damping is tried with local damping
    after four times the steps of the trial that came to rest."""
    prm = os.path.join(HERE, "..", "..", "parameter_files", "verification",
                       "space_incline", "safety.prm")
    status, printed = run(
        [quoin, prm, "--output", os.path.join(folder, "output")]
        + settings({"set": [
            "Stages/safety/Damping=adaptive", "Stages/safety/First factor=1.19",
            "Stages/safety/Highest factor=1.2",
            "Stages/safety/Factor tolerance=0.02",
            "Stages/safety/Failure displacement=2e-3"]}))
    expect(status, printed, 0, [
        "factor 1.19 is stable", "factor 1.2 is undecided under adaptive damping",
        "factor 1.2 is failing", "2 trials"])
    steps = [int(n) for n in re.findall(
        r"^safety, factor \S+: ended .* after (\d+) steps", printed, re.M)]
    # it looks every hundred steps
    if not 4 * steps[0] <= steps[1] < 4 * steps[0] + 100:
        raise Failure("the attempts take %s steps" % steps)
    return printed


def last_allowed_step(quoin, folder):
    """A stage that comes to its end in its last allowed step has not failed."""
    prm = prepare(folder)
    words = [quoin, prm, "--set", "Stages/first/Kinetic energy limit=1"]
    status, printed = run(words)
    expect(status, printed, 0, [])
    steps = int(re.search(r"first: ended .* after (\d+) steps", printed)[1])
    for allowed, wanted, says in ((steps, 0, []), (steps - 1, 2, ["'first'"])):
        status, printed = run(words + ["--set",
            "Stages/first/Maximum steps=%d" % allowed])
        expect(status, printed, wanted, says)


def implicit_checkpoints(quoin, folder):
    """Checkpoints are written within a stage of few steps, too."""
    latest = os.path.join(folder, "output", "checkpoint", "latest")
    process = subprocess.Popen(
        [quoin, prepare(folder)] + settings({"set": [
            "Solver=implicit", "Output/Checkpoint interval=1e-9",
            "Implicit/First step=1e-2", "Implicit/Largest step=1e-2"]}),
        env=ENVIRONMENT, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    while process.poll() is None and not os.path.exists(latest):
        time.sleep(0.005)
    with open(latest) as stream:
        step = int(re.search(r"^step (\d+)", stream.read(), re.M)[1])
    process.kill()
    process.wait()
    if not step < 100:
        raise Failure("the first checkpoint is that of step %d, where the "
                      "stage ends" % step)


def implicit_limit_load(quoin, folder):
    """A load above the limit load: the last equilibrium is kept, and from
    the checkpoint it gets no farther."""
    prm = prepare(folder)
    output = os.path.join(folder, "output")
    words = [quoin, prm, "--output", output] + settings({"set": [
        "Solver=implicit", "Implicit/Jumps=no",
        "Loads/push/Horizontal=if(T > 1e-3, 1e8*(T - 1e-3), 0)"]})
    says = ["stage 'second'", "no equilibrium", "load time 0.0005773 of",
            "steps were reduced", "in block", "at (", "limit load",
            "Path following", "last equilibrium is kept"]
    status, printed = run(words)
    expect(status, printed, 2, says)
    rows, summary = tables(output)
    # tan(30 degrees) of 1e5 Pa
    if not abs(rows["histories.csv"][-1][0] / 1.57735e-3 - 1) < 1e-4:
        raise Failure("the last row is that of %g s"
                      % rows["histories.csv"][-1][0])
    if summary["finished"]:
        raise Failure("summary.json says that the run has finished")
    status, again = run(words + ["--resume"])
    expect(status, again, 2, says)
    return printed


def elastic_model_without_equilibrium(quoin, folder):
    """No strength is named as the reason where nothing can fail."""
    status, printed = run([quoin, prepare(folder)] + settings({"set": [
        "Solver=implicit", "Joints/bed/Law=elastic",
        "Joints/bed/Normal stiffness=1e25"]}))
    expect(status, printed, 2, ["no equilibrium", "Neither joints nor blocks can fail",
                                "First step", "last equilibrium is kept"])
    for word in ("limit load", "strengths"):
        if word in printed:
            raise Failure("it speaks of '%s':\n%s" % (word, printed.strip()))
    return printed


def undecided_factor_of_the_implicit_solver(quoin, folder):
    """The log says why a trial has no equilibrium."""
    status, printed = run([quoin, prepare(folder)] + settings({"set": [
        "Solver=implicit", "Loads/push/Horizontal=3e4",
        "Implicit/First step=1", "Implicit/Largest step=1",
        "Implicit/Smallest step=0.9", "Stages/second/End=factor of safety",
        "Stages/second/First factor=3", "Stages/second/Highest factor=3",
        "Stages/second/Factor tolerance=1"]}))
    expect(status, printed, 0, [
        "factor 3: no equilibrium was found", "steps were reduced to",
        "those of the last one", "factor 3 is undecided",
        "are undecided", "The log says why", "Solver = explicit"])
    if "Maximum steps" in printed:
        raise Failure("it advises steps of the explicit solver")
    return printed


def starting(words, folder):
    """A run under way, once it has written to its log; it prints to 'screen'."""
    log = os.path.join(folder, "output", "log.txt")

    def written():
        return os.stat(log).st_mtime_ns if os.path.exists(log) else 0

    before = written()
    with open(os.path.join(folder, "screen"), "w") as screen:
        process = subprocess.Popen(words, env=ENVIRONMENT, stdout=screen,
                                   stderr=subprocess.STDOUT)
    deadline = time.monotonic() + 60
    while written() == before and process.poll() is None \
            and time.monotonic() < deadline:
        time.sleep(0.01)
    if process.poll() is not None or written() == before:
        process.kill()
        with open(os.path.join(folder, "screen")) as stream:
            raise Failure("a run does not begin:\n" + stream.read())
    return process


def interrupted_before_the_steps(quoin, folder):
    """Ctrl-C while the mesh is made: one line, and the run ends."""
    prm = prepare(folder)
    with open(os.path.join(folder, "base.geo"), "a") as stream:
        stream.write("\nMesh.CharacteristicLengthMax = 5e-4;\n")
    process = subprocess.Popen([quoin, prm], env=ENVIRONMENT, text=True,
                               stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    children = "/proc/%d/task/%d/children" % (process.pid, process.pid)
    deadline = time.monotonic() + 60
    while process.poll() is None and time.monotonic() < deadline:
        with open(children) as stream:
            if stream.read():
                break
        time.sleep(0.01)
    process.send_signal(signal.SIGINT)
    _, printed = process.communicate(timeout=60)
    if process.returncode != -signal.SIGINT:
        raise Failure("exit status %d; it printed:\n%s"
                      % (process.returncode, printed))
    if printed != "interrupted by SIGINT before the first step: nothing was " \
                  "computed\n":
        raise Failure("it printed:\n%s" % printed)
    if os.path.exists(os.path.join(folder, "output")):
        raise Failure("it left an output folder")
    return printed


LONG = ["--set", "Stages/first/Duration=1e3", "--set", "Histories/Interval=1",
        "--set", "Output/Checkpoint interval=0.05"]


def two_runs_at_once(quoin, folder):
    """The second run in one folder is refused, and the first goes on; killed,
    it leaves nothing in the way of being resumed."""
    prm = prepare(folder)
    words = [quoin, prm, "--output", os.path.join(folder, "output")] + LONG
    first = starting(words, folder)
    try:
        status, printed = run(words)
        expect(status, printed, 1, ["another run", "output", "--output"])
        status, printed = run(words + ["--resume"])
        expect(status, printed, 1, ["another run"])
        if first.poll() is not None:
            raise Failure("the first run has ended")
        latest = os.path.join(folder, "output", "checkpoint", "latest")
        deadline = time.monotonic() + 60
        while not os.path.exists(latest) and time.monotonic() < deadline:
            time.sleep(0.01)
    finally:
        first.kill()
        first.wait()
    again = starting(words + ["--resume"], folder)
    again.kill()
    again.wait()
    return printed


def odd_names(quoin, folder):
    """Names that are hard to read, from another working directory; links."""
    odd = os.path.join(folder, "-a b'c\"d \u00fc\u4e2d%s;$HOME&(x)")
    os.mkdir(odd)
    prm = prepare(odd)
    long = "n" * 200
    os.rename(os.path.join(odd, "base.geo"),
              os.path.join(odd, "-m \u00e4'\".geo"))
    for name in ("-c a\u00df.prm", long + ".prm"):
        shutil.copy(prm, os.path.join(odd, name))
    output = os.path.join(folder, "-out \u00fc '\"")
    words = ["--quiet", "--set", "Mesh/File=-m \u00e4'\".geo"]
    status, printed = run([os.path.abspath(quoin), "./-c a\u00df.prm",
                           "--output", "./" + long] + words, cwd=odd)
    expect(status, printed, 0, [])
    status, printed = run([quoin, os.path.join(odd, long + ".prm"),
                           "--output", output] + words)
    expect(status, printed, 0, [])
    if not os.path.exists(os.path.join(output, "histories.csv")):
        raise Failure("no histories.csv in '%s'" % output)
    # without --output, beside the file that a link leads to or the link
    link = os.path.join(folder, "link")
    os.symlink(odd, link)
    program = os.path.join(folder, "program")
    os.symlink(quoin, program)
    status, printed = run([program, os.path.join(link, "-c a\u00df.prm"),
                           "--set", "Output directory=."] + words)
    expect(status, printed, 0, [])
    if not os.path.exists(os.path.join(odd, "histories.csv")):
        raise Failure("no histories.csv in the folder of the parameter file")
    # what belongs to the user there is kept
    mine = os.path.join(odd, "checkpoint", "notes")
    os.mkdir(mine)
    status, printed = run([quoin, os.path.join(odd, "-c a\u00df.prm"),
                           "--set", "Output directory=."] + words)
    expect(status, printed, 0, [])
    if not os.path.isdir(mine):
        raise Failure("a folder that is none of the program's was removed")


def file_of_another_system(quoin, folder):
    """A byte order mark and carriage returns change nothing."""
    prm = prepare(folder)
    with open(prm) as stream:
        text = stream.read()
    with open(prm, "w", encoding="utf-8-sig", newline="\r\n") as stream:
        stream.write(text)
    status, printed = run([quoin, prm, "--check"])
    expect(status, printed, 0, ["2 blocks"])


def far_from_the_origin(quoin, folder):
    """Coordinates that leave few digits; nothing is said of those on maps."""
    prm = prepare(folder)
    geometry = os.path.join(folder, "base.geo")
    with open(geometry) as stream:
        text = stream.read()
    for far, words in ((4e6, []), (1e9, ["Warning: coordinates", "digits"])):
        shift = "Translate{%.0f, 0, 0}{Surface{1}; Surface{2};}\n" % far
        with open(geometry, "w") as stream:
            stream.write(text.replace("Physical Curve(\"bottom\")",
                                      shift + "Physical Curve(\"bottom\")"))
        status, printed = run([quoin, prm, "--check", "--set",
                               "Histories/u/Point=%.1f, 1" % (far + 0.5)])
        expect(status, printed, 0, words)
        if not words and "digits" in printed:
            raise Failure("a warning without need:\n" + printed)


def blocks_that_overlap(quoin, folder):
    """A surface within another one, which was not cut out of it."""
    prm = prepare(folder)
    with open(os.path.join(folder, "base.geo"), "a") as stream:
        stream.write("\nRectangle(9) = {0.3, 0.1, 0, 0.3, 0.3};\n"
                     "Physical Surface(\"lining\") = {9};\n")
    with open(os.path.join(folder, "base.geo")) as stream:
        text = stream.read()
    with open(os.path.join(folder, "base.geo"), "w") as stream:
        stream.write("SetFactory(\"OpenCASCADE\");\n" + text)
    status, printed = run([quoin, prm, "--check", "--set",
                           "Materials/stone/Groups=rock, lid, lining"])
    expect(status, printed, 0, ["Warning: a block lies within another near"])
    return printed


def slivers_of_tetrahedra(quoin, folder):
    """The log has the smallest angle between faces of all tetrahedra with its
    place, and a warning the place of the lowest one, of two slivers: four points on two
    edges of 2 m that cross at right angles, one 2 d above the other."""
    places = [(0.0, 0.0, 0.0), (10.0, 20.0, 30.0)]

    def write(path, halves):
        nodes, cells, ground = [], [], []
        for (x, y, z), d in zip(places, halves):
            first = len(nodes) + 1
            nodes += [(x + u, y + v, z + w) for u, v, w in
                      [(-1, 0, -d), (1, 0, -d), (0, -1, d), (0, 1, d),
                       (0, 0, -1.5), (0, 0, 1.5)]]
            a, b, c, e, low, high = range(first, first + 6)
            # the sliver between two tetrahedra above and two below
            cells += [(a, b, c, e), (a, c, e, high), (b, c, e, high),
                      (a, b, c, low), (a, b, e, low)]
            ground += [(a, c, low), (b, c, low), (a, e, low), (b, e, low)]
        elements = ([(2, 2, 1, 1, *face) for face in ground]
                    + [(4, 2, 2, 1, *cell) for cell in cells])
        with open(path, "w") as stream:
            stream.write(
                "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n"
                '2 1 "ground"\n3 2 "rock"\n$EndPhysicalNames\n')
            for name, rows in (("Nodes", nodes), ("Elements", elements)):
                stream.write("$%s\n%d\n" % (name, len(rows)))
                stream.writelines("%d %s\n" % (number, " ".join(map(repr, row)))
                                  for number, row in enumerate(rows, 1))
                stream.write("$End%s\n" % name)

    prm = os.path.join(folder, "slivers.prm")
    with open(prm, "w") as stream:
        stream.write("""subsection Mesh
  set File = slivers.msh
end
subsection Materials
  set Names = rock
  subsection rock
    set Density         = 2500
    set Young's modulus = 1e9
    set Poisson's ratio = 0.2
  end
end
subsection Loads
  set Names = ground, weight
  subsection ground
    set Type       = prescribed motion
    set Boundary   = ground
    set Horizontal = 0
    set Lateral    = 0
    set Vertical   = 0
  end
  subsection weight
    set Type          = gravity
    set Vertical      = -9.81
    set Ramp duration = 1e-3
  end
end
subsection Stages
  set Names = settle
  subsection settle
    set Loads   = ground, weight
    set End     = static ratio
    set Damping = local
  end
end
""")
    printed = ""
    for halves, lowest in (((0.3, 0.2), None), ((0.02, 1e-4), 1),
                           ((2e-4, 0.02), 0), ((3e-4, 2e-4), 1)):
        write(os.path.join(folder, "slivers.msh"), halves)
        status, printed = run([quoin, prm, "--check"])
        expect(status, printed, 0, ["2 blocks, 10 tetrahedra, 12 nodes"])
        d = min(halves)
        # along the four edges of sqrt(2 + 4 d^2); along the two of 2 m it is flat
        angle = math.degrees(math.acos(1 / (1 + 4 * d * d)))
        place = "(%g, %g, %g)" % places[halves.index(d)]
        found = re.search(
            r"smallest angle (\S+) degrees between faces at (\(.*\)) m", printed)
        if (not found or abs(float(found.group(1)) / angle - 1) > 1e-5
                or found.group(2) != place):
            raise Failure("the smallest angle is not %g degrees at %s m:\n%s"
                          % (angle, place, printed.strip()))
        warnings = [line for line in printed.splitlines()
                    if line.startswith("Warning: ")]
        if lowest is None:
            if warnings:
                raise Failure("a warning without need:\n%s" % printed)
            continue
        # three times the volume, 4 d/3 m3, by the area of a face
        height = 4 * d / math.sqrt(1 + 4 * d * d)
        expect(0, "\n".join(warnings), 0, [
            "the tetrahedron at (%g, %g, %g) m is only %.4g m high"
            % (*places[lowest], height), "Unite the points"])
        if len(warnings) != 1:
            raise Failure("%d warnings, not one:\n%s"
                          % (len(warnings), "\n".join(warnings)))
    return printed


def small_pieces_of_rock(quoin, folder):
    """Where few small pieces limit the step --check offers to leave them out,
    and the step is longer then."""
    prm = os.path.join(folder, "rock.prm")
    with open(prm, "w") as stream:
        stream.write("""
subsection Rock
  set Outline      = 0, 0; 10, 0; 10, 5; 0, 5
  set Element size = 0.5
end
subsection Rock joints
  set Names = bedding, cross
  subsection bedding
    set Dip     = Fisher 10, 10
    set Spacing = log-normal 1, .4
  end
  subsection cross
    set Dip     = Fisher 80, 10
    set Spacing = log-normal 1, .4
  end
end
subsection Materials
  set Names = rock
  subsection rock
    set Density         = 2600
    set Young's modulus = 10e9
    set Poisson's ratio = 0.25
  end
end
subsection Joints
  set Names = joints
  subsection joints
    set Curves           = bedding, cross
    set Law              = elastic
    set Normal stiffness = 1e9
    set Shear stiffness  = 1e9
  end
end
subsection Loads
  set Names = gravity
  subsection gravity
    set Type     = gravity
    set Vertical = -9.81
  end
end
subsection Stages
  set Names = fall
  subsection fall
    set Loads    = gravity
    set Duration = 1e-3
  end
end
""")
    offer = "'Shortest edge' of section 'Rock', "
    steps = []
    for shortest in (0.005, 0.25):
        status, printed = run([quoin, prm, "--check", "--set",
                               "Rock/Shortest edge=%g" % shortest])
        expect(status, printed, 0, ["without the stiffest 0.1 %"])
        if (offer in printed) != (shortest < 0.1):
            raise Failure("'Shortest edge' of %g m is %soffered:\n%s"
                          % (shortest, "" if offer in printed else "not ",
                             printed))
        steps.append(float(re.search("mass scaling, (.*?) s,", printed)[1]))
    if not steps[1] > 2. * steps[0]:
        raise Failure("the critical step grows from %g to %g s only"
                      % tuple(steps))
    return printed


def gmsh_comes_to_its_end(quoin, folder):
    """A command that ends gmsh; a file that crashes it; quoin without gmsh."""
    prm = prepare(folder)
    with open(os.path.join(folder, "base.geo"), "a") as stream:
        stream.write("\nExit;\n")
    words = ["base.geo", "gmsh", "Exit", "repair it"]
    status, printed = run([quoin, prm])
    expect(status, printed, 1, words)
    if shutil.which("mpirun"):
        status, printed = run(["mpirun", "--oversubscribe", "-np", "2", quoin,
                               prm])
        expect(status, printed, 1, words)
    # gmsh 4.8 overflows its stack on this; others may refuse it
    with open(os.path.join(folder, "base.geo"), "w") as stream:
        stream.write("a = " + "(" * 200000 + "1" + ")" * 200000 + ";\n")
    status, printed = run([quoin, prm])
    expect(status, printed, 1, ["base.geo", "gmsh"])
    alone = shutil.copy(quoin, folder)
    status, printed = run([alone, prepare(folder)])
    expect(status, printed, 1, ["'%s_gmsh'" % alone, "cannot be started",
                                "No such file"])
    return printed


def gmsh_ends_with_its_run(quoin, folder):
    """A run that is killed as it starts gmsh leaves none behind."""
    prm = prepare(folder)
    with open(os.path.join(folder, "base.geo"), "a") as stream:
        stream.write("\nMesh.MeshSizeMax = 3e-4;\n") # half a minute and more
    for _ in range(3):
        run_of_it = subprocess.Popen([quoin, prm], env=ENVIRONMENT,
                                     stdout=subprocess.DEVNULL,
                                     stderr=subprocess.DEVNULL)
        children = "/proc/%d/task/%d/children" % (run_of_it.pid, run_of_it.pid)
        found = []
        deadline = time.monotonic() + 30
        while not found and time.monotonic() < deadline:
            with open(children) as stream:
                found = [int(child) for child in stream.read().split()
                         if "quoin_gmsh" in words_of(int(child))]
        run_of_it.kill()
        run_of_it.wait()
        if not found:
            raise Failure("gmsh does not start")
        deadline = time.monotonic() + 10
        while words_of(found[0]):
            if time.monotonic() > deadline:
                os.kill(found[0], signal.SIGKILL)
                raise Failure("gmsh goes on without its run")
            time.sleep(0.02)


def words_of(process):
    """The command of a process; empty if it has ended."""
    try:
        with open("/proc/%d/cmdline" % process) as stream:
            return stream.read()
    except (FileNotFoundError, ProcessLookupError):
        return ""


def output_is_a_file(quoin, folder):
    """An output directory that is a file."""
    prm = prepare(folder)
    output = os.path.join(folder, "file")
    open(output, "w").close()
    status, printed = run([quoin, prm, "--output", output])
    expect(status, printed, 1, [output, "directory", "--output"])


def old_results(quoin, folder):
    """A run does not leave what an earlier one said of its end."""
    prm = prepare(folder)
    output = os.path.join(folder, "output")
    status, printed = run([quoin, prm, "--output", output])
    expect(status, printed, 0, [])
    for name in ("safety.csv", "far_field.csv", "boundary.pvd"):
        open(os.path.join(output, name), "w").close()
    first = starting([quoin, prm, "--output", output] + LONG, folder)
    first.kill()
    first.wait()
    left = {"summary.json", "safety.csv", "far_field.csv", "boundary.pvd"} \
        & set(os.listdir(output))
    if left:
        raise Failure("still there: %s" % ", ".join(sorted(left)))


def changed_inputs(quoin, folder):
    """A checkpoint of another mesh or another table is refused."""
    prm = prepare(folder)
    table = os.path.join(folder, "push.csv")
    with open(table, "w") as stream:
        stream.write("0, 0\n1, 1\n")
    output = os.path.join(folder, "output")
    words = [quoin, prm, "--output", output, "--set",
             "Loads/push/Vertical=table push.csv times -1e5"]
    status, printed = run(words)
    expect(status, printed, 0, [])
    status, printed = run(words + ["--resume"])
    expect(status, printed, 0, ["nothing is left to do"])
    with open(table, "w") as stream:
        stream.write("0, 0\n1, 2\n")
    status, printed = run(words + ["--resume"])
    expect(status, printed, 1, ["table", "without --resume"])
    with open(table, "w") as stream:
        stream.write("0, 0\n1, 1\n")
    geometry = os.path.join(folder, "base.geo")
    with open(geometry) as stream:
        text = stream.read()
    with open(geometry, "w") as stream:
        stream.write(text.replace("h = 0.25", "h = 0.2"))
    status, printed = run(words + ["--resume"])
    expect(status, printed, 1, ["mesh", "without --resume"])
    return printed


def damaged_checkpoints(quoin, folder):
    """Bytes that differ, files that are cut short or gone, other formats."""
    prm = prepare(folder)
    output = os.path.join(folder, "output")
    words = [quoin, prm, "--output", output]
    status, printed = run(words)
    expect(status, printed, 0, [])
    checkpoint = os.path.join(output, "checkpoint")
    whole = os.path.join(folder, "whole")
    shutil.copytree(checkpoint, whole)
    latest = os.path.join(checkpoint, "latest")
    archive = glob.glob(os.path.join(checkpoint, "*", "rank_0.bin"))[0]
    size = os.path.getsize(archive)

    def spoil(path, change):
        with open(path, "rb") as stream:
            data = bytearray(stream.read())
        data = change(data)
        with open(path, "wb") as stream:
            stream.write(data)

    def flip(place):
        def change(data):
            data[place % len(data)] ^= 0x55
            return data
        return change

    attempts = [(archive, lambda data: data[:0], "damaged"),
                (archive, lambda data: data[:-1], "damaged"),
                (archive, lambda data: data + b"x", "damaged"),
                (archive, flip(size // 2), "damaged"),
                (archive, flip(0), "damaged"),
                (latest, lambda data: data[:len(data) // 2], "damaged"),
                (latest, lambda data: b"", "damaged"),
                (latest, lambda data: bytes(100), "damaged"),
                (latest, lambda data: data.replace(b"format ", b"format 1"),
                 "another version"),
                (latest, lambda data: data.replace(b"version ", b"version 1"),
                 "version"),
                (latest, lambda data: data.replace(b"ranks 1", b"ranks 9"),
                 "damaged"),
                (latest, lambda data: data.replace(
                    b"ranks 1", b"ranks 99999999999999"), "damaged"),
                (latest, lambda data: data.replace(
                    b"directory ", b"directory ../"), "damaged")]
    for number, (path, change, word) in enumerate(attempts):
        spoil(path, change)
        status, printed = run(words + ["--resume"])
        try:
            expect(status, printed, 1, [word, "without --resume"])
        except Failure as failure:
            raise Failure("attempt %d: %s" % (number, failure))
        shutil.rmtree(checkpoint)
        shutil.copytree(whole, checkpoint)
    os.remove(archive)
    status, printed = run(words + ["--resume"])
    expect(status, printed, 1, ["damaged", "without --resume"])
    return printed


def full_disk_on_two_ranks(quoin, folder):
    """A table that the first rank cannot write stops both, at once."""
    return fill_disk(quoin, folder, 2)


FUNCTIONS = [base_case_runs, quiet_run, boundary_begins_in_motion,
             boundary_case_runs,
             check_writes_nothing, error_in_an_included_file, schema, no_arguments,
             unknown_option, output_below_a_file,
             read_only_output_on_two_ranks, full_disk, no_number,
             no_number_at_the_end, runaway, reported_block, deleted_block,
             elastic_model_without_equilibrium,
             undecided_factor_of_the_implicit_solver,
             other_ranks, failure_of_one_rank, more_ranks_than_rigid_blocks,
             other_parameters, nothing_to_resume, failing_block_leaves,
             safety_changes_nothing, failure_displacement_of_what_is_there,
             failure_displacement_of_growing_loads,
             search_leaves_adaptive_damping, unloaded_model_comes_to_rest,
             last_allowed_step, implicit_checkpoints,
             implicit_limit_load, interrupted_before_the_steps,
             two_runs_at_once, odd_names, file_of_another_system,
             far_from_the_origin, blocks_that_overlap, slivers_of_tetrahedra,
             small_pieces_of_rock,
             gmsh_comes_to_its_end, gmsh_ends_with_its_run, output_is_a_file, old_results, changed_inputs,
             damaged_checkpoints, full_disk_on_two_ranks]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--quoin", required=True, help="the executable")
    parser.add_argument("--only", help="those whose name contains this")
    parser.add_argument("--show", action="store_true",
                        help="print the messages")
    parser.add_argument("--many-runs", help="the program many_runs, to save time")
    parser.add_argument("--list", action="store_true", help="names only")
    options = parser.parse_args()
    quoin = os.path.abspath(options.quoin)
    if options.many_runs:
        global many_runs
        many_runs = ManyRuns(options.many_runs, quoin)

    with open(os.path.join(HERE, "errors.json")) as stream:
        tests = [(case["name"], lambda folder, case=case:
                  (failed_run if case.get("status") == 2
                   else warned_of if "warns" in case
                   else wrong_input)(quoin, case, folder))
                 for case in json.load(stream)]
    tests += [(function.__name__.replace("_", " "),
               lambda folder, function=function: function(quoin, folder))
              for function in FUNCTIONS]
    if options.only:
        only = options.only.replace("_", " ")
        tests = [test for test in tests if only in test[0]]
    if options.list:
        print("\n".join(name for name, _ in tests))
        return

    def outcome(named):
        """Outcome of a test, and what to print about it."""
        name, test = named
        with tempfile.TemporaryDirectory(prefix="quoin_") as folder:
            try:
                printed = test(folder)
                return "passed", ("ok: %s\n%s" % (name, printed or "")
                                  if options.show else None)
            except Skip as why:
                return "skipped", "skipped: %s: %s" % (name, why)
            except subprocess.TimeoutExpired:
                return "failed", "FAILED: %s: still running after 120 s" % name
            except Failure as failure:
                return "failed", "FAILED: %s: %s" % (name, failure)

    counts = collections.Counter()
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as threads:
        for result, text in threads.map(outcome, tests):
            counts[result] += 1
            if text:
                print(text, flush=True)
    print("%d passed, %d failed, %d skipped"
          % tuple(counts[key] for key in ("passed", "failed", "skipped")))
    sys.exit(1 if counts["failed"] or not counts["passed"] else 0)


if __name__ == "__main__":
    main()
