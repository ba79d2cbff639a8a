// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstddef>  // defines __GLIBC__

/// Compiles a function for several instruction sets. When the program starts, the one for its processor is
/// chosen. Results have the same bits, because operations of floats are rounded one by one on each of them
/// (-ffp-contract=off). For loops that compilers vectorise; kernels have versions of their own (targets.h).
///
/// Off with sanitizers: the choice is made before their runtime is initialised. Off with other compilers, GCC
/// before 12 and other C libraries, which do not support it; only speed differs.
#if defined(__x86_64__) && defined(__GLIBC__) && __GNUC__ >= 12 && !defined(__clang__) && \
    !defined(__SANITIZE_THREAD__) && !defined(__SANITIZE_ADDRESS__)
#define PCL_BV_VECTOR_CLONES __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define PCL_BV_VECTOR_CLONES
#endif
