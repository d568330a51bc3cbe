#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""A run that is killed and resumed writes the same files, bit by bit.

The run is killed (SIGKILL) several times, at random moments after the first
checkpoint, resumed each time, and its histories, energies and fields are
compared with those of an uninterrupted one as bytes. So are the histories of a
run that writes no fields: to write them must change nothing.
"""
import json
import os
import random
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import common  # noqa: E402
import ranks as on_ranks  # noqa: E402
from common import Failure  # noqa: E402

# Boundary elements beyond blocks as few as their edges allow.
FAST = ["Boundary elements/Element length=1",
        "Boundary elements/Passivity frequencies=0"]
TABLES = ("histories.csv", "energies.csv", "safety.csv", "flow.csv")
# entries of summary.json that a resumed run must have as the uninterrupted one
SUMMARY = ("time [s]", "steps", "energy throughput [J]", "energy residual [J]",
           "largest energy residual [J]", "energy residual share")
# name: parameter file, overrides, ranks, kills
CASES = {
    # friction and two stages: much history
    "crack": (os.path.join(common.VERIFICATION, "slipping_crack", "case.prm"),
              ["Output/Checkpoint interval=0.1", "Histories/Interval=1e-5",
               "Histories/Names=displacement, force, ratio",
               "Histories/ratio/Quantity=unbalanced ratio",
               "Time stepping/Share of critical time step=0.6"], 1, 3),
    # columns beside the blocks, motion at the start
    "free field": (os.path.join(common.VERIFICATION, "free_field_sides",
                                "case.prm"),
                   ["Output/Checkpoint interval=0.05",
                    "Stages/shake/Duration=2",
                    "Initial motion/Velocity=1e-3*exp(-x*x); 0"], 1, 2),
    # grids beside a block of tetrahedra
    "space, free field": (os.path.join(
        common.VERIFICATION, "space_free_field_sides", "case.prm"),
        [on_ranks.LAYER, "Output/Checkpoint interval=0.02",
         "Stages/shake/Duration=0.06"], 2, 2),
    # tetrahedra and dashpots
    "space": (os.path.join(common.VERIFICATION, "space_waves", "s.prm"),
              ["Output/Checkpoint interval=0.02"], 2, 2),
    # dashpots of a boundary that have followed the material beside it since the
    # second stage began, almost at the start
    "space, softer": (
        os.path.join(common.VERIFICATION, "space_waves", "s.prm"),
        ["Materials/Names=rock, soft", "Materials/soft/Groups=none",
         "Materials/soft/Density=2500", "Materials/soft/Young's modulus=6.25e9",
         "Materials/soft/Poisson's ratio=0.25", "Stages/Names=wave, softer",
         "Stages/wave/Duration=2e-4", "Stages/softer/Materials=rock:soft",
         "Stages/softer/Loads=base, push, top, y_sides",
         "Stages/softer/End=time", "Stages/softer/Duration=0.03",
         "Output/Checkpoint interval=0.02"], 2, 2),
    "space, joints": (os.path.join(common.VERIFICATION, "space_incline",
                                   "case.prm"),
                      ["Output/Checkpoint interval=0.02",
                       "Output/Field interval=0.1"], 2, 2),
    # blocks that meet on dashpots
    "space, dashpots": (os.path.join(common.VERIFICATION, "space_dashpots",
                                     "impacts.prm"),
                        ["Output/Checkpoint interval=0.02",
                         "Stages/impact/Duration=0.02",
                         "Histories/Interval=1e-5"], 2, 2),
    # plane waves that come in askew, from all sides
    "space, oblique wave": (os.path.join(common.VERIFICATION,
                                         "space_oblique_waves", "case.prm"),
                            [on_ranks.BOX, "Output/Checkpoint interval=0.02"],
                            2, 2),
    # platens with six degrees of freedom
    "space, platen": (os.path.join(common.VERIFICATION, "space_platens",
                                   "case.prm"),
                      ["Output/Checkpoint interval=0.02",
                       "Stages/load/End=time", "Stages/load/Duration=0.1"],
                      2, 2),
    # a rock joint whose slip turns
    "space, rock joint": (os.path.join(common.VERIFICATION,
                                       "space_rock_joints",
                                       "continuously_yielding.prm"),
                          ["Output/Checkpoint interval=0.05"], 2, 2),
    # rock that yields around what is excavated, under initial stress
    "space, excavation": (os.path.join(common.VERIFICATION, "space_tunnel",
                                       "case.prm"),
                          ["Materials/rock/Law=Mohr-Coulomb",
                           "Materials/rock/Cohesion=1e6",
                           "Materials/rock/Friction angle=30",
                           "Stages/excavate/End=time",
                           "Stages/excavate/Duration=4e-3",
                           "Stages/excavate/Release duration=2e-3",
                           "Output/Checkpoint interval=0.02"], 2, 2),
    # the factor of a load pattern, past its peak
    "pattern": (os.path.join(common.VERIFICATION, "collapse_load",
                             "softening.prm"),
                ["Output/Checkpoint interval=0.05"], 1, 2),
    # ... that follows a history
    "pattern, named": (os.path.join(common.VERIFICATION, "collapse_load",
                                    "case.prm"),
                       ["Stages/settle/Duration=0.1",
                        "Stages/push/Duration=0.4",
                        "Stages/push/Controlled displacement=top",
                        "Output/Checkpoint interval=0.05"], 1, 2),
    # a liner that slips and yields
    "liner": (os.path.join(common.VERIFICATION, "liner", "case.prm"),
              FAST + ["Loads/in_situ/Stress=-10e6, -5e6, 0",
                      "Joints/bond/Law=no tension",
                      "Joints/bond/Friction angle=20",
                      "Beams/shotcrete/Hinge moment=5e3",
                      "Stages/excavation/End=time",
                      "Stages/excavation/Duration=4e-3",
                      "Output/Checkpoint interval=0.05"], 1, 2),
    # ... that is placed on ground that has moved, so light that the time step
    # is its own, and bent so far that its shape would change that
    "liner, later": (
        os.path.join(common.VERIFICATION, "liner", "case.prm"),
        FAST + ["Stages/Names=excavation, lined",
                "Stages/excavation/Release=0.4", "Stages/excavation/End=time",
                "Stages/excavation/Duration=0.002",
                "Stages/lined/Loads=far_field", "Beams/shotcrete/Stage=lined",
                "Stages/lined/End=time", "Stages/lined/Duration=0.004",
                "Stages/lined/Release=1", "Stages/lined/Damping=local",
                "Beams/shotcrete/Density=100",
                "Loads/in_situ/Stress=-400e6, -200e6, 0",
                "Output/Checkpoint interval=0.05"], 1, 2),
    "liner, later, implicit": (
        os.path.join(common.VERIFICATION, "liner", "case.prm"),
        FAST + ["Solver=implicit", "Stages/Names=excavation, lined",
                "Stages/excavation/Release=0.4",
                "Stages/lined/Loads=far_field", "Beams/shotcrete/Stage=lined",
                "Stages/lined/End=static ratio", "Stages/lined/Release=1",
                "Implicit/First step=0.1", "Implicit/Largest step=0.1",
                "Output/Checkpoint interval=0.02"], 1, 2),
    # cells that yield
    "salencon": (os.path.join(common.VERIFICATION, "salencon", "case.prm"),
                 on_ranks.SOON + ["Output/Checkpoint interval=0.02",
                                  "Stages/excavate/Duration=0.04",
                                  "Output/Field interval=1e-2"], 1, 2),
    # joints that soften
    "couplet": (os.path.join(common.MASONRY, "couplet",
                             "shear.prm"),
                ["Output/Checkpoint interval=0.02",
                 "Output/Field interval=2e-2"], 1, 2),
    # rock joints that become general contacts
    "rock joint": (os.path.join(common.VERIFICATION, "barton_bandis",
                                "case.prm"),
                   ["Output/Checkpoint interval=0.1",
                    "Contact/Displacements=large", "Joints/joint/Curves=joint",
                    "Joints/joint/New contacts between=all"], 1, 2),
    # a generated wall, cracks that close, loads that slow down
    "wall": (os.path.join(common.MASONRY, "tue_walls", "j4d.prm"),
             ["Output/Checkpoint interval=0.02", "Output/Field interval=1e-3",
              "Joints/mortar/Cracks=close", "Stages/settle/End=time",
              "Stages/settle/Duration=5e-3", "Stages/push/Duration=6e-4"], 1, 2),
    # the same wall in equilibrium
    "implicit": (os.path.join(common.MASONRY, "tue_walls", "j4d.prm"),
                 ["Solver=implicit", "Output/Checkpoint interval=0.05",
                  "Output/Field interval=5e-3", "Stages/push/Duration=0.01"],
                 1, 2),
    # composite joints of tetrahedra under a load pattern
    "implicit, space, wall": (
        on_ranks.SPACE_WALL, on_ranks.CRACKING + [
            "Output/Checkpoint interval=0.02", "Output/Field interval=0.1",
            "Stages/push/Duration=0.4"], 1, 2),
    "implicit on 2 ranks": (
        os.path.join(common.MASONRY, "tue_walls", "j4d.prm"),
        ["Solver=implicit", "Output/Checkpoint interval=0.05",
         "Output/Field interval=5e-3", "Stages/push/Duration=0.02"], 2, 1),
    # stages that end on conditions, one of them on a peak
    "conditions": (os.path.join(common.VERIFICATION, "stage_conditions",
                                "case.prm"),
                   ["Output/Checkpoint interval=0.02",
                    "Time stepping/Share of critical time step=0.02"], 1, 3),
    # turns of a named block, counted
    "thrown": (os.path.join(common.VERIFICATION, "named_blocks", "thrown.prm"),
               ["Output/Checkpoint interval=0.02",
                "Materials/block/Law=linear elastic"], 1, 3),
    # contacts searched, handed over and taken up in between
    "sled": (common.SLED, ["Output/Checkpoint interval=0.02",
                           "Output/Field interval=2e-3"], 1, 4),
    "sled on 2 ranks": (common.SLED, ["Output/Checkpoint interval=0.05",
                                      "Output/Field format=xdmf",
                                      "Output/Field interval=2e-3"], 2, 2),
    # dashpots of contacts
    "dashpots": (os.path.join(common.VERIFICATION, "impacts", "case.prm"),
                 ["Output/Checkpoint interval=0.02"], 1, 2),
    # boundary elements: their history, and the domain after the last step
    "cavity": (os.path.join(common.VERIFICATION, "cavity_step", "case.prm"),
               ["Output/Checkpoint interval=0.01", "Sampled field/Spacing=4",
                "Output/Field interval=5e-3", "Histories/Interval=1e-4",
                "Boundary elements/Duration=0.05",
                "Boundary elements/Passivity frequencies=0"], 1, 3),
    "cavity on 2 ranks": (
        os.path.join(common.VERIFICATION, "cavity_step", "case.prm"),
        ["Output/Checkpoint interval=0.01", "Sampled field/Spacing=2",
         "Output/Field interval=5e-3", "Output/Field format=xdmf",
         "Histories/Interval=1e-4", "Boundary elements/Duration=0.1",
         "Boundary elements/Passivity frequencies=0"], 2, 1),
    # blocks with boundary elements beyond, stopped within a step of these
    "hybrid": (os.path.join(common.VERIFICATION, "hybrid_hole", "case.prm"),
               ["Output/Checkpoint interval=0.05", "Histories/Interval=1e-4",
                "Output/Field interval=1e-2", "Stages/pulse/Duration=0.05",
                "Boundary elements/Element length=0.5",
                "Boundary elements/Passivity frequencies=0"], 1, 3),
    # a static far field, and dashpots that hold what it carried
    "static": (os.path.join(common.VERIFICATION, "at_rest_after_switch",
                            "static_dashpots.prm"),
               ["Output/Checkpoint interval=0.05", "Histories/Interval=1e-4",
                "Stages/settle/Static ratio=1e-6",
                "Stages/rest/Duration=0.15"], 1, 3),
    "static on 2 ranks": (
        os.path.join(common.VERIFICATION, "at_rest_after_switch",
                     "static_dashpots.prm"),
        ["Output/Checkpoint interval=0.05", "Histories/Interval=1e-4",
         "Stages/settle/Static ratio=1e-6", "Stages/rest/Duration=0.15"], 2, 1),
    # blocks placed, excavated and placed again
    "construction": (os.path.join(common.VERIFICATION, "fill", "case.prm"),
                     ["Output/Checkpoint interval=0.05",
                      "Output/Field interval=5e-2", "Output/Field format=xdmf",
                      "Stages/fill/Reset=displacements, joint states",
                      "Stages/gone/Reset=displacements, slips",
                      "Time stepping/Share of critical time step=0.1"], 1, 3),
    "construction, implicit": (
        os.path.join(common.VERIFICATION, "fill", "case.prm"),
        ["Solver=implicit", "Output/Checkpoint interval=0.02",
         "Output/Field interval=5e-2", "Implicit/First step=4e-3",
         "Stages/fill/Reset=displacements, slips, joint states",
         "Implicit/Largest step=4e-3"], 1, 3),
    # a factor of safety between two trials, and the stage after it
    "safety": (
        os.path.join(common.VERIFICATION, "sliding_wedges", "two_planes.prm"),
        ["Rock/Element size=3", "Output/Checkpoint interval=0.02",
         "Histories/Interval=1e-2", "Stages/Names=settle, safety, rest",
         "Stages/rest/Duration=0.5", "Stages/rest/Loads=gravity, held"], 1, 3),
    # water in a joint, by both solvers
    "water": (os.path.join(common.VERIFICATION, "joint_flow",
                           "consolidation.prm"),
              ["Solver=explicit", "Water/Bulk modulus=2e8",
               "Stages/press/Duration=0.01", "Output/Checkpoint interval=0.02",
               "Histories/Interval=1e-4", "Output/Field interval=2e-3"], 1, 2),
    "water, implicit": (
        os.path.join(common.VERIFICATION, "joint_flow", "consolidation.prm"),
        ["Output/Checkpoint interval=0.02", "Output/Field interval=0.2",
         "Implicit/First step=0.01", "Implicit/Largest step=0.01"], 1, 2),
    "free surface": (
        os.path.join(common.VERIFICATION, "joint_flow", "slab.prm"),
        ["Water/Free surface=yes", "Stages/flow/Duration=20",
         "Histories/Interval=0.2", "Output/Checkpoint interval=0.05"], 1, 2),
    # water that moves with a wall; uplift in a crack
    "added mass": (os.path.join(common.VERIFICATION, "added_mass", "wall.prm"),
                   ["Output/Checkpoint interval=0.05"], 1, 2),
    "uplift": (os.path.join(common.VERIFICATION, "dam_uplift", "dam.prm"),
               ["Output/Checkpoint interval=0.02", "Stages/settle/End=time",
                "Stages/settle/Duration=2", "Stages/fill/End=time",
                "Stages/fill/Duration=10",
                "Time stepping/Share of critical time step=0.5"], 1, 2),
    # cells and joints that become softer under pressure
    "properties": (
        os.path.join(common.VERIFICATION, "property_change", "case.prm"),
        ["Output/Checkpoint interval=0.02", "Output/Field interval=5e-3",
         "Time stepping/Share of critical time step=0.01"], 1, 3),
}
# Steps from which on checkpoints count: a run is killed after the first of these,
# here within the stage in which the liner bears.
LATER = {"liner, later, implicit": 12}
# Those that a short test, too, resumes from a run that was resumed, and compares
# with one that writes no fields.
KILLED_AGAIN = ("crack", "space, joints", "safety", "construction, implicit")
# Those that it leaves out: they are here on one rank, too, and on several in
# resume_ranks.py.
ALSO_ON_ONE_RANK = ("sled on 2 ranks", "cavity on 2 ranks",
                    "implicit on 2 ranks", "static on 2 ranks")


def read(output, name):
    with open(os.path.join(output, name), "rb") as stream:
        return stream.read()


def written(checkpoint):
    """A number that changes with every checkpoint; 0: there is none."""
    try:
        return os.stat(checkpoint).st_mtime_ns
    except FileNotFoundError:
        return 0


def step_of(checkpoint):
    """The step of the last checkpoint; 0: there is none."""
    try:
        with open(checkpoint) as stream:
            return int(re.search(r"^step (\d+)$", stream.read(), re.M).group(1))
    except FileNotFoundError:
        return 0


def descendants(pid):
    """Processes started by @p pid, directly or not."""
    try:
        with open("/proc/%d/task/%d/children" % (pid, pid)) as stream:
            children = [int(word) for word in stream.read().split()]
    except FileNotFoundError:
        return []
    return children + [d for child in children for d in descendants(child)]


def is_running(pid):
    try:
        with open("/proc/%d/stat" % pid) as stream:
            return stream.read().rpartition(")")[2].split()[0] != "Z"
    except (FileNotFoundError, ProcessLookupError):
        return False


def kill_all(process):
    """Kills mpirun and its ranks, which must not write on."""
    pids = [process.pid] + descendants(process.pid)
    for pid in pids:
        try:
            os.kill(pid, signal.SIGKILL)
        except ProcessLookupError:
            pass
    process.wait()
    while any(is_running(pid) for pid in pids[1:]):
        time.sleep(0.005)


def run_and_kill(words, checkpoint, delay=None, first_step=0):
    """Starts a run and kills it @p delay [s] after its first new checkpoint of
    @p first_step or later.

    Returns None if it was killed; if it finished before, or without @p delay,
    the seconds from the checkpoint to its end."""
    before = written(checkpoint)
    deadline = time.monotonic() + 60
    with tempfile.TemporaryFile(mode="w+") as screen:
        process = subprocess.Popen(words, env=common.environment(),
                                   stdout=screen, stderr=screen)
        while process.poll() is None and (
                written(checkpoint) == before
                or step_of(checkpoint) < first_step):
            if time.monotonic() > deadline:
                kill_all(process)
                raise Failure("no checkpoint within 60 s")
            time.sleep(0.005)
        seen = time.monotonic()
        try:
            process.wait(timeout=delay)
        except subprocess.TimeoutExpired:
            kill_all(process)
            return None
        lasted = time.monotonic() - seen
        if process.returncode != 0:
            screen.seek(0)
            raise Failure("the run ended with exit status %d:\n%s"
                          % (process.returncode, screen.read()[-1500:]))
    return lasted


def compare_tables(what, one, other):
    for name in TABLES:
        if not os.path.exists(os.path.join(one, name)):
            continue
        a, b = read(one, name), read(other, name)
        if a != b:
            rows = list(zip(a.splitlines(), b.splitlines()))
            row = next((i for i, (x, y) in enumerate(rows) if x != y),
                       len(rows))
            raise Failure(
                "%s: %s differs from row %d on (%d and %d bytes)\n  %s\n  %s"
                % (what, name, row, len(a), len(b),
                   a.splitlines()[row:row + 1], b.splitlines()[row:row + 1]))


def compare_summaries(what, one, other):
    a, b = (json.loads(read(output, "summary.json"))
            for output in (one, other))
    for name in SUMMARY:
        if name in a and a[name] != b.get(name):
            raise Failure("%s: '%s' of summary.json is %s, not %s"
                          % (what, name, b.get(name), a[name]))


def field_files(output):
    """Lists and pieces of VTU files, and those of XDMF."""
    folder = os.path.join(output, "fields")
    pieces = os.listdir(folder) if os.path.isdir(folder) else []
    return sorted([os.path.join("fields", name) for name in pieces]
                  + [name for name in os.listdir(output)
                     if name.endswith((".pvd", ".xdmf", ".bin"))])


def compare_fields(what, one, other):
    names = field_files(one)
    if not names or names != field_files(other):
        raise Failure("%s: the field files are not the same ones" % what)
    for name in names:
        if read(one, name) != read(other, name):
            raise Failure("%s: %s differs" % (what, name))


def kill_and_resume(options, name):
    """Kills a case again and again, resumes it, and compares; returns the
    number of kills."""
    prm, sets, ranks, kills = CASES[name]
    if not options.all and name not in KILLED_AGAIN:
        kills = 1
    kills = options.kills or kills
    chance = random.Random("%d %s" % (options.seed, name))
    with tempfile.TemporaryDirectory(prefix="quoin_") as scratch:
        whole = os.path.join(scratch, "whole")
        broken = os.path.join(scratch, "broken")
        # what a run takes after its first checkpoint: its set-up may take
        # longer than all its steps
        checkpoint = os.path.join(whole, "checkpoint", "latest")
        lasting = run_and_kill(
            common.command(options.quoin, prm, whole, sets, ranks, []),
            checkpoint, first_step=LATER.get(name, 0))
        if not written(checkpoint):
            raise Failure("%s wrote no checkpoint" % name)
        if ((options.all or name in KILLED_AGAIN) and any(
                value.startswith("Output/Field") for value in sets)):
            bare = os.path.join(scratch, "bare")
            common.run(options.quoin, prm, bare,
                       sets + ["Output/Field interval=0"], ranks)
            compare_tables(name + ", without fields", whole, bare)
        checkpoint = os.path.join(broken, "checkpoint", "latest")
        killed = 0
        for attempt in range(kills + 10):
            delay = chance.random() * lasting / (kills + 1)
            words = common.command(options.quoin, prm, broken, sets, ranks,
                                   ["--resume"] if killed else [])
            if run_and_kill(words, checkpoint, delay,
                            LATER.get(name, 0)) is not None:
                # a machine that is quicker now than it was: once more
                lasting /= 2
                shutil.rmtree(broken)
                killed = 0
                continue
            killed += 1
            print("  %s: killed %.2f s after a checkpoint" % (name, delay),
                  flush=True)
            if killed == kills:
                break
        if killed == 0:
            raise Failure("%s finished before it could be killed" % name)
        common.run(options.quoin, prm, broken, sets, ranks, ["--resume"])
        compare_tables(name, whole, broken)
        compare_fields(name, whole, broken)
        compare_summaries(name, whole, broken)
    return killed


def body():
    parser = common.arguments(__doc__.splitlines()[0])
    parser.add_argument("--kills", type=int, help="how often in each case")
    parser.add_argument("--all", action="store_true",
                        help="all cases, each killed as often as the table "
                        "says")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--only", help="the case whose name begins so")
    options = parser.parse_args()
    if not options.only:
        results = common.begin(options, "resume")
    start = time.monotonic()
    names = [name for name in CASES if name.startswith(options.only or "")
             and (options.all or options.only or name not in ALSO_ON_ONE_RANK)]
    # Ranks, which wait for each other at each step, are not to share a core with
    # runs that never wait.
    names.sort(key=lambda name: CASES[name][2])
    killed_in_all = sum(common.in_parallel(
        lambda name: kill_and_resume(options, name), names))
    if not options.only:
        common.write_result(
            results, "resume",
            title="killed %d times and resumed" % killed_in_all,
            reference="uninterrupted run, bitwise", error=0.0, tolerance=0.0,
            seconds=round(time.monotonic() - start, 2), passed=True)
    print("passed: resume: bitwise equal after %d kills" % killed_in_all)


if __name__ == "__main__":
    common.main(body)
