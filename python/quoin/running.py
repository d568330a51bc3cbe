# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Starts quoin on a case. A run ends, with a checkpoint, when the Python that
started it is interrupted or ends in any other way."""

import ctypes
import fcntl
import os
import shutil
import signal
import subprocess
import threading

from quoin import run_parameters
from quoin.results import read

# the folder of the sources, unless the package was installed without them
CHECKOUT = os.path.dirname(os.path.dirname(os.path.dirname(
    os.path.abspath(__file__))))
if not os.path.exists(os.path.join(CHECKOUT, "scripts", "build")):
    CHECKOUT = None


class RunFailed(Exception):
    """A run that quoin refused or ended: its message, the exit status (1: wrong
    input, 2: the run failed and left what it had, negative: a signal) and the
    output folder."""

    def __init__(self, message, status, output):
        super().__init__(message)
        self.status = status
        self.output = output


def executable(quoin=None):
    """The program: @p quoin, that of the environment variable QUOIN, that
    which was built beside this package, or the one on the PATH."""
    built = os.path.join(CHECKOUT, "build", "quoin") if CHECKOUT else ""
    found = (quoin or os.environ.get("QUOIN")
             or (built if os.path.exists(built) else shutil.which("quoin")))
    if found is None:
        raise FileNotFoundError(
            "the program quoin was not found: build it with scripts/build, "
            "put its folder onto the PATH or name it in the environment "
            "variable QUOIN")
    return os.path.abspath(found)


def entry(name, value):
    """"Section/Name=value" for --set; lists with commas, truths as yes, no."""
    def text(one):
        return ("yes" if one else "no") if isinstance(one, bool) else str(one)
    several = isinstance(value, (list, tuple))
    return f"{name}=" + (", ".join(map(text, value)) if several
                         else text(value))


def command(case, output, entries=(), options=(), ranks=1, quoin=None):
    """The words that start a run; @p entries: "Section/Name=value"."""
    words = ["mpirun", "-n", str(ranks)] if ranks > 1 else []
    words += [executable(quoin), case, "--output", output]
    for text in entries:
        words += ["--set", text]
    return words + list(options)


def environment():
    """Environment variables of runs that share a machine; Open MPI refuses
    root unless told."""
    return dict(os.environ, OPENBLAS_NUM_THREADS="1",
                OMPI_ALLOW_RUN_AS_ROOT="1",
                OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1",
                OMPI_MCA_rmaps_base_oversubscribe="1",
                OMPI_MCA_mpi_yield_when_idle="1")


def end_with_parent(number):
    """Makes the kernel send a new process a signal when the thread that
    started it ends; does nothing where there is no such kernel."""
    try:
        prctl = ctypes.CDLL(None).prctl
    except AttributeError:
        return None
    return lambda: prctl(1, number)      # PR_SET_PDEATHSIG


class Runs:
    """Runs under way that can be stopped together, from any thread."""

    def __init__(self):
        self.lock = threading.Lock()
        self.processes = {}
        self.is_stopped = False

    def finish(self, words, ranks=1, quiet=True):
        """Starts a run and waits for its end: exit status and what it wrote to
        stderr. In a session of its own: Ctrl-C reaches Python alone, which
        passes it on once, as a second signal would end it at once."""
        # mpirun passes this one on and waits
        number = signal.SIGTERM if ranks == 1 else signal.SIGUSR1
        with self.lock:
            if self.is_stopped:
                raise KeyboardInterrupt
            process = subprocess.Popen(
                words, env=environment(), stderr=subprocess.PIPE, text=True,
                stdout=subprocess.DEVNULL if quiet else None,
                start_new_session=True, preexec_fn=end_with_parent(number))
            self.processes[process] = number
        try:
            said = process.communicate()[1]
        except BaseException:
            process.send_signal(number)
            process.communicate()
            raise
        finally:
            with self.lock:
                del self.processes[process]
        return process.returncode, said

    def stop(self):
        """Ends all, with their checkpoints, and starts no more."""
        with self.lock:
            self.is_stopped = True
            for process, number in self.processes.items():
                process.send_signal(number)


def is_under_way(output):
    """Whether a run is writing to a folder, by the lock that it holds."""
    try:
        with open(os.path.join(output, "lock"), "rb+") as file:
            fcntl.flock(file, fcntl.LOCK_SH | fcntl.LOCK_NB)
    except BlockingIOError:
        return True
    except OSError:
        pass
    return False


def run(case, overrides=None, output=None, ranks=1, quoin=None, options=(),
        quiet=True, runs=None):
    """Runs a case to its end and returns its Results.

    @p case: path of a parameter file. @p overrides: {"Section/Name": value},
    numbers, texts, truths or lists of them, in the units of the file. @p
    output: the folder of the results, default that of the parameter file. @p
    options: further words for quoin, e.g. ["--resume"]. With @p quiet its lines
    are not shown. @p runs: the Runs that it belongs to, default its own.
    Throws RunFailed with quoin's message.
    """
    entries = [entry(*item) for item in (overrides or {}).items()]
    output = output or run_parameters.output_of(case, entries)
    status, said = (runs or Runs()).finish(
        command(case, output, entries, options, ranks, quoin), ranks, quiet)
    if status != 0:
        raise RunFailed(said.strip()
                        or f"quoin ended with exit status {status}", status,
                        output)
    return read(output)
