#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Writes doc/parameters.md from the program, or checks that it is current.

  tests/tools/parameter_reference.py --quoin PATH FILE
  tests/tools/parameter_reference.py --quoin PATH --check FILE
"""
import argparse
import subprocess
import sys

parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
parser.add_argument("--quoin", required=True)
parser.add_argument("--check", action="store_true")
parser.add_argument("file")
options = parser.parse_args()

printed = subprocess.run([options.quoin, "--print-parameters"], check=True,
                         stdout=subprocess.PIPE, text=True).stdout
text = """# Parameters

Printed by `quoin --print-parameters`: every parameter with its default and
meaning. `NAME` stands for each of the names that the section lists. SI units,
angles in degrees, tension positive.

```
""" + "\n".join(line.rstrip() for line in printed.splitlines()) + "\n```\n"

if not options.check:
    with open(options.file, "w") as stream:
        stream.write(text)
    sys.exit(0)
with open(options.file) as stream:
    if stream.read() != text:
        sys.exit("%s is not current: write it again with %s --quoin %s %s"
                 % (options.file, sys.argv[0], options.quoin, options.file))
