#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Compiles what has SIMD lanes for processors of other widths than this one.

  tests/tools/other_processors.py --build PATH [--march haswell] [--only rigid]

The build is for this machine's processor. Code for four lanes, or for eight, that
does not compile stays unknown until somebody builds on a processor that has as
many. Only the syntax is checked, with all templates that are used.
"""
import argparse
import json
import os
import shlex
import subprocess
import sys

# modules of the library whose loops are in lanes, by a part of the file's name
MODULES = ("block_elements/", "blocks/", "contact/", "joint_elements/",
           "unity_dynamics", "unity_contact", "unity_loads")
MARCHES = ("haswell", "skylake-avx512")


def command(entry, march):
    """That of the compiler for another processor, without precompiled headers,
    which are for this one."""
    words, result = shlex.split(entry["command"]), []
    skip = False
    for word, after in zip(words, words[1:] + [""]):
        if skip:
            skip = False
        elif word == "-o" or (word == "-include" and "cmake_pch" in after):
            skip = True
        elif word not in ("-march=native", "-Winvalid-pch", "-c"):
            result.append(word)
    return result + ["-fsyntax-only", "-march=" + march]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--build", required=True)
    parser.add_argument("--march", choices=MARCHES)
    parser.add_argument("--only", default="", help="part of a file's name")
    options = parser.parse_args()
    with open(os.path.join(options.build, "compile_commands.json")) as stream:
        entries = [entry for entry in json.load(stream)
                   if "quoin_library.dir" in entry["command"]
                   and options.only in entry["file"]
                   and any(part in entry["file"] for part in MODULES)]
    if not entries:
        sys.exit("FAILED: compile_commands.json has none of the files")
    failed = []
    for march in [options.march] if options.march else MARCHES:
        for entry in entries:
            done = subprocess.run(command(entry, march), text=True,
                                  cwd=entry["directory"],
                                  stdout=subprocess.PIPE,
                                  stderr=subprocess.STDOUT)
            if done.returncode:
                failed.append("%s for %s" % (entry["file"], march))
                print(done.stdout[-3000:])
    if failed:
        sys.exit("FAILED: does not compile: " + ", ".join(failed))
    print("passed: %d files" % len(entries))


if __name__ == "__main__":
    main()
