#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""scripts/build and scripts/run among programs that only say what they were
called with."""
import os
import shutil
import subprocess
import unittest

from synthetic_runs import ROOT, Scratch

SAYS = '#!/bin/sh\necho "$(basename "$0")" "$@"\n'


class Shell(Scratch):
    def setUp(self):
        super().setUp()
        for folder in ("scripts", "python/quoin", "bin", "build", "cases"):
            os.makedirs(os.path.join(self.folder, folder))

    def take(self, *names):
        for name in names:
            shutil.copy(os.path.join(ROOT, name),
                        os.path.join(self.folder, name))

    def write(self, path, text):
        path = os.path.join(self.folder, path)
        with open(path, "w") as file:
            file.write(text)
        os.chmod(path, 0o755)

    def call(self, name, *words, **variables):
        path = os.path.join(self.folder, "bin") + ":" + os.environ["PATH"]
        return subprocess.run(
            [os.path.join(self.folder, "scripts", name), *words], check=True,
            cwd=self.folder, stdout=subprocess.PIPE, text=True, timeout=60,
            env=dict(os.environ, PATH=path, **variables)).stdout


class Build(Shell):
    def setUp(self):
        super().setUp()
        self.take("scripts/build")
        self.write("scripts/debian-packages.txt", "")
        self.write("bin/ninja", SAYS)
        self.write("bin/nproc", "#!/bin/sh\necho 7\n")
        # whose screen output the script throws away
        self.write("bin/cmake", SAYS.replace("echo", "echo >%s/called"
                                             % self.folder))

    def called(self, options):
        path = os.path.join(self.folder, "called")
        if os.path.exists(path):
            os.remove(path)
        self.assertEqual(self.call("build", "all", CMAKE_OPTIONS=options),
                         "ninja -C %s/build -j 7 all\n" % self.folder)
        if not os.path.exists(path):
            return None
        with open(path) as file:
            return file.read().split("-G Ninja")[1].strip()

    def test_options_are_passed_on(self):
        self.assertEqual(self.called(""), "")
        self.write("build/build.ninja", "")
        self.assertIsNone(self.called(""))
        self.assertEqual(self.called("-D QUOIN_WERROR=ON"),
                         "-D QUOIN_WERROR=ON")

    def test_python_of_vtk_may_come_from_paraview(self):
        self.write("build/build.ninja", "")
        self.write("scripts/debian-packages.txt", "python3-vtk9\nxvfb\n")
        self.write("bin/dpkg-query", "#!/bin/sh\n")
        self.write("bin/sudo", '#!/bin/sh\n"$@"\n')
        self.write("bin/apt-get", "#!/bin/sh\n")
        for status, missing in ((0, "xvfb"), (1, "python3-vtk9 xvfb")):
            self.write("bin/python3", f"#!/bin/sh\nexit {status}\n")
            python = os.path.join(self.folder, "bin/python3")
            self.assertEqual(self.call("build", PYTHON=python).splitlines()[0],
                             "installing: " + missing)


class Run(Shell):
    def setUp(self):
        super().setUp()
        self.take("scripts/run", "python/quoin/run_parameters.py")
        for name in ("scripts/build", "scripts/plot", "scripts/render",
                     "build/quoin"):
            self.write(name, SAYS)
        self.write("cases/case.prm", "include common.inc\n")
        self.write("cases/common.inc", "set Output directory = first\n"
                   "set Output directory = results  # the last one counts\n")
        self.write("cases/plot.json", "{}")

    def output(self, *words):
        """The folder that is drawn, the last line."""
        lines = self.call("run", "cases/case.prm", *words).splitlines()
        self.assertEqual(lines[1:], [
            " ".join(("quoin", "cases/case.prm") + words),
            "plot %s --spec cases/plot.json" % lines[-1][11:],
            "render " + lines[-1][11:], lines[-1]])
        return lines[-1][11:]

    def test_output_directory(self):
        self.assertEqual(self.output(), "cases/results")
        self.assertEqual(self.output("--set", "Thickness=2"), "cases/results")
        self.assertEqual(self.output(
            "--set", "Output directory=a", "--quiet",
            "--set=Output directory=b"), "cases/b")
        self.assertEqual(self.output("--set", "Output directory=/a"), "/a")
        self.assertEqual(self.output(
            "--output", "here", "--set", "Output directory=a"), "here")
        self.assertEqual(self.output("--output=here"), "here")

    def test_nothing_is_drawn_of_a_check(self):
        self.assertNotIn("render", self.call("run", "cases/case.prm",
                                             "--check"))


if __name__ == "__main__":
    unittest.main()
