# SPDX-License-Identifier: MIT
"""What needs no finite elements is answered at once: by a program that loads no deal.II, and in the
words of the one that does.
"""
import os
import pathlib
import re
import shutil
import subprocess

from cli import LAYERED, PROGRAM, InFolder, run

FULL = pathlib.Path(PROGRAM).with_name("homespun-full")
CELL = LAYERED
COMMANDS = ("check", "homogenize", "strain", "drape", "upsample", "stress", "converge", "verify",
            "report", "cells", "periodic", "judge", "bend")
AT_ONCE = [("--help",), ("--version",), (), ("frobnicate",), ("strain", "--frobnicate"),
           ("check",), ("check", CELL), ("check", "nothere.prm"), ("cells",),
           ("cells", "make", "nothere"), ("report", "nothere"),
           ("strain", CELL, "--loads", "none"), ("periodic", "load", CELL, "--references", "none"),
           ("periodic", "stability", CELL, "--strains", "0"), ("verify", "--parts", "strain"),
           ("upsample", "cell.h5", "f.obj", "--rest", "r.obj", "--format", "none"),
           *((command, "--help") for command in COMMANDS)]
# What the program is linked with: HDF5, which brings MPI and what the system's MPI needs, the C++
# runtime, the BLAS that it asks for its name, and CHOLMOD, by which `check` bends a cell. UCX,
# which MPI of Debian 13 stands on, opens plugins of its own when it is loaded.
OWN = (r"libhdf5|libmpi_cxx|libstdc\+\+|libgcc_s|lib(open)?blas|libgfortran|libquadmath|"
       r"libuc[a-z]_|libfuse3|lib(cholmod|c?c?(ol)?amd|suitesparseconfig|metis|lapack|gomp)\.")


def loads_of(path):
    """{name: path} of the libraries that a program or library is linked with, and theirs."""
    text = subprocess.run(["ldd", path], check=True, capture_output=True, text=True).stdout
    return dict(re.findall(r"(\S+) => (\S+)", text))


OF_HDF5 = set(loads_of(next(path for name, path in loads_of(PROGRAM).items()
                            if name.startswith("libhdf5") and "_hl" not in name)))
OF_HDF5 |= {"libc.so.6", "libm.so.6"}


def words_of(text):
    """A text, with the options that one excludes in an order: CLI11 lists them by their address."""
    return re.sub(r"Excludes:.*", lambda found: " ".join(sorted(found[0].split())), text)


class AtOnce(InFolder):
    def libraries(self, *arguments):
        """Process id, and the libraries that it and its children loaded, as the loader says."""
        log = self.folder / "loader"
        log.mkdir()
        self.addCleanup(shutil.rmtree, log, ignore_errors=True)
        with subprocess.Popen(
                [PROGRAM, *map(str, arguments)], cwd=self.folder, stdout=subprocess.DEVNULL,
                stderr=subprocess.DEVNULL,
                env={**os.environ, "LD_DEBUG": "files", "LD_DEBUG_OUTPUT": log / "of"}) as process:
            process.wait()
        logs = {int(path.suffix[1:]): path.read_text(encoding="utf-8", errors="replace")
                for path in log.iterdir()}
        shutil.rmtree(log)
        return process.pid, {pid: set(re.findall(r"file=(\S+) \[0\];  generating link map", text))
                             for pid, text in logs.items()}

    def test_what_needs_no_finite_elements_loads_none(self):
        for arguments in AT_ONCE:
            with self.subTest(arguments=arguments):
                pid, loaded = self.libraries(*arguments)
                self.assertIn("libstdc++.so.6", loaded[pid], "the loader said nothing")
                for libraries in loaded.values():
                    self.assertEqual([name for name in libraries
                                      if re.match(r"libdeal|libtrilinos|libpetsc|libdmumps", name)],
                                     [])
                self.assertEqual([name for name in loaded[pid] - OF_HDF5
                                  if not re.match(OWN, os.path.basename(name))], [])

    def test_what_solves_is_handed_over_to_the_same_process(self):
        pid, loaded = self.libraries("homogenize", CELL, "--no-bars", "--output", "out")
        self.assertEqual(list(loaded), [pid])
        self.assertTrue([name for name in loaded[pid] if name.startswith("libdeal")])
        self.assertTrue((self.folder / "out" / "cell.h5").is_file())

    def test_both_programs_say_the_same(self):
        for arguments in [*AT_ONCE, ("homogenize", "nothere.prm")]:
            with self.subTest(arguments=arguments):
                one = run(*arguments, cwd=self.folder)
                two = subprocess.run([FULL, *map(str, arguments)], cwd=self.folder, check=False,
                                     capture_output=True, text=True, timeout=600)
                self.assertEqual((one.returncode, words_of(one.stdout), one.stderr),
                                 (two.returncode, words_of(two.stdout), two.stderr))

    def test_without_its_other_part_it_answers_and_names_what_is_missing(self):
        alone = self.folder / "bin" / "homespun"
        alone.parent.mkdir()
        shutil.copy(PROGRAM, alone)

        def said_by(*arguments):
            return subprocess.run([alone, *map(str, arguments)], cwd=self.folder, check=False,
                                  capture_output=True, text=True, timeout=600)
        self.assertEqual(said_by("check", CELL).returncode, 0)
        refused = said_by("homogenize", CELL)
        self.assertEqual(refused.returncode, 2)
        self.assertIn("homespun-full: cannot be run (No such file or directory); expected the part "
                      "of homespun that solves: install homespun again", refused.stderr)
