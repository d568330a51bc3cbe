#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""How pictures look: units, places of legends and scales on wide and on tall
models, widths of cracks, and whether colour-blind readers can tell colours
apart."""
import itertools
import os
import subprocess
import sys
import tempfile
import types
import unittest
from unittest import mock

import numpy as np

from synthetic_runs import SCRIPTS, Scratch, write_vtu
from quoin.commands import paraview_view
from quoin.commands import plot
from quoin.figures import block_figure
from quoin import colours
from quoin import csv_table
from quoin import moments
from quoin.figures import curve_figure
from quoin.figures import field_figure
from quoin.figures import figure_style
from quoin.figures import joint_figure
from quoin.figures import page_layout
from quoin import shared_motion
from quoin.vtu import Grid
from matplotlib.colors import to_rgb
import matplotlib.pyplot as plt


class Units(unittest.TestCase):
    def test_unit_of_a_column_times_a_factor(self):
        for name, factor, wanted in (
                ("ux [m]", 1e3, "ux [mm]"), ("fh [N]", -1e-3, "-fh [kN]"),
                ("p [Pa]", 1e-6, "p [MPa]"), ("v [m/s]", 1e3, "v [mm/s]"),
                ("moment [N m]", 1e-3, "moment [kN m]"),
                ("u [m]", 1., "u [m]"), ("u [m]", -1., "-u [m]"),
                ("u [m]", 2., "2 × u [m]"), ("turn [deg]", 1e3,
                                             "1000 × turn [deg]"),
                ("area [m^2]", 1e3, "1000 × area [m^2]"),
                ("share [-]", 100., "100 × share [-]"), ("u", 1., "u")):
            self.assertEqual(csv_table.scaled_name(name, factor), wanted)

    def test_numbers_end_in_a_digit(self):
        self.assertEqual(csv_table.with_unit(-191.2e3, "N", "#.3g"), "-191 kN")
        self.assertEqual(csv_table.with_unit(1.2e-3, "m", "#.3g"), "1.20 mm")
        self.assertEqual(csv_table.as_text(-0.5), "-0.500")


class Axes(Scratch):
    def setUp(self):
        super().setUp()
        with open(os.path.join(self.folder, "histories.csv"), "w") as file:
            file.write("time [s],ux [m],uy [m],p [Pa],share [-]\n0,0,0,0,0\n"
                       "1,1e-3,2e-3,5e6,1\n")

    def figure(self, **spec):
        columns = spec.pop("columns", ("ux", "uy", "p", "share"))
        return curve_figure.CurveFigure(
            dict({"curves": [{"column": c} for c in columns]}, **spec),
            [(self.folder, None)], self.folder)

    def panels(self, **spec):
        figure = self.figure(**spec)
        return [([curve["column"] for _, curve in panel],
                 figure.label_of(panel)) for panel in figure.panels()]

    def test_metres_and_pascals_are_on_different_axes(self):
        self.assertEqual(self.panels(), [(["ux", "uy"], "[m]"),
                                         (["p"], "p [Pa]"),
                                         (["share"], "share [-]")])
        # a label with a unit is meant for all, another one is not
        self.assertEqual(len(self.panels(y={"label": "all [SI]"})), 1)
        self.assertEqual([label for _, label in
                          self.panels(y={"label": "all"})],
                         ["all [m]", "all [Pa]", "all"])

    def test_units_below_factors(self):
        figure = self.figure(x={"column": "ux", "factor": 1e3}, columns=["p"],
                             y={"factor": -1e-6})
        self.assertEqual((figure.x_label, figure.y_label),
                         ("ux [mm]", "-p [MPa]"))

    def test_labels_without_a_unit_get_it(self):
        figure = self.figure(x={"column": "ux", "factor": 1e3, "label": "push"},
                             columns=["p"], y={"factor": 1e-6, "label": "p"})
        self.assertEqual((figure.x_label, figure.y_label),
                         ("push [mm]", "p [MPa]"))
        figure = self.figure(x={"label": "since noon [h]"}, columns=["p"])
        self.assertEqual(figure.x_label, "since noon [h]")

    def test_after_a_time(self):
        curve = {"column": "p"}
        for after, rows in ((0., 2), (0.5, 1), (None, 2)):
            figure = self.figure(columns=["p"], after=after) if after \
                is not None else self.figure(columns=["p"])
            self.assertEqual(len(figure.points(self.folder, curve)[0]), rows)
        with self.assertRaisesRegex(ValueError, "no row is after 2 s"):
            self.figure(after=2.)
        with open(os.path.join(self.folder, "safety.csv"), "w") as file:
            file.write("trial,factor\n1,1\n")
        with self.assertRaisesRegex(ValueError, "have no time"):
            self.figure(columns=["factor"], table="safety.csv", after=0.)

    def test_after_a_stage_began(self):
        with open(os.path.join(self.folder, "summary.json"), "w") as file:
            file.write('{"stages": {"settle": {"time [s]": 0.5}}}')
        with open(os.path.join(self.folder, "used_parameters.prm"), "w") as f:
            f.write("subsection Stages\nset Names = settle, push\nend\n")
        figure = self.figure(columns=["p"], after="push")
        self.assertEqual(list(figure.points(self.folder, {"column": "p"})[0]),
                         [1.])

    def test_references_are_on_the_axes_of_their_column(self):
        with open(os.path.join(self.folder, "r.csv"), "w") as file:
            file.write("time,p,q\n0,1,2\n1,2,3\n")
        figure = self.figure(references=[
            {"file": "r.csv", "x": "time", "y": y} for y in ("p", "q")])
        drawn = []
        for panel in figure.panels():
            axes = plt.figure().subplots()
            figure.draw_references(axes, panel)
            drawn.append(len(axes.lines))
        self.assertEqual(drawn, [1, 1, 0])      # q, which has none, is first
        plt.close("all")

    def test_negative_factors_on_the_command_line(self):
        def plot(*words):
            done = subprocess.run(
                [sys.executable, os.path.join(SCRIPTS, "plot"), self.folder,
                 "--out", os.path.join(self.folder, "p.png"), *words],
                stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
            return done.stderr
        self.assertEqual(plot("--y-factor", "-1e3", "--band", "-1e3", "-.5"),
                         "")
        self.assertIn("expected 2 arguments", plot("--band", "-1e3", "--peak"))
        self.assertEqual(plot("--band", "1", "2", "--band-label", "tests"), "")
        self.assertIn("0 --band and 1 --band-label",
                      plot("--band-label", "tests"))

    def options(self, **others):
        words = dict(output=[self.folder], table="histories.csv", x=None,
                     y=None, x_factor=None, y_factor=None, x_label=None,
                     y_label=None, reference=[], reference_scaled=False,
                     band=[])
        return types.SimpleNamespace(**dict(words, **others))

    def test_units_that_can_be_read(self):
        """ux and uy up to 2 mm, p to 5 MPa."""
        spec = plot.spec_from_options(self.options())
        self.assertEqual([curve["factor"] for curve in spec["curves"]],
                         [1e3, 1e3, 1e-6, 1.])
        figure = curve_figure.CurveFigure(spec, [(self.folder, None)], "")
        self.assertEqual([figure.label_of(panel) for panel in figure.panels()],
                         ["[mm]", "p [MPa]", "share [-]"])
        spec = plot.spec_from_options(self.options(x="ux"))
        self.assertEqual(spec["x"]["factor"], 1e3)
        for others in ({"y_factor": 2.}, {"band": [["1", "2"]]},
                       {"y_label": "all"}):
            spec = plot.spec_from_options(self.options(**others))
            self.assertNotIn("factor", spec["curves"][0])
            self.assertEqual(spec["y"]["factor"], others.get("y_factor", 1.))

    def test_columns_of_zeros_are_left_out(self):
        with open(os.path.join(self.folder, "energies.csv"), "w") as file:
            file.write("time [s],a [J],b [J]\n0,0,0\n1,0,2\n")
        def columns(**others):
            return [curve["column"] for curve in plot.spec_from_options(
                self.options(table="energies.csv", **others))["curves"]]
        self.assertEqual(columns(), ["b [J]"])
        self.assertEqual(columns(y=["a", "b"]), ["a", "b"])

    def test_curves_of_one_run_can_be_told_apart(self):
        names = [f"a{k} [J]" for k in range(20)]
        with open(os.path.join(self.folder, "energies.csv"), "w") as file:
            file.write("time [s]," + ",".join(names) + "\n"
                       + 2 * ("1" + 20 * ",1" + "\n"))
        figure = self.figure(columns=names, table="energies.csv")
        axes = plt.figure().subplots()
        figure.draw_runs(axes, figure.panels()[0])
        self.assertEqual(len({(to_rgb(line.get_color()), line.get_linestyle())
                              for line in axes.lines}), 20)
        plt.close("all")

    def test_labels_of_bands(self):
        options = types.SimpleNamespace(
            band=[["1", "2"], ["3", "4"]], band_label=["tests", "code"])
        self.assertEqual([band["label"] for band in plot.bands_from(options)],
                         ["tests", "code"])


def blocks(width, height):
    """A row or a column of unit squares, under stress, that moves upwards."""
    points, cells = [], []
    for i in range(width):
        for j in range(height):
            n = len(points)
            points += [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)]
            cells += [(n, n + 1, n + 2), (n, n + 2, n + 3)]
    points = np.array(points, float)
    number = np.repeat(np.arange(width * height), 2)
    moved = 1e-3 * np.stack([0. * points[:, 1], points[:, 1],
                             0. * points[:, 1]], axis=1)
    return Grid(0., points, np.array(cells), {
        "displacement": moved, "velocity": moved}, {
        "block": number, "material": number,
        "stress": np.tile([0., -1e6, 0., 0.], (len(cells), 1))})


class Places(unittest.TestCase):
    def draw(self, width, height, shift=0., **options):
        grid = blocks(width, height)
        grid.point_data["displacement"] += [shift, 0., 0.]
        frame = types.SimpleNamespace(
            blocks=grid, joints=None, contacts=None, cables=None, beams=None,
            time=0., label=None,
            shared=shared_motion.shared_motion(grid))
        frame.position = types.MethodType(block_figure.Frame.position, frame)
        words = dict(scale=1., view=None, colour="velocity", joints="state",
                     widest=None, blocks_only=False, principal=True,
                     crosses=None, mesh=False, title=None, since=None,
                     beams="line")
        picture = block_figure.Picture(
            types.SimpleNamespace(**dict(words, **options)), [frame])
        figure = page_layout.draw_moment(picture, frame)
        self.addCleanup(plt.close, figure)
        figure.canvas.draw()
        return figure, figure.axes[0], figure.canvas.get_renderer()

    def test_the_legend_is_below_the_axis_title(self):
        for size in ((40, 1), (6, 3), (1, 20)):
            figure, axes, renderer = self.draw(*size)
            legend = figure.legends[0].get_window_extent(renderer)
            title = axes.xaxis.label.get_window_extent(renderer)
            self.assertLess(legend.y1, title.y0, size)
            # and not far
            self.assertLess(title.y0 - legend.y1, 40., size)

    def test_the_caption_names_what_is_left_out(self):
        for shift, scale, left_out in ((1., 5., True), (1., 1., False),
                                       (0., 5., False)):
            _, axes, _ = self.draw(2, 2, shift, scale=scale)
            self.assertEqual("without the motion of the whole"
                             in axes.get_title(), left_out)
            # the view is around what is drawn
            self.assertLess(axes.get_xlim()[1] - shift * (scale == 1.), 2.1)

    def test_the_caption_says_since_when(self):
        for since, words in (("push", "since push began"),
                             (0.25, "since t = 0.25 s")):
            _, axes, _ = self.draw(2, 2, since=since)
            self.assertIn(words, axes.get_title())

    def test_the_colour_bar_is_beside_the_blocks(self):
        for size in ((40, 1), (6, 3), (1, 20)):
            figure, axes, renderer = self.draw(*size)
            place = axes.get_window_extent(renderer)
            bar = figure.axes[1].get_window_extent(renderer)
            self.assertGreater(bar.x0, place.x1, size)
            self.assertAlmostEqual(bar.width, 0.15 * figure.dpi, delta=1.)
            self.assertAlmostEqual(bar.height, place.height, delta=1.)

    def test_levels_beside_a_wide_model(self):
        figure, _, renderer = self.draw(20, 2, colour="stress")
        places = [label.get_window_extent(renderer) for label in
                  figure.axes[1].get_yticklabels()]
        self.assertGreater(len(places), 1)
        for below, above in zip(places, places[1:]):
            self.assertLess(below.y1, above.y0)

    def test_the_scale_is_below_the_blocks(self):
        for size, view in (((40, 1), None), ((6, 3), None), ((1, 20), None),
                           ((6, 3), (1., 1., 5., 2.))):
            figure, axes, renderer = self.draw(*size, view=view)
            lowest = axes.transData.transform((0., view[1] if view else 0.))[1]
            label, = (text for text in axes.texts if "Pa" in text.get_text())
            extent = label.get_window_extent(renderer)
            self.assertLess(extent.y1, lowest + 1., (size, view))
            self.assertGreater(
                extent.y0, axes.get_window_extent(renderer).y0 - 1.,
                (size, view))


class Times(unittest.TestCase):
    """What stands above pictures of several moments tells them apart."""

    def test_of_a_panel(self):
        for times, form in (([0.1, 0.2], "4g"), ([12.009, 12.011], "3f"),
                            ([0.], "4g"), ([3., 3.], "4g")):
            self.assertEqual(moments.time_form(times), form)
        self.assertEqual(moments.time_form([1.001, 1.002], 3), "3f")

    def test_of_a_film(self):
        for times, form in (([0., 1., 2.], "2f"), ([0., 2e-4, 4e-4], "4f"),
                            ([5.], "2f")):
            self.assertEqual(moments.film_form(times), form)

    def test_captions(self):
        frames = [types.SimpleNamespace(time=time, label=None)
                  for time in (12.0093, 12.0107)]

        class Drawn:
            DIGITS = 4
            caption = block_figure.Picture.caption

            def draw(self, axes, frame, with_count):
                return []

        figure, axes = plt.subplots(1, 2)
        self.addCleanup(plt.close, figure)
        page_layout.draw_lettered(Drawn(), frames, axes)
        self.assertEqual([part.get_title() for part in axes],
                         ["(a) t = 12.009 s", "(b) t = 12.011 s"])

    def test_milliseconds(self):
        class Frame:
            time, label = 0.01234, None
        for form, text in (("3g", "12.3"), ("4f", "12.3"), ("2f", "12")):
            self.assertEqual(field_figure.FieldPicture.caption(
                None, Frame, form), f"t = {text} ms")


class ParaView(unittest.TestCase):
    """What is asked of ParaView, which need not be there."""

    def views(self, dim):
        views = paraview_view.Views.__new__(paraview_view.Views)
        for name, value in dict(pv=mock.MagicMock(), main=None, window=None,
                                time=0., scale=1., is_shared=False, dim=dim,
                                limits=None).items():
            setattr(views, name, value)
        return views

    def test_the_minor_stress_is_the_last_one(self):
        for dim in (2, 3):
            views = self.views(dim)
            views.draw_blocks("stress")
            self.assertEqual(views.pv.Calculator.return_value.Function,
                             f'1e-06*"principal stress {dim}"')

    def test_crosses_have_an_arm_for_each_stress(self):
        for dim in (2, 3):
            views = self.views(dim)
            with mock.patch.multiple(
                    views, size=lambda: 1., usual_stress=lambda _: 1e6,
                    draw_scale=mock.DEFAULT):
                views.draw_crosses(mock.MagicMock())
            self.assertEqual(
                [call.kwargs["registrationName"]
                 for call in views.pv.Glyph.call_args_list],
                [f"stress {k + 1}" for k in range(dim)])

    def test_a_mechanism_has_a_factor_and_no_time(self):
        views = self.views(2)
        for output, text in (("run", "t = 1.50 s"), ("run/mechanism/",
                                                     "factor 1.5")):
            views.output, views.time_form = output, "2f"
            self.assertEqual(views.moment(1.5), text)

    def test_dimension(self):
        with tempfile.TemporaryDirectory() as folder:
            views = self.views(None)
            views.output = folder
            self.assertEqual(views.dimension(), 2)
            write_vtu(os.path.join(folder, "blocks.vtu"), 0., np.eye(4, 3),
                      np.array([[0, 1, 2, 3]]), {}, {})
            with open(os.path.join(folder, "blocks.pvd"), "w") as file:
                file.write('<VTKFile><Collection><DataSet timestep="0" '
                           'file="blocks.vtu"/></Collection></VTKFile>')
            self.assertEqual(views.dimension(), 3)


class Cracks(unittest.TestCase):
    """Blocks of 0.1 m, most cracks of 0.1 mm, many joints that only strained
    a little."""

    cracks = np.concatenate([np.full(60, 1e-4), np.full(300, 1e-9),
                             np.zeros(300)])

    def usual(self, *others):
        return joint_figure.usual_width(
            np.concatenate([self.cracks, *others]), 0.1)

    def test_a_unit_that_comes_away_does_not_set_the_scale(self):
        self.assertAlmostEqual(self.usual(), 1e-4)
        for gap in (0.3e-3, 3e-3, 30e-3, 0.3):
            self.assertAlmostEqual(self.usual(np.full(12, gap)), 1e-4)
        # many gaps: only their size tells them from cracks
        self.assertAlmostEqual(self.usual(np.full(40, 30e-3)), 1e-4)

    def test_gaps_alone(self):
        self.assertEqual(joint_figure.usual_width(np.full(4, 0.2), 0.1), 0.2)
        self.assertEqual(joint_figure.usual_width(np.zeros(4), 0.1), 1e-5)

    def test_size_of_blocks(self):
        self.assertAlmostEqual(joint_figure.block_size(blocks(3, 2)), 1.)


# linear RGB as seen without one kind of cones: @cite MachadoOliveiraFernandes2009
SIGHT = {
    "normal": np.eye(3),
    "no long": [[0.152286, 1.052583, -0.204868],
                [0.114503, 0.786281, 0.099216],
                [-0.003882, -0.048116, 1.051998]],
    "no middle": [[0.367322, 0.860646, -0.227968],
                  [0.280085, 0.672501, 0.047413],
                  [-0.011820, 0.042940, 0.968881]],
    "no short": [[1.255528, -0.076749, -0.178779],
                 [-0.078411, 0.930809, 0.147602],
                 [0.004733, 0.691367, 0.303900]]}
TO_XYZ = np.array([[0.4124564, 0.3575761, 0.1804375],
                   [0.2126729, 0.7151522, 0.0721750],
                   [0.0193339, 0.1191920, 0.9503041]])


def seen(palette, sight):
    """CIE L*a*b* of sRGB colours."""
    rgb = np.array([to_rgb(colour) for colour in palette])
    rgb = np.where(rgb <= 0.04045, rgb / 12.92, ((rgb + 0.055) / 1.055) ** 2.4)
    rgb = np.clip(rgb @ np.transpose(sight), 0., 1.)
    xyz = rgb @ TO_XYZ.T / [0.95047, 1., 1.08883]
    f = np.where(xyz > 0.008856, np.cbrt(xyz), 7.787 * xyz + 16. / 116.)
    return np.stack([116. * f[:, 1] - 16., 500. * (f[:, 0] - f[:, 1]),
                     200. * (f[:, 1] - f[:, 2])], axis=1)


class Colours(unittest.TestCase):
    """2.3 is a just noticeable difference of two areas side by side; lines
    apart from each other need much more."""

    def apart(self, palette, least):
        for name, sight in SIGHT.items():
            lab = seen(palette, sight)
            for a, b in itertools.combinations(range(len(lab)), 2):
                self.assertGreater(np.linalg.norm(lab[a] - lab[b]), least,
                                   (name, palette[a], palette[b]))

    def test_lines_and_tints(self):
        c = colours
        self.apart([c.INTACT, c.YELLOW, c.ORANGE, c.RED], 20.)
        self.apart([c.INTACT, c.ORANGE, c.RED, c.VIOLET], 20.)
        self.apart([c.COMPRESSION, c.TENSION], 20.)
        self.apart([c.COMPRESSION, c.ORANGE], 20.)
        self.apart(c.CURVES, 15.)
        self.apart(c.MATERIALS, 10.)

    def test_joints_on_blocks(self):
        for colour in (colours.YELLOW, colours.ORANGE, colours.RED):
            for below in (*colours.MATERIALS, *colours.VALUES):
                self.apart([colour, below], 10.)

    def test_scales_grow_in_lightness(self):
        scales = [figure_style.MAGNITUDES, figure_style.STRESSES.reversed(),
                  joint_figure.DAMAGE_COLOURS, plt.get_cmap(colours.FIELD)]
        for scale in scales:
            for name, sight in SIGHT.items():
                lightness = seen(scale(np.linspace(0., 1., 17)), sight)[:, 0]
                self.assertLess(np.diff(lightness).max(), 0., (scale.name,
                                                               name))


if __name__ == "__main__":
    unittest.main()
