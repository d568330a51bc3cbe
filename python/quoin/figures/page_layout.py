# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Puts the pictures of scripts/render on a page: one, several, or a film.

A picture has draw(axes, frame, with_count), caption(frame, form), in which the time
has this form, remark(), colour_bars(), extent and DIGITS, those of a time.
"""

import io
import os

from matplotlib.colors import BoundaryNorm
import matplotlib.pyplot as plt
from matplotlib.transforms import ScaledTranslation
from mpl_toolkits.axes_grid1.inset_locator import inset_axes
import numpy as np

from quoin.moments import film_form, time_form

PANEL_WIDTH = 8.0                    # [inch]
LABELS_PER_INCH = 5
MOST_BYTES = 2e6                     # of a film


def height_for(width, extent):
    return np.clip(width * extent[1] / extent[0], 2.0, 9.0)


def hide_frame(axes):
    axes.set_xticks([])
    axes.set_yticks([])
    for spine in axes.spines.values():
        spine.set_visible(False)


def heading(picture, frame, form):
    remark = picture.remark()
    return picture.caption(frame, form) + (", " + remark if remark else "")


def times_of(frames):
    return [frame.time for frame in frames]


def draw_moment(picture, frame):
    """A figure of one moment."""
    height = height_for(6.5, picture.extent) + 1.0
    figure, axes = plt.subplots(figsize=(6.5, height),
                                constrained_layout=True)
    handles = picture.draw(axes, frame, with_count=True)
    axes.set_xlabel("x [m]")
    axes.set_ylabel("y [m]")
    title = picture.options.title
    axes.set_title((title + ", " if title else "")
                   + heading(picture, frame, f"{picture.DIGITS}g"))
    for k, (mappable, label) in enumerate(picture.colour_bars()):
        # As wide on any model, and as high as this one.
        beside = axes.transAxes + ScaledTranslation(
            0.15 + 1.0 * k, 0.0, figure.dpi_scale_trans)
        bar = figure.colorbar(mappable, label=label, cax=inset_axes(
            axes, width=0.15, height="100%", loc="lower left",
            bbox_to_anchor=(1.0, 0.0, 1.0, 1.0), bbox_transform=beside,
            borderpad=0.0))
        if isinstance(mappable.norm, BoundaryNorm):
            # beside a wide model there is no room for every level
            n = int(LABELS_PER_INCH * 5.0 * picture.extent[1]
                    / picture.extent[0])
            levels = mappable.norm.boundaries
            bar.set_ticks(levels[::-(-len(levels) // max(n, 2))])
    if handles:
        place_legend(figure, [axes], handles, None)
    return figure


def columns_for(n, ratio):
    """Number of pictures in a row, for rows of similar length."""
    most = min(n, 1 if ratio > 4 else 2 if ratio > 1.2 else 3
               if ratio > 0.6 else 4)
    return -(-n // -(-n // most))


def draw_panel(picture, frames, n_columns=None):
    """A figure of several moments, in rows of @p n_columns, by default as many
    as fit."""
    ratio = picture.extent[0] / picture.extent[1]
    bars = picture.colour_bars()
    n_columns = n_columns or columns_for(len(frames), ratio)
    n_rows = -(-len(frames) // n_columns)
    width = (PANEL_WIDTH - 0.9 * len(bars)) / n_columns - 0.1
    figure, all_axes = plt.subplots(
        n_rows, n_columns, squeeze=False, constrained_layout=True,
        figsize=(PANEL_WIDTH, n_rows * (min(width / ratio, 6.0) + 0.35)
                 + (0.3 if picture.options.title else 0.0)))
    handles = draw_lettered(picture, frames, all_axes.flat)
    for axes in all_axes.flat[len(frames):]:
        axes.set_visible(False)
    if picture.options.title:
        figure.suptitle(picture.options.title)
    for mappable, label in bars:
        figure.colorbar(mappable, label=label, ax=all_axes, shrink=0.8)
    place_legend(figure, all_axes.flat, handles, picture.remark())
    return figure


def draw_lettered(picture, frames, all_axes):
    """Pictures (a), (b), ...; returns what their legend shall have, in the
    order of the picture that has most."""
    handles, place = {}, {}
    form = time_form(times_of(frames), picture.DIGITS)
    for k, (axes, frame) in enumerate(zip(all_axes, frames)):
        for n, handle in enumerate(picture.draw(axes, frame,
                                                with_count=False)):
            label = handle.get_label()
            handles.setdefault(label, handle)
            place[label] = max(n, place.get(label, 0))
        axes.set_title(f"({letter(k)}) {picture.caption(frame, form)}",
                       fontsize=9)
        hide_frame(axes)
    return [handles[label] for label in sorted(handles, key=place.get)]


def letter(k):
    return chr(ord("a") + k % 26)


def in_rows(handles):
    """Number of columns of a legend, and the handles so that it reads row by
    row, though it is filled by columns."""
    n = len(handles)
    columns = n if n <= 5 else -(-n // 2)
    return {"ncol": columns,
            "handles": [h for k in range(columns) for h in handles[k::columns]]}


def legend_in(axes, handles, remark):
    """Draws the legend in axes of its own."""
    axes.axis("off")
    axes.legend(handles=handles, title=remark, title_fontsize=8, fontsize=8,
                loc="center")


def below(figure, all_axes):
    """The middle of what lies below these axes, in parts of the figure."""
    figure.canvas.draw()
    boxes = [axes.get_tightbbox(figure.canvas.get_renderer())
             for axes in all_axes if axes.get_visible()]
    return figure.transFigure.inverted().transform(
        (0.5 * (min(box.x0 for box in boxes) + max(box.x1 for box in boxes)),
         min(box.y0 for box in boxes)))


def place_legend(figure, all_axes, handles, remark):
    """Centred below these axes, the remark above it."""
    x, y = below(figure, all_axes)
    if handles:
        figure.legend(title=remark, title_fontsize=8, fontsize=8,
                      loc="upper center", bbox_to_anchor=(x, y),
                      borderaxespad=0.3, **in_rows(handles))
    else:
        figure.text(x, y - 0.02, remark, fontsize=8, ha="center", va="top")


def film_image(picture, frame, form, dpi):
    """One picture of a film; all of them are of the same size, and of one @p
    form of the time."""
    from PIL import Image

    height = height_for(6.5, picture.extent) + 0.4
    figure, axes = plt.subplots(figsize=(6.5, height), dpi=dpi,
                                constrained_layout=True)
    picture.draw(axes, frame, with_count=False)
    hide_frame(axes)
    axes.set_title(heading(picture, frame, form))
    for mappable, label in picture.colour_bars():
        figure.colorbar(mappable, label=label, ax=axes, shrink=0.8)
    stream = io.BytesIO()
    figure.savefig(stream, format="png", dpi=dpi)
    plt.close(figure)
    stream.seek(0)
    return Image.open(stream).convert("RGB")


def write_film(picture, frames, path):
    """A GIF in real time if that is neither too fast nor too slow to see, in
    as few dots as keep it below MOST_BYTES."""
    from PIL import Image

    span = frames[-1].time - frames[0].time
    form = film_form(times_of(frames))
    step = int(np.clip(1000 * span / max(len(frames) - 1, 1), 50, 200))
    for dpi in (100, 80, 60, 45, 30):
        images = [film_image(picture, frame, form, dpi) for frame in frames]
        # One palette for all, or the colours of the stones flicker; of octrees,
        # which keep what is seen in few places, such as slipping joints.
        sample = Image.fromarray(np.hstack(
            [np.asarray(images[k]) for k in
             {0, len(images) // 2, len(images) - 1}]))
        palette = sample.quantize(128, Image.Quantize.FASTOCTREE)
        images = [image.quantize(palette=palette, dither=Image.Dither.NONE)
                  for image in images]
        images[0].save(path, save_all=True, append_images=images[1:],
                       duration=[step] * (len(images) - 1) + [1500], loop=0,
                       optimize=True)
        if os.path.getsize(path) <= MOST_BYTES:
            return


