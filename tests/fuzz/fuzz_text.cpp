// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Any bytes as rows of two numbers, at once and in pieces of a few bytes by three threads: the same records
// or the same error. The first byte says how many rows are wanted, the second one how large pieces are
// and which character separates values.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "memory_file.h"
#include "pcl_bv/io/raw_cloud.h"
#include "text_rows.h"

namespace {

using namespace pcl_bv;
using namespace pcl_bv::detail;

struct Outcome {
  RowsRead rows;
  std::string error;
  ByteBuffer records;
};

void read_pair(TextRows& rows, std::byte* to) {
  if (rows.read({"pair", 'F', 4, 2, 0}, to) < 2)
    throw RowError{"row ", " is bad at " + std::string(rows.value())};
  if (rows.find_value()) throw RowError{"row ", " is too long"};
}

Outcome outcome(const TextBody& body, std::size_t wanted, const ParallelPolicy& policy) {
  Outcome result;
  result.records.assign(wanted * 8, std::byte{0});
  try {
    result.rows = read_text_rows(body, {1, wanted, 8}, read_pair, result.records.data(), policy);
  } catch (const IoError& error) {
    result.error = error.what();
  }
  return result;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 3) return 0;
  static MemoryFile memory;
  memory.assign({reinterpret_cast<const char*>(data), size});
  const InputFile file(memory.path());
  const char separator = data[1] < 128 ? ' ' : ',';
  for (const bool returns : {false, true}) {
    const Outcome whole = outcome({file, 2, returns, separator}, data[0], Serial{});
    const TextBody small_pieces{file, 2, returns, separator, data[1] % 64 + std::size_t{1}};
    const Outcome pieces = outcome(small_pieces, data[0], Threads{3});
    if (whole.error != pieces.error || whole.rows.count != pieces.rows.count ||
        whole.rows.more != pieces.rows.more)
      std::abort();
    const auto read = static_cast<std::ptrdiff_t>(whole.rows.count * 8);
    if (whole.error.empty() &&
        !std::equal(whole.records.begin(), whole.records.begin() + read, pieces.records.begin()))
      std::abort();
  }
  return 0;
}
