# SPDX-License-Identifier: MIT
"""Tables that tell `homespun judge` which file is of which level or frame."""
import unittest

from cli import rows_of
from judge_case import JudgingFrames, JudgingLevels


class TableOfLevels(JudgingLevels):
    def setUp(self):
        super().setUp()
        self.shifted = self.kept_positions("strip-1-biot-0.1") + [1e-8, 0.]
        self.write("some/one.npy", self.shifted)
        self.write("some/two.npy", self.shifted)
        self.given = self.folder / "table.csv"

    def refused_table(self, text, *words):
        self.given.write_text(text)
        return self.refused(words, self.given)

    def test_a_table_tells_levels_files_and_seconds(self):
        self.given.write_text("\ufefffile, load,law,strain,seconds,remark\r\n"
                              "some/one.npy,strip-1,biot,0.1,2.5,x\r\n\r\n"
                              "some/two.npy,strip-1,linear,0.1,,x", encoding="utf-8")
        rows, _ = self.judged(self.given)
        self.assertEqual(set(rows), {"strip-1-biot-0.1", "strip-1-linear-0.1"})
        # The coarse cloth's time comes to the method's, as in homespun's own.
        cloth = next(row for row in rows_of(self.study / "levels.csv") if row["part"] == "" and
                     (row["load"], row["reference"], row["strain"]) == ("strip-1", "biot", "0.1"))
        self.assertAlmostEqual(float(rows["strip-1-biot-0.1"]["seconds_method"]),
                               2.5 + float(cloth["seconds_coarse_solve"]), delta=1e-12)
        self.assertEqual(rows["strip-1-linear-0.1"]["seconds_method"], "")

    def test_all_faults_of_a_table_are_told_at_once_with_their_lines(self):
        said = self.refused_table(
            "load,law,strain,file,seconds\n"
            "strip-1,biot,0.1,some/none.npy,\n"
            "strip-1,elastic,0.1,some/one.npy,\n"
            "strip-1,biot,10%,some/one.npy,\n"
            "strip-1,biot,inf,some/one.npy,\n"
            "strip-1,biot,0.1,,\n"
            "strip-1,biot,0.1,some/one.npy,-1\n"
            "strip-1,biot,0.1,some/one.npy,inf\n"
            "strip-1,biot,0.1,some/one.npy,soon\n"
            "strip-1,biot,0.1,some/one.npy,0\n"
            "strip-1,biot,0.1,some/two.npy,0\n",
            "table.csv, line 2: column file: ", "none.npy is not there",
            "line 3: unknown reference", "line 4: column strain: found `10%`",
            "line 5: column strain: found `inf`", "line 6: column file: ",
            "line 7: column seconds: found `-1`", "line 8: column seconds: found `inf`",
            "line 9: column seconds: found `soon`",
            "line 11: " + str(self.folder / "some/two.npy") + ": is of the same level as " +
            str(self.given) + ", line 10: ")
        self.assertEqual(said.count("table.csv, line "), 10)  # line 10 has no fault

    def test_what_is_no_table_is_refused(self):
        good = "load,law,strain,file\n"
        tables = {
            "short": good + "strip-1,biot,0.1\n",
            "no-file": "load,law,strain\nstrip-1,biot,0.1\n",
            "no-strain": "load,law,file\nstrip-1,biot,some/one.npy\n", "no-row": good, "none": ""}
        paths = [self.folder / f"{name}.csv" for name in tables]
        for path, text in zip(paths, tables.values()):
            path.write_text(text)
        self.refused(("short.csv, line 2: found 3 fields; expected 4",
                      "no-file.csv, line 2: column file: ",
                      "no-strain.csv, line 2: column strain: found ``; expected a fraction above "
                      "zero", "columns load, law, strain, file"), *paths[:3])
        said = self.refused((), *paths[3:])
        self.assertRegex(said, "no-row.csv.*expected a row at least")
        self.assertRegex(said, "none.csv.*is empty")

    def test_what_is_wrong_with_a_file_names_its_row(self):
        short, line = self.shifted[1:], "table.csv, line 2: "
        self.write("some/short.npy", short)
        row = "load,law,strain,file\nstrip-1,biot,{},some/{}.npy\n"
        self.refused_table(row.format(0.1, "short"), line, "short.npy: holds an array of shape")
        self.refused_table(row.format(0.3, "one"), line, "`strip-1-biot-0.3` is no level or frame")


class TableOfFrames(JudgingFrames):
    def test_a_table_tells_frames(self):
        positions = self.kept_positions("biot-0002") + [0., 0., 1e-8]
        path, table = self.write("mine.npy", positions), self.folder / "table.csv"
        table.write_text("frame,reference,file\n2,biot,mine.npy\n")
        rows, _ = self.judged(table)
        self.assertEqual(rows, self.judged(self.write("biot-0002.npy", positions))[0])
        for faults in ((
                ("frame,reference,file\nlast,biot,mine.npy\n",
                 "columns reference, frame: found `biot`, `last`"),
                ("frame,reference,file\n-1,biot,mine.npy\n", "columns .*: found `biot`, `-1`"),
                ("frame,file\n2,mine.npy\n", "columns .*: found ``, `2`"),
                ("frame,reference,file\n2,biot,none.npy\n", "column file: ")), (
                ("frame,reference,file\n9,biot,mine.npy\n",
                 f"{path}: `biot-0009` is no level or frame"),
                ("load,law,strain,file\nstrip-1,biot,0.1,mine.npy\n",
                 f"{path}: `strip-1-biot-0.1` is no level or frame .*such as biot-0000")), (
                ("frame,reference,file,seconds\n2,biot,mine.npy,1\n",
                 "column seconds: has a run time"),)):
            tables = [self.folder / f"table-{k}.csv" for k in range(len(faults))]
            for table, (text, _) in zip(tables, faults):
                table.write_text(text)
            said = self.refused((), *tables)
            for table, (_, words) in zip(tables, faults):
                self.assertRegex(said, f"{table}, line 2: {words}")


if __name__ == "__main__":
    unittest.main()
