// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// seeds FOLDER: small clouds of every layout and encoding, as the fuzzers' first inputs.
#include <filesystem>
#include <fstream>

#include "pcl_bv/io/pcd.h"
#include "sample_clouds.h"
#include "sample_plys.h"

namespace {

namespace fs = std::filesystem;
using namespace pcl_bv;

void write(const fs::path& path, std::string_view content) {
  std::ofstream(path, std::ios::binary).write(content.data(), static_cast<std::streamsize>(content.size()));
}

std::string content_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void write_pcds(const fs::path& folder) {
  for (const Layout& layout : sample_layouts()) {
    const RawCloud cloud = sample_cloud(layout, 3, 2, 21);
    write_pcd(folder / "pcd" / (layout.name + "_ascii"), cloud, PcdEncoding::ascii);
    write_pcd(folder / "pcd" / (layout.name + "_binary"), cloud, PcdEncoding::binary);
    write_pcd(folder / "pcd" / (layout.name + "_compressed"), cloud, PcdEncoding::binary_compressed);
  }
}

// The number of points and the stream of packed bytes, as fuzz_lzf wants them.
void write_streams(const fs::path& folder) {
  const Layout layout{"lzf", {{"x"}, {"y"}, {"z"}, {"a", 'U', 1}}};
  for (const std::size_t points : {1, 6, 200}) {
    RawCloud cloud = sample_cloud(layout, points, 1, 21);
    for (std::size_t i = 0; i < cloud.data.size(); i += 3)
      cloud.data[i] = std::byte{0};  // something to pack
    write_pcd(folder / "whole", cloud, PcdEncoding::binary_compressed);
    const std::string file = content_of(folder / "whole");
    const std::string line = "DATA binary_compressed\n";
    const std::size_t stream = file.find(line) + line.size() + 8;
    write(folder / "lzf" / std::to_string(points), static_cast<char>(points) + file.substr(stream));
  }
  fs::remove(folder / "whole");
}

void write_plys(const fs::path& folder) {
  std::size_t number = 0;
  for (const Layout& layout : ply_layouts()) {
    for (const PlyStyle& style : ply_styles())
      write(folder / "ply" / std::to_string(number++), ply_text(ply_cloud(layout, 3), style));
  }
}

// Small files that claim to be great.
void write_claims(const fs::path& folder) {
  for (const std::string encoding : {"ascii", "binary", "binary_compressed"}) {
    write(folder / "pcd" / ("great_" + encoding),
          "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nWIDTH 50000000\nHEIGHT 1\nDATA " + encoding +
              "\n1 2 3\n4 5 6\n");
  }
  for (const std::string format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
    write(folder / "ply" / ("great_" + format),
          "ply\nformat " + format +
              " 1.0\nelement vertex 50000000\nproperty float x\nproperty float y\nproperty float "
              "z\nend_header\n1 2 3\n4 5 6\n");
  }
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 2) return 2;
  const fs::path folder = arguments[1];
  for (const char* name : {"pcd", "ply", "lzf", "bin", "number", "text"})
    fs::create_directories(folder / name);
  write_pcds(folder);
  write_streams(folder);
  write_plys(folder);
  write_claims(folder);
  write(folder / "bin" / "sweep", std::string(64, '\x3f'));
  write(folder / "number" / "some", "-12.3456789e-01");
  write(folder / "text" / "rows",
        "\x03\x05"
        "1 2\n\n 3.5 -4e1\r\nnan 6\n");
}
