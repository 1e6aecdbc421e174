// SPDX-License-Identifier: MIT
// The BLAS that does the dense algebra of the direct solvers: whichever the machine has chosen.
#pragma once

#include <string>

namespace homespun::verification
{
struct Blas
{
  std::string library; ///< its own name and version, or the path of its file
  int threads;         ///< of each process; 0 where it does not say
};

/// Loads the machine's BLAS into a program that is not linked with it, for the functions below, by
/// the name under which those that are linked find it. Where there is none, nothing happens.
void load_blas();

/// The library that is loaded, asked while the program runs.
Blas loaded_blas();

/// An OpenBLAS that is older than the processor takes the kernels of a Prescott (2004), with 5.5
/// instead of 36 Gflop/s in a product of matrices on a Xeon of 2023: this one has it take those for
/// the instructions that are there, unless the user says otherwise by OPENBLAS_CORETYPE. To be
/// called before it is used.
void choose_blas_kernels();

/// One thread of OpenBLAS in each process, as ranks have a core each; unless the user says
/// otherwise by OPENBLAS_NUM_THREADS, GOTO_NUM_THREADS or OMP_NUM_THREADS. To be called before it
/// is used.
void limit_blas_threads();
} // namespace homespun::verification
