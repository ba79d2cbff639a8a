// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "failures.h"

#include <sstream>

namespace pcl_bv::detail {
namespace {

void write(const TileHeader& header, std::ostream& out) {
  out << header.points << ' ' << size_of(header.scalar) << ' ' << header.random_access << ' '
      << header.error.has_value() << ' ' << header.error.value_or("").size() << ' ' << header.note.size()
      << ' ' << header.error.value_or("") << header.note << '\n';
}

TileHeader read_header(std::istream& in) {
  TileHeader header;
  std::size_t scalar = 0, length = 0, note_length = 0;
  bool failed = false;
  in >> header.points >> scalar >> header.random_access >> failed >> length >> note_length;
  header.scalar = scalar == 8 ? ScalarType::float64 : ScalarType::float32;
  in.get();
  std::string error(length, '\0');
  in.read(error.data(), static_cast<std::streamsize>(length));
  if (failed) header.error = error;
  header.note.resize(note_length);
  in.read(header.note.data(), static_cast<std::streamsize>(note_length));
  return header;
}

}  // namespace

std::optional<TileFailure> first_failure(Ranks& ranks, const std::optional<TileFailure>& own) {
  const std::string text = own ? std::to_string(own->tile) + ' ' + own->reason : std::string();
  for (const std::string& each : ranks.all_gather(text)) {
    if (each.empty()) continue;
    const std::size_t space = each.find(' ');
    return TileFailure{std::stoul(each.substr(0, space)), each.substr(space + 1)};
  }
  return std::nullopt;
}

std::vector<TileHeader> describe_tiles(Ranks& ranks, const std::vector<Job>& jobs) {
  std::ostringstream own;
  for (std::size_t i = ranks.rank(); i < jobs.size(); i += ranks.size())
    write(describe_tile(jobs[i]), own);
  std::vector<TileHeader> headers(jobs.size());
  std::size_t rank = 0;
  for (const std::string& text : ranks.all_gather(own.str())) {
    std::istringstream in(text);
    for (std::size_t i = rank; i < jobs.size(); i += ranks.size())
      headers[i] = read_header(in);
    ++rank;
  }
  return headers;
}

}  // namespace pcl_bv::detail
