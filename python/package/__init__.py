# SPDX-License-Identifier: MIT
"""homespun: periodic cloth homogenized, moved coarsely and up-sampled.

    cell = homespun.Cell.read("cell.h5")           # or homespun.homogenize("cell.prm")
    sheet = homespun.Sheet(cell, 20, 20)
    cloth = homespun.Cloth(cell, sheet.coarse_vertices, sheet.coarse_triangles, held=[0, 20])
    upsampler = homespun.Upsampler(cell, sheet)
    cloth.step(0.01)
    fine = upsampler.upsample(cloth.positions)     # (n, 3) float32

Arrays are not copied where they are float64 (indices int32) and contiguous; other numbers and lists
are converted. What cannot be used raises BadInput, a ValueError, with the text of the program; what
does not converge raises NotConverged. homespun.plot draws cells, sheets and errors.
"""
from __future__ import annotations

import typing

from . import plot
from ._light import (BadInput, Bracket, BracketedCell, Cell, Cloth, Garment, NotConverged, Sheet,
                     Upsampler, __version__, read_positions)
from .results import results
from .study import Judged, Study, study

if typing.TYPE_CHECKING:
    import os
    from collections.abc import Mapping, Sequence

    from numpy.typing import ArrayLike

__all__ = ["BadInput", "Bracket", "BracketedCell", "Cell", "Cloth", "Garment", "Judged",
           "NotConverged", "Sheet", "Study", "Upsampler", "__version__", "homogenize", "plot",
           "read_positions", "results", "study"]


def homogenize(cell: str | os.PathLike[str] | None = None, *,
               vertices: ArrayLike | None = None, triangles: ArrayLike | None = None,
               groups: ArrayLike | None = None,
               phases: Sequence[Mapping[str, float]] | None = None, order: int = 2,
               bars: bool = True, max_dofs: int | None = None) -> BracketedCell:
    """The BracketedCell of a cell file, or of arrays, homogenized on one rank.

    cell: the path of a .prm file; or
    vertices (n, 2) [m], triangles (m, 3), groups (m,) numbers of the phases,
    phases: a list of dict(E=, nu=, thickness=, density=) [Pa, -, m, kg/m^3], or for a fabric with
    axes dict(E1=, E2=, nu12=, G12=, angle=, thickness=, density=), angle in degrees.
    order: 1 or 2, of the displacement elements.
    bars: also D^H [N m] and the guaranteed brackets of C^H and D^H, as `homespun homogenize` gives
    them; without, the cell problems alone.
    max_dofs: DoFs up to which brackets are made, None for those of the program.

    Raises BadInput with what `homespun check` says of the file, or naming the array; NotConverged.
    Warns of what the program warns of, and where there are no bars.
    """
    from . import _fem  # loads deal.II, and starts MPI when it is called

    choices = _fem.Choices(order, bars, max_dofs)
    arrays = {"vertices": vertices, "triangles": triangles, "groups": groups, "phases": phases}
    if cell is not None:
        given = [name for name, value in arrays.items() if value is not None]
        if given:
            raise BadInput(f"homogenize: found a file and {', '.join(given)}; expected one or the "
                           "other")
        return _fem.homogenize_file(cell, choices)
    if vertices is None or triangles is None or groups is None or phases is None:
        missing = [name for name, value in arrays.items() if value is None]
        raise BadInput(f"homogenize: {', '.join(missing)} missing; expected a cell file, or all of "
                       "vertices, triangles, groups and phases")
    return _fem.homogenize_arrays(vertices, triangles, groups, phases, choices)
