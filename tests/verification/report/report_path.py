# SPDX-License-Identifier: MIT
"""Puts the report on the path of modules, as if its program had been started. Tests import this
first.
"""
import pathlib
import sys

REPORT = pathlib.Path(__file__).resolve().parents[3] / "verification" / "report"
sys.path.insert(0, str(REPORT))
