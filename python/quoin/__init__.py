# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Runs quoin and reads what it leaves.

  import quoin
  results = quoin.run("case.prm", {"Joints/mortar/Cohesion": 0.3e6}, "output")
  results = quoin.read("output")                  what is there already
  results.histories["force"].max(), results.joints()["state"]
  table = quoin.study("case.prm", {"Joints/mortar/Cohesion": [0.2e6, 0.3e6]},
                      "study", lambda results: {...})
"""

from quoin.results import Results, read
from quoin.running import RunFailed, run
from quoin.studies import study

__all__ = ["Results", "RunFailed", "read", "run", "study"]
