# SPDX-License-Identifier: MIT
"""Tests of the page of `homespun periodic stability`, on made-up margins."""
import json
import math
import os
import shutil
import unittest

import h5py
import report_path  # noqa: F401
from figures.stability import direction, stability_figure, values_of_zone
from made_up_run import verdict, write_run, write_table, write_verdicts
from made_up_study import write_results
from page_case import PageTest
from read.stability_results import StabilityPath

NAMES = {"cell": "stripes", "law": "biot", "load": "uniaxial-1"}
FINITE = {"waves": "finite", "k1": 0.5, "k2": 0.0, "scale": "micro", "cells_1": 2, "cells_2": 1}


def row(kind, mesh, number, **more):
    return {"kind": kind, **NAMES, "way": "pressed", "mesh": mesh, "number": number, "cells_1": 0,
            "cells_2": 0, **more}


def level(mesh, strain, beta):
    return {
        **row("level", mesh, round(-100 * strain)),
        **FINITE,
        "strain": strain,
        "beta": beta,
        "beta_lower": beta - 1e-9,
        "outcome": "unstable-proved" if beta < 0 else "stable-up-to-mesh",
        "long_waves": "stable",
        "acoustic": 0.5,
    }


def loss(mesh, strain):
    return {
        **row("loss", mesh, 0),
        **FINITE,
        "outcome": "lost",
        "held_to": strain + 5e-5,
        "lost_at": strain - 5e-5,
        "strain": strain,
        "strain_bar": 0.01,
        "wave": "k = (1/2, 0)",
    }


LEVELS = [
    level("given", -0.05, 0.6), level("given", -0.1, 0.1), level("given", -0.15, -0.2),
    level("refined", -0.05, 0.5), level("refined", -0.1, -0.02), level("refined", -0.15, -0.3),
]
LOSSES = [loss("given", -0.11), loss("refined", -0.098)]
ZONE = [
    row("wave", "given", 10 * i + j, waves="finite", k1=i / 8, k2=j / 8, strain=-0.11,
        beta=math.cos(math.pi * i / 8) ** 2 + 0.1 * j / 8)
    for i in range(5) for j in range(8) if (i, j) != (0, 0) and not (i in (0, 4) and j > 4)
] + [
    row("wave", "given", 100 + a, waves="long", angle_deg=15.0 * a, strain=-0.11, beta=0.8)
    for a in range(12)
]
PATTERN = row("pattern", "given", 15, strain=-0.15, outcome="found", wave="k = (1/2, 0)", beta=-0.2,
              energy_periodic_N_per_m=1.0, energy_N_per_m=0.976, less_energy=0.024,
              largest_per_cell=0.11) | {"cells_1": 2, "cells_2": 1}


def mode(vertices):
    return [
        {**row("mode", "given", v), "strain": -0.11, "x_m": 0.89 * x, "y_m": y,
         "u_real": math.sin(3.0 * v), "u_imaginary": 0.0, "v_real": math.cos(v),
         "v_imaginary": 0.0}
        for v, (x, y) in enumerate(vertices)
    ]


class StabilityPage(PageTest):
    def setUp(self):
        super().setUp()
        study = os.path.join(self.place, "study")
        write_results(study)
        os.makedirs(self.folder)
        shutil.copytree(os.path.join(study, "stripes"), os.path.join(self.folder, "stripes"))
        for name in os.listdir(os.path.join(self.folder, "stripes")):
            if name.startswith("fields-"):
                os.remove(os.path.join(self.folder, "stripes", name))
        with h5py.File(os.path.join(self.folder, "stripes", "cell.h5")) as file:
            self.vertices = file["vertices"][()]
        write_table(self.folder, "stability.csv",
                    LEVELS + ZONE + [PATTERN] + LOSSES + mode(self.vertices))
        with open(os.path.join(self.folder, "study.json"), "w", encoding="utf-8") as file:
            json.dump({"command": "homespun periodic stability x.prm"}, file)
        write_verdicts(self.folder, [verdict("stripes: beta at rest is 1", "PASS")])
        write_run(self.folder, "stability")

    def test_the_page_says_where_it_is_lost_to_what_and_how_sure_that_is(self):
        name = "stability-stripes-biot-uniaxial-1"
        self.assertEqual(self.run_report(saved=[name]), (0, ""))
        page = self.page()
        self.assertIn("homespun: stripes", page)
        self.assertIn("Where the cells start to buckle in their plane", page)
        # Compression in the plane names wrinkling in the sentence itself.
        self.assertIn("(k = (1/2, 0)) (kept flat: a free sheet that is pressed in its plane wrinkles at"
                      " once); proved for the discrete cloth", page)
        self.assertIn("first lost at −9.8 ± 1.0 %, to a pattern over 2 × 1 cells (k = (1/2, 0))",
                      page)
        self.assertIn("open: the meshes disagree", page)
        self.assertIn("lost, proved", page)
        self.assertIn("followed to an equilibrium with 2.40 % less energy", page)
        self.assertIn("stable, up to the mesh", page)
        self.assertTrue(os.path.isfile(os.path.join(self.output, "figures", f"{name}.svg")))

    def test_a_path_without_loss_holds_up_to_the_mesh(self):
        def held(rows):
            for one in rows:
                if one["kind"] == "loss":
                    one.update(outcome="held", held_to="-0.15", lost_at="", strain="",
                               strain_bar="")

        self.edit_table("stability.csv", held)
        status, errors = self.run_report()
        self.assertEqual(status, 0, errors)
        self.assertIn("stable up to −15.0 %, the last strain (kept flat: a free sheet that is"
                      " pressed in its plane wrinkles at once); that holds up to the mesh",
                      self.page())

    def test_a_state_that_has_left_the_path_of_its_load_says_so_in_its_row(self):
        jumped = "not the state of this load any more: the path jumped to another equilibrium"

        def left(rows):
            for one in rows:
                if one["kind"] == "level" and one["strain"] == "-0.15":
                    one["path"] = "left"

        self.edit_table("stability.csv", left)
        status, errors = self.run_report()
        self.assertEqual(status, 0, errors)
        self.assertEqual(self.page().count(jumped), 1)
        self.assertIn(f"lost, proved; {jumped}", self.page())

    def test_the_zone_is_the_same_at_k_and_at_minus_k(self):
        values = values_of_zone(ZONE)
        self.assertEqual(values[(3, 6)], values[(21, 18)])
        self.assertEqual(values[(12, 0)], ZONE[28]["beta"])
        self.assertAlmostEqual(direction(30.0, [[1.0, 0.0], [0.0, 1.0]]), 30.0)

    def test_the_figure_has_margin_zone_and_mode_and_without_a_cell_the_margin_alone(self):
        path = StabilityPath("stripes", "biot", "uniaxial-1", LEVELS, LOSSES, ZONE, [])
        self.assertEqual(len(stability_figure(path, None).axes), 1)

    def test_a_damaged_row_is_refused_by_line_and_column(self):
        self.edit("stability.csv", lambda text: text.replace("0.6,", "x,", 1))
        status, errors = self.run_report()
        self.assertEqual(status, 2)
        self.assertIn("stability.csv, line 2", errors)

    def test_a_kind_that_there_is_not_is_refused_by_line(self):
        self.edit("stability.csv", lambda text: text.replace("wave,stripes", "ripple,stripes", 1))
        status, errors = self.run_report()
        self.assertEqual(status, 2)
        self.assertIn("stability.csv, line 8: `kind` is `ripple`, expected level, loss", errors)


if __name__ == "__main__":
    unittest.main()
