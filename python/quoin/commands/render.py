# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Draws the deformed blocks of a run, the state of its joints and the forces
in its contacts; one moment, several of them, or a film.

  scripts/render OUTPUT_DIR                      cracks.png of the last time
  scripts/render OUTPUT_DIR --time 0.2 --scale 50 --principal --out wall.png
  scripts/render OUTPUT_DIR --times 0,1.5,3,8 --colour block --view=-9,-1,9,8
  scripts/render OUTPUT_DIR --at displacement=1e-3,2e-3,end --joints mode
  scripts/render OUTPUT_DIR --at force=peak --principal --blocks-only
  scripts/render OUTPUT_DIR --colour velocity --animate collapse.gif

--at takes the fields nearest to where a column of histories.csv first reaches
values (in the units of the table), its peak (largest magnitude) or its end.
Above each picture stands the value that the history has at that field.

Joints are dark red where open, orange where slipping, yellow where they slipped
earlier, thin grey where intact. --joints mode draws cracks instead: what failed
is dark red where it opens more than it slips, orange where it slips more, violet
where it crushed (beyond the compressive strength), and as wide as it opens,
slips inelastically or closes. --joints damage colours joints by the share of
their strength that a composite law has lost, --joints slip by how far they slipped,
elastically or not, --joints water by the pressure of the water in them, as wide as it
flows. Bolts are as wide as they are loaded; beams and liners are black lines, with
--beams moment or --beams "axial force" across them, positive values on their left;
take --scale 1 with them, whose displacements begin as they are placed. Joints that
large displacements handed over to contacts are drawn as far as their two faces are
near each other. Contacts of large displacements are lines along the overlap, as wide
as their normal force. --blocks-only leaves all of these out.

--since TIME draws what came after that time alone, --since STAGE what came since
that stage began, e.g. after gravity: the displacements from then on, and joints by
what they slipped and opened since; those that moved less than a hundredth of the
one that moved most are thin grey. --time, --times and --between take names of
stages, too: their ends, of the first one of --between its beginning. STAGE+TIME is
that time [s] after the stage began, anywhere.

  scripts/render OUTPUT_DIR --times blast+0.009,blast+0.011 --since blast

Displacements are enlarged by --scale, by default so that the deformation can
be seen: never less than once, and not so much that a block seems turned by
more than 0.3 rad, so that blocks which really turn are drawn as they are. A
motion that all blocks share, as on a shaken table, is not enlarged but left out;
the line above the picture then says so. --scale 1 draws all where it is.

--principal adds crosses of the principal stresses on a regular grid: blue is
compression, red is tension, the length is the magnitude, in the scale of the
bar below. --colour stress fills the blocks with contours of the minor, that is
most compressive, principal stress. Both are averaged at the nodes of a block.

Of blocks in three dimensions they stand on what is seen of these, their arms in
the directions of all three stresses.

Blocks in three dimensions are seen from --camera; --cut draws what lies on one
side of a plane, --explode moves them apart. Their faces at joints have the colours
of joints where these open or slip. They need VTK's Python and, without a screen, Xvfb:
apt-get install python3-vtk9 xvfb.

  scripts/render OUTPUT_DIR --colour displacement --cut 'y<0.4' --camera 30,20
  scripts/render OUTPUT_DIR/mechanism --explode 0.3

Of a run of boundary elements it draws the field in the domain, the magnitude of
velocity or, with --colour displacement, of displacement, and the boundary.

  scripts/render OUTPUT_DIR --times 1e-3,2e-3,3e-3 --out wave.png

--animate writes a GIF, or with a name that ends in .png a strip of pictures,
of --frames moments at equal distances. --out may end in .pdf or .svg.
"""

import os
import sys

import numpy as np

from quoin.commands.options import (Cut, Parser, add_picture_options,
                                    camera, positive)
from quoin.figures import field_figure
from quoin.figures.block_figure import Picture, frames_of, is_in_space
from quoin.figures.page_layout import draw_moment, draw_panel, write_film
from quoin.moments import Moment, check_times, moments_at, recorded_times
from quoin.stages import begin, end, time_of, time_or_name, times_or_names


def times_of_film(series, options):
    """Recorded times at equal distances, each once."""
    times = recorded_times(options.output, series)
    if options.between:
        first, last = options.between
        low = time_of(options.output, first, begin)
        high = time_of(options.output, last, end)
        times = times[(times >= low) & (times <= high)]
    if len(times) == 0:
        raise ValueError("no field was written between these times")
    n = options.frames or (6 if options.animate.endswith(".png") else 60)
    wanted = np.linspace(times[0], times[-1], max(n, 2))
    nearest = np.abs(np.subtract.outer(wanted, times)).argmin(axis=1)
    return times[np.unique(nearest)]


def moments_from(series, options):
    if options.at:
        return moments_at(options.output, options.at, series)
    if options.animate:
        return [Moment(t) for t in times_of_film(series, options)]
    wanted = options.times or [options.time]
    if wanted != [None]:
        wanted = [time_of(options.output, moment, end) for moment in wanted]
        check_times(options.output, series, wanted)
    return [Moment(t) for t in wanted]


def read_options():
    parser = Parser(__doc__)
    parser.add_argument("output", metavar="OUTPUT_DIR")
    moment = parser.add_mutually_exclusive_group()
    moment.add_argument("--time", type=time_or_name,
                        help="[s], or a stage: its end; default the last")
    moment.add_argument("--times", type=times_or_names, metavar="T,T,...",
                        help="several output times in one figure")
    moment.add_argument("--at", metavar="COLUMN=VALUE,...",
                        help="where a history reaches values, peak or end")
    moment.add_argument("--animate", metavar="FILE",
                        help="a film, .gif, or a strip, .png")
    parser.add_argument("--frames", type=positive(int),
                        help="of --animate, default 60 (strip: 6)")
    parser.add_argument("--between", type=times_or_names, metavar="START,END",
                        help="of --animate [s], default all")
    add_picture_options(parser)
    space = parser.add_argument_group("three dimensions")
    space.add_argument("--camera", type=camera, default=[-60.0, 25.0],
                       metavar="AZIMUTH,ELEVATION",
                       help="where it is seen from [deg], from the axis x "
                            "towards y, and above the level; default -60,25")
    space.add_argument("--cut", type=Cut, metavar="'x<VALUE'",
                       help="draw what lies there in the mesh alone [m]; or "
                            "y or z, < or >")
    space.add_argument("--explode", type=positive(float), metavar="SHARE",
                       help="move blocks apart by this share of the distances "
                            "of their centres")
    parser.add_argument("--title")
    parser.add_argument("--out", metavar="FILE",
                        help="default OUTPUT_DIR/cracks.png, or field.png")
    options = parser.parse_args()
    if options.animate and not options.animate.endswith((".gif", ".png")):
        parser.error("--animate writes a .gif or a .png")
    if options.between and len(options.between) != 2:
        parser.error("--between takes two times or stages")
    if options.animate and options.out:
        parser.error("--animate names its file itself: leave --out away")

    return options


def space_figure():
    """The module that draws three dimensions, for which VTK must be there."""
    try:
        from quoin.figures import space_figure as module
    except ModuleNotFoundError as error:
        if not error.name.startswith("vtkmodules"):
            raise
        raise ValueError("pictures in three dimensions are drawn by VTK, whose "
                         "Python was not found. Install it: apt-get install "
                         "python3-vtk9, or pip install vtk") from None
    return module


def draw(options):
    """Writes the figure and returns its name."""
    is_field = field_figure.is_field_run(options.output)
    if is_field and options.colour == "stress":
        raise ValueError("--colour stress is for blocks")
    if is_field and options.since is not None:
        raise ValueError("--since is for blocks")
    moments = moments_from("boundary.pvd" if is_field else "blocks.pvd",
                           options)
    in_space = not is_field and is_in_space(options.output)
    if not in_space and (options.cut or options.explode):
        raise ValueError("--cut and --explode are for blocks in three "
                         "dimensions")
    frames = ([field_figure.FieldFrame(options.output, *moment)
               for moment in moments] if is_field else
              [space_figure().SpaceFrame(options.output, *moment)
               for moment in moments] if in_space else
              frames_of(options.output, moments, options.since))
    picture = (field_figure.FieldPicture if is_field
               else space_figure().SpacePicture if in_space else Picture)(options, frames)
    if options.animate and options.animate.endswith(".gif"):
        write_film(picture, frames, options.animate)
        return options.animate
    path = (options.animate or options.out
            or os.path.join(options.output, "field.png" if is_field
                            else "cracks.png"))
    figure = (draw_moment(picture, frames[0]) if len(frames) == 1
              else draw_panel(picture, frames))
    figure.savefig(path, bbox_inches="tight")
    return path


def main():
    try:
        print(draw(read_options()))
    except (OSError, ValueError) as error:
        sys.exit(f"render: {error}")


if __name__ == "__main__":
    main()
