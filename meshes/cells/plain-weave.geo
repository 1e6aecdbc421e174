// SPDX-License-Identifier: MIT
// plain-weave: every yarn passes over one yarn and under the next. Two mirrors and a rotation by 90
// degrees: C11 = C22 and C16 = C26 = 0.
//
//     weft 1   # .      # warp on top
//     weft 0   . #      . weft on top
//
// One mesh unit is the pitch, the distance of neighbouring yarns. The outline runs along the middle of
// a warp and a weft yarn, so that the gaps between yarns are holes inside it, with free edges:
//
//     weft  warp-over  weft        a crossing is two layers thick, named by the yarn on top
//     hole    warp     hole        between crossings there is one yarn alone
//     weft  weft-over  weft
//
// Rectangles of a grid, each cut into two triangles, with diagonals that alternate: mirror symmetry of
// the weave is one of the mesh. No side of a rectangle is longer than twice the other.
// gmsh -2 -format msh41 plain-weave.geo -o plain-weave.msh

DefineConstant[
  yarn_width = { 0.75, Min 0.3, Max 0.9, Name "Parameters/width of a yarn, in pitches" }
  h          = { 0.094, Min 0.02, Max 0.5, Name "Parameters/mesh size, in pitches; 1024 triangles as shipped" }
];

harness = 2; // yarns after which the weave repeats

// ---- the grid: half a yarn, gap, yarn, ..., gap, half a yarn, the same along both axes ----
// An even number of rectangles across half a yarn and across a gap, for the mirror symmetry.
gap  = 1 - yarn_width;
rows = 2 * Ceil(gap / (2 * h));
step = gap / rows;
half = 2 * Ceil(Max(yarn_width / (4 * h), yarn_width / (8 * step)));
step = yarn_width / (2 * half);
rows = 2 * Ceil(Max(rows / 2, gap / (4 * step)));

N      = 2 * harness + 1; // strips: even ones are yarns, odd ones gaps
at[]   = {0};
cuts[] = {};
For k In {0 : N - 1}
  If (k % 2 == 1)
    at[]   += {at[k] + gap};
    cuts[] += {rows};
  ElseIf (k == 0 || k == N - 1)
    at[]   += {at[k] + yarn_width / 2};
    cuts[] += {half};
  Else
    at[]   += {at[k] + yarn_width};
    cuts[] += {2 * half};
  EndIf
EndFor

For l In {0 : N}
  For k In {0 : N}
    Point(1 + k + l * (N + 1)) = {at[k], at[l], 0};
  EndFor
EndFor
// Lines along axis 1 have numbers from 1, along axis 2 from 10001.
For l In {0 : N}
  For k In {0 : N - 1}
    a = 1 + k * (N + 1) + l;
    Line(1 + k + l * N)     = {1 + k + l * (N + 1), 2 + k + l * (N + 1)};
    Line(10001 + k + l * N) = {a, a + N + 1};
    Transfinite Curve{1 + k + l * N, 10001 + k + l * N} = cuts[k] + 1;
  EndFor
EndFor

// ---- the yarns ----
// Warp yarns run along axis 2, weft yarns along axis 1. on_top[i * harness + j] is 1 where warp yarn i
// lies over weft yarn j.
on_top[] = {};
For i In {0 : harness - 1}
  For j In {0 : harness - 1}
    on_top[] += {(i + j) % 2 == 0 ? 0 : 1};
  EndFor
EndFor

warp[] = {};
weft[] = {};
warp_over[] = {};
weft_over[] = {};
For l In {0 : N - 1}
  For k In {0 : N - 1}
    If (k % 2 == 0 || l % 2 == 0)
      s = 1 + k + l * N;
      Curve Loop(s)    = {1 + k + l * N, 10001 + l + (k + 1) * N, -(1 + k + (l + 1) * N), -(10001 + l + k * N)};
      Plane Surface(s) = {s};
      Transfinite Surface{s} Alternate;
      // The crossing below and to the left, of warp yarn i and weft yarn j; the next one along the yarn.
      i    = Floor(k / 2) % harness;
      j    = Floor(l / 2) % harness;
      here = on_top[i * harness + j];
      If (k % 2 == 0 && l % 2 == 0)
        If (here == 1)
          warp_over[] += {s};
        Else
          weft_over[] += {s};
        EndIf
      ElseIf (k % 2 == 0)
        warp[] += {s};
      Else
        weft[] += {s};
      EndIf
    EndIf
  EndFor
EndFor

// Materials: the names are the keys of the .prm file. No physical curves: sides are found by matching.
Physical Surface("warp", 1) = {warp[]};
Physical Surface("weft", 2) = {weft[]};
Physical Surface("warp-over", 3) = {warp_over[]};
Physical Surface("weft-over", 4) = {weft_over[]};
