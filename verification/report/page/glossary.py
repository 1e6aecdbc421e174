# SPDX-License-Identifier: MIT
"""The words of the page that a reader may not know, in the order of the way from cell to cloth."""

GLOSSARY = (
    ("cell", "one period of the cloth: a mesh with a few materials that repeats along two lattice"
     " vectors"),
    ("macro strain", "the strain of the cloth seen from afar, the same over a whole cell; 11 and 22"
     " along the axes, 12 in shear (engineering shear γ12 = 2 E12)"),
    ("C^H", "effective membrane stiffness: what an even sheet must have to answer like the cloth"
     " [N/m], in the order 11, 22, 12"),
    ("D^H", "effective bending stiffness [N m], of the curvatures κ11, κ22, 2 κ12"),
    ("deflection of the cell, φ", "how a cell leaves the parabola of its macro curvature where it"
     " bends, for a unit of each curvature; computed once per cell"),
    ("roll, cantilever-1, -2, twist, pressure", "loads of a sheet that bends: rolled by a moment at the"
     " edge opposite a clamp; clamped at one edge under a pressure; one of two clamps turned; clamped"
     " all around under a pressure"),
    ("bracket", "two stiffnesses of which it is proven that C^H (D^H) lies between them; the bars"
     " ± are read off it"),
    ("characteristic displacements, χ", "how the vertices of a cell move beside an even strain,"
     " for a unit of each macro strain; computed once per cell"),
    ("anchor", "χ is known up to a constant; it is fixed by holding the corners of the cell still,"
     " which makes the place of the cut matter; with the term edges it has mean zero instead"),
    ("affine", "the coarse mesh alone: fine vertices follow their coarse triangle; the baseline"),
    ("localized", "up-sampling as the paper has it: affine plus χ times the strain of the coarse"
     " triangle, blended between triangles"),
    ("full", "the default: all terms that have a meaning under the law and load: p2, edges,"
     " cubic, modes, curved and micro. Other methods are named by what is added or taken away:"
     " `localized+p2`, `full-micro`"),
    ("base", "the coarse cloth of a method, not up-sampled: of `full` the better of `full-micro` and"
     " `affine+p2`, load by load and strain by strain; of `localized` it is `affine`"),
    ("gain", "an error over a smaller one, in two factors: of the coarse cloth, `affine` over the base,"
     " and of up-sampling, the base over the method. A cell of one material has the first alone"),
    ("cubic", "a term: the coarse cloth has the cubic energy of the cell beside C^H"),
    ("modes", "a term: χ is joined by six modes for the products of macro strains; in cloths of"
     " yarns by modes that are fitted over the strains of the study, and the box is among the notes"),
    ("curved", "a term of cloths that bend: between its vertices the coarse cloth is a quadric of the"
     " curvature there, and with micro it has the deflection of the bent cell"),
    ("micro", "a term: χ and all that goes with it; without it the coarse motion is interpolated"),
    ("edges", "a term: what clamped and free edges of the sheet do: the slip of a clamped"
     " edge, the tension of a free one, and displacements that decay from both inwards; χ has mean"
     " zero"),
    ("p2", "a term: the coarse cloth is made of triangles two cells wide whose displacements are"
     " quadratic; it has the same vertices"),
    ("lift", "how χ is turned with the coarse cloth before it is added: by its rotation"),
    ("blending", "averaging the strain of neighbouring coarse triangles so that χ has no jumps"),
    ("reference", "the fine mesh solved by finite elements: what counts as the truth, with an error"
     " bar of its own"),
    ("linear, biot, green, yarn", "laws of the reference: small strain;"
     " ½ (U−I):C:(U−I), which is also the law of the coarse cloth; St. Venant-Kirchhoff; stretches"
     " and angle of two yarns, which the coarse cloth then has too"),
    ("fluctuation", "what the cloth does beside an even sheet of stiffness C^H: the part that"
     " up-sampling is to restore"),
    ("cell side", "square root of the area of the cell; errors are given in it"),
    ("periodic-11, -22, -12", "loads of an endless cloth, by one macro strain; no edges, no coarse"
     " mesh to solve"),
    ("margin β", "least eigenvalue of the stiffness of a periodic state on waves over any number of"
     " cells, relative to the stiffness at rest: 1 at rest, 0 where a wave costs nothing"),
    ("uniaxial-1, -2", "loads of an endless cloth that is pulled along one axis, its sides free of"
     " stress; resolved and coarse cloth each find how much they contract"),
    ("strip-1, strip-2, shear-frame", "sheets that are clamped at two sides and pulled along an"
     " axis, or sheared in a frame; they have edges"),
    ("claim", "a sentence that may fail, with a limit that was known before the figure: of the"
     " program (it computes what it says), of the input (cell, mesh, scene are fit) or of the"
     " method (it does here what it is for). Open: it could not be decided"),
    ("order", "by which power an error falls with mesh width, strain or time step"),
    ("degrees of freedom (DoFs)", "unknowns of a solve"),
)
