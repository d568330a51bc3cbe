# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""The usual views of a run in ParaView: pictures, films, or a state to go on
from in its window.

  scripts/paraview_view OUTPUT_DIR                         view.png of the end
  scripts/paraview_view OUTPUT_DIR --view velocity --time 0.2 --out wave.png
  scripts/paraview_view OUTPUT_DIR --view crosses --scale 200
  scripts/paraview_view OUTPUT_DIR --view velocity --range 0,0.5 --animate film.png
  scripts/paraview_view OUTPUT_DIR --view block --state view.pvsm

Views:

  stress        deformed blocks coloured by the minor, that is most compressive,
                principal stress [MPa]
  velocity, displacement
                by its magnitude
  block, material
                each in one of a few tints that can be told apart
  crosses       principal stresses as crosses: blue compression, red tension;
                the bar below is their scale, beyond 2.5 times it they are cut
  field         of a run of boundary elements: the field in the domain, by the
                magnitude of the velocity, and the boundary

Above each stands what it shows, the time and the scale of displacements. A motion
that all blocks share, as on a shaken table, is not enlarged but left out, and it
says so. All but the field have the joints on top, by their state: slipping orange, slipped
earlier yellow, open dark red, intact thin and grey; contacts of large
displacements that press, slipping orange, others blue; and boundary elements, if
there are any, black.
--no-joints leaves joints and contacts out.

--animate film.png writes film.0000.png, film.0001.png ... of all recorded times,
or of those --between START,END, which ffmpeg or ImageMagick make a film of.
--state writes a file for File > Load State of ParaView's window.

It needs ParaView 5.10 or later: on Debian and Ubuntu 'apt-get install paraview
python3-paraview', elsewhere its own installer. It is run by pvpython if
python3 does not find ParaView. Without a screen put 'xvfb-run -a -s -noreset'
before it (package xvfb).

In ParaView's window, View > Python Shell:

  import runpy
  show = runpy.run_path("scripts/paraview_view")["show"]
  show("parameter_files/masonry/tue_walls/output/j4d", "stress", scale=100)
"""

import argparse
import math
import os
import shutil
import sys

from quoin import colours, vtu
from quoin.csv_table import with_unit
from quoin.commands.options import Parser
from quoin.moments import time_form
from quoin.screen import has_screen
from quoin.shared_motion import Motion, shared_motion
from quoin.stages import end, time_of, time_or_name


def rgb(colour):
    """"#rrggbb" as three numbers."""
    return [int(colour[k:k + 2], 16) / 255.0 for k in (1, 3, 5)]


JOINT_STATES = [("intact", 0, 0, rgb(colours.INTACT), 1),
                ("slipped", 2, 2, rgb(colours.YELLOW), 3),
                ("slipping", 1, 1, rgb(colours.ORANGE), 4),
                ("open", 3, 3, rgb(colours.RED), 4)]
CONTACT_STATES = [("failed contact", 2, 2, rgb(colours.COMPRESSION), 2),
                  ("contact", 0, 0, rgb(colours.COMPRESSION), 2),
                  ("slipping contact", 1, 1, rgb(colours.ORANGE), 3)]
CROSSES = 600                       # at most
ACROSS = 30                          # as many of the reference side by side
LONGEST = 2.5                        # of the reference, in a cross
WIDTH = 1200                         # [pixels]
INK = (0.1, 0.1, 0.1)
TITLES = {"stress": "minor principal stress", "block": "blocks",
          "material": "materials", "crosses": "principal stresses, blue "
          "compression, red tension", "field": "velocity"}


def round_down(value):
    """1, 2 or 5 times a power of ten."""
    power = 10.0 ** math.floor(math.log10(value))
    return power * max(f for f in (1, 2, 5) if f * power <= 1.0001 * value)


def find_paraview():
    """paraview.simple; by pvpython, if this python does not know it."""
    try:
        import paraview.simple
    except ImportError:
        pvpython = shutil.which("pvpython")
        if pvpython is None or "QUOIN_PVPYTHON" in os.environ:
            sys.exit("paraview_view: ParaView was not found. Install it, e.g. "
                     "'apt-get install paraview python3-paraview', or put its "
                     "pvpython onto the PATH.")
        os.environ["QUOIN_PVPYTHON"] = "1"
        os.execv(pvpython, [pvpython, *sys.argv])
    return paraview.simple


class Views:
    """The pipelines of a run, in one view of ParaView."""

    def __init__(self, output, name="stress", scale=None, joints=True,
                 limits=None, time=None):
        self.pv = find_paraview()
        self.pv._DisableFirstRenderCameraReset()
        self.output = output
        self.limits = limits
        is_field = name == "field"
        self.times = None
        self.main = self.series("field" if is_field else "blocks")
        if self.main is None and is_field:
            self.main = self.series("boundary")
        if self.main is None:
            raise ValueError(f"{output} has no "
                             f"{'field' if is_field else 'blocks'}.pvd "
                             "or .xdmf")
        self.time_form = time_form(self.times)
        self.dim = self.dimension()
        self.window = self.pv.GetActiveViewOrCreate("RenderView")
        self.time = self.nearest(self.times[-1] if time is None else time)
        self.window.ViewTime = self.time
        self.coloured = self.bar = None
        self.scale = 0.0 if is_field else (
            self.automatic_scale() if scale is None else scale)
        self.what = name
        self.moving = []
        self.is_shared = self.shared(self.time) is not None
        self.draw_field() if is_field else self.draw_blocks(name)
        if joints and not is_field:
            self.draw_joints(self.series("joints"), "joints", JOINT_STATES)
            self.draw_joints(self.series("contacts"), "contacts",
                             CONTACT_STATES)
        self.draw_boundary()
        self.title = self.pv.Text(registrationName="title")
        self.draw_text(self.title, WindowLocation="Upper Center")
        self.look()

    def series(self, name):
        """Fields of the series as one grid; None if there are none."""
        path = os.path.join(os.path.abspath(self.output), name + ".pvd")
        if not vtu.exists(path) or not any(
                pieces for _, pieces in vtu.read_pvd(path)):
            return None
        if os.path.exists(path):
            found = reader = self.pv.PVDReader(FileName=path,
                                               registrationName=name)
        else:
            reader = self.pv.Xdmf3ReaderS(FileName=vtu.xdmf_of(path),
                                          registrationName=name + " in pieces")
            found = self.pv.MergeBlocks(Input=reader, registrationName=name)
            found.MergePoints = 0  # of blocks that touch
        reader.UpdatePipelineInformation()
        if self.times is None:
            self.times = list(reader.TimestepValues or [0.0])
        return found

    def dimension(self):
        """Of the blocks; the field of boundary elements has two."""
        path = os.path.join(self.output, "blocks.pvd")
        blocks = vtu.read_at(path) if vtu.exists(path) else None
        return 2 if blocks is None else blocks.cells.shape[1] - 1

    # Displacements ---------------------------------------------------------

    def automatic_scale(self):
        """The largest displacement at the end as 4 % of the size."""
        self.main.UpdatePipeline(self.times[-1])
        data = self.main.PointData["displacement"]
        # each component by itself: a translation of the whole does not count
        moved = max(data.GetRange(d)[1] - data.GetRange(d)[0]
                    for d in range(3))
        motion = self.motion(self.times[-1])
        if motion is not None and motion.turn != 0.0:
            blocks = self.blocks_at(self.times[-1])
            start = blocks.points
            u = blocks.point_data["displacement"][:, :start.shape[1]]
            moved = (motion.taken_off(start + u) - start).ptp(axis=0).max()
        size = self.size()
        if moved <= 1e-12 * size:
            return 1.0
        return round_down(max(0.04 * size / moved, 1.0))

    def blocks_at(self, time):
        return vtu.read_at(os.path.join(self.output, "blocks.pvd"), time)

    def motion(self, time):
        """That which all blocks share, or None."""
        blocks = self.blocks_at(time)
        return None if blocks is None else shared_motion(blocks)

    def shared(self, time):
        """The same, where displacements are enlarged."""
        return None if self.scale in (0.0, 1.0) else self.motion(time)

    def warped(self, source, name, is_joint=False):
        """Enlarged, without a motion that all blocks share; joints lie where
        they are now."""
        scale, vectors = self.scale - is_joint, "displacement"
        if self.is_shared:
            source = self.pv.Calculator(Input=source,
                                        registrationName=name + " beyond")
            source.ResultArrayName = vectors = "drawn displacement"
            self.moving.append((source, is_joint))
            self.leave_out(self.shared(self.time))
            scale = 1.0
        return self.pv.WarpByVector(
            Input=source, Vectors=["POINTS", vectors],
            ScaleFactor=scale, registrationName=name)

    def leave_out(self, motion):
        """Removes this Motion from all pictures from now on."""
        motion = motion or Motion(0.0, [0.0, 0.0])
        c, s = math.cos(motion.turn), math.sin(motion.turn)
        x, y, z = (*motion.shift, 0.0)[:3]
        for source, is_joint in self.moving:
            # where it is now without the motion, less where it was
            now = "coords" if is_joint else "coords+displacement"
            at = [f"(dot({now},{axis}Hat)-({float(far)!r}))"
                  for axis, far in zip("ijk", (x, y, z))]
            places = (f"(({c!r})*{at[0]}+({s!r})*{at[1]})*iHat"
                      f"+(({c!r})*{at[1]}-({s!r})*{at[0]})*jHat+{at[2]}*kHat")
            start = "(coords-displacement)" if is_joint else "coords"
            source.Function = (f"{self.scale!r}*({places}-{start})"
                               + ("-displacement" if is_joint else ""))

    # What is drawn ---------------------------------------------------------

    def multiplied(self, source, array, factor, name):
        """A source with an array of its cells times a factor, too."""
        scaled = self.pv.Calculator(Input=source, registrationName=name)
        scaled.AttributeType = "Cell Data"
        scaled.Function = f'{factor!r}*"{array}"'
        scaled.ResultArrayName = name
        return scaled

    def colour(self, shown, place, array, title, unit, scale, component=None):
        """Colours by an array, from the least to the largest value."""
        self.pv.ColorBy(shown, (place, array) if component is None
                        else (place, array, component))
        table = self.pv.GetColorTransferFunction(array)
        table.ColorSpace = "Lab"
        table.RGBPoints = [value for k, colour in enumerate(scale)
                           for value in (k / (len(scale) - 1), *rgb(colour))]
        if self.limits:
            table.RescaleTransferFunction(*self.limits)
        else:
            shown.RescaleTransferFunctionToDataRange(False, True)
            self.coloured = shown
        shown.SetScalarBarVisibility(self.window, True)
        bar = self.pv.GetScalarBar(table, self.window)
        bar.Title = f"{title} [{unit}]" if unit else title
        bar.ComponentTitle = ""
        bar.AutomaticLabelFormat = 0
        bar.LabelFormat = bar.RangeLabelFormat = "%.3g"
        bar.TitleColor = bar.LabelColor = INK
        self.bar = bar

    def tint(self, shown, blocks, name):
        """Blocks or materials, each in one of a few tints; neighbours are
        mostly of consecutive numbers."""
        blocks.UpdatePipeline(self.time)
        last = int(blocks.CellData[name].GetRange()[1])
        self.pv.ColorBy(shown, ("CELLS", name))
        table = self.pv.GetColorTransferFunction(name)
        table.InterpretValuesAsCategories = 1
        table.Annotations = [str(k // 2) for k in range(2 * last + 2)]
        tints = [rgb(colour) for colour in colours.MATERIALS]
        table.IndexedColors = [value for k in range(last + 1)
                               for value in tints[k % len(tints)]]
        shown.SetScalarBarVisibility(self.window, name == "material")
        if name == "material":
            self.bar = self.pv.GetScalarBar(table, self.window)
            self.bar.Title, self.bar.ComponentTitle = "material", ""
            self.bar.TitleColor = self.bar.LabelColor = INK

    def draw_text(self, text, **look):
        shown = self.pv.Show(text, self.window, "TextSourceRepresentation")
        shown.Color, shown.FontSize = INK, 20
        for name, value in look.items():
            setattr(shown, name, value)

    def draw_blocks(self, name):
        blocks = self.warped(self.main, "deformed blocks")
        if name == "stress":
            # factors of the unit that is shown
            if self.limits:
                self.limits = [1e-6 * value for value in self.limits]
            # the last one, as they are in the order of their values
            blocks = self.multiplied(blocks, f"principal stress {self.dim}",
                                     1e-6, "minor principal stress")
        shown = self.pv.Show(blocks, self.window)
        shown.Representation = "Surface"
        blocks.UpdatePipeline(self.time)
        if name == "stress":
            self.colour(shown, "CELLS", "minor principal stress",
                        "minor principal stress", "MPa", colours.VALUES[::-1])
        elif name in ("velocity", "displacement"):
            self.colour(shown, "POINTS", name, name,
                        "m/s" if name == "velocity" else "m",
                        colours.VALUES, "Magnitude")
        elif name in ("block", "material"):
            self.tint(shown, blocks, name)
        elif name == "crosses":
            shown.ColorArrayName = [None, ""]
            shown.DiffuseColor = shown.AmbientColor = (0.93, 0.91, 0.87)
            self.draw_crosses(blocks)
        else:
            raise ValueError(f"there is no view '{name}'")
        # flat colours: the plane has no relief
        shown.Ambient, shown.Diffuse, shown.Specular = 1.0, 0.0, 0.0

    def draw_crosses(self, blocks):
        """Bars along all principal directions, as long as the stress."""
        centres = self.pv.CellCenters(Input=blocks, registrationName="centres")
        centres.UpdatePipeline(self.time)
        reference = self.usual_stress(centres)
        length = self.size() / ACROSS
        most = LONGEST * reference
        for k in self.principal():
            name = f"cut stress {k}"
            cut = self.pv.Calculator(Input=centres, registrationName=name)
            cut.Function = (f'max(min("principal stress {k}", {most!r}), '
                            f'{-most!r})')
            cut.ResultArrayName = name
            bars = self.pv.Glyph(Input=cut, GlyphType="Line",
                                 registrationName=f"stress {k}")
            bars.OrientationArray = ["POINTS", f"principal direction {k}"]
            bars.ScaleArray = ["POINTS", name]
            bars.ScaleFactor = length / reference
            bars.GlyphMode = "Uniform Spatial Distribution (Bounds Based)"
            bars.MaximumNumberOfSamplePoints = CROSSES
            shown = self.pv.Show(bars, self.window)
            shown.LineWidth = 2.0
            self.pv.ColorBy(shown, ("POINTS", name))
            table = self.pv.GetColorTransferFunction(name)
            # no white between: the sign alone counts
            table.RGBPoints = [
                -most, *rgb(colours.COMPRESSION),
                -1e-9 * most, *rgb(colours.COMPRESSION),
                1e-9 * most, *rgb(colours.TENSION),
                most, *rgb(colours.TENSION)]
            shown.SetScalarBarVisibility(self.window, False)
        self.draw_scale(blocks, length, reference)

    def principal(self):
        """The numbers of the principal stresses."""
        return range(1, self.dim + 1)

    def usual_stress(self, centres):
        """A round number below the largest of each ten stresses [Pa], so
        that the few at a corner do not make all others invisible."""
        data = self.pv.servermanager.Fetch(centres).GetPointData()
        sizes = sorted(
            max(abs(data.GetArray(f"principal stress {k}").GetValue(i))
                for k in self.principal())
            for i in range(data.GetArray("principal stress 1")
                           .GetNumberOfTuples()))
        sizes = [size for size in sizes if size > 1e-6 * sizes[-1]] or [1.0]
        return round_down(sizes[int(0.9 * len(sizes))])

    def draw_scale(self, blocks, length, reference):
        """A bar as long as the cross of the reference stress, below all."""
        b = blocks.GetDataInformation().GetBounds()
        x, y, z = b[0], b[2] - 2.0 * length, b[4] if self.dim == 3 else 0.0
        bar = self.pv.Line(Point1=[x, y, z], Point2=[x + length, y, z],
                           registrationName="scale")
        self.draw_lines(bar, rgb(colours.COMPRESSION), 3)
        label = self.pv.Text(registrationName="stress of the scale")
        label.Text = (f"{with_unit(reference, 'Pa')}, cut at "
                      f"{with_unit(LONGEST * reference, 'Pa')}")
        self.draw_text(label, TextPropMode="Billboard 3D Text",
                       BillboardPosition=[x + 1.3 * length, y - 0.3 * length,
                                          z])

    def draw_joints(self, joints, name, states):
        """Their points lie at current positions: the displacement is in them
        once. Joints whose sides are farther apart than a block is wide are
        left out: the blocks have gone separate ways."""
        if joints is None:
            return
        moved = self.warped(joints, "deformed " + name, is_joint=True)
        apart = self.pv.Calculator(Input=moved, registrationName=name + " apart")
        square = '"slip"*"slip"' if self.dim == 2 else 'dot("slip","slip")'
        apart.Function = f'sqrt("opening"*"opening" + {square})'
        apart.ResultArrayName = "apart"
        moved = self.pv.Threshold(Input=apart, registrationName=name + " near")
        moved.Scalars = ["POINTS", "apart"]
        n_blocks = self.main.CellData["block"].GetRange()[1] + 1.0
        moved.LowerThreshold = 0.0
        moved.UpperThreshold = self.size() / math.sqrt(n_blocks)
        moved.ThresholdMethod = "Between"
        for label, low, high, colour, width in states:
            part = self.pv.Threshold(Input=moved, registrationName=label)
            part.Scalars = ["CELLS", "state"]
            part.LowerThreshold, part.UpperThreshold = low, high
            part.ThresholdMethod = "Between"
            self.draw_lines(part, colour, width)

    def draw_boundary(self):
        boundary = self.series("boundary")
        if boundary is not None:
            self.draw_lines(boundary, INK, 2)

    def draw_lines(self, source, colour, width):
        shown = self.pv.Show(source, self.window)
        shown.ColorArrayName = [None, ""]
        shown.DiffuseColor = shown.AmbientColor = colour
        shown.Ambient, shown.Diffuse = 1.0, 0.0
        shown.LineWidth = width
        # in front of the blocks
        shown.Position = [0.0, 0.0, 1e-4 * self.size()]

    def draw_field(self):
        shown = self.pv.Show(self.main, self.window)
        shown.Representation = "Surface"
        self.main.UpdatePipeline(self.time)
        place = ("POINTS" if "velocity" in self.main.PointData.keys()
                 else "CELLS")
        self.colour(shown, place, "velocity", "velocity", "m/s",
                    colours.VALUES, "Magnitude")
        shown.Ambient, shown.Diffuse, shown.Specular = 1.0, 0.0, 0.0

    # Camera, files ---------------------------------------------------------

    def size(self):
        bounds = self.main.GetDataInformation().GetBounds()
        return max(bounds[1] - bounds[0], bounds[3] - bounds[2],
                   bounds[5] - bounds[4], 1e-30)

    def look(self):
        """Directs the camera at the blocks or the field: from in front, in
        three dimensions with z up from the corner of the least x and y."""
        b = self.main.GetDataInformation().GetBounds()
        if self.bar is not None:
            self.bar.WindowLocation = "Any Location"
            # its labels are as wide on any picture
            self.bar.Position = [1.0 - 170.0 / self.window.ViewSize[0], 0.2]
            self.bar.ScalarBarLength = 0.6
        self.window.OrientationAxesVisibility = 0
        self.window.UseColorPaletteForBackground = 0
        self.window.Background = [1.0, 1.0, 1.0]
        if b[5] - b[4] > 1e-6 * self.size():
            self.window.OrientationAxesVisibility = 1
            self.window.CameraPosition = [-2.0, -3.0, 2.0]
            self.window.CameraFocalPoint = [0.0, 0.0, 0.0]
            self.window.CameraViewUp = [0.0, 0.0, 1.0]
            self.window.ResetCamera(False)
            return
        x, y = 0.5 * (b[0] + b[1]), 0.5 * (b[2] + b[3])
        self.window.InteractionMode = "2D"
        # room for the bar on the right, the title above and a scale below
        x += 0.08 * (b[1] - b[0]) if self.bar else 0.0
        self.window.CameraPosition = [x, y, 10.0 * self.size()]
        self.window.CameraFocalPoint = [x, y, 0.0]
        self.window.CameraViewUp = [0.0, 1.0, 0.0]
        self.window.CameraParallelProjection = 1
        width, height = self.window.ViewSize
        self.window.CameraParallelScale = max(
            0.5 * (b[3] - b[2]) + 0.1 * self.size(),
            0.65 * (b[1] - b[0]) * height / max(width, 1))

    def height(self, width):
        """Height of a picture of this width that the blocks fill."""
        b = self.main.GetDataInformation().GetBounds()
        ratio = ((b[3] - b[2] + 0.2 * self.size())
                 / max(1.3 * (b[1] - b[0]), 1e-30))
        is_plane = b[5] - b[4] <= 1e-6 * self.size()
        return int(width * min(max(ratio, 0.4), 1.6)) if is_plane \
            else 3 * width // 4

    def nearest(self, time):
        return min(self.times, key=lambda t: abs(t - time))

    def moment(self, time):
        """Text of a recorded time; the mechanism of a search for the factor of
        safety is listed by its factor."""
        if os.path.basename(os.path.abspath(self.output)) == "mechanism":
            return f"factor {time:.4g}"
        return f"t = {time:.{self.time_form}} s"

    def at(self, time):
        """The recorded time nearest to @p time [s], shown."""
        nearest = self.nearest(time)
        motion = self.shared(nearest)
        self.leave_out(motion)
        self.pv.GetAnimationScene().UpdateAnimationUsingDataTimeSteps()
        self.window.ViewTime = nearest
        self.title.Text = (
            f"{TITLES.get(self.what, self.what)}, {self.moment(nearest)}"
            + (f", displacements × {self.scale:g}"
               if self.scale not in (0.0, 1.0) else "")
            + (" without the motion of the whole" if motion else ""))
        self.pv.GetAnimationScene().AnimationTime = nearest
        self.pv.Render(self.window)
        return nearest

    def picture(self, path, size):
        self.pv.SaveScreenshot(path, self.window, ImageResolution=list(size),
                               OverrideColorPalette="")
        return path

    def film(self, path, size, between):
        root, ending = os.path.splitext(path)
        times = [t for t in self.times
                 if between is None or between[0] <= t <= between[1]]
        if not times:
            raise ValueError("no field was written between these times")
        if self.coloured is not None:
            self.coloured.RescaleTransferFunctionToDataRangeOverTime()
        for i, time in enumerate(times):
            self.at(time)
            self.picture(f"{root}.{i:04d}{ending}", size)
        return f"{root}.0000{ending} to {root}.{len(times) - 1:04d}{ending}"


def show(output, view="stress", scale=None, joints=True, limits=None,
         time=None):
    """For ParaView's Python shell: draws @p view of the run in folder
    @p output and returns the pipelines. @p limits: of the colours; @p time
    [s], default the last."""
    views = Views(output, view, scale, joints, limits, time)
    views.at(views.time)
    return views


def numbers(count):
    def convert(text):
        values = [float(word) for word in text.split(",")]
        if len(values) != count:
            raise argparse.ArgumentTypeError(f"expected {count} numbers with "
                                             f"commas between")
        return values
    return convert


def read_options():
    parser = Parser(__doc__)
    parser.add_argument("output", metavar="OUTPUT_DIR")
    parser.add_argument("--view", default="stress",
                        choices=("stress", "velocity", "displacement", "block",
                                 "material", "crosses", "field"),
                        help="default stress")
    parser.add_argument("--time", type=time_or_name,
                        help="[s], or a stage: its end; default the last")
    parser.add_argument("--scale", type=float,
                        help="of displacements, default automatic")
    parser.add_argument("--range", type=numbers(2), metavar="LOW,HIGH",
                        help="of the colours, in SI units, default that of "
                             "the picture, of a film that of all times")
    parser.add_argument("--no-joints", action="store_true")
    parser.add_argument("--size", type=numbers(2), metavar="WIDTH,HEIGHT",
                        help="[pixels], default 1200 and as high as the "
                             "blocks need")
    parser.add_argument("--out", metavar="FILE",
                        help="default OUTPUT_DIR/view.png")
    parser.add_argument("--animate", metavar="FILE.png",
                        help="a picture of each recorded time")
    parser.add_argument("--between", type=numbers(2), metavar="START,END",
                        help="of --animate [s], default all")
    parser.add_argument("--state", metavar="FILE.pvsm",
                        help="for ParaView's window")
    return parser.parse_args()


def main():
    options = read_options()
    pv = find_paraview()
    if not has_screen():
        sys.exit("paraview_view: ParaView draws on a screen and DISPLAY names "
                 "none. Put 'xvfb-run -a -s -noreset' before the command "
                 "(apt-get install xvfb), or take scripts/render.")
    try:
        window = pv.CreateView("RenderView")
        pv.SetActiveView(window)
        views = Views(options.output, options.view, options.scale,
                      not options.no_joints, options.range,
                      time_of(options.output, options.time, end))
        size = [int(value) for value in
                options.size or (WIDTH, views.height(WIDTH))]
        window.ViewSize = size
        views.look()
        time = views.at(views.time)
        print(f"{views.moment(time)}, displacements {views.scale:g} times"
              + (" without the motion of the whole" if views.is_shared
                 else ""))
        if options.state:
            pv.SaveState(options.state)
            print(options.state)
        if options.animate:
            print(views.film(options.animate, size, options.between))
        elif options.out or not options.state:
            print(views.picture(
                options.out or os.path.join(options.output, "view.png"), size))
    except (OSError, ValueError, RuntimeError) as error:
        sys.exit(f"paraview_view: {error}")


if __name__ == "__main__":
    main()
