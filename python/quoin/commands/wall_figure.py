# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Draws a load-displacement curve and, beside it, the wall at points of it.

  scripts/wall_figure OUTPUT_DIR --spec plot.json \\
               --at displacement=0.5e-3,1e-3,4e-3
  scripts/wall_figure OUTPUT_DIR --spec plot.json --at horizontal=peak,end \\
               --principal --blocks-only --out wall.pdf

On the left is the first figure of plot.json, see scripts/plot; letters mark the
moments on its first curve. On the right are the pictures that scripts/render
makes with the same --at and the same options, by default the cracks, as wide
as they open, in the colours of their modes.
"""

import os
import sys
import textwrap

from matplotlib.patheffects import withStroke
import matplotlib.pyplot as plt
import numpy as np

from quoin.commands.options import Parser, add_picture_options
from quoin.figures.block_figure import Picture, frames_of
from quoin.figures.curve_figure import CurveFigure, read_specs
from quoin.figures.page_layout import (PANEL_WIDTH, below, draw_lettered,
                                       legend_in, letter, place_legend)
from quoin.moments import moments_at

LEFT_SHARE = 0.44                    # of the width
HEIGHT = 3.6                         # [inch], aimed at
CAPTION = 1.45                       # [inch], width
LONGEST_LABEL = 36                   # [letters] of a line


def draw_curve(axes, curve, moments):
    curve.draw(axes)
    axes.set_xlabel(textwrap.fill(axes.get_xlabel(), LONGEST_LABEL))
    axes.set_ylabel(textwrap.fill(axes.get_ylabel(), LONGEST_LABEL))
    right = axes.get_xlim()[1]
    for k, moment in enumerate(moments):
        x, y = curve.place_at(moment.time)
        axes.plot(x, y, "o", color="black", markersize=4, zorder=5,
                  clip_on=False)
        # Below the curve and to its right, unless that is the edge.
        at_edge = x > 0.95 * right
        axes.annotate(f"({letter(k)})", (x, y), fontsize=9, zorder=6,
                      xytext=(-2 if at_edge else 3, -12),
                      textcoords="offset points",
                      ha="right" if at_edge else "left",
                      path_effects=[withStroke(linewidth=2, foreground="w")])


def arrangement(n, width, ratio):
    """Columns, rows and height [inch] of n pictures as many times wider than
    high as @p ratio, such that they are about as high as the curve and their
    captions have room; at most one place is free, for the legend."""
    found = []
    for columns in range(1, n + 1):
        rows = -(-n // columns)
        if columns == 1 or (rows * columns - n <= 1
                            and width / columns >= CAPTION):
            height = rows * (width / columns / ratio + 0.35)
            found.append((abs(np.log(height / HEIGHT)), columns, rows, height))
    return min(found)[1:]


def draw(options):
    """Writes the figure and returns its name."""
    moments = moments_at(options.output, options.at)
    frames = frames_of(options.output, moments, options.since)
    picture = Picture(options, frames)
    curve = CurveFigure(read_specs(options.spec)[0], [(options.output, None)],
                        os.path.dirname(options.spec))

    if len(curve.panels()) > 1:
        raise ValueError(f"{options.spec}: its curves have several units and "
                         "would need as many axes: leave some of them out, or "
                         "take scripts/plot")

    bars = picture.colour_bars()
    width = PANEL_WIDTH * (1.0 - LEFT_SHARE) - 0.9 * len(bars)
    n_columns, n_rows, height = arrangement(
        len(frames), width, picture.extent[0] / picture.extent[1])
    figure = plt.figure(figsize=(PANEL_WIDTH, np.clip(height, 2.6, 9.0)),
                        constrained_layout=True)
    left, right = figure.subfigures(
        1, 2, width_ratios=(LEFT_SHARE, 1.0 - LEFT_SHARE))
    for part in (left, right):
        part.set_facecolor("none")
    axes = left.subplots()
    # No taller than wide, as rows of pictures are, and not flat.
    axes.set_box_aspect(np.clip(height / (LEFT_SHARE * PANEL_WIDTH), 0.7, 1.0))
    axes.set_anchor("N")
    draw_curve(axes, curve, moments)

    all_axes = right.subplots(n_rows, n_columns, squeeze=False)
    handles = draw_lettered(picture, frames, all_axes.flat)
    for mappable, label in bars:
        right.colorbar(mappable, label=label, ax=all_axes, shrink=0.8)
    free = list(all_axes.flat[len(frames):])
    if free and handles:
        legend_in(free[0], handles, picture.remark())
    else:
        for spare in free:
            spare.set_visible(False)
        place_legend(figure, all_axes.flat, handles, picture.remark())
    if curve.has_legend(axes):
        # within the axes it would lie on the marks of the pictures
        figure.legend(*axes.get_legend_handles_labels(), fontsize=7.5,
                      loc="upper center", bbox_to_anchor=below(figure, [axes]))
    if options.title:
        figure.suptitle(options.title)
    path = options.out or os.path.join(options.output, "wall.png")
    figure.savefig(path, bbox_inches="tight")
    return path


def main():
    parser = Parser(__doc__)
    parser.add_argument("output", metavar="OUTPUT_DIR")
    parser.add_argument("--spec", metavar="plot.json", required=True)
    parser.add_argument("--at", metavar="COLUMN=VALUE,...", required=True,
                        help="where a history reaches values, peak or end")
    add_picture_options(parser, joints="mode")
    parser.add_argument("--title")
    parser.add_argument("--out", metavar="FILE",
                        help="default OUTPUT_DIR/wall.png")
    options = parser.parse_args()
    if options.colour == "displacement":
        parser.error("--colour displacement is for the field of boundary "
                     "elements")
    try:
        print(draw(options))
    except (OSError, ValueError) as error:
        sys.exit(f"wall_figure: {error}")


if __name__ == "__main__":
    main()
