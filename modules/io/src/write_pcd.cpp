// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include <stdexcept>

#include "pcd_format.h"
#include "pcl_bv/io/atomic_file.h"
#include "text.h"

namespace pcl_bv {
using namespace detail;
namespace {

void require(bool holds, const std::string& rule) {
  if (!holds) throw std::invalid_argument("cloud to write: " + rule);
}

void check_cloud(const RawCloud& cloud) {
  require(!cloud.fields.empty(), "must have fields");
  std::size_t offset = 0;
  for (const PointField& field : cloud.fields) {
    const std::string name = "field " + in_quotes(field.name) + ": ";
    require(is_word(field.name), name + "its name must be a word");
    require(field.type == 'F' || field.type == 'I' || field.type == 'U', name + "type must be F, I or U");
    require(field.size == 1 || field.size == 2 || field.size == 4 || field.size == 8,
            name + "size " + std::to_string(field.size) + " must be 1, 2, 4 or 8");
    require(field.count > 0, name + "count must be positive");
    require(field.offset == offset,
            name + "offset " + std::to_string(field.offset) + " must be " + std::to_string(offset));
    offset += field.bytes();
  }
  require(cloud.point_step == offset, "point_step " + std::to_string(cloud.point_step) + " must be " +
                                          std::to_string(offset) + ", the sum of the fields");
  require(
      cloud.data.size() == cloud.size() * offset,
      std::to_string(cloud.data.size()) + " bytes of data, must be " + std::to_string(cloud.size() * offset));
}

// Returns the header. Leaves out padding fields in binary_compressed files.
std::string format_header(const RawCloud& cloud, PcdEncoding encoding) {
  std::string names, sizes, types, counts, viewpoint;
  for (const PointField& field : cloud.fields) {
    if (encoding == PcdEncoding::binary_compressed && field.name == "_") continue;
    names += ' ' + field.name;
    sizes += ' ' + std::to_string(field.size);
    types += {' ', field.type};
    counts += ' ' + std::to_string(field.count);
  }
  for (const double value : cloud.viewpoint)
    append_number(viewpoint += ' ', value);
  return "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS" + names + "\nSIZE" + sizes +
         "\nTYPE" + types + "\nCOUNT" + counts + "\nWIDTH " + std::to_string(cloud.width) + "\nHEIGHT " +
         std::to_string(cloud.height) + "\nVIEWPOINT" + viewpoint + "\nPOINTS " +
         std::to_string(cloud.size()) + "\nDATA " +
         pcd_encoding_names.at(static_cast<std::size_t>(encoding)) + "\n";
}

}  // namespace

void write_pcd(const std::filesystem::path& path, const RawCloud& cloud, PcdEncoding encoding) {
  check_cloud(cloud);
  const std::string header = format_header(cloud, encoding);
  require(header.size() <= kMaxHeaderBytes,
          "its fields need a header of more than " + std::to_string(kMaxHeaderBytes) + " bytes");
  if (encoding == PcdEncoding::binary) {
    const char* data = reinterpret_cast<const char*>(cloud.data.data());
    return write_file_atomically(path, {header, {data, cloud.data.size()}});
  }
  const std::string body =
      encoding == PcdEncoding::ascii ? format_ascii_points(cloud) : compress_points(cloud);
  write_file_atomically(path, {header, body});
}

}  // namespace pcl_bv
