#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Makes report.html, one self-contained page, and the figures as SVG and CSV, with --pdf as PDF
too, from stored results.

    report.py DIR [DIR...] --output FOLDER [--pdf]
    report.py DIR... --output FOLDER --figure strain --width 8.5cm --loads strip-1 --format pdf,svg

The second form writes one figure for a paper and no page. Of several cells, or of several versions of one cell, the page compares what they share.

Exit status: 0 the report is written; 2 the results cannot be used, one message per fault on stderr;
130 Ctrl-C.
FOLDER/report.html and FOLDER/figures/ appear when all of them are complete, or not at all.
"""
import argparse
import contextlib
import errno
import gc
import os
import shutil
import signal
import sys
import tempfile
import warnings

from figures import style

style.use()  # before anything draws

# pylint: disable=wrong-import-position
from page.contents import page_contents  # noqa: E402
from page.gallery import Gallery  # noqa: E402
from page.page import render  # noqa: E402
from page.page_size import fitted  # noqa: E402
from page.paper_figure import NAMES, write_figures  # noqa: E402
from page.terminal import answer_text  # noqa: E402
from read.results import BadResults, read_results  # noqa: E402


def write_report(folders, output, tells=False, with_pdf=False):
    """Reads result folders and writes the report.

    @param tells whether a terminal shows what is drawn
    @param with_pdf whether figures are saved as PDF as well

    @return the path of report.html, and its answer as text
    @throws BadResults naming every file, line or key that is wrong
    """
    # What is imported by now stays, and drawing makes few cycles of much that does not: looking for
    # them as often as usual takes a sixth of the time.
    gc.freeze()
    gc.set_threshold(100_000)
    results = read_results(folders)
    if os.path.exists(output) and not os.path.isdir(output):
        raise BadResults([f"{output}: is a file, expected a folder. Give another --output."])
    created = not os.path.isdir(output)
    try:
        os.makedirs(output, exist_ok=True)
        workplace = tempfile.mkdtemp(prefix=".report-", dir=output)
    except OSError as error:
        raise BadResults(
            [f"{output}: cannot be written ({error}). Give another --output."]
        ) from error
    try:
        sheets = sum(len(cell.field_files) for cell in results.cells.values())
        gallery = Gallery(os.path.join(workplace, "figures"), sheets, tells, with_pdf)
        contents = page_contents(results, gallery, output)
        gallery.finish()
        html = render(contents)
        html = fitted(
            html, {name[:-5] for name in os.listdir(gallery.folder) if name.endswith(".webp")}
        )
        with open(os.path.join(workplace, "report.html"), "w", encoding="utf-8") as file:
            file.write(html)
        os.makedirs(os.path.join(output, "figures"), exist_ok=True)
        names = sorted(os.listdir(gallery.folder))
        for name in names:
            os.replace(os.path.join(gallery.folder, name), os.path.join(output, "figures", name))
            pdf = name.removesuffix(".svg") + ".pdf"
            if name.endswith(".svg") and pdf not in names:  # one of an earlier page shows other numbers
                with contextlib.suppress(FileNotFoundError):
                    os.remove(os.path.join(output, "figures", pdf))
        os.replace(os.path.join(workplace, "report.html"), os.path.join(output, "report.html"))
        created = False
    finally:
        shutil.rmtree(workplace, ignore_errors=True)
        if created:  # nothing was written: leave no empty folder behind
            try:
                os.rmdir(output)
            except OSError:
                pass
    return os.path.join(output, "report.html"), answer_text(contents)


def comes_of_a_full_disk(error):
    """Whether a write to a full disk is where an exception began; libraries that draw fail again
    while they clean up.
    """
    while error is not None:
        if isinstance(error, OSError) and error.errno in (errno.ENOSPC, errno.EDQUOT):
            return True
        error = error.__cause__ or error.__context__
    return False


def main(arguments=None):
    parser = argparse.ArgumentParser(
        prog="homespun report", description=__doc__.split("\n\n", maxsplit=1)[0]
    )
    parser.add_argument(
        "folders",
        nargs="+",
        metavar="DIR",
        help=(
            "output folder of `homespun strain`, `homogenize`, `drape`, `stress`, `converge`,"
            " `load`, `bend` or `verify`; of several the page compares cells and versions"
        ),
    )
    parser.add_argument(
        "--output", required=True, metavar="FOLDER", help="where report.html and figures/ go"
    )
    parser.add_argument("--pdf", action="store_true", help="save each figure as PDF, too")
    parser.add_argument(
        "--figure", help=f"one figure for a paper instead of the page: {', '.join(NAMES)}"
    )
    parser.add_argument("--width", default="8.5cm", help="of the figure")
    parser.add_argument("--loads", default="", help="of the figure, comma-separated")
    parser.add_argument("--format", default="pdf,svg", help="of the figure, comma-separated")
    parser.add_argument(
        "--quiet", action="store_true", help="say nothing unless something is wrong"
    )
    options = parser.parse_args(arguments)
    # Ctrl-C reaches the processes that draw, too: they end without a word.
    os.register_at_fork(after_in_child=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL))
    try:
        tells = not options.quiet and sys.stderr.isatty()
        with warnings.catch_warnings():
            # Pages are drawn by processes that are forked where nothing else runs: the threads that
            # Python 3.12 and later warn of are those of BLAS, which wait.
            warnings.filterwarnings("ignore", message=".*use of fork", category=DeprecationWarning)
            if options.figure:
                paths = write_figures(
                    read_results(options.folders),
                    options.output,
                    options.figure,
                    options.width,
                    [load for load in options.loads.split(",") if load],
                    options.format.split(","),
                )
                print("" if options.quiet else "\n".join(paths), end="" if options.quiet else "\n")
                return 0
            path, answer = write_report(options.folders, options.output, tells, options.pdf)
        if tells:
            print("\r\033[K", end="", file=sys.stderr)
    except BadResults as error:
        for fault in error.faults:
            print(f"error: {fault}", file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        print("\nhomespun report: interrupted, no page was written", file=sys.stderr)
        return 130
    except Exception as error:  # pylint: disable=broad-exception-caught
        if not comes_of_a_full_disk(error):
            raise
        print(
            f"homespun report: {options.output}: cannot be written: is the disk full?",
            file=sys.stderr,
        )
        return 2
    if not options.quiet:
        if answer:
            print(answer)
        print(f"{path} ({os.path.getsize(path) / 1e6:.1f} MB)")
    return 0


if __name__ == "__main__":
    sys.exit(main())
