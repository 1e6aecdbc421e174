# SPDX-License-Identifier: MIT
"""The peers: what each must do whatever the cell, and that nothing is tested that was trained on."""
import contextlib
import csv
import io
import sys
import unittest
from unittest import mock

import numpy

import homespun
from with_cell import COARSE, SOURCE, WithFolder

CELL = COARSE / "layered.prm"
sys.path.insert(0, str(SOURCE / "python" / "peers"))

# pylint: disable=wrong-import-position
import compare  # noqa: E402
from flat import flat  # noqa: E402
from learned import learned  # noqa: E402
from pod import pod  # noqa: E402
from smooth import smooth  # noqa: E402
from training import equilibrium, stiffness_of  # noqa: E402

LEVEL = ("strip-1", 0.01, "linear")


class Peers(WithFolder):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        with contextlib.redirect_stderr(io.StringIO()):
            cls.study = homespun.study(CELL, loads=["strip-1"], strains=[0.01], laws=["linear"],
                                       methods=["affine"], cells=4, output=cls.folder / "study")
        cls.mesh = cls.study.sheet
        cls.stiffness = compare.phases_of(CELL)
        cls.coarse, cls.fine = compare.frames(cls.study, cls.stiffness, 0, 24)

    def pulled(self, points, triangles, stiffness, part):
        """A mesh under strip-1 at 1 %, by training.py."""
        sides = compare.at_ends(points[:, 0])
        held = numpy.concatenate(sides)
        values = numpy.zeros((1, len(held), 2))
        values[0, len(sides[0]):, 0] = 0.01 * numpy.ptp(points[:, 0])
        return points + equilibrium((points, triangles), stiffness, part, held, values)[0]

    def test_training_frames_are_in_the_equilibrium_of_the_program(self):
        mesh = self.mesh
        part = (mesh.rest[mesh.triangles].mean(axis=1) // 0.01) @ [100, 1]
        numpy.testing.assert_allclose(
            self.pulled(mesh.rest, mesh.triangles, self.stiffness[mesh.phases], part),
            self.study.reference(*LEVEL), rtol=0.0, atol=1e-14)
        one = numpy.zeros(len(mesh.coarse_triangles))
        numpy.testing.assert_allclose(
            self.pulled(mesh.coarse_rest, mesh.coarse_triangles,
                        numpy.tile(self.study.cell.stiffness, (len(one), 1, 1)), one),
            self.study.coarse(*LEVEL), rtol=0.0, atol=1e-14)

    def test_stiffness_is_that_of_plane_stress(self):
        modulus, ratio, thickness = 2e6, 0.3, 5e-4
        compliance = [[1.0, -ratio, 0.0], [-ratio, 1.0, 0.0], [0.0, 0.0, 2.0 * (1.0 + ratio)]]
        numpy.testing.assert_allclose(stiffness_of(modulus, ratio, thickness) @ compliance,
                                      modulus * thickness * numpy.eye(3), rtol=1e-14, atol=1e-9)

    def test_every_method_keeps_what_it_must(self):
        mesh, turn = self.mesh, numpy.array([[0.96, 0.28], [-0.28, 0.96]])
        trained = [learned(mesh, self.coarse[:20], self.fine[:20], n) for n in (8, 32)]
        for method in (flat(mesh), smooth(mesh), *trained):
            shifted = method(mesh.coarse_rest + [0.1, -0.2])
            numpy.testing.assert_allclose(shifted, mesh.rest + [0.1, -0.2], rtol=0.0, atol=1e-14)
        for method in (flat(mesh), smooth(mesh)):  # all that is linear
            numpy.testing.assert_allclose(method(mesh.coarse_rest @ turn), mesh.rest @ turn,
                                          rtol=0.0, atol=1e-14)

    def test_a_smooth_surface_passes_through_the_coarse_vertices(self):
        mesh = self.mesh
        at = numpy.linalg.norm(mesh.rest[:, None] - mesh.coarse_rest, axis=2).argmin(axis=0)
        numpy.testing.assert_allclose(mesh.rest[at], mesh.coarse_rest, rtol=0.0, atol=1e-15)
        numpy.testing.assert_allclose(smooth(mesh)(self.coarse[0])[at], self.coarse[0], rtol=0.0,
                                      atol=1e-14)
        # and is nearer to what is curved than the flat one, in the middle of the sheet
        def curved(points):
            return points + points[:, :1] * points * [[30.0, -20.0]]
        inside = (numpy.abs(mesh.rest - 0.02) < 0.01).all(axis=1)
        flat_wrong, smooth_wrong = (numpy.linalg.norm(
            (method(mesh)(curved(mesh.coarse_rest)) - curved(mesh.rest))[inside], axis=1).mean()
            for method in (flat, smooth))
        self.assertLess(smooth_wrong, 1e-3 * flat_wrong)

    def test_a_learned_operator_finds_an_operator_that_is_there(self):
        mesh = self.mesh
        near = numpy.linalg.norm(mesh.rest[:, None] - mesh.coarse_rest, axis=2).argsort(axis=1)
        by = 0.3 * numpy.sin(numpy.arange(len(near)))[:, None]

        def truth(coarse):
            moved = coarse - mesh.coarse_rest
            return flat(mesh)(coarse) + by * (moved[near[:, 1]] - moved[near[:, 0]])[:, ::-1]

        operator = learned(mesh, self.coarse[:20], numpy.stack([*map(truth, self.coarse[:20])]), 8)
        wrong, size = (numpy.abs(its(self.coarse[22]) - truth(self.coarse[22])).max()
                       for its in (operator, flat(mesh)))
        self.assertLess(wrong, 1e-4 * size)

    def test_sums_of_frames_are_their_own_nearest(self):
        total = self.mesh.rest + 0.5 * (self.fine[0] + self.fine[1]) - self.fine[2]
        numpy.testing.assert_allclose(pod(self.mesh.rest, self.fine[:20])(total), total, rtol=0.0,
                                      atol=1e-12)

    def test_what_was_trained_on_is_never_tested(self):
        rest, training = self.mesh.rest, self.fine[:12]
        for one in (training[7], rest + 3.0 * (training[7] - rest), rest - (training[7] - rest)):
            with self.assertRaises(homespun.BadInput):
                compare.outside(rest, training, one)
        for one in (*self.fine[20:], self.study.reference(*LEVEL)):
            self.assertGreater(compare.outside(rest, training, one), 1e-3)

    def test_the_table_of_a_small_sheet_is_whole_and_refuses_what_was_trained_on(self):
        table, frames = self.folder / "peers.csv", compare.frames
        table.write_text(",".join(compare.COLUMNS) + "\nother" + "," * (len(compare.COLUMNS) - 1) + "\n",
                         encoding="utf-8")
        methods = ("affine", "localized")
        with mock.patch.multiple(compare, CELLS=4, LOADS=("strip-1",), METHODS=methods,
                                 N_TRAINING=12, N_TESTED=4), \
                contextlib.redirect_stderr(io.StringIO()):
            compare.main(CELL, table, self.folder)

            def planted(run, stiffness, axis, n):
                coarse, fine = frames(run, stiffness, axis, n)
                fine[compare.N_TRAINING + 3] = fine[5]
                return coarse, fine

            before = table.read_text(encoding="utf-8")
            with mock.patch.object(compare, "frames", planted), \
                    self.assertRaisesRegex(homespun.BadInput, "is a training frame"):
                compare.main(CELL, table, self.folder)
            self.assertEqual(table.read_text(encoding="utf-8"), before)
        with open(table, newline="", encoding="utf-8") as file:
            rows = [row for row in csv.DictReader(file) if row["cell"] != "other"]
        trained = [(name, on) for name in ("learned_8", "learned_32", "pod")
                   for on in ("left and right", "both pairs")]
        peers = [("flat", ""), ("smooth", ""), *trained]
        of_sheets = {("strip-1", law, method, on) for law in ("linear", "biot")
                     for method, on in [*peers, *((name, "") for name in methods)]}
        of_waves = {(f"waves {pair}", "linear", method, on) for pair in compare.PAIRS
                    for method, on in [*peers, ("localized", "")]}
        self.assertEqual(len(rows), len(of_sheets | of_waves))
        self.assertEqual({(row["tested"], row["law"], row["method"], row["trained_on"])
                          for row in rows}, of_sheets | of_waves)
        for row in rows:
            self.assertGreater(float(row["error"]), 0.0)
            self.assertEqual(bool(row["error_bar"]), row["tested"] == "strip-1")
            self.assertEqual(bool(row["outside_training"]), (row["method"], row["trained_on"]) in trained)


if __name__ == "__main__":
    unittest.main()
