# SPDX-License-Identifier: MIT
"""Writes the manual page homespun.1.gz and the completion homespun.bash.

    manual.py PROGRAM VERSION FOLDER
"""
import gzip
import pathlib
import sys

from bash_completion import bash_completion
from help_text import read
from man_page import man_page


def main(path, version, folder):
    """Asks the program at `path` and writes both files into `folder`."""
    program = read(path)
    folder = pathlib.Path(folder)
    # No time stamp, so that equal pages are equal files.
    page = gzip.compress(man_page(program, version).encode(), mtime=0)
    (folder / "homespun.1.gz").write_bytes(page)
    (folder / "homespun.bash").write_text(bash_completion(program), encoding="utf-8")


if __name__ == "__main__":
    main(*sys.argv[1:])
