// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// libdeflate 1.14 (Debian 12) multiplies 128 bits at a time, which is slower than the page cache. From 1.19
// on it multiplies 512, as folded_crc() does; once no supported system has an older one, folded_crc() can go.

#include "pcl_bv/io/crc32.h"

#include <libdeflate.h>

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace pcl_bv::detail {
#if defined(__x86_64__)
namespace {

constexpr std::size_t kFoldedBytes = 256;  // of one step: four vectors, which do not wait for each other

#define PCL_BV_FOLDS __attribute__((target("avx512f,avx512vl,avx512bw,vpclmulqdq,pclmul,sse4.1")))

// Moves the 16 bytes of each lane over the distance of `powers`: their first half times the even element,
// plus their second half times the odd one (carry-less).
PCL_BV_FOLDS inline __m512i folded(__m512i bytes, __m512i powers) {
  return _mm512_clmulepi64_epi128(bytes, powers, 0x00) ^ _mm512_clmulepi64_epi128(bytes, powers, 0x11);
}

PCL_BV_FOLDS inline __m512i folded_onto(__m512i bytes, __m512i powers, __m512i following) {
  return folded(bytes, powers) ^ following;
}

PCL_BV_FOLDS inline __m512i load(const std::byte* data) {
  return _mm512_loadu_si512(data);
}

// Folds `steps` times 256 bytes, at least once (Gopal et al. 2009). Returns their CRC.
// The even elements are x^(d + 32) modulo the polynomial for the distance d in bits, the odd ones x^(d - 32),
// with reversed bits and shifted by one.
PCL_BV_FOLDS std::uint32_t folded_crc(const std::byte* data, std::size_t steps, std::uint32_t crc) {
  const __m512i over_2048 = _mm512_set4_epi64(0x1322d1430, 0x11542778a, 0x1322d1430, 0x11542778a);
  const __m512i over_512 = _mm512_set4_epi64(0x1c6e41596, 0x154442bd4, 0x1c6e41596, 0x154442bd4);
  // Over 384, 256 and 128 bits; the last 16 bytes stay.
  const __m512i over_rest =
      _mm512_set_epi64(0, 0, 0xccaa009e, 0x1751997d0, 0x15a546366, 0xf1da05aa, 0x174359406, 0x3db1ecdc);
  __m512i a = load(data), b = load(data + 64), c = load(data + 128), d = load(data + 192);
  a ^= _mm512_set_epi64(0, 0, 0, 0, 0, 0, 0, ~crc);
  for (std::size_t i = 1; i < steps; ++i) {
    data += kFoldedBytes;
    a = folded_onto(a, over_2048, load(data));
    b = folded_onto(b, over_2048, load(data + 64));
    c = folded_onto(c, over_2048, load(data + 128));
    d = folded_onto(d, over_2048, load(data + 192));
  }
  d = folded_onto(folded_onto(folded_onto(a, over_512, b), over_512, c), over_512, d);
  const __m512i lanes = folded_onto(d, over_rest, _mm512_maskz_mov_epi64(0xc0, d));
  alignas(64) std::uint64_t words[8];
  _mm512_store_si512(words, lanes);
  const std::uint64_t rest[2] = {words[0] ^ words[2] ^ words[4] ^ words[6],
                                 words[1] ^ words[3] ^ words[5] ^ words[7]};
  // libdeflate inverts the CRC at both ends: 0xffffffff starts with the remainder 0.
  return libdeflate_crc32(0xffffffff, rest, sizeof rest);
}

bool can_fold() {
  static const bool can = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
                          __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("vpclmulqdq");
  return can;
}

}  // namespace
#endif

std::uint32_t crc32_of(const void* data, std::size_t size, std::uint32_t crc) {
  if (size == 0) return crc;  // libdeflate starts anew at a null address
#if defined(__x86_64__)
  const std::size_t steps = size / kFoldedBytes;
  if (steps >= 4 && can_fold()) {
    crc = folded_crc(static_cast<const std::byte*>(data), steps, crc);
    data = static_cast<const std::byte*>(data) + steps * kFoldedBytes;
    size -= steps * kFoldedBytes;
  }
#endif
  return libdeflate_crc32(crc, data, size);
}

}  // namespace pcl_bv::detail
