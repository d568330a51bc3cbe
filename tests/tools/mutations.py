#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Proves that the tests notice faults.

mutations.json lists faults: one text in one file replaced by another that is
wrong. Each is put into a copy of the tree; the files that it concerns are
compiled and linked with the objects of the build folder; the test named with it
must fail then, though it passes without the fault. A fault that no test notices
survives: the test is too weak.

  tests/tools/mutations.py --build build                 # all, an hour and more
  tests/tools/mutations.py --build build --only joints   # group, name or file
  tests/tools/mutations.py --build build --check         # the list only

Neither the tree nor the build folder is changed, but that the build is brought
up to date first. Exit status 1: a fault survives, does not compile, or its text
does not occur exactly once; or a test fails without any fault, or a group of
tests has no fault.

An entry of mutations.json:

  name     in words, what is wrong
  file     where
  from     the text, which occurs once (white space counts as one space)
  to       what stands there instead
  test     what must fail, as "KIND WHAT", see KINDS
  compile  of a header: the files that are compiled with it; none given: all
           that include it
"""
import argparse
import collections
import concurrent.futures
import fnmatch
import json
import os
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
import threading
import time

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))
LIST = os.path.join(HERE, "mutations.json")
PYTHON = "/usr/bin/python3"
ENVIRONMENT = dict(os.environ, OMPI_ALLOW_RUN_AS_ROOT="1",
                   OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1",
                   OMPI_MCA_rmaps_base_oversubscribe="1",
                   OMPI_MCA_mpi_yield_when_idle="1")
FOLDERS = ("include", "source", "tests", "scripts", "python", "parameter_files",
           "meshes", "doc")

# kind: the program it needs, and its command. {tree}, {quoin}, {unit_tests},
# {fuzz}, {boundary_long_run}: where they are; {what}: the rest of the entry
KINDS = {
    "unit": ("unit_tests", "{unit_tests} --gtest_filter={what}"),
    "ranks": ("unit_tests", "mpirun --oversubscribe -np 2 {unit_tests} "
              "--gtest_filter={what}"),
    "case": ("quoin", "{tree}/tests/cases/compare.py --quoin {quoin} {what}"),
    "bracket": ("quoin", "{tree}/tests/cases/bracket.py --quoin {quoin} {what}"),
    "cases": ("quoin", "{tree}/tests/cases/{what}.py --quoin {quoin}"),
    "long run": ("quoin", "{tree}/tests/cases/hybrid_long_run.py --quoin {quoin}"
                 " --steps 2000 --ratios {what}"),
    "resume": ("quoin", "{tree}/tests/cases/resume.py --quoin {quoin} "
               "--only {what}"),
    "interrupt": ("quoin", "{tree}/tests/cases/interrupt.py --quoin {quoin} "
                  "--only {what}"),
    "other ranks": ("quoin", "{tree}/tests/cases/resume_ranks.py --quoin "
                    "{quoin} --only {what}"),
    "shipped": ("quoin", "{tree}/tests/cases/shipped_cases.py --quoin {quoin} "
                "--only {what}"),
    "errors": ("quoin", "{tree}/tests/errors/errors.py --quoin {quoin} "
               "--only {what}"),
    "figures": ("quoin", "{tree}/tests/scripts/figures.py --quoin {quoin}"),
    "scripts": (None, "{tree}/tests/scripts/{what}.py"),
    "polygons": ("quoin", "{tree}/tests/scripts/polygons.py --quoin {quoin}"),
    "traces": ("quoin", "{tree}/tests/scripts/traces.py --quoin {quoin}"),
    "check": ("quoin", "{quoin} {tree}/parameter_files/{what} --check --quiet"),
    "boundary": ("boundary_long_run", "{boundary_long_run} --short"),
    "fuzz": ("fuzz", "{fuzz} {tree} --inputs {what}"),
    "include_order": (None, "{tree}/tests/tools/include_order.py {tree}"),
    "parameter_reference": ("quoin", "{tree}/tests/tools/parameter_reference.py "
                            "--quoin {quoin} --check {tree}/doc/parameters.md"),
    "clang_format": (None, "clang-format-14 --dry-run --Werror {tree}/{what}"),
    "mutations": (None, "{tree}/tests/tools/mutations.py --check"),
}
TARGETS = {"quoin": "quoin", "unit_tests": "tests/unit_tests",
           "fuzz": "tests/fuzz", "boundary_long_run": "tests/boundary_long_run"}
GMSH = "quoin_gmsh"  # what these programs look for beside them


class Failure(Exception):
    """What is wrong with a fault or a test, in a line."""


def split(test):
    """"unit A.B" as ("unit", "A.B")."""
    for kind in sorted(KINDS, key=len, reverse=True):
        if test == kind or test.startswith(kind + " "):
            return kind, test[len(kind) + 1:]
    raise Failure("'%s' is no test; kinds are: %s" % (test, ", ".join(KINDS)))


def read(path):
    with open(path, encoding="utf-8") as stream:
        return stream.read()


def faulty(fault, text):
    """The text of a file with the fault in it."""
    words = r"\s+".join(re.escape(word) for word in fault["from"].split())
    places = list(re.finditer(words, text))
    if len(places) != 1:
        raise Failure("its text occurs %d times in %s, not once"
                      % (len(places), fault["file"]))
    start, end = places[0].span()
    if text[start:end] == fault["to"]:
        raise Failure("it changes nothing")
    return text[:start] + fault["to"] + text[end:]


# ---- the list ---------------------------------------------------------------

def suites():
    """{suite: {test: its module}} of the unit tests."""
    known = {}
    root = os.path.join(ROOT, "tests", "unit")
    for folder, _, names in os.walk(root):
        module = os.path.relpath(folder, root).split(os.sep)[0]
        for name in names:
            if name.endswith("_test.cc"):
                for suite, test in re.findall(
                        r"^ *(?:TYPED_)?TEST(?:_[PF])?\(\s*(\w+),\s*(\w+)\)",
                        read(os.path.join(folder, name)), re.M):
                    known.setdefault(suite, {})[test] = module
    return known


def names_in(path):
    """Names of the entries of a list of tests."""
    return {entry["name"] for entry in
            json.loads(read(os.path.join(ROOT, "tests", path)))}


def module_of(what, known):
    """The module whose unit tests a filter names; each of its parts must name
    one."""
    modules = set()
    for part in what.split(":"):
        pieces = part.split("/")  # */Suite.test of a suite with parameters
        suite, _, test = pieces["." not in pieces[0]].partition(".")
        found = {module for name, module in known.get(suite, {}).items()
                 if fnmatch.fnmatchcase(name, test)}
        if not found:
            raise Failure("there is no unit test '%s'" % part)
        modules |= found
    if len(modules) > 1:
        raise Failure("'%s' names tests of several modules" % what)
    return modules.pop()


def group_of(test, known, cases):
    """The group of tests that a test is of, which must exist."""
    kind, what = split(test)
    if kind == "unit":
        return "unit/" + module_of(what, known)
    if kind == "ranks":
        module_of(what, known)
        return "unit tests on two ranks"
    if kind == "case":
        if what not in cases:
            raise Failure("there is no case '%s'" % what)
        return "cases: " + (cases[what].get("check") or "closed form")
    if kind == "bracket" and what not in names_in("cases/brackets.json"):
        raise Failure("there is no limit '%s'" % what)
    if kind in ("cases", "scripts"):
        if not os.path.exists(os.path.join(ROOT, "tests", kind, what + ".py")):
            raise Failure("there is no test '%s'" % what)
        return "%s/%s.py" % (kind, what)
    if kind == "errors":
        known_errors = names_in("errors/errors.json") | set(re.findall(
            r"^def (\w+)\(quoin, folder\)",
            read(os.path.join(ROOT, "tests/errors/errors.py")), re.M))
        if not any(what in name for name in known_errors):
            raise Failure("errors.py has no test '%s'" % what)
    script = {"resume": "resume.py", "interrupt": "interrupt.py",
              "other ranks": "resume_ranks.py"}.get(kind)
    if script and '    "%s' % what not in read(
            os.path.join(ROOT, "tests/cases", script)):
        raise Failure("%s has no case '%s'" % (script, what))
    return kind


def wanted_groups(known, cases):
    """All groups of tests; each must have a fault."""
    groups = {"unit/" + module for tests in known.values()
              for module in tests.values()}
    groups |= {"cases: " + (case.get("check") or "closed form")
               for case in cases.values() if case.get("label") != "long"}
    for kind in ("cases", "scripts"):
        for name in os.listdir(os.path.join(ROOT, "tests", kind)):
            text = name.endswith(".py") and read(
                os.path.join(ROOT, "tests", kind, name))
            if text and "__main__" in text and name not in (
                    "compare.py", "bracket.py", "interrupt.py", "resume.py",
                    "resume_ranks.py",
                    "hybrid_long_run.py", "shipped_cases.py", "wall_stability.py",
                    "figures.py", "polygons.py", "traces.py"):
                groups.add("%s/%s" % (kind, name))
    return groups | {"unit tests on two ranks"} | (
        set(KINDS) - {"unit", "ranks", "case", "cases", "scripts"})


def check(faults, everything):
    """Groups of the faults by name; raises a Failure that lists all that is
    wrong with the list."""
    known = suites()
    cases = {case["name"]: case for case in json.loads(
        read(os.path.join(ROOT, "tests/cases/cases.json")))}
    wrong, groups = [], {}
    for fault in faults:
        try:
            if fault["name"] in groups:
                raise Failure("its name is taken")
            groups[fault["name"]] = group_of(fault["test"], known, cases)
            faulty(fault, read(os.path.join(ROOT, fault["file"])))
            for file in fault.get("compile", []):
                read(os.path.join(ROOT, file))
        except (Failure, OSError, KeyError) as problem:
            wrong.append("%s: %s" % (fault.get("name"), problem))
    if everything:
        wrong += ["the tests '%s' have no fault" % group for group in
                  sorted(wanted_groups(known, cases) - set(groups.values()))]
    if wrong:
        raise Failure("\n".join(wrong))
    return groups


# ---- building and running ---------------------------------------------------

class Build:
    """The commands of a build folder that is up to date."""

    def __init__(self, folder, targets):
        self.folder = os.path.abspath(folder)
        if targets:
            self.call(["ninja", "-C", self.folder]
                      + sorted(TARGETS[name] for name in targets))
        with open(os.path.join(self.folder, "compile_commands.json")) as stream:
            self.compile = {entry["file"]: shlex.split(entry["command"])
                            for entry in json.load(stream)}
        self.link = {}
        for name in targets:
            command = self.call(["ninja", "-C", self.folder, "-t", "commands",
                                 TARGETS[name]]).strip().splitlines()[-1]
            words = shlex.split(command)
            self.link[name] = words[words.index("&&") + 1:
                                    len(words) - words[::-1].index("&&") - 1]
        self.deps = collections.defaultdict(set)
        for line in self.call(["ninja", "-C", self.folder, "-t", "deps"]) \
                .splitlines():
            if line and not line.startswith(" "):
                obj = line.split(":")[0]
            elif line.startswith("    " + ROOT):
                self.deps[line.strip()].add(obj)
        self.objects = {self.object_of(file): file for file in self.compile}
        # modules that are compiled as one file: that of each of their sources
        self.unity = {}
        for file in self.compile:
            if file.startswith(self.folder) and "/Unity/" in file \
                    and os.path.exists(file):
                with open(file) as stream:
                    for source in re.findall(r'#include "(.*\.cc)"',
                                             stream.read()):
                        self.unity[source] = file

    @staticmethod
    def call(words):
        done = subprocess.run(words, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, text=True)
        if done.returncode != 0:
            raise Failure("%s:\n%s" % (" ".join(words), done.stdout[-3000:]))
        return done.stdout

    def object_of(self, file):
        words = self.compile[file]
        return words[words.index("-o") + 1]

    def concerned(self, fault):
        """The files to compile anew."""
        file = os.path.join(ROOT, fault["file"])
        if "compile" in fault:
            files = [os.path.join(ROOT, name) for name in fault["compile"]]
            return sorted({self.unity.get(name, name) for name in files})
        file = self.unity.get(file, file)
        if file in self.compile:
            return [file]
        if file.endswith((".h", ".cc")):
            if not self.deps[file]:
                raise Failure("nothing includes %s" % fault["file"])
            return sorted(self.objects[o] for o in self.deps[file]
                          if o in self.objects)
        return []

    def commands(self, place, files, program):
        """Compile files of the copy in place and link the program there."""
        replaced = {}
        for file in files:
            is_unity = file in self.unity.values()
            name = os.path.relpath(file, self.folder if is_unity else ROOT)
            words = list(self.compile[file])
            old = self.object_of(file)
            # objects of another program are none of ours
            is_library = old.startswith("CMakeFiles/quoin_library.dir")
            if not is_library and old not in self.link[program]:
                continue
            new = os.path.join(place, "objects", name + ".o")
            os.makedirs(os.path.dirname(new), exist_ok=True)
            replaced[old] = new
            tree = os.path.join(place, "tree")
            words[words.index("-o") + 1] = new
            source = os.path.join(tree, name)
            if is_unity:
                # it includes the sources of the copy
                source = os.path.join(place, name)
                os.makedirs(os.path.dirname(source), exist_ok=True)
                with open(file) as stream, open(source, "w") as copy:
                    copy.write(stream.read().replace('"%s/' % ROOT,
                                                     '"%s/' % tree))
            words[words.index("-c") + 1] = source
            words = ["-I" + os.path.join(tree, "include")
                     if word == "-I" + os.path.join(ROOT, "include") else word
                     for word in words]
            yield words + ["-w"]
        words = list(self.link[program])
        words[words.index("-o") + 1] = os.path.join(place, program)
        # Before all others: of a function of a header that is not inlined the
        # linker takes the first, and does not ask the library for old ones.
        first = next(i for i, word in enumerate(words) if word.endswith(".o"))
        words[first:first] = replaced.values()
        yield [word for word in words if word not in replaced]


class Worker:
    """A folder with a copy of the tree, in which one fault at a time is tried."""

    def __init__(self, place, build):
        self.place, self.build = place, build
        self.tree = os.path.join(place, "tree")
        os.makedirs(self.tree)
        os.symlink(os.path.join(build.folder, GMSH), os.path.join(place, GMSH))
        for folder in FOLDERS:
            # not what runs leave in the folders of their parameter files
            ignored = ["__pycache__"] + (["output", "output_*"] if folder
                                         == "parameter_files" else [])
            shutil.copytree(os.path.join(ROOT, folder),
                            os.path.join(self.tree, folder),
                            ignore=shutil.ignore_patterns(*ignored))

    def places(self, tree, program_folder):
        return dict({name: os.path.join(program_folder, name if program_folder
                                        == self.place else TARGETS[name])
                     for name in TARGETS}, tree=tree)

    def run(self, test, places, limit):
        """Whether the test passes, and its last words."""
        kind, what = split(test)
        words = shlex.split(KINDS[kind][1])
        words = [word.format(what=what, **places) for word in words]
        if words[0].endswith(".py"):
            words.insert(0, PYTHON)
        process = subprocess.Popen(
            words, cwd=self.place, env=ENVIRONMENT, stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT, text=True, errors="replace",
            start_new_session=True)
        try:
            printed, _ = process.communicate(timeout=limit)
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, 9)
            process.communicate()
            return False, "not over after %g s" % limit
        return process.returncode == 0, last_words(printed)

    def without_fault(self, test):
        start = time.monotonic()
        passed, said = self.run(
            test, self.places(ROOT, self.build.folder), 1800)
        if not passed:
            raise Failure("'%s' fails without a fault: %s" % (test, said))
        return time.monotonic() - start

    def with_fault(self, fault, limit):
        program = KINDS[split(fault["test"])[0]][0]
        places = self.places(self.tree, self.place)
        path = os.path.join(self.tree, fault["file"])
        right = read(os.path.join(ROOT, fault["file"]))
        for name in TARGETS:
            if os.path.exists(places[name]):
                os.remove(places[name])
        try:
            with open(path, "w", encoding="utf-8") as stream:
                stream.write(faulty(fault, right))
            if program:
                files = self.build.concerned(fault)
                for words in self.build.commands(self.place, files, program):
                    done = subprocess.run(
                        words, cwd=self.build.folder, env=ENVIRONMENT,
                        stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                        text=True)
                    if done.returncode != 0:
                        raise Failure("does not compile: %s" % next(
                            (line for line in done.stdout.splitlines()
                             if "error" in line), done.stdout[-300:]))
            return self.run(fault["test"], places, limit)
        finally:
            with open(path, "w", encoding="utf-8") as stream:
                stream.write(right)


def last_words(printed):
    """The line that says most of why a test failed."""
    lines = [line.strip() for line in printed.splitlines() if line.strip()]
    for sign in ("FAILED:", "failed:", "Failure", "[  FAILED  ]", "rror"):
        for line in lines:
            if sign in line:
                return line[:160]
    return lines[-1][:160] if lines else ""


def run_all(faults, groups, options):
    if not os.path.exists(os.path.join(options.build, "build.ninja")):
        raise Failure("'%s' is no build folder" % options.build)
    programs = {KINDS[split(fault["test"])[0]][0] for fault in faults} - {None}
    build = Build(options.build, programs)
    with tempfile.TemporaryDirectory(prefix="mutations_",
                                     dir=build.folder) as folder:
        results = try_all(faults, groups, options, build, folder)
    report(faults, groups, results)


def try_all(faults, groups, options, build, folder):
    """{name of a fault: (what became of it, last words)}."""
    idle = [Worker(os.path.join(folder, str(i)), build)
            for i in range(options.jobs)]
    lock, seconds, results = threading.Lock(), {}, {}

    def attempt(fault):
        with lock:
            worker = idle.pop()
        start = time.monotonic()
        try:
            if not options.quick and fault["test"] not in seconds:
                seconds[fault["test"]] = worker.without_fault(fault["test"])
            limit = max(120., 10. * seconds.get(fault["test"], 30.))
            passed, said = worker.with_fault(fault, limit)
            result = ("SURVIVED" if passed else "caught", said)
        except Failure as failure:
            result = ("WRONG", str(failure))
        with lock:
            idle.append(worker)
            results[fault["name"]] = result
            print("%-8s %3.0f s  %-26s %s\n%s" % (
                result[0], time.monotonic() - start, groups[fault["name"]],
                fault["name"], " " * 16 + result[1]), flush=True)

    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        for future in [pool.submit(attempt, fault) for fault in faults]:
            future.result()
    return results


def report(faults, groups, results):
    """Prints the table; a Failure if anything was not caught."""
    counts = collections.defaultdict(collections.Counter)
    for fault in faults:
        counts[groups[fault["name"]]][results[fault["name"]][0]] += 1
    print("\n| tests | faults | caught |\n|---|---|---|")
    for group in sorted(counts):
        print("| %s | %d | %d |" % (group, sum(counts[group].values()),
                                    counts[group]["caught"]))
    bad = [name for name, (word, _) in results.items() if word != "caught"]
    print("\n%d faults, %d caught" % (len(faults), len(faults) - len(bad)))
    if bad:
        raise Failure("not caught: " + "; ".join(bad))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--build", default=os.path.join(ROOT, "build"))
    parser.add_argument("--only", action="append",
                        help="those whose group, name or file has this; may "
                        "be given several times")
    parser.add_argument("--check", action="store_true",
                        help="check the list, build and run nothing")
    parser.add_argument("--quick", action="store_true",
                        help="do not run the tests without a fault first")
    parser.add_argument("--jobs", type=int, default=1,
                        help="faults at a time (default 1)")
    options = parser.parse_args()
    try:
        faults = json.loads(read(LIST))
        groups = check(faults, everything=True)
        if options.only:
            faults = [fault for fault in faults if any(
                only in text for only in options.only for text in
                (groups[fault["name"]], fault["name"], fault["file"]))]
        if options.check:
            print("%d faults in %d groups of tests"
                  % (len(faults), len(set(groups.values()))))
            return
        run_all(faults, groups, options)
    except Failure as failure:
        print("FAILED: %s" % failure)
        sys.exit(1)


if __name__ == "__main__":
    main()
