# SPDX-License-Identifier: MIT
"""homespun upsample: the frames of another program's simulation as a user hands them over."""
import json
import re
import shutil
import signal
import subprocess
import sys
import time
import unittest

import h5py
import numpy

from cli import CELLS, LAYERED, PROGRAM, cut, rows_of, run
from upsample_case import Upsampling, write_obj
from usda import Usda

sys.path.append(str(CELLS.parents[1] / "verification" / "report"))
from read.vtu import read_vtu  # noqa: E402

SCENES = CELLS.parent / "scenes"


class Oracles(Upsampling):
    def test_frames_of_a_scene_are_those_that_drape_made_byte_by_byte(self):
        drape = self.folder / "drape"
        cases = {"hang": (self.rest, ["--quick"]), "skirt": (SCENES / "skirt.obj", [])}
        for scene, (rest, size) in cases.items():
            with self.subTest(scene=scene):
                result = run("drape", SCENES / f"{scene}.prm", *size, "--duration", 0.1,
                             "--frames", "obj,ply", "--no-report", "--unit-cells",
                             LAYERED, "--output", drape / scene)
                self.assertEqual(result.returncode, 0, result.stderr)
                made = drape / scene / "layered-biot"
                self.output, self.rest = self.folder / f"out-{scene}", rest
                self.upsample(made / "coarse_*.obj", "--format", "ply,obj")
                frames = sorted(path.stem for path in made.glob("coarse_*.obj"))
                self.assertEqual(len(frames), 3)
                for frame in frames:
                    for ending in ("ply", "obj"):
                        fine = made / f"{frame.replace('coarse', 'fine')}.{ending}"
                        self.assertEqual((self.output / f"{frame}.{ending}").read_bytes(),
                                         fine.read_bytes(), fine)

    def test_frames_of_a_cloth_that_moved_by_the_terms_of_edges_take_them_byte_by_byte(self):
        scene = (SCENES / "hang.prm").read_text(encoding="utf-8").replace("../cells", str(CELLS))
        self.assertIn("damping, pins", scene)
        path = self.folder / "hang.prm"
        path.write_text(scene.replace("damping, pins", "damping, pins, selvedge"), encoding="utf-8")
        method = "localized+edges+modes"
        result = run("drape", path, "--quick", "--duration", 0.1, "--frames", "obj,ply",
                     "--no-report", "--unit-cells", LAYERED, "--methods",
                     f"localized,{method}", "--output", self.folder / "drape")
        self.assertEqual(result.returncode, 0, result.stderr)
        made = self.folder / "drape" / f"layered-{method}"
        said = {}
        for slip in (["--slip"], []):
            self.output = self.folder / f"out{len(slip)}"
            self.upsample(made / "coarse_*.obj", "--method", method, "--held", "top", *slip,
                          "--format", "ply")
            said[len(slip)] = [(self.output / f"coarse_000{k}.ply").read_bytes() for k in (1, 2)]
        drawn = [(made / f"fine_000{k}.ply").read_bytes() for k in (1, 2)]
        self.assertEqual(said[1], drawn)
        self.assertNotEqual(said[0], drawn)  # of a cloth whose edges lie where they are held
        refused = self.upsample(made / "coarse_*.obj", "--method", method, status=2)
        self.assertIn("`held` does not say which edges on lattice lines are held", refused)

    def test_a_uniform_strain_gives_affine_and_chi(self):
        E11 = 0.03
        self.upsample(self.frame("a.obj", self.vertices * [1. + E11, 1., 1.]),
                      self.frame("b.obj"), "--format", "vtu")
        at_rest, strained = (read_vtu(self.output / f"{name}.vtu") for name in "ba")
        with h5py.File(self.cell) as file:
            vertices, lattice, chi = (file[name][:] for name in ("vertices", "lattice", "chi"))
            chi -= chi[file["chi"].attrs["anchor"]]
        # The vertex of the cell that each fine vertex is an image of.
        def wrapped(points):
            part = (points - vertices.min(axis=0)) @ numpy.linalg.inv(lattice)
            return part - numpy.floor(part + 1e-6)
        fine = wrapped(at_rest.points[:, :2].astype(float))
        away = numpy.abs(fine[:, None] - wrapped(vertices)[None]).max(axis=2)
        self.assertLess(away.min(axis=1).max(), 1e-4)
        w = -E11 * chi[away.argmin(axis=1), :, 0]
        self.assertGreater(numpy.abs(w).max(), 1e-5)
        expected = at_rest.points[:, :2] * [1. + E11, 1.] + w
        side = self.vertices.max()
        self.assertLess(numpy.abs(strained.points[:, :2] - expected).max(), 4 * 2.**-24 * side)
        self.assertEqual(strained.points[:, 2].max(), 0.)


class Results(Upsampling):
    def test_table_fields_and_description(self):
        stdout = self.upsample(*self.moving(3), "--format", "vtu,usda")
        self.assertIn("3 frames of a sheet of 4 x 4 cells", stdout)
        self.assertIn("strain: largest 0.02 in f_2", stdout)
        self.assertIn("no range of validity is known", stdout)
        rows = rows_of(self.output / "upsample.csv")
        self.assertEqual([(row["frame"], row["indicator"]) for row in rows],
                         [(f"f_{k}", name) for k in range(3)
                          for name in ("strain", "strain_change", "compression")])
        for k in range(3):
            strain, change, compression = rows[3 * k: 3 * k + 3]
            for column in ("mean", "quantile_99", "largest"):
                self.assertAlmostEqual(float(strain[column]), 0.01 * k, 12)
                self.assertLess(float(change[column]), 1e-12)
                self.assertLess(float(compression[column]), 1e-12)
            self.assertEqual(strain["triangles"], "32")
            self.assertEqual((strain["limit"], strain["triangles_beyond"]), ("", ""))
            self.assertEqual(compression["triangles_beyond"], "0")
        found = read_vtu(self.output / "f_2.vtu")
        numpy.testing.assert_allclose(found.point_data["strain [-]"], 0.02, rtol=1e-6)
        self.assertEqual((self.output / "frames.pvd").read_text().count("f_"), 3)
        study = json.loads((self.output / "upsample.json").read_text())
        self.assertEqual(next(iter(study)), "format_version")
        self.assertEqual(study["frames"], 3)
        self.assertEqual(study["fine_vertices"], len(found.points))

    def test_one_usd_file_holds_all_frames_and_a_material_for_each_phase(self):
        self.upsample(*self.moving(2), "--format", "usda,vtu", "--up", "y")
        layer = Usda((self.output / "frames.usda").read_text())
        self.assertEqual(layer.metadata["defaultPrim"], layer.prim.name)
        self.assertEqual(layer.metadata["metersPerUnit"], 1.)
        self.assertEqual(layer.metadata["upAxis"], "Y")
        self.assertEqual((layer.metadata["startTimeCode"], layer.metadata["endTimeCode"]), (0., 1.))
        mesh = layer.prim.children["surface"]
        self.assertEqual(mesh.kind, "Mesh")
        samples = mesh.attributes["point3f[] points.timeSamples"]
        self.assertEqual(list(samples), [0., 1.])
        for frame in (0, 1):
            found = read_vtu(self.output / f"f_{frame}.vtu")
            points = numpy.array(samples[frame], dtype=numpy.float32)
            numpy.testing.assert_array_equal(points, found.points)
            numpy.testing.assert_array_equal(
                numpy.array(mesh.attributes["float3[] extent.timeSamples"][frame],
                            dtype=numpy.float32), [points.min(axis=0), points.max(axis=0)])
        numpy.testing.assert_array_equal(
            numpy.reshape(mesh.attributes["int[] faceVertexIndices"], (-1, 3)), found.triangles)
        self.assertEqual(mesh.attributes["int[] faceVertexCounts"], [3.] * len(found.triangles))
        self.assertEqual(mesh.attributes["uniform token subdivisionScheme"], "none")
        texture = numpy.array(mesh.attributes["texCoord2f[] primvars:st"])
        self.assertEqual(texture.shape, (3 * len(found.triangles), 2))
        self.assertEqual((texture.min(), texture.max()), (0., 1.))
        # Stripes: half of the triangles each, every one in one subset with a material that exists.
        phases = found.cell_data["material"]
        self.assertEqual(sorted(mesh.children), ["phase_0", "phase_1"])
        for k in (0, 1):
            subset = mesh.children[f"phase_{k}"]
            self.assertEqual(subset.attributes["int[] indices"],
                             numpy.flatnonzero(phases == k).tolist())
            path = subset.attributes["rel material:binding"].split("/")[1:]
            self.assertEqual(path[:2], [layer.prim.name, "materials"])
            self.assertIn(path[2], layer.prim.children["materials"].children)

    def test_frames_of_a_point_cache_are_those_of_the_mesh_beside_it(self):
        self.upsample(*self.moving(3), "--format", "pc2,ply")
        cache = (self.output / "frames.pc2").read_bytes()
        version, n_points = numpy.frombuffer(cache, "<i4", 2, 12)
        n_frames = numpy.frombuffer(cache, "<i4", 1, 28)[0]
        self.assertEqual((cache[:12], version, n_frames), (b"POINTCACHE2\0", 1, 3))
        frames = numpy.frombuffer(cache, "<f4", 3 * n_points * 3, 32).reshape(3, n_points, 3)
        for k in range(3):
            ply = (self.output / f"f_{k}.ply").read_bytes()
            head, body = ply.split(b"end_header\n", 1)
            self.assertIn(b"property float nx", head)
            self.assertIn(b"property int material", head)
            vertices = numpy.frombuffer(body, numpy.dtype([("x", "<f4", 8), ("rgb", "u1", 3)]),
                                        n_points)
            numpy.testing.assert_array_equal(vertices["x"][:, :3], frames[k])
            numpy.testing.assert_allclose(vertices["x"][:, 5], 1., rtol=1e-6)  # flat: nz
        # More frames make the files of all frames anew, and leave finished ones.
        before = (self.output / "f_1.ply").stat().st_mtime_ns
        self.upsample(*self.moving(3), "--format", "pc2,ply")
        self.assertEqual((self.output / "frames.pc2").read_bytes(), cache)
        self.assertEqual((self.output / "f_1.ply").stat().st_mtime_ns, before)

    def test_indicators_stand_against_the_range_of_validity(self):
        (self.folder / "validity.csv").write_text(
            "cell,load,reference,method,measure,limit,relation,largest_strain,"
            "largest_strain_lower,largest_strain_upper,note,elliptic_up_to,"
            "least_radius_m\n"
            "layered,strip-1,biot,localized,cell side,0.01,=,0.015,0.01,0.02,,,0.023\n",
            encoding="utf-8")
        stdout = self.upsample(*self.moving(3), "--validity", self.folder / "validity.csv")
        self.assertIn("cell layered was found valid up to 0.015", stdout)
        self.assertIn("32 of 32 triangles above 0.015", stdout)
        rows = [row for row in rows_of(self.output / "upsample.csv")
                if row["indicator"] == "strain"]
        self.assertEqual([(row["limit"], row["triangles_beyond"]) for row in rows],
                         [("0.015", "0"), ("0.015", "0"), ("0.015", "32")])

    def test_another_unit_is_asked_about_before_anything_is_written_and_answered(self):
        for frame, words in (
                (self.frame("mm.obj", 1000. * self.vertices),
                 "lengths differ by a factor of 1000:"),
                (self.frame("pressed.obj", 0.6 * self.vertices), "pressed together by 40 %"),
                (self.frame("drawn.obj", 1.6 * self.vertices), "strained by 60 %")):
            said = self.upsample(frame, status=2)
            self.assertIn(words, said)
            self.assertIn("`--accept-strain` goes on as it is", said)
            self.assertFalse(self.output.exists())
        self.upsample(frame, "--accept-strain")
        # Just below: nothing is asked.
        self.output = self.folder / "below"
        self.upsample(self.frame("less.obj", self.vertices * [0.72, 0.72, 1.]),
                      self.frame("more.obj", self.vertices * [1.49, 1., 1.]))

    def test_positions_in_centimetres_give_the_same_bits_as_in_metres(self):
        moved = self.vertices * [1.02, 1., 1.]
        self.upsample(self.frame("a.obj", moved), "--format", "ply")
        expected = (self.output / "a.ply").read_bytes()
        # A power of two, by which numbers are scaled exactly.
        write_obj(self.rest, 128. * self.vertices, self.triangles)
        self.output, frame = self.folder / "scaled", self.frame("a.obj", 128. * moved)
        said = self.upsample(frame, "--format", "ply", status=2)
        self.assertRegex(said, r"triangle \d+ is .* m long at rest, which are \S+ cells; expected "
                               r"a hundred at most: .*`--unit 0.01` takes")
        self.assertFalse(self.output.exists())
        self.upsample(frame, "--format", "ply", "--unit", 1 / 128)
        self.assertEqual((self.output / "a.ply").read_bytes(), expected)

    def test_a_sheet_that_lies_in_another_plane_is_the_same_sheet(self):
        moved = self.vertices * [1.02, 1., 1.]
        self.upsample(self.frame("a.obj", moved), "--format", "ply")
        expected = (self.output / "a.ply").read_bytes()
        y_up = self.vertices[:, [0, 2, 1]] * [1., 1., -1.]
        write_obj(self.rest, y_up, self.triangles)
        self.output = self.folder / "y-up"
        self.assertIn("a sheet of 4 x 4 cells", self.upsample(self.frame("a.obj", moved),
                                                              "--format", "ply"))
        self.assertEqual((self.output / "a.ply").read_bytes(), expected)

    def test_slack_cloth_is_counted_and_found(self):
        short = self.vertices.copy()
        short[self.vertices[:, 0] > 0.035, 0] -= 0.002  # the last column of cells of 1 cm
        self.upsample(self.frame("slack.obj", short))
        row = rows_of(self.output / "upsample.csv")[2]
        self.assertAlmostEqual(float(row["largest"]), 0.2, 6)
        self.assertEqual(row["triangles_beyond"], "8")
        self.assertAlmostEqual(float(row["area_share_beyond"]), 0.25, 6)
        self.assertAlmostEqual(float(row["worst_rest_1_m"]), 0.035, delta=0.005)

    def test_cells_are_turned_and_cut_where_they_do_not_fit(self):
        stdout = self.upsample(self.frame("a.obj"), "--angle", 30, "--origin", "-0.001,0.002")
        self.assertIn("1 panel, 32 coarse triangles, cells cut along outlines", stdout)
        found = read_vtu(self.output / "a.vtu").points
        # At rest the cut cells cover the sheet.
        numpy.testing.assert_allclose(found.min(axis=0), self.vertices.min(axis=0), atol=1e-7)
        numpy.testing.assert_allclose(found.max(axis=0), self.vertices.max(axis=0), atol=1e-7)

    def test_every_fine_triangle_has_the_phase_that_the_cell_has_there(self):
        with h5py.File(self.cell) as file:
            vertices, lattice, triangles, material = (
                file[name][:] for name in ("vertices", "lattice", "triangles", "material"))
        corners = vertices[triangles]
        inverse = numpy.linalg.inv(numpy.swapaxes(corners[:, 1:] - corners[:, :1], 1, 2))
        for angle, origin in ((0., (0., 0.)), (0., (0.0021, 0.0013)), (90., (0.0021, 0.0013)),
                              (20., (-0.003, 0.001))):
            with self.subTest(angle=angle, origin=origin):
                self.output = self.folder / f"out-{angle}-{origin[0]}"
                self.upsample(self.frame("a.obj"), "--angle", angle, "--origin",
                              f"{origin[0]},{origin[1]}")
                found = read_vtu(self.output / "a.vtu")
                middles = found.points[:, :2][found.triangles].mean(axis=1)[::7]
                c, s = numpy.cos(numpy.radians(angle)), numpy.sin(numpy.radians(angle))
                in_cell = (middles - origin) @ [[c, -s], [s, c]]  # turned back
                part = in_cell @ numpy.linalg.inv(lattice)
                places = vertices.min(axis=0) + (part - numpy.floor(part)) @ lattice
                weights = numpy.einsum("tij,ptj->pti", inverse,
                                       places[:, None] - corners[None, :, 0])
                inside = numpy.minimum(weights.min(axis=2), 1. - weights.sum(axis=2))
                self.assertGreater(inside.max(axis=1).min(), -1e-3)
                numpy.testing.assert_array_equal(found.cell_data["material"][::7],
                                                 material[inside.argmax(axis=1)])


class OneRun(Upsampling):
    def test_frames_that_are_there_are_not_made_again(self):
        frames = self.moving(3)
        self.upsample(*frames[:2], "--format", "ply")
        before = {path: path.stat().st_mtime_ns for path in self.output.glob("f_*.ply")}
        # One of them anew, one more, and one whose result is gone.
        self.frame("f_1.obj", self.vertices * [1.5, 1., 1.])
        self.upsample(*frames, "--format", "ply")
        after = {path: path.stat().st_mtime_ns for path in self.output.glob("f_*.ply")}
        self.assertEqual(sorted(path.name for path in after), ["f_0.ply", "f_1.ply", "f_2.ply"])
        self.assertEqual(after[self.output / "f_0.ply"], before[self.output / "f_0.ply"])
        self.assertNotEqual(after[self.output / "f_1.ply"], before[self.output / "f_1.ply"])
        strains = {row["frame"]: float(row["largest"]) for row in
                   rows_of(self.output / "upsample.csv") if row["indicator"] == "strain"}
        self.assertAlmostEqual(strains["f_1"], 0.5, 12)
        self.assertEqual(len(rows_of(self.output / "upsample.csv")), 9)
        cut(self.output)
        (self.output / "f_2.ply").unlink()
        self.upsample(*frames, "--format", "ply", "--resume")
        self.assertTrue((self.output / "f_2.ply").exists())
        self.assertEqual((self.output / "f_0.ply").stat().st_mtime_ns,
                         before[self.output / "f_0.ply"])

    def test_frames_of_a_later_call_stand_beside_those_of_earlier_ones(self):
        frames = self.moving(12)
        self.upsample(*frames[:10])
        stdout = self.upsample(*frames[10:])
        self.assertIn("12 frames of a sheet", stdout)
        self.assertIn("of them 10 of earlier calls", stdout)
        self.assertIn("strain: largest 0.11 in f_11", stdout)
        self.assertIn("12 frames of a sheet", self.upsample(frames[0]))
        self.assertEqual(json.loads((self.output / "upsample.json").read_text())["frames"], 12)
        collection = (self.output / "frames.pvd").read_text()
        self.assertEqual(re.findall(r'file="(\w+)\.vtu"', collection),
                         [f"f_{k}" for k in range(12)])

    def test_a_run_that_was_killed_goes_on_to_the_same_bytes(self):
        frames = self.moving(60, 0.005)
        self.upsample(*frames, "--format", "obj,usda")
        whole = {path.name: path.read_bytes() for path in self.output.glob("f*")}
        self.assertIn("frames.usda", whole)
        shutil.rmtree(self.output)
        process = subprocess.Popen([PROGRAM, "upsample", self.cell, "--rest", self.rest, *frames,
                                    "--format", "obj,usda", "--output", self.output],
                                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        until = time.monotonic() + 60
        while len(list(self.output.glob("f_*.obj"))) < 5 and time.monotonic() < until:
            time.sleep(0.005)
        process.send_signal(signal.SIGKILL)
        process.wait()
        self.assertLess(len(list(self.output.glob("f_*.obj"))), 60)
        for path in self.output.glob("f*.*"):  # whole or not at all
            if path.suffix != ".part":
                self.assertEqual(path.read_bytes(), whole[path.name], path)
        self.upsample(*frames, "--format", "obj,usda")
        self.assertEqual({path.name: path.read_bytes() for path in self.output.glob("f*")}, whole)
        self.assertEqual(len(rows_of(self.output / "upsample.csv")), 180)

    def test_another_run_is_told_and_a_newer_format_refused(self):
        frames = self.moving(1)
        self.upsample(*frames)
        self.assertIn("holds another run (angle_degrees)",
                      self.upsample(*frames, "--angle", 5, "--resume", status=2))
        self.upsample(*frames, "--angle", 5, "--overwrite")
        path = self.output / "run.json"
        description = json.loads(path.read_text())
        path.write_text(json.dumps({**description, "format_version": 7}))
        self.assertIn("run.json: found format_version 7; expected at most 1",
                      self.upsample(*frames, status=2))


if __name__ == "__main__":
    unittest.main()
