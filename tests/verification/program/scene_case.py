# SPDX-License-Identifier: MIT
"""Copies of shipped scenes with other keys, for tests of `drape`."""
from cli import CELLS, InFolder

SCENES = CELLS.parent / "scenes"
TRIANGLE = "v 0 0 1\nv 0.1 0 0\nv 0 0.1 0\nvt 0 0\nvt 0.1 0\nvt 0 0.1\nf 1/1 2/2 3/3\n"


class SceneCase(InFolder):
    def scene(self, changes, name="hang", garment=None):
        """A copy of a shipped scene with keys replaced, added, or, given None, removed."""
        shipped = (SCENES / f"{name}.prm").read_text(encoding="utf-8")
        lines = shipped.replace("../cells", str(CELLS)).splitlines()
        for key, value in changes.items():
            lines = [line for line in lines if line.split("=")[0].split()[1:] != key.split()]
            if value is not None:
                lines.append(f"set {key} = {value}")
        if garment is not None:
            (self.folder / "cloth.obj").write_text(garment, encoding="utf-8")
            lines.append("set Mesh = cloth.obj")
        path = self.folder / "scene.prm"
        path.write_text("\n".join(lines) + "\n", encoding="utf-8")
        return path
