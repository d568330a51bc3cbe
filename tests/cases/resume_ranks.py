#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""A run that is resumed on another number of ranks goes on to rounding.

Each run is killed (SIGKILL) as soon as a checkpoint has passed a share of its
steps and resumed on the next number of ranks, again and again. Histories and
energies agree with those of an uninterrupted run on one rank. So do the rows
that were written before, which the resumed run keeps. Without --all each run is
killed once, on its first number of ranks, and goes on on its last one, and some
are left to ranks.py, which has run them on one rank anyway.
"""
import json
import os
import random
import re
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import common  # noqa: E402
import ranks as on_ranks  # noqa: E402
from common import Failure  # noqa: E402
from resume import kill_all  # noqa: E402

sys.path.insert(0, os.path.join(common.ROOT, "python"))
from quoin.xdmf import read_xdmf  # noqa: E402

SALENCON = os.path.join(common.VERIFICATION, "salencon", "case.prm")
WEDGES = os.path.join(common.VERIFICATION, "sliding_wedges", "two_planes.prm")
# A joint in a generated box of rock: three trials of its factor of safety, and a stage
# after them.
ROCK_BOX = os.path.join(common.VERIFICATION, "space_plane_of_weakness",
                        "case.prm")
LOADED = "x_sides, y_sides, foot, top"
SAFE = ["Rock box/Element size=0.7", "Loads/Names=ground, " + LOADED,
        "Loads/top/Type=traction", "Loads/top/Boundary=top",
        "Loads/top/Pressure=6e6", "Stages/Names=press, safety, rest",
        "Stages/press/Duration=2e-3", "Stages/rest/Duration=2e-3",
        "Stages/safety/End=factor of safety", "Stages/safety/First factor=1.5",
        "Stages/safety/Factor tolerance=0.2", "Histories/Interval=2e-4",
        "Histories/Names=slip_x, slip_y, slip_z"] + [
    "Stages/%s/Loads=%s" % (stage, LOADED)
    for stage in ("press", "safety", "rest")]
ALL = (2, 1, 2, 3, 1)
UP = (1, 2, 3)
DOWN = (3, 1, 2)


def of_ranks(name, numbers, sets=()):
    prm, own = on_ranks.VARIANTS[name]
    return prm, own + list(sets), numbers


# name: parameter file, overrides, numbers of ranks
CASES = {
    "deformable": of_ranks("deformable", DOWN),
    "rigid": of_ranks("rigid", ALL),
    "yielding": of_ranks("yielding", UP),
    "yielding, divided": (SALENCON, on_ranks.SOON, ALL),
    "conditions": of_ranks("conditions", UP),
    "sled": of_ranks("sled", ALL, ["Output/Field format=xdmf",
                                   "Output/Field interval=5e-3"]),
    "wall": (on_ranks.WALL, ["Stages/settle/End=time",
                             "Stages/settle/Duration=2e-3",
                             "Stages/push/Duration=1e-3",
                             "Stages/push/Kinetic energy limit=0",
                             "Joints/mortar/Cracks=close",
                             "Output/Field interval=1e-3"], ALL),
    "free field": of_ranks("free field", UP),
    "space, free field": of_ranks("space, free field", UP),
    "divided": of_ranks("divided", ALL),
    "divided, cracked": of_ranks("divided, cracked", DOWN),
    "reset, divided": of_ranks("reset, divided", ALL),
    "cavity": of_ranks("cavity", ALL),
    "hybrid": of_ranks("hybrid", ALL),
    "contacts, divided": of_ranks("contacts, divided", ALL),
    "space": of_ranks("space", ALL),
    "bars": of_ranks("bars", ALL),
    "implicit, bars": of_ranks("implicit, bars", UP),
    "space, joints": of_ranks("space, joints", ALL),
    "space, dashpots": of_ranks("space, dashpots", UP),
    "space, platen": of_ranks("space, platen", UP),
    "space, rock joint": of_ranks("space, rock joint", ALL),
    "space, crack": of_ranks("space, crack", UP),
    "space, excavation": of_ranks("space, excavation", UP),
    "space, wall": of_ranks("space, wall", ALL),
    "space, construction": of_ranks("space, construction", ALL),
    "space, safety": (ROCK_BOX, SAFE, UP),
    "static far field": of_ranks("static far field", ALL),
    "construction": of_ranks("construction", ALL),
    "construction, divided": of_ranks("construction, divided", ALL),
    "liner": of_ranks("liner", ALL),
    "implicit, liner": of_ranks("implicit, liner", UP),
    "liner, slipping": of_ranks("liner, slipping", DOWN),
    "implicit, liner, slipping": of_ranks("implicit, liner, slipping", UP),
    "dashpots": of_ranks("dashpots", DOWN, ["Stages/impact/Duration=0.03"]),
    "dashpots, divided": of_ranks("dashpots, divided", UP,
                                  ["Stages/slide/Duration=0.02"]),
    "pattern": of_ranks("pattern", ALL),
    "pattern, named": of_ranks("pattern, named", UP),
    # four trials: what the factors nearest to failure take, hundreds of thousands of
    # steps, each of which waits for the other ranks, shows no more
    "safety": (WEDGES, ["Rock/Element size=3", "Stages/safety/Factor tolerance=0.2",
                        "Histories/Interval=1e-2",
                        "Stages/Names=settle, safety, rest",
                        "Stages/rest/Duration=0.5",
                        "Stages/rest/Loads=gravity, held"], UP),
    "water": of_ranks("water", ALL),
    "implicit, water": of_ranks("implicit, water", UP),
    "implicit, divided": of_ranks("implicit, divided", ALL),
    "implicit, space": of_ranks("implicit, space", UP),
    "mixed": of_ranks("mixed", ALL),
    "implicit, turning": of_ranks("implicit, turning", ALL),
    "implicit, mixed": of_ranks("implicit, mixed", UP),
    "implicit, quadratic": of_ranks("implicit, divided, cracked", UP,
                                    ["Mesh/Triangles=quadratic"]),
    "implicit, construction": (common.FILL,
                               ["Solver=implicit", "Implicit/First step=0.05",
                                "Implicit/Largest step=0.05",
                                "Implicit/Force ratio=1e-11"], UP),
    "implicit": of_ranks("implicit", DOWN),
}
# Those that a short test leaves out: ranks.py and resume.py have them, and others
# here have the same state and the same exchange.
ONLY_ALL = ("space, wall", "yielding", "free field", "divided",
            "reset, divided", "space", "implicit, bars", "space, dashpots",
            "construction", "liner", "implicit, liner",
            "implicit, liner, slipping", "dashpots", "pattern, named",
            "implicit, water", "implicit, turning", "implicit, mixed",
            "implicit, quadratic")
# Those that a short ranks.py resumes, for that run on one rank and, of most, another
# one on 2 ranks, which the killed run repeats: they go from 2 ranks to 3.
IN_RANKS = ("deformable", "sled", "space, free field", "divided, cracked",
            "contacts, divided", "bars", "space, joints", "space, platen", "hybrid",
            "static far field", "pattern", "water", "implicit, divided", "implicit")
TOLERANCE = on_ranks.TOLERANCE
# Of the peak, where an equilibrium is found to 'Force ratio'; of the wall's
# reaction, which differs by 4e-9 on 1 and 2 ranks without a stop, too.
LOOSE = {"implicit": 1e-6, "wall": 1e-7, **on_ranks.ROUNDED}


def steps_in(latest):
    """Steps of the last checkpoint; -1: there is none."""
    try:
        with open(latest) as stream:
            found = re.search(r"^step (\d+)$", stream.read(), re.M)
        return int(found.group(1)) if found else -1
    except FileNotFoundError:
        return -1


def run_until(words, latest, step):
    """Kills the run once a checkpoint has @p step steps; False if it finished
    before."""
    with tempfile.TemporaryFile(mode="w+") as screen:
        process = subprocess.Popen(words, env=common.environment(),
                                   stdout=screen, stderr=screen)
        deadline = time.monotonic() + 300
        while process.poll() is None and steps_in(latest) < step:
            if time.monotonic() > deadline:
                kill_all(process)
                raise Failure("no checkpoint within 300 s")
            time.sleep(0.002)
        if process.poll() is None:
            kill_all(process)
            return True
        if process.returncode != 0:
            screen.seek(0)
            raise Failure("the run ended with exit status %d:\n%s"
                          % (process.returncode, screen.read()[-1500:]))
    return False


def check_series(folder):
    """The pieces that lists of fields name must exist, arrays be whole."""
    for name in os.listdir(folder):
        if name.endswith(".xdmf"):
            for _, pieces in read_xdmf(os.path.join(folder, name)):
                for piece in pieces:
                    piece.read()
        if name.endswith(".pvd"):
            with open(os.path.join(folder, name)) as stream:
                for piece in re.findall(r'file="([^"]+)"', stream.read()):
                    if not os.path.exists(os.path.join(folder, piece)):
                        raise Failure("%s names %s, which is not there"
                                      % (name, piece))


def check_repetition(name, killed, whole):
    """What a killed run has written must be bitwise that of another one on as many
    ranks."""
    for table in ("histories.csv", "energies.csv"):
        if not os.path.exists(os.path.join(whole, table)):
            continue
        with open(os.path.join(killed, table), "rb") as one, \
                open(os.path.join(whole, table), "rb") as other:
            rows, expected = one.read().split(b"\n")[:-1], other.read().split(b"\n")
        if len(rows) < 2 or rows != expected[:len(rows)]:
            raise Failure("%s, twice on as many ranks: the first %d rows of %s are "
                          "not bitwise the same" % (name, len(rows), table))


def compare(quoin, name, scratch, whole, numbers, seed=1, same=None):
    """The largest difference, the columns that differ, and kills.

    @p whole and @p same: uninterrupted runs on 1 rank and, if not None, on as many
    ranks as the killed one begins with."""
    prm, sets, _ = CASES[name]
    chance = random.Random("%d %s" % (seed, name))
    broken = os.path.join(scratch, name + ", resumed")
    with open(os.path.join(whole, "summary.json")) as stream:
        summary = json.load(stream)
    n_steps = summary["steps"]
    # often, though each one waits for the disk
    sets = sets + ["Output/Checkpoint interval=%.2g"
                   % min(0.02, summary["wall time [s]"] / 100.)]
    latest = os.path.join(broken, "checkpoint", "latest")
    kills = []
    for i, n in enumerate(numbers[:-1]):
        share = (i + 0.5 + chance.random()) / len(numbers)
        words = common.command(quoin, prm, broken, sets, n,
                               ["--resume"] if i > 0 else [])
        if not run_until(words, latest, max(1, int(share * n_steps))):
            break
        if same and i == 0:
            check_repetition(name, broken, same)
        check_series(broken)
        kills.append("%d of %d" % (steps_in(latest), n_steps))
    if not kills:
        raise Failure("%s finished before it could be killed" % name)
    common.run(quoin, prm, broken, sets, numbers[-1], ["--resume"])
    check_series(broken)
    errors = on_ranks.differences(on_ranks.tables(whole),
                                  on_ranks.tables(broken), name)
    worst = max(errors.values())
    print("  %s on %s ranks, killed at steps %s: largest difference %.2e"
          % (name, ", ".join(map(str, numbers)), ", ".join(kills), worst),
          flush=True)
    different = ["%s '%s' by %.1e" % (name, column, error)
                 for column, error in errors.items()
                 if not error <= LOOSE.get(name, TOLERANCE)]
    return worst, different, len(kills)


def body():
    parser = common.arguments(__doc__.splitlines()[0])
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--only", help="the case of that name")
    parser.add_argument("--all", action="store_true",
                        help="kill and resume on all numbers of ranks")
    options = parser.parse_args()
    if not options.only:
        results = common.begin(options, "resume_ranks")
    start = time.monotonic()
    worst, different, n_kills = 0.0, [], 0
    with tempfile.TemporaryDirectory(prefix="quoin_") as scratch:
        names = [options.only] if options.only else [
            name for name in CASES
            if options.all or name not in ONLY_ALL + IN_RANKS]

        def whole_of(name):
            return os.path.join(scratch, name)

        def outcome(name):
            numbers = CASES[name][2]
            return compare(options.quoin, name, scratch, whole_of(name),
                           numbers if options.all else (numbers[0], numbers[-1]),
                           options.seed)

        # not beside those on several ranks, which wait for each other at each step
        common.in_parallel(
            lambda name: common.run(options.quoin, CASES[name][0], whole_of(name),
                                    CASES[name][1]), names)
        for name, (error, columns, kills) in zip(
                names, common.in_parallel(outcome, names)):
            if name not in LOOSE:
                worst = max(worst, error)
            different += columns
            n_kills += kills
    if not options.only:
        common.write_result(
            results, "resume_ranks",
            title="killed %d times and resumed on 1, 2 and 3 ranks" % n_kills,
            reference="uninterrupted run on 1 rank", error=worst,
            tolerance=TOLERANCE, seconds=round(time.monotonic() - start, 2),
            passed=not different)
    if different:
        raise Failure("columns differ: " + ", ".join(different))
    print("passed: resume_ranks: on 1, 2 and 3 ranks to %.2e after %d kills"
          % (worst, n_kills))


if __name__ == "__main__":
    common.main(body)
