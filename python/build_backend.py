# SPDX-License-Identifier: MIT
"""What pip builds the package with: scikit-build-core, or a sentence on where to get it."""
import sys

try:
    from scikit_build_core.build import *  # noqa: F401,F403  the hooks that pip calls
except ModuleNotFoundError as missing:
    sys.exit(f"homespun needs the Python package {missing.name}, and did not find it: install "
             "python3-scikit-build-core (Debian 13), or leave out --no-build-isolation. Without pip: "
             "cmake --build --preset release --target python, or the package python3-homespun")
