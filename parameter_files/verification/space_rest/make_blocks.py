#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Writes the blocks of the box, 1 m x 0.8 m x 0.6 m, as OBJ, STL and 3DEC's
grid, without any mesh: a bed whose top has two slopes, two blocks on it side by
side, whose joint ends on faces of the bed, and a plug in a pocket of one."""
import os

HERE = os.path.dirname(os.path.abspath(__file__))
BED = [(0, 0), (1, 0), (1, .35), (.55, .2), (0, .2)]  # x, z
UPPER = [(0, .2), (.55, .2), (1, .35), (1, .6), (0, .6)]
POCKET = (.2, .4), (.1, .3), (.4, .6)  # from, to in x, y, z


def prism(profile, y0, y1):
    """Faces of a profile in x, z from y0 to y1, corners outwards."""
    n = len(profile)
    faces = [[(x, y0, z) for x, z in profile],
             [(x, y1, z) for x, z in reversed(profile)]]
    for i in range(n):
        (x0, z0), (x1, z1) = profile[i], profile[(i + 1) % n]
        faces.append([(x0, y0, z0), (x0, y1, z0), (x1, y1, z1), (x1, y0, z1)])
    return faces


def box(x, y, z):
    """Faces of a box."""
    return prism([(x[0], z[0]), (x[1], z[0]), (x[1], z[1]), (x[0], z[1])], *y)


def with_pocket(faces):
    """The block with the pocket in its top, whose face has a hole: four quads
    around it."""
    (a, b), (c, d), (e, f) = POCKET
    top = [face for face in faces if all(p[2] == f for p in face)]
    outer = [(0, 0), (1, 0), (1, .5), (0, .5)]
    inner = [(a, c), (b, c), (b, d), (a, d)]
    result = [face for face in faces if face not in top]
    for i in range(4):
        j = (i + 1) % 4
        result.append([(*outer[i], f), (*outer[j], f), (*inner[j], f),
                       (*inner[i], f)])
    walls = [face for face in box(*POCKET) if not all(p[2] == f for p in face)]
    return result + [face[::-1] for face in walls]


BLOCKS = {"bed": prism(BED, 0, .8),
          "front": with_pocket(prism(UPPER, 0, .5)),
          "back": prism(UPPER, .5, .8),
          "plug": box(*POCKET)}


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
            a[0] * b[1] - a[1] * b[0])


def minus(a, b):
    return tuple(x - y for x, y in zip(a, b))


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def triangles(face):
    """Ears of a plane face, cut off one by one."""
    left = list(face)
    normal = (0, 0, 0)
    for i in range(1, len(face) - 1):
        c = cross(minus(face[i], face[0]), minus(face[i + 1], face[0]))
        normal = tuple(x + y for x, y in zip(normal, c))
    result = []
    while len(left) > 3:
        for i in range(len(left)):
            a, b, c = left[i - 1], left[i], left[(i + 1) % len(left)]
            area = cross(minus(b, a), minus(c, a))
            if dot(area, normal) <= 1e-12:
                continue
            inside = any(
                all(dot(cross(minus(q, p), minus(r, p)), normal) >= 0
                    for p, q in ((a, b), (b, c), (c, a)))
                for r in left if r not in (a, b, c))
            if not inside:
                result.append([a, b, c])
                del left[i]
                break
    return result + [left]


def write_obj(stream):
    stream.write("# blocks of one box\n")
    n = 0
    for name, faces in BLOCKS.items():
        stream.write("o %s\nusemtl %s\n"
                     % (name, "bed" if name == "bed" else "rock"))
        points = sorted({p for face in faces for p in face})
        for p in points:
            stream.write("v %.9g %.9g %.9g\n" % p)
        for face in faces:
            stream.write("f %s\n" % " ".join(
                "%d//1" % (n + points.index(p) + 1) for p in face))
        n += len(points)


def write_stl(stream):
    for name, faces in BLOCKS.items():
        stream.write("solid %s\n" % name)
        for face in faces:
            for corners in triangles(face):
                stream.write("facet normal 0 0 0\nouter loop\n")
                for p in corners:
                    stream.write("vertex %.9g %.9g %.9g\n" % p)
                stream.write("endloop\nendfacet\n")
        stream.write("endsolid %s\n" % name)


def write_3dgrid(stream):
    """The plug with zones, the others as rigid blocks are, by faces."""
    stream.write("* 3DEC grid\nTOL 1e-4\n")
    points, n_faces, n_zones = {}, 0, 0
    for b, (name, faces) in enumerate(BLOCKS.items()):
        points = {}
        for face in faces:
            for p in face:
                if p not in points:
                    points[p] = 100 * b + len(points) + 1
                    stream.write("G %d %.9g, %.9g, %.9g\n" % (points[p], *p))
        if name == "plug":
            (a, e), (c, d), (f, g) = POCKET
            corner = [points[(x, y, z)] for z in (f, g) for y in (c, d)
                      for x in (a, e)]
            parts = []
            for zone in ((0, 1, 3, 7), (0, 1, 5, 7), (0, 4, 5, 7),
                         (0, 2, 3, 7), (0, 2, 6, 7), (0, 4, 6, 7)):
                n_zones += 1
                parts.append(n_zones)
                stream.write("Z %d %s\n" % (n_zones, " ".join(
                    str(corner[k]) for k in zone)))
        else:
            parts = []
            for face in faces:
                n_faces += 1
                parts.append(n_faces)
                stream.write("F %d %s\n" % (n_faces, " ".join(
                    str(points[p]) for p in face)))
        stream.write("B %d %d %s %s\n" % (
            b + 1, 1 if name == "bed" else 2, "Z" if name == "plug" else "F",
            " ".join(map(str, parts))))


def main():
    for ending, write in (("obj", write_obj), ("stl", write_stl),
                          ("3dgrid", write_3dgrid)):
        with open(os.path.join(HERE, "blocks." + ending), "w") as stream:
            write(stream)


if __name__ == "__main__":
    main()
