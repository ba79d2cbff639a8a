// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "laz_files.h"

#include <gtest/gtest.h>
#include <laszip/laszip_api.h>

namespace pcl_bv {
namespace {

class Handle {
 public:
  Handle() { check(laszip_create(&handle_)); }
  ~Handle() { laszip_destroy(handle_); }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;

  void check(laszip_I32 status) {
    laszip_CHAR* reason = nullptr;
    if (status == 0) return;
    laszip_get_error(handle_, &reason);
    ADD_FAILURE() << (reason == nullptr ? "no reason" : reason);
  }

  laszip_POINTER get() const { return handle_; }

 private:
  laszip_POINTER handle_ = nullptr;
};

}  // namespace

void compress_las(const std::filesystem::path& las, const std::filesystem::path& laz,
                  std::uint32_t chunk_points) {
  Handle from, to;
  laszip_BOOL compressed = 0;
  from.check(laszip_open_reader(from.get(), las.c_str(), &compressed));
  laszip_header* header = nullptr;
  from.check(laszip_get_header_pointer(from.get(), &header));
  to.check(laszip_set_header(to.get(), header));
  to.check(laszip_preserve_generating_software(to.get(), 1));
  to.check(laszip_request_native_extension(to.get(), 1));
  to.check(laszip_set_chunk_size(to.get(), chunk_points));
  to.check(laszip_open_writer(to.get(), laz.c_str(), 1));
  laszip_point* point = nullptr;
  from.check(laszip_get_point_pointer(from.get(), &point));
  const std::uint64_t wide = header->extended_number_of_point_records;
  const std::uint64_t count = header->number_of_point_records != 0 ? header->number_of_point_records : wide;
  for (std::uint64_t i = 0; i < count; ++i) {
    from.check(laszip_read_point(from.get()));
    to.check(laszip_set_point(to.get(), point));
    to.check(laszip_write_point(to.get()));
  }
  to.check(laszip_close_writer(to.get()));
  from.check(laszip_close_reader(from.get()));
}

}  // namespace pcl_bv
