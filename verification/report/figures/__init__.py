# SPDX-License-Identifier: MIT
"""Drawing: figures, what their colours and fonts are, and the numbers and vertices that a page
needs of them.
"""
