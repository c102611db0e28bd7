#pragma once

namespace dotyk::algebra {

/// OpenBLAS has kernels for each kind of processor, and takes those of 2004 (SSE) for one that it does not know: that of Debian 12 (0.3.21) for all of Intel's
/// since 2023. There this chooses the kernels for AVX2 or AVX-512: a factor of a cube of 24³ cells takes 1.8 s in place of 5.0. Where the user has
/// set OPENBLAS_CORETYPE, or OpenBLAS knows the processor, it does nothing. Before the first product; not from several threads.
void choose_blas_kernels();

}  // namespace dotyk::algebra
