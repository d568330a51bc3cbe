# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Polygons of blocks as a gmsh geometry whose blocks share their edges.

  from quoin import geometry
  blocks = geometry.arch(4.0, 1.0, 0.4, 21, springer=(0.8, 0.5))
  blocks.append(geometry.Polygon("pier", "pier", [(-2.8, -3), ...]))
  geometry.write_geo("bridge.geo", blocks, size=0.2,
                     boundaries={"base": (-2.8, -3, 2.8, -3)})

Every polygon is a surface, every group a physical surface, every edge between
two polygons part of the physical curve 'joint': with "Joints along = joint"
these are the joints of quoin. Lengths are in metres.
"""

from collections import namedtuple
import csv
import json

import numpy as np

TOLERANCE = 1e-6                     # of the size of all, for what coincides
# vertices: (n, 2) [m], in either sense, the first one not repeated
Polygon = namedtuple("Polygon", "name group vertices")
# of polygons that share points and edges: points (n, 2) [m]; loops, numbers of
# the points of each, anticlockwise; edges {(from, to): [polygons]}, of a pair
# that two polygons use in the two senses the smaller number first; hanging, how
# many vertices were set into edges of others
Partition = namedtuple("Partition", "points loops edges hanging")


def cross(a, b):
    return a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]


def area_of(vertices):
    """Area of a polygon [m^2], positive if it is anticlockwise."""
    v = np.asarray(vertices, dtype=float)
    return 0.5 * cross(v, np.roll(v, -1, axis=0)).sum()


def is_inside(place, vertices):
    """Whether a place is within a polygon, by the edges right of it."""
    a, b = vertices, np.roll(vertices, -1, axis=0)
    passes = (a[:, 1] > place[1]) != (b[:, 1] > place[1])
    rise = np.where(passes, b[:, 1] - a[:, 1], 1.0)
    x = a[:, 0] + (place[1] - a[:, 1]) / rise * (b[:, 0] - a[:, 0])
    return bool(np.count_nonzero(passes & (x > place[0])) % 2)


def distance_to(places, a, b):
    """Distance of places to the line from a to b [m], and their projections on
    it as a fraction within 0 and 1."""
    share = np.clip((places - a) @ (b - a) / ((b - a) @ (b - a)), 0.0, 1.0)
    return np.linalg.norm(a + share[..., None] * (b - a) - places,
                          axis=-1), share


def crossing(a, b, c, d, tolerance):
    """Point where the line from a to b crosses one of those from c to d, (n,
    2), apart from their ends [m], or None."""
    way, ways = b - a, d - c
    turn = cross(way, ways)
    is_turned = np.abs(turn) > 1e-12 * np.linalg.norm(way) \
        * np.linalg.norm(ways, axis=1)
    turn = np.where(is_turned, turn, 1.0)
    s, t = cross(c - a, ways) / turn, cross(c - a, way) / turn
    margin_s = tolerance / np.linalg.norm(way)
    margin_t = tolerance / np.linalg.norm(ways, axis=1)
    found = np.flatnonzero(is_turned & (s > margin_s) & (s < 1.0 - margin_s)
                           & (t > margin_t) & (t < 1.0 - margin_t))
    return a + s[found[0]] * way if len(found) else None


def at(place):
    return f"({place[0]:.6g}, {place[1]:.6g}) m"


def common_points(polygons, tolerance):
    """Points (n, 2) [m], those nearer than @p tolerance to an earlier one
    left out, and the numbers of each polygon's vertices, repeated ones left
    out, anticlockwise."""
    points, cells, loops = [], {}, []

    def number(place):
        cell = np.floor(place / tolerance).astype(int)
        for i in (-1, 0, 1):
            for j in (-1, 0, 1):
                for k in cells.get((cell[0] + i, cell[1] + j), ()):
                    if np.linalg.norm(points[k] - place) <= tolerance:
                        return k
        points.append(place)
        cells.setdefault(tuple(cell), []).append(len(points) - 1)
        return len(points) - 1

    for polygon in polygons:
        numbers = [number(place) for place in polygon.vertices]
        loop = [k for k, last in zip(numbers, numbers[-1:] + numbers[:-1])
                if k != last]
        if area_of(polygon.vertices) < 0.0:
            loop.reverse()
        loops.append(loop)
    return np.array(points), loops


def partition(polygons):
    """The Partition of these polygons. A vertex of one that lies on an edge of
    another is set into it. Polygons that overlap, cross themselves or are
    nothing, and names that occur twice, are a ValueError with the place."""
    polygons = [Polygon(p.name, p.group, checked_vertices(p))
                for p in polygons]
    if not polygons:
        raise ValueError("there are no polygons")
    names = [p.name for p in polygons]
    for name in names:
        if names.count(name) > 1:
            raise ValueError(f"there are {names.count(name)} polygons '{name}':"
                             " give each a name of its own")
    every = np.concatenate([p.vertices for p in polygons])
    tolerance = TOLERANCE * np.ptp(every, axis=0).max()
    points, loops = common_points(polygons, tolerance)
    hanging = 0
    for number, (polygon, loop) in enumerate(zip(polygons, loops)):
        if len(loop) < 3 or abs(area_of(points[loop])) < tolerance ** 2:
            raise ValueError(f"polygon '{polygon.name}' has no area")
        whole = []
        for i, j in zip(loop, loop[1:] + loop[:1]):
            apart, share = distance_to(points, points[i], points[j])
            on = np.flatnonzero((apart <= tolerance) & (share > 0.0)
                                & (share < 1.0))
            on = [k for k in on[np.argsort(share[on])] if k not in (i, j)]
            whole += [i, *on]
            hanging += len(on)
        loops[number] = whole
        if len(set(whole)) < len(whole):
            twice = next(k for k in whole if whole.count(k) > 1)
            raise ValueError(f"polygon '{polygon.name}' touches itself at "
                             f"{at(points[twice])}: cut it there in two")
    check_overlaps(polygons, points, loops, tolerance)
    edges = {}
    for number, loop in enumerate(loops):
        for i, j in zip(loop, loop[1:] + loop[:1]):
            key = (j, i) if (j, i) in edges else (i, j)
            edges.setdefault(key, []).append(number)
    return Partition(points, loops, edges, hanging)


def checked_vertices(polygon):
    """Vertices of the polygon as an array (n, 2) [m], checked."""
    try:
        vertices = np.array(polygon.vertices, dtype=float)
    except (TypeError, ValueError):
        vertices = np.zeros(0)
    if vertices.ndim != 2 or vertices.shape[1] != 2 or len(vertices) < 3 \
            or not np.isfinite(vertices).all():
        raise ValueError(f"polygon '{polygon.name}' needs three or more "
                         "vertices, each two numbers x, y [m]")
    for what, name in (("name", polygon.name), ("group", polygon.group)):
        if not name or set(name) & set(',"\n'):
            raise ValueError(f"the {what} '{name}' of a polygon must not be "
                             "empty or have a comma or a quotation mark")
    return vertices


def check_overlaps(polygons, points, loops, tolerance):
    """Refuses edges that cross, go through another polygon, or are used twice
    in the same sense. As all vertices on edges are set into them, an edge
    that crosses none is as a whole within a polygon, on its edge or outside,
    and so is its middle."""
    corners = [points[loop] for loop in loops]
    low = np.array([c.min(axis=0) for c in corners]) - tolerance
    high = np.array([c.max(axis=0) for c in corners]) + tolerance
    for p, loop in enumerate(loops):
        near = np.flatnonzero(((low <= high[p]) & (high >= low[p])).all(axis=1))
        for q in near:
            place = overlap(loop, loops[q], corners[p], corners[q], tolerance,
                            p == q)
            if place is not None and p == q:
                raise ValueError(f"polygon '{polygons[p].name}' crosses itself "
                                 f"at {at(place)}")
            if place is not None:
                raise ValueError(f"polygons '{polygons[p].name}' and "
                                 f"'{polygons[q].name}' overlap at {at(place)}:"
                                 " move or cut one of them")


def overlap(loop, other, corners, others, tolerance, is_same):
    """Point where an edge of @p loop crosses an edge of the other or lies
    within it, or where it crosses itself if both are of the same polygon; or
    None."""
    c, d = others, np.roll(others, -1, axis=0)
    known = set() if is_same else set(zip(other, other[1:] + other[:1]))
    for i, j, a, b in zip(loop, loop[1:] + loop[:1], corners,
                          np.roll(corners, -1, axis=0)):
        place = crossing(a, b, c, d, tolerance)
        if place is not None:
            return place
        middle = 0.5 * (a + b)
        if (i, j) in known:
            return middle
        apart = min(distance_to(middle, *line)[0] for line in zip(c, d))
        if not is_same and apart > tolerance and is_inside(middle, others):
            return middle
    return None


def size_of(sizes, group):
    """Size of the cells of a group [m]; @p sizes is a number or {group: size},
    in which "" is for all others."""
    if not isinstance(sizes, dict):
        sizes = {"": sizes}
    size = sizes.get(group, sizes.get(""))
    if size is None:
        raise ValueError(f"there is no mesh size for the group '{group}'")
    if not (np.isfinite(size) and size > 0.0):
        raise ValueError(f"the mesh size {size:g} of the group '{group}' is "
                         "not positive")
    return size


def boundary_of(edge, points, boundaries, tolerance):
    """The name of the boundary that an outer edge lies on, or None."""
    for name, (x0, y0, x1, y1) in boundaries.items():
        apart, _ = distance_to(points[list(edge)], np.array([x0, y0]),
                               np.array([x1, y1]))
        if apart.max() <= tolerance:
            return name
    return None


def write_geo(path, polygons, size=None, elements=None, boundaries=None,
              joint="joint"):
    """Writes polygons, of one or more groups, as a geometry for gmsh.

    Either @p size [m], a number or {group: size}, or @p elements on each piece
    of an edge between two vertices. @p boundaries, {name: (x0, y0, x1, y1)},
    are lines [m]: what lies on one of the edges of a single polygon becomes
    the physical curve of that name. Edges of two polygons are the curve
    @p joint. Returns "blocks", "joints" (edges), "joint length [m]", "hanging
    vertices" and "areas", {group: [m^2]}.
    """
    if (size is None) == (elements is None):
        raise ValueError("give either a mesh size or a number of elements on "
                         "each edge")
    if elements is not None and (elements != int(elements) or elements < 1):
        raise ValueError(f"{elements} elements on each edge: give 1 or more")
    boundaries = boundaries or {}
    made = partition(polygons)
    points, edges = made.points, made.edges
    number = {edge: k for k, edge in enumerate(edges, 1)}
    tolerance = TOLERANCE * np.ptp(points, axis=0).max()
    curves = {joint: [number[e] for e, use in edges.items() if len(use) == 2]}
    for name, line in boundaries.items():
        if name in curves or line[:2] == line[2:]:
            raise ValueError(f"boundary '{name}': " + (
                "the joints have this name" if name in curves
                else "its line has no length"))
        curves[name] = []
    for edge, use in edges.items():
        name = boundary_of(edge, points, boundaries, tolerance)
        if len(use) == 1 and name:
            curves[name].append(number[edge])
    for name in boundaries:
        if not curves[name]:
            raise ValueError(f"boundary '{name}': no outer edge lies on its "
                             f"line {boundaries[name]}")
    finest = np.full(len(points), np.inf)
    groups = {}
    for k, (polygon, loop) in enumerate(zip(polygons, made.loops), 1):
        groups.setdefault(polygon.group, []).append(k)
        if size is not None:
            finest[loop] = np.minimum(finest[loop],
                                      size_of(size, polygon.group))

    lines = ["// Polygons of blocks, by quoin.geometry."]
    for k, (x, y) in enumerate(points, 1):
        mesh = "" if size is None else f", {finest[k - 1]:g}"
        lines.append(f"Point({k}) = {{{x:.12g}, {y:.12g}, 0{mesh}}};")
    lines += [f"Line({k}) = {{{i + 1}, {j + 1}}};"
              for (i, j), k in number.items()]
    for k, loop in enumerate(made.loops, 1):
        signed = [number.get((i, j)) or -number[j, i]
                  for i, j in zip(loop, loop[1:] + loop[:1])]
        lines.append(f"Curve Loop({k}) = {{{listed(signed)}}};")
        lines.append(f"Plane Surface({k}) = {{{k}}};")
    if elements is not None:
        lines.append(f"Transfinite Curve{{1:{len(edges)}}} = "
                     f"{int(elements) + 1};")
    lines += [f'Physical Surface("{name}") = {{{listed(members)}}};'
              for name, members in groups.items()]
    lines += [f'Physical Curve("{name}") = {{{listed(members)}}};'
              for name, members in curves.items() if members]
    with open(path, "w", encoding="utf-8") as file:
        file.write("\n".join(lines) + "\n")
    between = np.array([e for e, use in edges.items() if len(use) == 2],
                       dtype=int).reshape(-1, 2)
    areas = [area_of(points[loop]) for loop in made.loops]
    return {"blocks": len(polygons), "joints": len(between),
            "joint length [m]": float(np.linalg.norm(
                points[between[:, 0]] - points[between[:, 1]], axis=1).sum()),
            "hanging vertices": made.hanging,
            "areas": {name: float(sum(areas[k - 1] for k in members))
                      for name, members in groups.items()}}


def listed(numbers):
    return ", ".join(map(str, numbers))


def read_polygons(path):
    """Polygons of a file: JSON, a list of {"name", "group", "vertices":
    [[x, y], ...]}, or CSV with the columns name, group, x, y, separated by
    commas or semicolons, a row each vertex."""
    with open(path, newline="", encoding="utf-8-sig") as file:
        text = file.read()
    try:
        if path.endswith(".json"):
            return [Polygon(str(p["name"]), str(p["group"]), p["vertices"])
                    for p in json.loads(text)]
        rows = csv.DictReader(text.splitlines(), skipinitialspace=True,
                              delimiter=";" if ";" in text else ",")
        found = {}
        for row in rows:
            group, vertices = found.setdefault(row["name"], (row["group"], []))
            if group != row["group"]:
                raise ValueError(f"line {rows.line_num}: polygon "
                                 f"'{row['name']}' is in '{group}' before")
            vertices.append((float(row["x"]), float(row["y"])))
    except KeyError as error:
        raise ValueError(f"{path}: {error} is missing; a polygon needs name, "
                         "group and vertices (CSV: name, group, x, y)"
                         ) from error
    except (TypeError, ValueError) as error:
        raise ValueError(f"{path}: {error}") from error
    return [Polygon(name, *rest) for name, rest in found.items()]


def arch(span, rise, thickness, voussoirs, springer=None, backing=None,
         cover=None):
    """Polygons of a circular arch between x = -span/2 and span/2 [m], whose
    intrados springs at y = 0; named from the left.

    @p span and @p rise of the intrados, rise at most half of the span;
    @p thickness across, radial joints; so many straight-sided @p voussoirs.
    @p springer, (width, height): blocks below both ends, of this width from
    the intrados outwards and this height below y = 0, on which the first joint
    is cut. @p backing: level y up to which masonry fills the spandrels,
    @p cover: height above the extrados at its crown up to which fill lies over
    all; both are as wide as the springers and need them. Groups are voussoir,
    springer, backing and fill.
    """
    sizes = {"span": span, "rise": rise, "thickness": thickness}
    for name, value in sizes.items():
        if not (np.isfinite(value) and value > 0.0):
            raise ValueError(f"arch: {name} = {value:g} is not positive")
    if rise > 0.5 * span * (1.0 + 1e-12):
        raise ValueError(f"arch: rise = {rise:g} is more than half of span = "
                         f"{span:g}, which no circular arch has")
    if voussoirs != int(voussoirs) or voussoirs < 2:
        raise ValueError(f"arch: voussoirs = {voussoirs:g}: give 2 or more")
    n = int(voussoirs)
    radius = (0.25 * span ** 2 + rise ** 2) / (2.0 * rise)
    opening = 2.0 * np.arctan2(2.0 * rise, span)      # half of the angle
    angle = np.linspace(-opening, opening, n + 1)
    ray = np.stack([np.sin(angle), np.cos(angle)], axis=1)
    centre = np.array([0.0, rise - radius])
    inner, outer = centre + radius * ray, centre + (radius + thickness) * ray
    # not a rounding below the springings of a semicircle
    inner[[0, -1], 1] = 0.0
    outer[[0, -1], 1] = thickness * max((radius - rise) / radius, 0.0)
    blocks = [Polygon(f"voussoir {k + 1}", "voussoir",
                      np.array([inner[k], outer[k], outer[k + 1],
                                inner[k + 1]])) for k in range(n)]
    if springer is None:
        if backing is not None or cover is not None:
            raise ValueError("arch: backing and cover need springer = "
                             "(width, height), beside which they end")
        return blocks
    return blocks + springers(inner, outer, *springer) + spandrels(
        outer, 0.5 * span + springer[0], backing, cover, rise + thickness)


def mirrored(name, group, left):
    """A polygon on the left and its image on the right."""
    return [Polygon(f"{name} left", group, np.array(left)),
            Polygon(f"{name} right", group, np.array(left) * [-1.0, 1.0])]


def springers(inner, outer, width, height):
    """See arch()."""
    (a, _), (b, top) = inner[0], outer[0]
    if width < (a - b) * (1.0 - 1e-12) or height <= 0.0:
        raise ValueError(f"arch: springer = ({width:g}, {height:g}) must be "
                         f"{a - b:g} or more wide, below the whole joint, and "
                         "higher than 0")
    return mirrored("springer", "springer", [
        (a, 0.0), (a, -height), (a - width, -height), (a - width, top),
        (b, top)])


def spandrels(outer, side, backing, cover, crown):
    """Backing and fill over the extrados @p outer up to x = +-side, see
    arch(); crown: level of the extrados' middle."""
    top = outer[0, 1]
    if cover is not None and cover <= 0.0:
        raise ValueError(f"arch: cover = {cover:g} is not positive")
    if backing is None:
        low, blocks = outer, []
        level = top
    else:
        left = outer[:(len(outer) + 1) // 2]
        if not top < backing < left[-1, 1]:
            raise ValueError(f"arch: backing = {backing:g} is not between the "
                             f"springing of the extrados, {top:g}, and its "
                             f"crown, {left[-1, 1]:g}")
        below = left[left[:, 1] < backing]
        cut = [np.interp(backing, left[:, 1], left[:, 0]), backing]
        blocks = mirrored("backing", "backing", [
            (-side, top), *below, cut, (-side, backing)])
        low = np.array([cut, *outer[outer[:, 1] >= backing],
                        [-cut[0], backing]])
        level = backing
    if cover is None:
        return blocks
    return blocks + [Polygon("fill", "fill", np.array(
        [(-side, level), *low, (side, level), (side, crown + cover),
         (-side, crown + cover)]))]
