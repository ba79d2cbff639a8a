// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "seeds_of_formats.h"

#include <cstdint>
#include <fstream>
#include <string>
#include <string_view>

#include "las_bytes.h"
#ifdef PCL_BV_LASZIP
#include "copc_files.h"
#include "laz_files.h"
#endif

namespace pcl_bv::test {
namespace {

namespace fs = std::filesystem;
using namespace std::string_literals;

void write(const fs::path& path, std::string_view content) {
  std::ofstream(path, std::ios::binary).write(content.data(), static_cast<std::streamsize>(content.size()));
}

// As fuzz_nested reads them, with a byte that selects the reader, and as fuzz_labels reads them.
void write_labels(const fs::path& folder, const std::string& name, const std::string& content) {
  write(folder / "nested" / ("boxes_" + name), content);
  write(folder / "labels" / name, content.substr(1));
}

void write_boxes(const fs::path& folder) {
  const std::string box = R"({"translation":[1,2,3],"size":[1,2,3],"rotation":[1,0,0,0]})";
  write_labels(folder, "nuscenes", "\3{\"results\":{\"a\":[" + box + "]}}");
  write_labels(
      folder, "openlabel",
      "\3{\"openlabel\":{\"objects\":{\"0\":{\"object_data\":{\"cuboid\":[{\"val\":[1,2,3,0,0,0,1,4,5,6]},"
      "{\"val\":[1,2,3,0,0.1,0.2,4,5,6]}]}}}}}");
  write_labels(folder, "sustech",
               "\3[{\"psr\":{\"position\":{\"x\":1,\"y\":2,\"z\":3},\"scale\":{\"x\":1,\"y\":2,\"z\":3},"
               "\"rotation\":{\"x\":0,\"y\":0,\"z\":0.5}}}]");
  write_labels(folder, "kitti",
               "\1Car 0 0 1.5 0 0 9 9 1.5 1.6 4 -2 1.7 20 0.1\n"
               "0 1 DontCare 0 0 1.5 0 0 9 9 1.5 1.6 4 -2 1.7 20 0.1\n");
}

void write_tile_contents(const fs::path& folder) {
  const auto word = [](std::size_t value) {
    const auto n = static_cast<std::uint32_t>(value);
    return std::string(reinterpret_cast<const char*>(&n), 4);
  };
  const auto table = [&](const std::string& json, const std::string& numbers) {
    return word(1) + word(28 + json.size() + numbers.size()) + word(json.size()) + word(numbers.size()) +
           word(0) + word(0) + json + numbers;
  };
  const std::string numbers(36, '\x3e');
  write(folder / "tiles" / "points",
        "pnts" + table(R"({"POINTS_LENGTH":3,"POSITION":{"byteOffset":0},"RTC_CENTER":[1,2,3]})", numbers));
  write(
      folder / "tiles" / "quantized",
      "pnts" + table(R"({"POINTS_LENGTH":2,"POSITION_QUANTIZED":{"byteOffset":24},"QUANTIZED_VOLUME_OFFSET":)"
                     R"({"byteOffset":0},"QUANTIZED_VOLUME_SCALE":{"byteOffset":12}})",
                     numbers));
  const std::string json =
      R"({"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0,"children":[1],"rotation":[0,0,0,1]},)"
      R"({"mesh":0,"matrix":[1,0,0,0,0,1,0,0,0,0,1,0,5,0,0,1]}],"meshes":[{"primitives":[{"attributes":)"
      R"({"POSITION":0}}]}],"buffers":[{"byteLength":36}],"accessors":[{"bufferView":0,"componentType":5126,)"
      R"("count":3,"type":"VEC3","byteOffset":0}],"bufferViews":[{"buffer":0,"byteLength":36,"byteStride":12}]})";
  const std::string glb = "glTF" + word(2) + word(28 + json.size() + 36) + word(json.size()) + "JSON" + json +
                          word(36) + std::string("BIN", 4) + numbers;
  write(folder / "tiles" / "mesh", glb);
  write(folder / "tiles" / "batched", "b3dm" + table(R"({"BATCH_LENGTH":0,"RTC_CENTER":[1,2,3]})", "") + glb);
}

void write_tables(const fs::path& folder) {
  const std::string dict = "{'descr': '<f4', 'fortran_order': False, 'shape': (3, 3), }";
  const auto npy = [](const std::string& text, const std::string& data) {
    return "\x93NUMPY" + std::string("\1\0", 2) + static_cast<char>(text.size()) + '\0' + text + data;
  };
  const std::string numbers(36, '\x3e'), array = npy(dict, numbers);
  write(folder / "npy" / "numbers", array);
  write(folder / "npy" / "columns", npy("{'shape': (3, 3), 'fortran_order': True, 'descr': '<f4'}", numbers));
  write(folder / "npy" / "records",
        npy("{'descr': [('x', '<f4'), ('y', '<f4'), ('z', '<f4'), ('', '|V4'), ('c', 'u1', (2,4))], "
            "'fortran_order': False, 'shape': (1,1), }",
            numbers));
  const auto word = [](std::size_t value) {
    const auto n = static_cast<std::uint32_t>(value);
    return std::string(reinterpret_cast<const char*>(&n), 4);
  };
  // One stored block of deflate, and a stored array.
  const auto half = [&](std::size_t value) { return word(value).substr(0, 2); };
  const std::string block = '\1' + half(array.size()) + half(~array.size()) + array;
  for (const bool deflated : {false, true}) {
    const std::string& packed = deflated ? block : array;
    const std::string entry = half(0) + half(0) + half(deflated ? 8 : 0) + word(0) + word(0) +
                              word(packed.size()) + word(array.size()) + half(10);
    const std::string local = "PK\3\4" + entry + half(0) + "points.npy" + packed;
    const std::string directory =
        "PK\1\2" + half(0) + entry + half(0) + half(0) + half(0) + half(0) + word(0) + word(0) + "points.npy";
    write(folder / "npz" / (deflated ? "deflated" : "stored"),
          local + directory + "PK\5\6" + word(0) + half(1) + half(1) + word(directory.size()) +
              word(local.size()) + half(0));
  }
  write(folder / "table" / "csv", "x,y,z,class\n1,2,3,car\n4,5.5,nan,4\n");
  write(folder / "table" / "xyz", "# a b\n//X Y Z R\n1 2 3 4\n\n5 6 7 8");
  write(folder / "table" / "pts", "2\n1;2;3;\n4;5;-6e7;\n");
}

// Of each point format, compressed too where there is LASzip.
void write_las(const fs::path& folder) {
  for (int format = 0; format <= 10; ++format) {
    const LasFile las{4, format, kRecords[format] + (format % 3 == 0 ? 2 : 0), 6};
    const fs::path path = folder / "las" / std::to_string(format);
    write(path, las.bytes());
#ifdef PCL_BV_LASZIP
    for (const std::uint32_t chunk : {2U, 50'000U})
      compress_las(path, path.string() + "_by_" + std::to_string(chunk), chunk);
#endif
  }
#ifdef PCL_BV_LASZIP
  const std::vector<CopcNode> nodes{{0, {}, 2}, {1, {0, 0, 0}, 3}, {1, {1, 1, 1}, 1, true}};
  write(folder / "las" / "copc", make_copc(nodes, folder).copc);
  fs::remove(folder / "part.las");
  fs::remove(folder / "part.laz");
#endif
}

void write_meshes(const fs::path& folder) {
  std::string binary(84, '\0');
  binary[80] = 1;  // triangle
  write(folder / "meshes" / "stl_binary", '\0' + binary + std::string(50, '\x3e'));
  write(folder / "meshes" / "stl_text", std::string(1, '\0') +
                                            "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n"
                                            "vertex 1 0 -2e1\nvertex 0 1 0\nendloop\nendfacet\nendsolid\n");
  write(folder / "meshes" / "obj", "\1# a\nv 0 0 0\nv 1 2.5 -3e-1\nv 0 1 0\nf 1 2 3\n");
}

void write_poses(const fs::path& folder) {
  write(folder / "poses" / "kitti",
        "\2"
        "1 0 0 4 0 1 0 5 0 0 1 6\n0 -1 0 1 1 0 0 2 0 0 1 -3e0\n");
  write(folder / "poses" / "tum", "\0# time\n1.5 1 2 3 0 0 0 1\n2.5, 1 2 3 0 0 0.6 0.8\n"s);
}

void write_tileset(const fs::path& folder) {
  const std::string box = R"("boundingVolume":{"box":[0,0,0,1,0,0,0,1,0,0,0,1]})";
  write(folder / "tileset" / "tree",
        R"({"asset":{"version":"1.1"},"geometricError":1,"root":{)" + box +
            R"(,"transform":[1,0,0,0,0,1,0,0,0,0,1,0,5,0,0,1],"content":{"uri":"a%20b.glb?c"},"children":[{)"
            R"("boundingVolume":{"sphere":[0,0,0,1]},"contents":[{"uri":"b.pnts"},{"url":"c.json"}]},{)"
            R"("boundingVolume":{"region":[0.1,0.2,0.3,0.4,0,9]}}]}})");
}

// A database with one leaf page of 512 bytes, which has a topic and two messages. The second message
// continues on an overflow page.
void write_db3(const fs::path& folder) {
  const auto big = [](std::size_t value, int bytes) {
    std::string text;
    for (int shift = 8 * (bytes - 1); shift >= 0; shift -= 8)
      text += static_cast<char>(value >> shift);
    return text;
  };
  const auto row = [](char id, const std::string& types, const std::string& values) {
    const std::string record = static_cast<char>(types.size() + 1) + types + values;
    return static_cast<char>(record.size()) + std::string(1, id) + record;
  };
  const std::string topic = row(1, {0, 17, 17, 17}, "/ab/cd/Ecd"),
                    message = row(1, {0, 1, 1, 20}, "\1\5data");
  // 600 bytes of data: a record of 608 bytes (varint 84 60), of which 608 - 508 are on this page.
  const std::string head = "\x84\x60\2\6\0\1\1\x89\x3c\1\6"s, on_page(100 - (head.size() - 3), 'x');
  const std::string cells = topic + message + head + on_page + big(2, 4);
  std::string page = "SQLite format 3\0"s + big(512, 2) + std::string(82, '\0');
  const std::size_t first = 512 - cells.size();
  page += "\x0d"s + big(0, 2) + big(3, 2) + big(first, 2) + '\0';
  for (const std::size_t at : {first, first + topic.size(), first + topic.size() + message.size()})
    page += big(at, 2);
  page.resize(first, '\0');
  write(folder / "db3" / "three", page + cells + big(0, 4) + std::string(508, 'y'));
}

}  // namespace

void write_format_seeds(const fs::path& folder) {
  write_boxes(folder);
  write_tile_contents(folder);
  write_tables(folder);
  write_las(folder);
  write_meshes(folder);
  write_poses(folder);
  write_tileset(folder);
  write_db3(folder);
}

}  // namespace pcl_bv::test
