// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

/// Compiles a function for several instruction sets. When the program starts, the one for its processor is
/// chosen. Results have the same bits, because operations of floats are rounded one by one on each of them
/// (-ffp-contract=off). For loops that compilers vectorise; kernels have versions of their own (targets.h).
///
/// Sanitizers are not ready when the choice is made, and other compilers than GCC need no version of their
/// own to be correct.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_THREAD__) && \
    !defined(__SANITIZE_ADDRESS__)
#define PCL_BV_VECTOR_CLONES __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define PCL_BV_VECTOR_CLONES
#endif
