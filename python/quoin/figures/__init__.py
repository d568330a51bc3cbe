# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Figures of runs by matplotlib, all in one look."""

from quoin.figures import figure_style  # noqa: F401  (before any figure)
