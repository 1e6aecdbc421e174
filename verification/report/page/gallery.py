# SPDX-License-Identifier: MIT
"""Saves figures as SVG, and as PDF where asked for, with their numbers as CSV, animations as WebP, and
inlines them into the page.

Laying figures out and writing them takes most of the time of a page, and no figure knows of
another: each is saved by a copy of this process, as many at once as there are cores, while the
next are drawn.
"""
import base64
import contextlib
import functools
import gc
import io
import json
import multiprocessing
import os
import pickle
import re
import sys
import urllib.parse
from dataclasses import dataclass
from multiprocessing import connection

from matplotlib import pyplot
from markupsafe import Markup
from PIL import Image

from figures import plot_data

PAD = 0.04  # inches around a figure
PAGE_DPI = 130  # of images on the page; the saved files are finer
SHADED_DPI = 170  # of pictures of shaded cloth, which are small files
METADATA = {  # the same input gives the same file
    "pdf": {"CreationDate": None, "Producer": None, "Creator": "homespun"},
    "svg": {"Date": None, "Creator": "homespun"},
}
FULL_IMAGES = 6  # that the page takes at this resolution; more of them become coarser


@dataclass
class Picture:
    """A drawn figure as the template shows it; of one that is still being saved, the name and the
    caption alone are known."""

    name: str  # file name without ending
    source: str  # data URI
    caption: str
    width: int  # CSS pixels
    endings: tuple = ("svg",)  # of its files, as far as there are any
    plot: str = ""  # JSON of panels and curves, for the interactive plot
    view: str = ""  # JSON of a cloth to turn and zoom

    def take(self, saved):
        """What Gallery.save() returned is of this figure."""
        self.source, self.width, self.endings, self.plot = saved


def short_svg(svg):
    """An SVG with coordinates of one decimal (1/720 inch) and without metadata, comments and unused
    names.

    Only paths, positions and shifts are rounded; scale factors keep their digits.
    """
    svg = re.sub(
        r"<metadata>.*?</metadata>|<!--.*?-->|<\?xml.*?\?>|<!DOCTYPE.*?>", "", svg, flags=re.S
    )
    used = set(re.findall(r'(?:href="|url\()#([^")]*)', svg))
    svg = re.sub(
        r' id="([^"]*)"', lambda match: match.group(0) if match.group(1) in used else "", svg
    )

    def rounded(match):
        return re.sub(r"(\d+\.\d)\d+", r"\1", match.group(0))

    svg = re.sub(r'\b(?:d|x|y|points)="[^"]*"|translate\([^)]*\)', rounded, svg)
    return (
        re.sub(r"\s+", " ", svg).replace("> <", "><").replace("; ", ";").replace(": ", ":").strip()
    )


def svg_address(svg):
    """An SVG as a data URI in percent encoding: a quarter shorter than base64."""
    return "data:image/svg+xml," + urllib.parse.quote(
        svg.replace('"', "'"), safe=" !$()*+,-./:;=?@[]_~'<>{}|^`"
    )


def small_webp(figure, box, dpi):
    """A WebP for the page: a third to a tenth of the PNG, and the eye misses nothing."""
    buffer = io.BytesIO()
    figure.savefig(
        buffer, format="png", dpi=dpi, bbox_inches=box, pil_kwargs={"compress_level": 0}
    )
    picture = Image.open(buffer).convert("RGB")
    buffer = io.BytesIO()
    picture.save(buffer, format="webp", quality=84, method=4)
    return buffer.getvalue()


def file_name(name):
    """A name without characters that file systems and links dislike."""
    return re.sub(r"[^A-Za-z0-9._-]+", "-", name).strip("-.")


def fault_of_system(error):
    """The OSError that a chain of exceptions began with, or None; pickling keeps no chain."""
    while error is not None and not isinstance(error, OSError):
        error = error.__cause__ or error.__context__
    return error


def as_sent(error, name):
    """An exception that another process can take: itself, or what it says where it cannot."""
    try:
        pickle.loads(pickle.dumps(error))
        return error
    except Exception:  # pylint: disable=broad-exception-caught
        return RuntimeError(f"saving the figure {name}: {error!r}")


def in_page(value):
    """JSON that may stand in a script element; empty for None."""
    if value is None:
        return ""
    return json.dumps(value, ensure_ascii=False, allow_nan=False, separators=(",", ":")).replace(
        "<", "\\u003c"
    )


@functools.cache
def learn_to_draw(kinds):
    """Draws a word, a formula and a logarithmic axis into these formats, for nobody: fonts, the
    grammar of formulas and the writers of files are then there in every copy of this process, which
    would each load them again.
    """
    figure, axes = pyplot.subplots(figsize=(1, 1))
    axes.set(xscale="log", xlim=(1, 10), xlabel="words", ylabel="$C^H$")
    for kind in kinds:
        figure.savefig(io.BytesIO(), format=kind)
    pyplot.close(figure)


class Gallery:
    """Saves figures into a folder and keeps them as data URIs for the page."""

    def __init__(self, folder, images=0, tells=False, with_pdf=False):
        """@param images how many images of dots will come: with many of them each is kept smaller
        @param tells whether a terminal shows what is drawn
        @param with_pdf whether each figure is also saved as PDF, which takes a third of the time
        """
        self.tells = tells
        self.kinds = ("pdf", "svg") if with_pdf else ("svg",)
        self.folder = folder
        self.dpi = PAGE_DPI * min(1.0, (FULL_IMAGES / max(1, images)) ** 0.5)
        os.makedirs(folder, exist_ok=True)
        learn_to_draw(self.kinds + ("png",))
        self.names = set()
        self.at_once = len(os.sched_getaffinity(0))
        self.saving = {}  # connection: process and Picture

    def tell(self, name):
        """What is drawn now, on a line that rewrites itself; nothing where no terminal shows it."""
        if self.tells:
            print(f"\r\033[Kdrawing {name}", end="", file=sys.stderr, flush=True)

    def own_name(self, name):
        """A file name that no other figure has."""
        name = file_name(name)
        while name in self.names:
            name += "-2"
        self.names.add(name)
        return name

    def add(self, figure, name, caption, as_image=False, table=None, view=None, plotted=True):
        """Saves `name`.svg and, of figures with numbers, `name`.csv, where asked for `name`.pdf, and
        closes the figure.

        @param as_image whether the page shows an image of dots, "shaded" for a fine one of shaded
            pictures; else the SVG
        @param table (header, rows) of the CSV file; None: the numbers of the curves and bars
        @param view what the page needs to show the same cloth in space, or None
        @param plotted whether the page draws its curves again as an interactive plot
        @return Picture
        @throws what went wrong with this figure or an earlier one
        """
        name = self.own_name(name)
        self.tell(name)
        picture = Picture(name, "", caption, 0, view=in_page(view))
        pyplot.close(figure)
        self.start(picture, (figure, name, as_image, table, plotted))
        return picture

    def start(self, picture, figure):
        """Has a figure saved, by a process of its own where another core could draw meanwhile.

        @param figure what save() takes
        @throws what went wrong with this figure or an earlier one
        """
        if self.at_once == 1:
            picture.take(self.save(*figure))
            return
        self.wait(self.at_once - 1)
        theirs, mine = multiprocessing.Pipe(duplex=False)
        process = multiprocessing.get_context("fork").Process(
            target=self.send_saved, args=(mine, [theirs, *self.saving], figure), daemon=True
        )
        process.start()
        mine.close()
        self.saving[theirs] = (process, picture)

    def send_saved(self, to, read_by_others, figure):
        """save(), in a process of its own: what it returns or raises goes to the one that asked.

        @param read_by_others ends of pipes that are not this process's: where nobody else has them
            open any more, it ends, too
        """
        for end in read_by_others:
            end.close()
        gc.disable()  # it ends before there is much to collect
        try:
            saved = self.save(*figure)
        except Exception as error:  # pylint: disable=broad-exception-caught
            saved = as_sent(fault_of_system(error) or error, figure[1])
        with contextlib.suppress(BrokenPipeError):
            to.send(saved)

    def finish(self):
        """Waits until all figures are saved.

        @throws what went wrong with one of them
        """
        self.wait(0)

    def wait(self, unfinished):
        """Waits until no more than so many processes still save figures.

        @throws what went wrong with a figure
        """
        while len(self.saving) > unfinished:
            for theirs in connection.wait(list(self.saving)):
                process, picture = self.saving.pop(theirs)
                try:
                    saved = theirs.recv()
                except (EOFError, OSError):
                    saved = RuntimeError(f"saving the figure {picture.name} ended without a word")
                process.join()
                if isinstance(saved, Exception):
                    self.stop()
                    raise saved
                picture.take(saved)

    def stop(self):
        """Ends the processes that still save figures: nobody wants these any more."""
        for process, _ in self.saving.values():
            process.terminate()
            process.join()
        self.saving.clear()

    def save(self, figure, name, as_image, table, plotted):
        """The files of a figure, and source, width, endings and plot of its Picture."""
        source, width = self.save_picture(figure, name, as_image)
        panels = None if as_image or not plotted else plot_data.panels_of(figure)
        header, rows = table or (plot_data.HEADER, [] if as_image else plot_data.rows_of(figure))
        endings = self.kinds + (("csv",) if rows else ())
        if rows:
            with open(os.path.join(self.folder, name + ".csv"), "w", encoding="utf-8") as file:
                file.write(plot_data.csv_text(rows, header))
        return source, width, endings, in_page(panels)

    def save_picture(self, figure, name, as_image):
        """Lays a figure out and writes it; its source and width on the page."""
        if engine := figure.get_layout_engine():
            engine.execute(figure)  # once for all formats
            figure.set_layout_engine(None)  # one that does nothing would draw once more per format
        box = figure.get_tightbbox().padded(PAD)
        for kind in self.kinds:
            figure.savefig(
                os.path.join(self.folder, f"{name}.{kind}"),
                metadata=METADATA[kind],
                bbox_inches=box,
            )
        if as_image:
            data = small_webp(figure, box, SHADED_DPI if as_image == "shaded" else self.dpi)
            source = "data:image/webp;base64," + base64.b64encode(data).decode("ascii")
        else:
            with open(os.path.join(self.folder, name + ".svg"), encoding="utf-8") as file:
                # Without quotes and ampersands.
                source = Markup(svg_address(short_svg(file.read())))
        return source, round(105.0 * box.width)

    def add_animation(self, data, name, width, caption):
        """Saves `name`.webp, a looping picture of so many pixels' width.

        @return Picture
        """
        name = self.own_name(name)
        with open(os.path.join(self.folder, name + ".webp"), "wb") as file:
            file.write(data)
        source = "data:image/webp;base64," + base64.b64encode(data).decode("ascii")
        return Picture(name, source, caption, width, ("webp",))
