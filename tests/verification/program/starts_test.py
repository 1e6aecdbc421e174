# SPDX-License-Identifier: MIT
"""Starts of the program beside each other: each has the exit status of what it did, and no folder
of a session is left, whatever ended it.
"""
import concurrent.futures
import os
import signal
import subprocess
import time
import unittest

from cli import CELLS, LAYERED, PROGRAM, InFolder, run

STARTS = int(os.environ.get("STARTS", "20"))
SOLVE = ("homogenize", LAYERED, "--order", "1", "--no-bars", "--quiet")


class Starts(InFolder):
    def setUp(self):
        super().setUp()
        self.temporary = self.folder / "tmp"
        self.temporary.mkdir()
        self.environment = {**os.environ, "TMPDIR": str(self.temporary)}

    def start(self, k):
        """Start number k: one solves, one meets a fault after MPI has started, one before."""
        output = self.folder / f"out{k}"
        arguments, status = [((*SOLVE, "--output", output), 0),
                             (("homogenize", self.folder / "none.prm"), 2),
                             (("periodic", "load", CELLS / "layered.prm", "--references", "none"),
                              2)][k % 3]
        return run(*arguments, env=self.environment).returncode, status

    def left(self):
        return sorted(str(path) for path in self.temporary.rglob("*"))

    def test_four_at_a_time_each_has_its_exit_status(self):
        with concurrent.futures.ThreadPoolExecutor(4) as pool:
            for k, (found, expected) in enumerate(pool.map(self.start, range(STARTS))):
                self.assertEqual(found, expected, f"start {k}")
        self.assertEqual(self.left(), [])

    def test_no_end_of_a_process_leaves_a_folder_nor_harms_another(self):
        with concurrent.futures.ThreadPoolExecutor(1) as pool:
            other = pool.submit(self.start, 0)
            for k, end in enumerate([signal.SIGINT, signal.SIGTERM, signal.SIGINT, signal.SIGINT]):
                with subprocess.Popen([PROGRAM, *map(str, SOLVE), "--output",
                                       self.folder / f"ended{k}"], env=self.environment,
                                      stderr=subprocess.DEVNULL) as process:
                    time.sleep(0.1 + 0.15 * k)
                    process.send_signal(end)
                self.assertIn(process.returncode, (-end, 0))
            found, expected = other.result()
        self.assertEqual(found, expected)
        # A process that nobody could end in order, while it works.
        study = ["strain", "--quick", CELLS / "layered.prm", "--output", self.folder / "killed"]
        with subprocess.Popen([PROGRAM, *study], env=self.environment,
                              stdout=subprocess.DEVNULL) as process:
            folder = self.folder / "killed"
            while not folder.exists() and process.poll() is None:
                time.sleep(0.01)
            process.kill()
        self.assertEqual(process.returncode, -signal.SIGKILL)
        self.assertEqual(self.left(), [])

    def test_a_start_that_fails_is_no_claim_that_failed_and_says_why(self):
        for broken in ({"OMPI_MCA_pml": "absent"}, {"TMPDIR": str(self.folder / "none")}):
            result = run(*SOLVE, "--output", self.folder / "out",
                         env={**self.environment, **broken})
            self.assertEqual(result.returncode, 3)
            self.assertIn("MPI did not start", result.stderr)
            self.assertEqual(self.left(), [])

    def test_faults_of_the_command_line_are_answered_before_mpi_starts(self):
        without = {**self.environment, "OMPI_MCA_pml": "absent"}
        cell = CELLS / "layered.prm"
        for arguments in (("strain", cell, "--loads", "none"),
                          ("periodic", "load", cell, "--references", "none"),
                          ("periodic", "stability", cell, "--strains", "0"),
                          ("verify", "--parts", "strain"),
                          ("converge", cell, "--studies", "none"),
                          ("drape", CELLS.parent / "scenes" / "hang.prm", "--frames", "none"),
                          ("upsample", "cell.h5", "f.obj", "--rest", "r.obj", "--format", "none")):
            with self.subTest(arguments=arguments):
                self.assertEqual(run(*arguments, env=without).returncode, 2)


if __name__ == "__main__":
    unittest.main()
