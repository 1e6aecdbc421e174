# SPDX-License-Identifier: MIT
"""Reading and judging stored results: whatever only reads."""
