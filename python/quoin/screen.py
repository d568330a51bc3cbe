# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""The screen that VTK draws on, which nobody need see. Without matplotlib, for
ParaView's Python."""

import ctypes
import os
import random
import shutil
import signal
import subprocess


def has_screen():
    """Whether VTK, which crashes without, can open a window: where it draws by X,
    that a server answers at DISPLAY, with which this program stays connected."""
    import vtkmodules.vtkRenderingOpenGL2  # noqa: F401  (fills the factory)
    from vtkmodules.vtkRenderingCore import vtkRenderWindow
    if vtkRenderWindow().GetClassName() != "vtkXOpenGLRenderWindow":
        return True
    try:
        x11 = ctypes.CDLL("libX11.so.6")
    except OSError:
        return True
    x11.XOpenDisplay.restype = ctypes.c_void_p
    return bool(x11.XOpenDisplay(None))


def end_with_parent():
    """In a new process: Linux ends it with the program that has started it."""
    pr_set_pdeathsig = 1
    ctypes.CDLL(None).prctl(pr_set_pdeathsig, signal.SIGTERM)


def open_screen():
    """Starts, if there is no screen, an X server that nobody sees and that ends
    with this program, however and whenever that ends."""
    if has_screen():
        return
    if shutil.which("Xvfb") is None:
        raise OSError("pictures in three dimensions need a screen: DISPLAY "
                      "names none, and Xvfb, which stands for one, was not "
                      "found. Install it: apt-get install xvfb")
    # any number, for the next one may be that of a server which is ending
    number = f":{random.randint(1000, 50000)}"
    out, into = os.pipe()
    open_screen.server = subprocess.Popen(
        ["Xvfb", number, "-displayfd", str(into), "-nolisten", "tcp",
         "-screen", "0", "64x64x24"], pass_fds=[into],
        preexec_fn=end_with_parent, stdin=subprocess.DEVNULL,
        stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    os.close(into)
    os.environ["DISPLAY"] = number
    with open(out) as pipe:
        pipe.read()                  # until it answers, or has ended
    if not has_screen():
        raise OSError("Xvfb, the screen of pictures in three dimensions, does "
                      f"not start; 'Xvfb {number}' says why")
