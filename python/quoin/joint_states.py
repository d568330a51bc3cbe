# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""The states of joints and contacts, as the fields have them (JointState)."""

INTACT, SLIPPING, SLIPPED, OPEN = 0, 1, 2, 3
NAMES = {INTACT: "intact", SLIPPING: "slipping", SLIPPED: "slipped",
         OPEN: "open"}
