# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Runs a case by the explicit and by the implicit solver and compares both.

  scripts/compare CASE.prm [OPTIONS] [OPTIONS OF quoin ...]
  scripts/compare CASE.prm --output both --set "Stages/push/Duration=0.1"
  scripts/compare CASE.prm --explicit DIR --implicit DIR      runs nothing

Results go to the output directory of the case with _compare at its end (or
--output DIR): explicit/ and implicit/ have the runs, and beside them are

  compare.png   the curves of CASE.plot.json, or plot.json, of both runs, with
                the references and bands that it has (see scripts/plot)
  cracks.png    both at the same displacement, at the earlier of both peaks
                and at the end that both reach, or as --at says
  compare.json  the numbers that are printed

The first curve is what is compared: its peak (largest magnitude) and the
difference between both, relative to the peak of the explicit run, over x as far
as both go, or under cycles over the sum of all steps of x. Joints are open or
slide where opening or slip (without its elastic part) is above --threshold.

A run that ended early (exit status 2) is compared as far as it went. RANKS=2
makes parallel runs.
"""

import json
import os
import subprocess
import sys

from quoin import run_parameters
from quoin.commands.options import Parser, add_picture_options, positive
from quoin.csv_table import as_text, unit_of
from quoin.figures.block_figure import Frame, Picture, is_in_space
from quoin.figures.page_layout import draw_panel
from quoin.running import CHECKOUT, command, environment
from quoin.solver_comparison import SOLVERS, THRESHOLD, Comparison, spec_of

LOST_EQUILIBRIUM = 2                 # exit status: the outputs are kept


def run_solver(options, others, solver, output):
    """Runs quoin; a run that ended early leaves its outputs, too."""
    words = command(options.case, output,
                    options.set + ["Solver=" + solver], others,
                    ranks=int(os.environ.get("RANKS", "1")),
                    quoin=options.quoin)
    print(f"-- {solver}", flush=True)
    status = subprocess.run(words, env=environment()).returncode
    if status not in (0, LOST_EQUILIBRIUM):
        raise ValueError(f"the {solver} run ended with exit status {status}")


def ways_of(comparison, wanted):
    """The ways that --at asks for, each with its name."""
    places = {"peak": comparison.places()["at the peak"],
              "end": comparison.places()["at the end"]}
    ways = []
    for word in wanted.split(","):
        try:
            ways.append((places.get(word.strip()) if word.strip() in places
                         else float(word), word.strip()))
        except ValueError as error:
            raise ValueError(f"--at takes values of x as the figure shows "
                             f"them, peak and end, not '{word}'") from error
    return ways


def draw_cracks(comparison, options, path):
    """Both runs side by side, a row a moment; the path, or None without
    fields or in three dimensions."""
    if any(is_in_space(run.folder) for run in comparison.runs):
        return None
    unit = unit_of(comparison.figure.x_label)
    frames = []
    for way, word in ways_of(comparison, options.at):
        moments = comparison.moments(way)
        if moments is None:
            return None
        for solver, run, (time, there) in zip(SOLVERS, comparison.runs,
                                              moments):
            note = f" ({word})" if word in ("peak", "end") else ""
            frames.append(Frame(run.folder, time,
                                f"{solver}, {as_text(there)} {unit}{note}"))
    options.output = comparison.runs[0].folder
    figure = draw_panel(Picture(options, frames), frames, n_columns=2)
    figure.savefig(path, bbox_inches="tight")
    return path


def percent(value):
    return "-" if value is None else f"{100.0 * value:.2f} %"


def report(numbers):
    """The lines on the screen."""
    lines = [f"{'':24}{'explicit':>14}{'implicit':>14}"]
    for name in numbers["explicit"]:
        if name == "folder":
            continue
        pair = [numbers[solver][name] for solver in SOLVERS]
        text = [f"{value:.4g}" if isinstance(value, float) else
                "-" if value is None else str(value) for value in pair]
        lines.append(f"{name:24}{text[0]:>14}{text[1]:>14}")
    lines.append("")
    for name in ("peak, implicit by explicit", "wall time, explicit by implicit"):
        value = numbers[name]
        lines.append(f"{name:42}{'-' if value is None else f'{value:.4g}'}")
    curves = numbers["curves"]
    for name in ("largest difference up to the peak", "largest difference",
                 "mean difference"):
        lines.append(f"{name:42}{percent(curves[name])} of the peak")
    joints = numbers["joints"] or {}
    for place in (name for name in joints if name.startswith("at ")):
        for name, value in joints[place].items():
            if name.startswith("same ") or name.endswith("in both"):
                lines.append(f"{'joints ' + place + ', ' + name:42}"
                             f"{percent(value)}")
    return "\n".join(lines + [f"note: {note}" for note in numbers["notes"]])


def folders_of(options, others):
    """Folders of the explicit, the implicit and the compared results after
    both runs."""
    given = [options.explicit, options.implicit]
    if any(given) != all(given):
        raise ValueError("give both --explicit DIR and --implicit DIR, or "
                         "neither: then both are run")
    if not options.case and not all(given):
        raise ValueError("give a CASE.prm to run")
    if not options.output:
        if not options.case:
            raise ValueError("give --output DIR for the results")
        options.output = run_parameters.output_of(
            options.case, options.set) + "_compare"
    os.makedirs(options.output, exist_ok=True)
    if all(given):
        return given
    if not options.quoin and CHECKOUT:
        subprocess.run([os.path.join(CHECKOUT, "scripts", "build"), "quoin"],
                       check=True, stdout=subprocess.DEVNULL)
    folders = [os.path.join(options.output, solver) for solver in SOLVERS]
    for solver, folder in zip(SOLVERS, folders):
        run_solver(options, others, solver, folder)
    return folders


def compare(options, others):
    """Writes figures and numbers; prints them."""
    spec, beside = spec_of(options.case, options.spec)
    folders = folders_of(options, others)
    spec["curves"][0].setdefault("peak", True)
    comparison = Comparison(spec, beside, *folders,
                            threshold=options.threshold)
    numbers = comparison.numbers()
    path = os.path.join(options.output, "compare.json")
    with open(path, "w", encoding="utf-8") as file:
        json.dump(numbers, file, indent=2)
        file.write("\n")
    print(report(numbers))
    print(path)
    print(comparison.figure.save(os.path.join(options.output, "compare.png")))
    cracks = draw_cracks(comparison, options,
                         os.path.join(options.output, "cracks.png"))
    if cracks:
        print(cracks)


def main():
    parser = Parser(__doc__, allow_abbrev=False)
    parser.add_argument("case", metavar="CASE.prm", nargs="?")
    parser.add_argument("--output", metavar="DIR")
    parser.add_argument("--explicit", metavar="DIR", help="a run to take")
    parser.add_argument("--implicit", metavar="DIR", help="a run to take")
    parser.add_argument("--spec", metavar="plot.json",
                        help="default CASE.plot.json, or plot.json beside it")
    parser.add_argument("--at", metavar="VALUE,...", default="peak,end",
                        help="of cracks.png: x as the figure shows it, peak, "
                             "end; default peak,end")
    parser.add_argument("--threshold", type=positive(float), metavar="WIDTH",
                        default=THRESHOLD,
                        help="[m], default %(default)g")
    parser.add_argument("--set", action="append", default=[],
                        metavar="Section/Name=VALUE", help="of both runs")
    parser.add_argument("--quoin", metavar="FILE",
                        help="the executable, default build/quoin, which is "
                             "built if need be")
    parser.add_argument("--title", help="of cracks.png")
    add_picture_options(parser, joints="mode")
    options, others = parser.parse_known_args()
    if options.since is not None:
        parser.error("--since is for one run: a time of one solver is another "
                     "moment of the other")
    try:
        compare(options, others)
    except (OSError, ValueError, subprocess.CalledProcessError) as error:
        sys.exit(f"compare: {error}")


if __name__ == "__main__":
    main()
