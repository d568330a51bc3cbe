#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""The same answer on 1, 2, 3 and some on 4 ranks to 1e-10, some bitwise on a repeat.

On 2 and on 3 ranks by turns, with --all on both. Without --all some are killed on 2
ranks and resumed on 3, see resume_ranks.py.

The five blocks of the patch test, loaded suddenly and undamped: deformable ones
on their base, rigid ones flying freely. The sled: contacts between deformable
and rigid blocks of different ranks, some of them joints at first, some of them
new. The patch test once more with blocks that yield. Motion with many impacts
would not agree: it multiplies rounding. The cavity: boundary elements, whose
history and points the ranks share. A block that is distributed over several ranks,
without and with joints inside. A static far field, which every rank has as a
whole, and dashpots that hold what it carried. Blocks placed and excavated, whole
and divided. A divided block that slides along another one, from a joint that slipped
on, without and with dashpots; impacts of whole blocks on dashpots. Tetrahedra, without and
with joints and their dashpots, and with a crack. Bars through
divided blocks, by both solvers. A wall in equilibrium, cracking, to what its
iterations leave, by both linear solvers; water in a joint by both solvers; a block that
is distributed over 2 and 3 ranks in equilibrium, without
and with joints inside; tetrahedra with a joint by multigrid. A stack of blocks under a
load pattern, by both solvers. In space a generated wall that cracks under one, and with
--all a cube placed and excavated and a generated box of rock.
"""
import json
import os
import sys
import tempfile
import time

import numpy as np

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import common  # noqa: E402
from common import Failure  # noqa: E402

SETS = ["Stages/load/End=time", "Stages/load/Duration=5e-3",
        "Stages/load/Damping=none", "Histories/Interval=1e-5"]
PATCH_TEST = os.path.join(common.VERIFICATION, "patch_test", "case.prm")
# A stage of the static far field, left before it is at rest, then dashpots.
AFTER_SWITCH = os.path.join(common.VERIFICATION, "at_rest_after_switch",
                            "static_dashpots.prm")
UNSETTLED = ["Stages/settle/Static ratio=0.1"]
# Results counted from a stage in which a block has just been placed.
SHORT = common.SHORT_FILL + [
    "Stages/fill/Reset=displacements, slips, joint states"]
# The first displacements of a shear wall, joints opening.
WALL = os.path.join(common.MASONRY, "tue_walls", "j4d.prm")
PUSHED = ["Solver=implicit", "Stages/push/Duration=0.02",
          "Implicit/Force ratio=1e-8"]
# A slab that presses water out of the joint below it.
SLAB = os.path.join(common.VERIFICATION, "joint_flow", "consolidation.prm")
FLOWING = ["Histories/Names=opening, middle, flow, left",
           "Histories/flow/Quantity=water outflow",
           "Histories/left/Quantity=water outflow",
           "Histories/left/Curve=left"]
DRAINING = FLOWING + ["Solver=explicit", "Water/Bulk modulus=2e8",
                      "Stages/press/Duration=2e-4", "Histories/Interval=1e-5"]
# The hole in rock that yields, in a time in which rounding does not grow.
SOON = ["Stages/excavate/End=time", "Stages/excavate/Duration=0.015",
        "Loads/wall/Pressure=30e6*0.5*(1+cos(pi*min(1,t/0.02)))",
        "Loads/outside/Pressure=30e6-2.165887e6*0.5*(1-cos(pi*min(1,t/0.02)))"]
# Coarse meshes of models in space.
BOX = "Mesh/File=" + os.path.join(common.ROOT, "tests", "cases", "box.geo")
LAYER = "Mesh/File=" + os.path.join(common.ROOT, "tests", "cases", "layer.geo")
# A stack pushed by a factor of loads that grow with the height; the factor is
# no number in the first stage, the reaction to it and a displacement are.
COLLAPSE = os.path.join(common.VERIFICATION, "collapse_load", "stack.prm")
COLLAPSING = ["Materials/block/Law=linear elastic",
              "Materials/block/Young's modulus=1e9",
              "Materials/block/Poisson's ratio=0.2",
              "Stages/settle/Duration=5e-3", "Stages/push/Duration=0.01",
              "Stages/push/Control function=0.025 * t^2",
              "Histories/factor/Quantity=reaction x",
              "Histories/factor/Load=base",
              "Histories/moved/Quantity=displacement x",
              "Histories/moved/Point=0.5, 3", "Histories/Interval=1e-4"]
BARS = os.path.join(common.ROOT, "tests", "cases", "bars.prm")
PLATENS = os.path.join(common.VERIFICATION, "space_platens", "case.prm")
IMPACTS = os.path.join(common.VERIFICATION, "space_dashpots", "impacts.prm")
TURNING = os.path.join(common.VERIFICATION, "space_platens", "turning.prm")
PRESSED = ["Stages/load/End=time", "Stages/load/Duration=5e-3",
           "Stages/load/Damping=none", "Histories/Interval=1e-4",
           "Loads/load/Horizontal=force 1e6", "Loads/load/Lateral=force -6e5",
           "Loads/load/Vertical=force -2e6",
           "Loads/load/Rotation x=moment 1e5",
           "Loads/load/Rotation y=moment 4e5",
           "Loads/load/Rotation=moment -3e5"]
ROUGH = os.path.join(common.VERIFICATION, "space_rock_joints",
                     "barton_bandis.prm")
SPACE_YIELDING = ["Materials/rock/Law=Mohr-Coulomb",
                  "Materials/rock/Cohesion=1e6",
                  "Materials/rock/Friction angle=30",
                  "Stages/excavate/End=time",
                  "Stages/excavate/Duration=4e-3",
                  "Stages/excavate/Release duration=2e-3"]
# A generated wall of composite joints in space that cracks under a load pattern.
SPACE_WALL = os.path.join(common.MASONRY, "out_of_plane_wall", "case.prm")
CRACKING = ["Wall/Length=0.48", "Wall/Courses=4", "Wall/Element size=0.12",
            "Histories/middle/Point=0.3, 0.12, 0.4",
            "Histories/Names=reaction, middle, force",
            "Histories/reaction/Quantity=reaction y",
            "Histories/reaction/Load=sides",
            "Histories/force/Quantity=joint force y"]
CRACKING_SOON = CRACKING + [
    "Solver=explicit", "Output/Field interval=0",
    "Stages/settle/End=time", "Stages/settle/Duration=2e-3",
    "Stages/settle/Damping=none", "Stages/push/Duration=6e-3",
    "Stages/push/Damping=none", "Stages/push/Control function=4*t^2",
    "Histories/Interval=1e-4"]
# A cube of tetrahedra placed on another one, and excavated; the joint breaks under more
# than rounding.
SPACE_FILL = os.path.join(common.VERIFICATION, "space_fill", "case.prm")
SPACE_BUILDING = ["Stages/Names=settle, fill, press, gone",
                  "Stages/gone/Loads=base, x, y, gravity",
                  "Stages/gone/Excavate=high",
                  "Stages/fill/Reset=displacements, joint states",
                  "Joints/contact/Cohesion=2e3",
                  "Joints/contact/Tensile strength=2e3"] + [
    "Stages/%s/%s" % (stage, value)
    for stage in ("settle", "fill", "press", "gone")
    for value in ("End=time", "Duration=0.01", "Damping=none")]
# Blocks of a generated box of rock that slip.
ROCK_BOX = os.path.join(common.ROOT, "parameter_files", "rock", "blocks_3d",
                        "case.prm")
SETTLING = ["Joints/all/Law=Coulomb", "Joints/all/Friction angle=20",
            "Stages/settle/End=time", "Stages/settle/Duration=0.01",
            "Stages/settle/Damping=none", "Histories/Interval=1e-4"]
# A bonded liner with hinges, and one that slips.
LINER = ["Loads/in_situ/Stress=-10e6, -5e6, 0",
         "Boundary elements/Element length=1",
         "Boundary elements/Passivity frequencies=0",
         "Beams/shotcrete/Hinge moment=3e3", "Stages/excavation/End=time",
         "Stages/excavation/Duration=2e-3", "Histories/Interval=5e-5"]
SLIPPING = ["Joints/bond/Law=Coulomb", "Joints/bond/Friction angle=20",
            "Joints/bond/Cohesion=0.1e6", "Joints/bond/Tensile strength=1e6"]
VARIANTS = {"deformable": (PATCH_TEST, SETS),
            "rigid": (PATCH_TEST, SETS + ["Materials/rock/Law=rigid",
                                          "Loads/base/Type=traction"]),
            "yielding": (PATCH_TEST, SETS + [
                "Materials/rock/Law=Mohr-Coulomb",
                "Materials/rock/Cohesion=150",
                "Materials/rock/Friction angle=20",
                "Materials/rock/Dilation angle=10",
                "Materials/rock/Tensile strength=100"]),
            # stages that end on conditions, quantities of two points
            "conditions": (os.path.join(common.VERIFICATION,
                                        "stage_conditions", "case.prm"),
                           ["Histories/Names=opening, normal traction, apart, "
                            "turned, open",
                            "Histories/apart/Quantity=distance change",
                            "Histories/apart/Point=0, 0",
                            "Histories/apart/Second point=1, 1",
                            "Histories/turned/Quantity=tilt",
                            "Histories/turned/Point=0, 0",
                            "Histories/turned/Second point=1, 1",
                            "Histories/open/Quantity=open joints"]),
            "sled": (common.SLED, []),
            # forces by place, on faces between ranks
            "moving load": (os.path.join(common.VERIFICATION, "moving_load",
                                         "case.prm"), []),
            "couplet": (os.path.join(common.MASONRY, "couplet",
                                     "tension.prm"), []),
            # a column in each rank, and joints across it
            "free field": (os.path.join(common.VERIFICATION,
                                        "free_field_sides", "case.prm"),
                           ["Mesh/File=two_layers.geo",
                            "Mesh/Joints between=rock:soil",
                            "Materials/Names=rock, soil",
                            "Materials/soil/Density=2000",
                            "Materials/soil/Young's modulus=5e9",
                            "Materials/soil/Poisson's ratio=0.25",
                            "Joints/Names=bed", "Joints/bed/Law=elastic",
                            "Joints/bed/Curves=unnamed",
                            "Joints/bed/Normal stiffness=1e11",
                            "Joints/bed/Shear stiffness=1e11",
                            "Initial motion/Velocity=1e-3*exp(-(x*x+(y+8)^2));"
                            " 0"]),
            # grids in each rank beside a block in several ones
            "space, free field": (os.path.join(
                common.VERIFICATION, "space_free_field_sides", "case.prm"),
                [LAYER, "Stages/shake/Duration=0.01",
                 "Initial motion/Velocity=1e-3*exp(-(x*x+(z+8)^2)); 0; 0"]),
            # a block in several ranks, with free fields and dashpots
            "divided": (os.path.join(common.VERIFICATION, "free_field_sides",
                                     "case.prm"),
                        ["Initial motion/Velocity=1e-3*exp(-(x*x+(y+8)^2));"
                         " 2e-3*x*y"]),
            # and one with joints inside
            "divided, cracked": (os.path.join(common.VERIFICATION,
                                              "slipping_crack", "case.prm"),
                                 ["Stages/cycle/Damping=none",
                                  "Stages/cycle/Duration=5e-3",
                                  "Histories/Interval=5e-5"]),
            # ... and a stage from which results count
            "reset, divided": (os.path.join(common.VERIFICATION,
                                            "slipping_crack", "case.prm"),
                               ["Stages/cycle/Damping=none",
                                "Stages/cycle/Duration=5e-3",
                                "Stages/Names=cycle, more",
                                "Stages/more/Loads=base, press",
                                "Stages/more/Duration=5e-3",
                                "Stages/more/Reset=displacements, slips, "
                                "joint states",
                                "Histories/Names=displacement, force, apart, "
                                "slip, state",
                                "Histories/apart/Quantity=distance change",
                                "Histories/apart/Point=0, 2",
                                "Histories/apart/Second point=1, 0",
                                "Histories/slip/Quantity=joint slip",
                                "Histories/slip/Point=0.5, 1",
                                "Histories/state/Quantity=joint state",
                                "Histories/state/Point=0.5, 1",
                                "Histories/Interval=5e-5"]),
            "cavity": (os.path.join(common.VERIFICATION, "cavity_step",
                                    "case.prm"), ["Sampled field/Box="]),
            "hybrid": (os.path.join(common.VERIFICATION, "hybrid_hole",
                                    "case.prm"),
                       ["Boundary elements/Element length=0.5",
                        "Boundary elements/Passivity frequencies=0"]),
            "static far field": (AFTER_SWITCH, UNSETTLED),
            "construction": (common.FILL, SHORT),
            # divided blocks, one of them excavated and placed again
            "construction, divided": (common.DIG, []),
            # general contacts, both blocks in several ranks
            "contacts, divided": (common.SLIDE, []),
            # dashpots of contacts
            "dashpots": (os.path.join(common.VERIFICATION, "impacts",
                                      "case.prm"), []),
            # and of joints and contacts of blocks in several ranks
            "dashpots, divided": (common.SLIDE,
                                  ["Joints/seam/Restitution=0.3",
                                   "Joints/touch/Restitution=0.3"]),
            # joints between ranks that become contacts
            "named blocks": (os.path.join(common.VERIFICATION, "named_blocks",
                                          "slide.prm"), []),
            # a block of tetrahedra in several ranks, with dashpots
            "space": (os.path.join(common.VERIFICATION, "space_waves",
                                   "s.prm"),
                      ["Stages/wave/Damping=Rayleigh",
                       "Stages/wave/Rayleigh stiffness coefficient=1e-6"]),
            # plane waves that come in askew, below a free surface
            "space, oblique wave": (
                os.path.join(common.VERIFICATION, "space_oblique_waves",
                             "case.prm"),
                [BOX, "Loads/open/Incident direction=0.48, 0.36, 0.8",
                 "Loads/open/Free surface=0", "Loads/open/Boundary=below"]),
            # blocks of another program, heavier at once than what bears them
            "space, imported": (os.path.join(common.VERIFICATION, "space_rest",
                                             "imported.prm"),
                                ["Loads/gravity/Vertical=-40"]),
            # bars through blocks that several ranks share, in a second stage,
            # with pretension, slip of a bond under pressure, and dowels
            "bars": (BARS, ["Solver=explicit"]),
            "implicit, bars": (BARS, []),
            # joints between them that slip, damped
            "space, joints": (os.path.join(common.VERIFICATION,
                                           "space_incline", "case.prm"),
                              ["Stages/slide/Duration=0.08",
                               "Stages/slide/Damping=Rayleigh",
                               "Stages/slide/Rayleigh stiffness "
                               "coefficient=1e-6",
                               "Output/Field interval=0.1"]),
            # the same with dashpots of the joint, which does not break before
            # it bears more than rounding, and whole blocks that meet
            "space, dashpots": (os.path.join(common.VERIFICATION,
                                             "space_incline", "case.prm"),
                                ["Stages/slide/Duration=0.12",
                                 "Joints/slope/Restitution=0.3",
                                 "Joints/slope/Cohesion=2e3",
                                 "Joints/slope/Tensile strength=2e3"]),
            "space, impacts": (IMPACTS, ["Stages/impact/Duration=0.008"]),
            # two platens in space, one free
            "space, platen": (PLATENS, PRESSED),
            "implicit, space, platen": (
                PLATENS, PRESSED + ["Solver=implicit",
                                    "Implicit/Force ratio=1e-11"]),
            # a bar that turns with the platens at its ends
            "implicit, turning": (TURNING, ["Loads/cap/Vertical=force 1e7*T",
                                            "Loads/cap/Lateral=force 1e6*T",
                                            "Implicit/Force ratio=1e-9"]),
            # rock joints that remember more, by both solvers
            "space, rock joint": (ROUGH, ["Stages/shear/Duration=0.3"]),
            "implicit, space, rock joint": (
                ROUGH, ["Solver=implicit", "Stages/shear/Duration=0.3",
                        "Implicit/First step=0.01",
                        "Implicit/Largest step=0.01",
                        "Implicit/Force ratio=1e-11"]),
            # a crack inside a block of tetrahedra in several ranks
            "space, crack": (os.path.join(common.VERIFICATION, "space_crack",
                                          "case.prm"),
                             ["Stages/pull/End=time",
                              "Stages/pull/Duration=0.01"]),
            # rock that yields around what is excavated, under initial stress
            "space, excavation": (os.path.join(common.VERIFICATION,
                                               "space_tunnel", "case.prm"),
                                  SPACE_YIELDING),
            "space, wall": (SPACE_WALL, CRACKING_SOON),
            "space, construction": (SPACE_FILL, SPACE_BUILDING),
            "space, rock box": (ROCK_BOX, SETTLING),
            # the tunnel in equilibrium, elastic
            "implicit, space": (os.path.join(common.VERIFICATION,
                                             "space_tunnel", "case.prm"),
                                ["Solver=implicit",
                                 "Stages/excavate/End=time",
                                 "Stages/excavate/Duration=4e-3",
                                 "Stages/excavate/Release duration=2e-3",
                                 "Implicit/First step=0.25",
                                 "Implicit/Largest step=0.25",
                                 "Implicit/Force ratio=1e-11"]),
            "implicit, space, yielding": (
                os.path.join(common.VERIFICATION, "space_yield", "case.prm"),
                ["Solver=implicit", "Implicit/First step=0.25",
                 "Implicit/Largest step=0.25", "Implicit/Force ratio=1e-11"]),
            # mixed tetrahedra, which ranks do not divide
            "mixed": (os.path.join(common.VERIFICATION, "space_tunnel",
                                   "case.prm"),
                      SPACE_YIELDING + ["Mesh/Tetrahedra=mixed",
                                        "Stages/excavate/Duration=5e-4",
                                        "Stages/excavate/Release duration=3e-4",
                                        "Histories/Interval=5e-5"]),
            "implicit, mixed": (os.path.join(common.VERIFICATION,
                                             "space_yield", "case.prm"),
                                ["Mesh/Tetrahedra=mixed", "Solver=implicit",
                                 "Implicit/First step=0.5",
                                 "Implicit/Largest step=0.5",
                                 "Implicit/Force ratio=1e-11"]),
            "implicit, space, joints": (
                os.path.join(common.VERIFICATION, "space_incline", "case.prm"),
                ["Solver=implicit", "Joints/slope/Friction angle=36",
                 "Stages/slide/Duration=0.1", "Implicit/First step=0.25",
                 "Implicit/Largest step=0.25",
                 "Implicit/Force ratio=1e-11"]),
            # multigrid with rotations, whose coarse levels differ with the ranks
            "implicit, space, iterative": (
                os.path.join(common.VERIFICATION, "space_joint_patch",
                             "case.prm"),
                ["Mesh/File=fine.geo", "Solver=implicit",
                 "Implicit/Linear solver=iterative",
                 "Implicit/First step=0.5", "Implicit/Largest step=0.5",
                 "Implicit/Force ratio=1e-11"]),
            # a load pattern on divided blocks
            "pattern": (COLLAPSE, COLLAPSING),
            "pattern, named": (
                COLLAPSE,
                COLLAPSING + ["Stages/push/Controlled displacement=moved"]),
            "implicit, pattern": (
                COLLAPSE, COLLAPSING + ["Solver=implicit",
                                        "Implicit/Force ratio=1e-12",
                                        "Implicit/Largest step=0.1"]),
            # a liner of a divided block
            "liner": (os.path.join(common.VERIFICATION, "liner", "case.prm"),
                      LINER),
            "implicit, liner": (
                os.path.join(common.VERIFICATION, "liner", "case.prm"),
                LINER + ["Solver=implicit", "Stages/excavation/Release=0.15",
                         "Beams/shotcrete/Hinge moment=1e3",
                         "Implicit/Largest step=0.2"]),
            "liner, slipping": (os.path.join(common.VERIFICATION, "liner",
                                             "case.prm"), LINER + SLIPPING),
            "implicit, liner, slipping": (
                os.path.join(common.VERIFICATION, "liner", "case.prm"),
                LINER + SLIPPING + ["Solver=implicit",
                                    "Stages/excavation/Release=0.3",
                                    "Beams/shotcrete/Hinge moment=1e3",
                                    "Implicit/First step=0.2",
                                    "Implicit/Largest step=0.2",
                                    "Implicit/Force ratio=1e-10"]),
            "implicit, divided": (
                os.path.join(common.VERIFICATION, "kirsch", "case.prm"),
                ["Solver=implicit", "Implicit/First step=0.1",
                 "Implicit/Largest step=0.1"]),
            # to the middle of the cycle, where the crack has slipped
            "implicit, divided, cracked": (
                os.path.join(common.VERIFICATION, "slipping_crack",
                             "case.prm"),
                ["Solver=implicit", "Loads/base/Horizontal=0",
                 "Stages/cycle/Duration=0.05",
                 "Implicit/Force ratio=1e-12"]),
            "water": (SLAB, DRAINING),
            # water that moves with a block that several ranks share
            "added mass": (os.path.join(common.VERIFICATION, "added_mass",
                                        "block.prm"),
                           ["Stages/rock/Duration=0.01",
                            "Histories/Interval=5e-4"]),
            # the crack of a joint between ranks, and its uplift
            "uplift": (os.path.join(common.VERIFICATION, "dam_uplift",
                                    "dam.prm"),
                       ["Stages/settle/End=time", "Stages/settle/Duration=2",
                        "Stages/fill/End=time", "Stages/fill/Duration=10",
                        "Histories/Interval=0.1"]),
            "implicit, water": (
                SLAB, FLOWING + ["Stages/press/Duration=0.1",
                                 "Implicit/First step=0.1",
                                 "Implicit/Largest step=0.1",
                                 "Materials/rock/Young's modulus=20e9",
                                 "Implicit/Force ratio=1e-11"]),
            "implicit": (WALL, PUSHED),
            "implicit, iterative": (
                WALL, PUSHED + ["Implicit/Linear solver=iterative"])}
# Other than 2 and 3; on more ranks than cores each waits for its turn.
RANKS = {"deformable": (2, 4), "divided": (2, 4),
         "contacts, divided": (2, 3, 4)}
# Those that a short test leaves out: resume_ranks.py has them, or others are like them.
ONLY_ALL = ("space, construction", "space, rock box", "rigid", "conditions",
            "cavity", "space, rock joint", "space, crack", "space, excavation",
            "construction, divided", "liner, slipping", "dashpots, divided",
            "implicit, space", "mixed")
# Those that run on 2 ranks once more: one of each kind of exchange. A short test does
# so with fewer: resume.py repeats those below on 2 ranks, and others are resumed here,
# what they have written before being the repetition.
REPEATED = ("deformable", "divided, cracked", "sled", "contacts, divided",
            "space, joints", "space, dashpots", "space, platen",
            "space, free field", "static far field", "hybrid", "water", "liner",
            "bars", "pattern", "implicit, divided", "implicit, space, joints")
REPEATED_BY_RESUME = ("space, joints", "space, dashpots", "space, platen",
                      "space, free field")
# Those whose blocks move little against their skin; what they show is the sums
# of forces on both sides, of joints and then of contacts.
LEAST_SEARCHES = {"named blocks": 8, "sled": 40, "dashpots": 12}
TOLERANCE = 1e-10
# Of the peak, where an equilibrium is found to 'Force ratio'.
LOOSE = {"implicit": 1e-6, "implicit, iterative": 1e-6}
# The rounding of a controlled displacement, by the square of the time step, is
# an acceleration, which the factor of a load pattern brings about.
# Moments of a liner are differences of directions: those of positions that are
# rounded to 1e-16 m, by EI/l^2 = 1e9 N/m, a few 1e-10 of their peak.
# Slip multiplies that.
ROUNDED = {"pattern": 1e-8, "pattern, named": 1e-8, "liner": 1e-8,
           "implicit, liner": 1e-8, "liner, slipping": 1e-6,
           "implicit, liner, slipping": 1e-6}


def tables(folder):
    histories, _ = common.read_table(os.path.join(folder, "histories.csv"))
    if not os.path.exists(os.path.join(folder, "energies.csv")):
        return histories  # of boundary elements
    energies, _ = common.read_table(os.path.join(folder, "energies.csv"))
    # the residual is a difference: rounding of the others
    energies.pop("residual", None)
    energies.pop("time")
    histories.update(("energy " + k, v) for k, v in energies.items())
    return histories


def differences(one, many, what):
    """The largest difference of each column, by its peak; of energies by that
    of all of them."""
    errors = {}
    peak = max((np.max(np.abs(v)) for k, v in one.items()
                if k.startswith("energy ")), default=1.0)
    for name, values in one.items():
        other = many.get(name)
        if other is None or other.shape != values.shape:
            raise Failure("%s: column '%s' differs in length" % (what, name))
        scale = peak if name.startswith("energy ") \
            else np.max(np.abs(values)) or 1.0
        errors[name] = float(np.max(np.abs(other - values)) / scale)
    return errors


def compare_linear_solvers(scratch):
    """The columns in which the iterative one differs from the direct one."""
    direct, iterative = (tables(os.path.join(scratch, name + " 1"))
                         for name in LOOSE)
    errors = differences(direct, iterative, "iterative linear solver")
    print("  linear solvers: largest difference %.2e" % max(errors.values()))
    return ["'%s' by %.1e with the iterative linear solver" % (name, error)
            for name, error in errors.items() if not error <= 1e-6]


def numbers_of_ranks(variant, every, resumed):
    """Those that are compared with 1; none of what is @p resumed on others and
    repeated elsewhere."""
    if resumed and (variant not in REPEATED or variant in REPEATED_BY_RESUME):
        return ()
    if every or variant in RANKS:
        return tuple(n for n in RANKS.get(variant, (2, 3))
                     if n != 3 or not resumed)
    on_two = variant in REPEATED or list(VARIANTS).index(variant) % 2 == 0
    return (2,) if on_two else (3,)


def run(quoin, variant, scratch, ranks, name=None):
    """The folder of a run of a variant."""
    prm, sets = VARIANTS[variant]
    output = os.path.join(scratch, "%s %s" % (variant, name or ranks))
    common.run(quoin, prm, output, sets, ranks)
    return output


def compare(quoin, variant, scratch, every):
    """The largest difference from one rank, on which it has run, and the columns
    that differ."""
    import resume_ranks  # which imports this file

    resumed = not every and variant in resume_ranks.IN_RANKS
    worst, different = 0.0, []
    whole = last = os.path.join(scratch, variant + " 1")
    one = tables(whole)
    for ranks in numbers_of_ranks(variant, every, resumed):
        last = run(quoin, variant, scratch, ranks)
        errors = differences(one, tables(last),
                             "%s, %d ranks" % (variant, ranks))
        worst = max(worst, max(errors.values()))
        different += ["%s '%s' by %.1e on %d ranks"
                      % (variant, name, error, ranks)
                      for name, error in errors.items()
                      if not error <= {**LOOSE, **ROUNDED}.get(variant,
                                                               TOLERANCE)]
        print("  %s, up to %d ranks: largest difference %.2e"
              % (variant, ranks, worst))
    on_two = os.path.join(scratch, variant + " 2")
    if resumed:
        error, columns, _ = resume_ranks.compare(
            quoin, variant, scratch, whole, (2, 3),
            same=on_two if os.path.exists(on_two) else None)
        worst = max(worst, error)
        different += columns
    elif variant in REPEATED and (every or variant not in REPEATED_BY_RESUME):
        again = run(quoin, variant, scratch, 2, "2 again")
        for name in ("histories.csv", "energies.csv"):
            if not os.path.exists(os.path.join(again, name)):
                continue
            with open(os.path.join(on_two, name), "rb") as first, \
                    open(os.path.join(again, name), "rb") as second:
                if first.read() != second.read():
                    raise Failure("%s, 2 ranks twice: %s is not bitwise the "
                                  "same" % (variant, name))
    with open(os.path.join(last, "summary.json")) as stream:
        searches = json.load(stream).get("contact searches")
    if searches is not None and searches < LEAST_SEARCHES.get(variant, 50):
        raise Failure("%s: contacts were searched %d times only, so that this "
                      "shows little" % (variant, searches))
    return worst, different


def body():
    parser = common.arguments(__doc__.splitlines()[0])
    parser.add_argument("--all", action="store_true",
                        help="every variant on 2 and on 3 ranks")
    options = parser.parse_args()
    variants = [variant for variant in VARIANTS
                if options.all or variant not in ONLY_ALL]
    results = common.begin(options, "ranks")
    worst, different = 0.0, []
    start = time.monotonic()
    with tempfile.TemporaryDirectory(prefix="quoin_") as scratch:
        # not beside those on several ranks, which wait for each other at each step
        common.in_parallel(
            lambda variant: run(options.quoin, variant, scratch, 1), variants)
        outcomes = common.in_parallel(
            lambda variant: compare(options.quoin, variant, scratch, options.all),
            variants)
        for variant, (error, columns) in zip(variants, outcomes):
            if variant not in LOOSE and variant not in ROUNDED:
                worst = max(worst, error)
            different += columns
        different += compare_linear_solvers(scratch)
    common.write_result(
        results, "ranks", title="1, 2, 3 and 4 ranks", reference="1 rank",
        error=worst, tolerance=TOLERANCE,
        seconds=round(time.monotonic() - start, 2), passed=not different)
    if different:
        raise Failure("columns differ: " + ", ".join(different))
    print("passed: ranks: 1, 2, 3 and 4 agree to %.2e" % worst)


if __name__ == "__main__":
    common.main(body)
