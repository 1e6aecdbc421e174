# SPDX-License-Identifier: MIT
"""same_results.py notices one changed number, and nothing else."""
import json
import pathlib
import tempfile
import unittest

import same_results


class SameResults(unittest.TestCase):
    def setUp(self):
        made = tempfile.TemporaryDirectory()
        self.addCleanup(made.cleanup)
        self.folder = pathlib.Path(made.name)

    def found(self, old, new, suffix=".csv", **how):
        paths = [self.folder / f"{name}{suffix}" for name in ("old", "new")]
        for path, text in zip(paths, (old, new)):
            path.write_text(text, encoding="utf-8")
        return same_results.differences(*paths, **how)

    OLD = "cell,strain,error_m,seconds\na,0.01,2.5,1\na,0.02,3.5,1\nb,0.01,4.5,1\n"

    def test_rows_and_columns_in_another_order_and_other_seconds_are_the_same(self):
        new = "seconds,strain,cell,error_m\n9,0.01,b,4.5\n8,0.02,a,3.5\n7,0.01,a,2.5\n"
        self.assertEqual(self.found(self.OLD, new), [])

    def test_one_changed_number_is_noticed(self):
        for k, value in enumerate(("2.5", "3.5", "4.5")):
            found = self.found(self.OLD, self.OLD.replace(value, f"{value}0001"))
            self.assertEqual(len(found), 1, k)
            self.assertIn("error_m by up to", found[0])

    def test_a_tolerance_is_of_the_largest_of_the_column(self):
        new = self.OLD.replace("2.5", "2.5004")  # 0.9e-4 of 4.5
        self.assertEqual(self.found(self.OLD, new, tolerance=1e-4), [])
        self.assertEqual(len(self.found(self.OLD, new, tolerance=8e-5)), 1)
        self.assertEqual(len(self.found(self.OLD, self.OLD.replace("2.5", "nan"),
                                        tolerance=1.)), 1)

    def test_what_is_gone_or_new_is_listed(self):
        new = "cell,strain,error_m,more\na,0.01,2.5,1\na,0.02,3.5,1\nc,0.01,4.5,1\n"
        self.assertEqual(self.found(self.OLD, new),
                         ["column more is new", "row b, 0.01, 1 is gone",
                          "row c, 0.01, 1 is new"])

    def test_names_of_the_old_program_are_translated(self):
        new = self.OLD.replace("error_m", "distance_m")
        self.assertEqual(len(self.found(self.OLD, new)), 2)
        self.assertEqual(self.found(self.OLD, new, rename={"error_m": "distance_m"}), [])

    def test_numbers_of_json(self):
        old = {"C": [[1., 2.], [2., 5.]], "seconds": {"solve": 1.}, "checks": [{"value": 3.}]}
        new = {**old, "seconds": {"solve": 2.}}
        self.assertEqual(self.found(json.dumps(old), json.dumps(new), ".json"), [])
        new["C"] = [[1., 2.], [2., 5.0001]]
        self.assertEqual(len(self.found(json.dumps(old), json.dumps(new), ".json")), 1)

    def test_positions_of_h5(self):
        import h5py
        paths = [self.folder / "old.h5", self.folder / "new.h5"]
        for path, last in zip(paths, (1., 1. + 1e-9)):
            with h5py.File(path, "w") as file:
                file["positions"] = [[0., 0.5], [0.25, last]]
        self.assertEqual(same_results.differences(*paths, tolerance=1e-8), [])
        self.assertEqual(len(same_results.differences(*paths)), 1)


if __name__ == "__main__":
    unittest.main()
