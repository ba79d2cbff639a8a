// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// laz_load FILE.laz: what a program with LASzip's reader does to a file: load the coordinates, and their box.
// laz_load --write FILE.xyz FILE.laz: compresses coordinates, three doubles a point, in millimetres.
#include <laszip/laszip_api.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <limits>
#include <string>
#include <vector>

namespace {

void check(laszip_POINTER laszip, laszip_I32 status) {
  if (status == 0) return;
  laszip_CHAR* reason = nullptr;
  laszip_get_error(laszip, &reason);
  std::fprintf(stderr, "laz_load: %s\n", reason == nullptr ? "no reason" : reason);
  std::exit(1);
}

void load(const char* file) {
  laszip_POINTER reader = nullptr;
  laszip_BOOL compressed = 0;
  laszip_header* header = nullptr;
  check(reader, laszip_create(&reader));
  check(reader, laszip_open_reader(reader, file, &compressed));
  check(reader, laszip_get_header_pointer(reader, &header));
  const std::size_t points = header->number_of_point_records;
  std::vector<std::array<double, 3>> all(points);
  for (std::array<double, 3>& point : all) {
    check(reader, laszip_read_point(reader));
    check(reader, laszip_get_coordinates(reader, point.data()));
  }
  check(reader, laszip_close_reader(reader));
  laszip_destroy(reader);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const std::array<double, 3>& point : all) {
      low = std::min(low, point[axis]);
      high = std::max(high, point[axis]);
    }
    std::printf("%.3f %.3f\n", low, high);
  }
}

void write(const char* xyz, const char* file) {
  std::ifstream input(xyz, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(input), {}};
  laszip_POINTER writer = nullptr;
  laszip_header* header = nullptr;
  laszip_point* point = nullptr;
  check(writer, laszip_create(&writer));
  check(writer, laszip_get_header_pointer(writer, &header));
  header->version_major = 1;
  header->version_minor = 2;
  header->header_size = 227;
  header->offset_to_point_data = 227;
  header->point_data_format = 1;
  header->point_data_record_length = 28;
  header->x_scale_factor = header->y_scale_factor = header->z_scale_factor = 0.001;
  header->number_of_point_records = static_cast<laszip_U32>(bytes.size() / 24);
  check(writer, laszip_open_writer(writer, file, 1));
  check(writer, laszip_get_point_pointer(writer, &point));
  for (std::size_t i = 0; i < header->number_of_point_records; ++i) {
    std::array<double, 3> at;
    std::copy_n(bytes.data() + i * sizeof at, sizeof at, reinterpret_cast<char*>(at.data()));
    point->intensity = static_cast<laszip_U16>(i * 2'654'435'761U >> 24U & 0xFF);
    point->gps_time = 1e-5 * static_cast<double>(i);
    check(writer, laszip_set_coordinates(writer, at.data()));
    check(writer, laszip_write_point(writer));
  }
  check(writer, laszip_close_writer(writer));
  laszip_destroy(writer);
}

}  // namespace

int main(int count, char** arguments) {
  if (count == 4 && std::string(arguments[1]) == "--write") {
    write(arguments[2], arguments[3]);
  } else if (count == 2) {
    load(arguments[1]);
  }
}
