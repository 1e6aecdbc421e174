# SPDX-License-Identifier: MIT
"""The figure and the page of pareto.py: pareto.csv and pareto.json of a folder in, pareto.svg and
pareto.html out. By itself: pareto_page.py FOLDER."""
import csv
import html
import json
import pathlib
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as pyplot

# Okabe and Ito, which readers with any colour vision tell apart.
COLOURS = {"homespun": "#0072B2", "SfePy": "#D55E00", "FEniCSx": "#009E73"}
STYLES = {"P1": ("--", "s"), "P2": ("-", "o"), "adaptive bracket": (":", "*")}
FLOOR = 1e-13  # errors below it are round-off and drawn there
LEVELS = (1e-1, 1e-2, 1e-3, 1e-4, 1e-5)
TIMES = {
    "seconds_median": "whole command, from its start to its end",
    "seconds_solver_median": "what the program says of its own work, without start, imports, files",
}


def read_rows(folder):
    with open(folder / "pareto.csv", encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    for row in rows:
        for key in ("seconds_median", "seconds_solver_median", "error", "error_of_answer"):
            row[key] = float(row[key])
        row["error_guaranteed"] = float(row["error_guaranteed"] or "nan")
    return rows


def ways_of(rows):
    """{(program, method): its rows}, in their order."""
    ways = {}
    for row in rows:
        ways.setdefault((row["program"], row["method"]), []).append(row)
    return ways


def draw_panel(axes, rows, column):
    for (program, method), its in ways_of(rows).items():
        its = sorted(its, key=lambda row: row[column])
        style, marker = STYLES[method]
        seconds = [row[column] for row in its]
        axes.loglog(
            seconds,
            [max(row["error"], FLOOR) for row in its],
            style,
            marker=marker,
            color=COLOURS[program],
            markersize=4 if method != "adaptive bracket" else 6,
            linewidth=1,
            label=f"{program}, {method}",
        )
        if method == "adaptive bracket":
            axes.loglog(
                seconds,
                [max(row["error_guaranteed"], FLOOR) for row in its],
                "-",
                marker="_",
                markersize=9,
                color="black",
                linewidth=0.6,
                label="homespun, width of the bracket",
            )
    known = max(row["error_of_answer"] for row in rows)
    errors = [max(row["error"], FLOOR) for row in rows]
    axes.set_ylim(min(*errors, known or FLOOR) / 3, 3 * max(*errors, 1e2 * FLOOR))
    if known > 0:
        axes.axhspan(FLOOR / 10, known, color="0.9", zorder=0)
    axes.grid(True, which="major", linewidth=0.3)


def draw(rows, path):
    cells = list(dict.fromkeys(row["cell"] for row in rows))
    figure, panels = pyplot.subplots(
        2, len(cells), figsize=(4 * len(cells), 7), sharey="col", squeeze=False
    )
    for column, cell in enumerate(cells):
        its = [row for row in rows if row["cell"] == cell]
        for row, (key, label) in enumerate(TIMES.items()):
            axes = panels[row][column]
            draw_panel(axes, its, key)
            axes.set_xlabel("seconds, " + ("whole command" if row == 0 else "solver alone"))
            axes.set_title(cell if row == 0 else "")
        panels[0][column].set_ylabel("relative error of an energy" if column == 0 else "")
        panels[1][column].set_ylabel("relative error of an energy" if column == 0 else "")
    handles, labels = panels[0][0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="lower center", ncol=4, fontsize=8, frameon=False)
    figure.tight_layout(rect=(0, 0.07, 1, 1))
    figure.savefig(path)
    pyplot.close(figure)


def fastest(rows, program, level, column):
    """The fastest point of a program whose error is at most the level, or none. A bracket counts
    by its true error."""
    its = [row for row in rows if row["program"] == program and row["error"] <= level]
    return min(its, key=lambda row: row[column], default=None)


def table_of(rows, column):
    """Lines of a table, and sentences on where a peer wins."""
    programs = list(dict.fromkeys(row["program"] for row in rows))
    cells = list(dict.fromkeys(row["cell"] for row in rows))
    lines, wins = [], []
    for cell in cells:
        of_cell = [row for row in rows if row["cell"] == cell]
        for level in LEVELS:
            best = {p: fastest(of_cell, p, level, column) for p in programs}
            reached = {p: row for p, row in best.items() if row}
            if not reached:
                continue
            winner = min(reached, key=lambda program: reached[program][column])
            entries = []
            for program in programs:
                row = best[program]
                text = f"{row[column]:.2f} s, {row['method']}" if row else "not reached"
                entries.append(f"<b>{text}</b>" if program == winner else text)
            guaranteed = min(
                (row for row in of_cell if row["error_guaranteed"] <= level),
                key=lambda row: row[column],
                default=None,
            )
            entries.append(f"{guaranteed[column]:.2f} s" if guaranteed else "not reached")
            lines.append((cell, f"{level:.0e}", *entries))
            ours = best.get("homespun")
            if winner != "homespun":
                by = (
                    f"takes {reached[winner][column] / ours[column]:.2f} of homespun's time"
                    if ours
                    else "alone reaches it"
                )
                wins.append(f"{cell}, error {level:.0e}: {winner} wins; it {by}.")
    return programs, lines, wins


def section(rows, column, label):
    programs, lines, wins = table_of(rows, column)
    head = "".join(
        f"<th>{html.escape(text)}</th>"
        for text in ("cell", "error at most", *programs, "homespun, guaranteed")
    )
    body = "".join(
        "<tr>" + "".join(f"<td>{entry}</td>" for entry in line) + "</tr>\n" for line in lines
    )
    others = [program for program in programs if program != "homespun"]
    if not others:
        said = "<p>No other program was measured.</p>"
    elif wins:
        said = "<ul>" + "".join(f"<li>{html.escape(text)}</li>" for text in wins) + "</ul>"
    else:
        said = f"<p>At none of these errors is {' or '.join(others)} faster.</p>"
    return (
        f"<h2>Seconds to an error: {html.escape(label)}</h2>\n"
        f"<table><tr>{head}</tr>\n{body}</table>\n<h3>Where another program wins</h3>\n{said}\n"
    )


STYLE = """body{font:16px/1.5 sans-serif;max-width:72rem;margin:2rem auto;padding:0 1rem}
table{border-collapse:collapse}td,th{border:1px solid #ccc;padding:.2rem .6rem;text-align:left}
svg{width:100%;height:auto}"""


def write(folder):
    rows = read_rows(folder)
    with open(folder / "pareto.json", encoding="utf-8") as file:
        about = json.load(file)
    draw(rows, folder / "pareto.svg")
    picture = (folder / "pareto.svg").read_text(encoding="utf-8")
    picture = picture[picture.index("<svg") :]
    missing = "".join(
        f"<p>{html.escape(program)} was not measured, because it is not installed:"
        f" apt install {html.escape(packages)}.</p>"
        for program, packages in about["missing"].items()
    )
    answers = "".join(
        f"<li>{html.escape(cell)}: {html.escape(its['answer'])}.</li>"
        for cell, its in about["answers"].items()
    )
    versions = "; ".join(f"{name}: {text}" for name, text in about["versions"].items())
    rounds = sorted({row["rounds"] for row in rows})
    page = f"""<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><title>Error of C^H against seconds</title>
<style>{STYLE}</style></head><body>
<h1>Error of C^H against seconds</h1>
{missing}
{picture}
<p>The error is the largest relative difference of an energy E.C.E from the known answer, over all
E; the black bars are the width of homespun's bracket, which needs no answer. Grey: the answer
itself is known no better. Each point is one mesh; homespun reads its cell from a text file, the
others get arrays. Times are medians of {', '.join(rounds)} rounds, in each of which every point ran once.
{html.escape(about['machine'])}, load average {about['load_average']:.1f}.</p>
<h2>What the answers are</h2><ul>{answers}</ul>
{''.join(section(rows, column, label) for column, label in TIMES.items())}
<p>{html.escape(versions)}</p>
</body></html>
"""
    (folder / "pareto.html").write_text(page, encoding="utf-8")


if __name__ == "__main__":
    write(pathlib.Path(sys.argv[1]))
