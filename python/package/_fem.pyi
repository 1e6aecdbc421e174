# SPDX-License-Identifier: MIT
import os
from collections.abc import Mapping, Sequence

from numpy.typing import ArrayLike

from ._light import BracketedCell

class Choices:
    def __init__(self, order: int, bars: bool, max_dofs: int | None) -> None: ...

def homogenize_file(file: str | os.PathLike[str], choices: Choices) -> BracketedCell: ...
def homogenize_arrays(
    vertices: ArrayLike,
    triangles: ArrayLike,
    groups: ArrayLike,
    phases: Sequence[Mapping[str, float]],
    choices: Choices,
) -> BracketedCell: ...
