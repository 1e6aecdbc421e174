# SPDX-License-Identifier: MIT
"""What stands in the page, in its order: contents, tables, templates, style and scripts."""
