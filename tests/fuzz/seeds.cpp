// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// seeds FOLDER: small clouds of every layout and encoding, as the fuzzers' first inputs.
#include <libdeflate.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "../recording/made_hesai.h"
#include "../recording/made_livox.h"
#include "../recording/made_ouster.h"
#include "../recording/made_packets.h"
#include "codecs.h"
#include "message_bytes.h"
#include "object_seeds.h"
#include "pcl_bv/io/read_cloud.h"
#include "pcl_bv/messages/serialize.h"
#include "pcl_bv/recording/mcap_writer.h"
#include "sample_clouds.h"
#include "sample_plys.h"
#include "seeds_of_formats.h"

namespace {

namespace fs = std::filesystem;
using namespace pcl_bv;
using namespace pcl_bv::detail;

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

void write_requests(const fs::path& folder) {
  write(folder / "live" / "subscribe", R"({"op":"subscribe","subscriptions":[{"id":1,"channelId":2}]})");
  write(folder / "live" / "set",
        R"({"op":"setParameters","id":"a","parameters":[{"name":"b","value":[0.5,"c",true]}]})");
  write(folder / "live" / "get", R"({"op":"getParameters","id":"a","parameterNames":["b"]})");
  write(folder / "live" / "address", "[::1]:8765");
}

// As fuzz_nested reads them: the reader, and a text with bytes that repeat what is before them.
void write_nested(const fs::path& folder) {
  const std::string deep_list = "[\x11\x01", deep_map = "{\"a\":\x10\x05";
  const std::string set = R"({"op":"setParameters","parameters":[{"name":"x","value":)";
  const std::string ball = R"({"shape":"sphere","center":[0,0,0],"radius":1},)";
  write(folder / "nested" / "request", '\0' + set + deep_list);
  write(folder / "nested" / "request_map", '\0' + set + deep_map);
  write(folder / "nested" / "change",
        std::string(1, '\0') + R"({"cluster.tolerance":0.5,"volumes":["aabb"]})");
  write(folder / "nested" / "volumes", "\3[" + ball.substr(0, ball.size() - 1) + ']');
  write(folder / "nested" / "volumes_many", "\3[" + ball + "\x0c/" + ball.substr(0, ball.size() - 1) + ']');
  write(folder / "nested" / "volumes_deep", "\3{\"volumes\":" + deep_list + "]\x11\x01}");
  write(folder / "nested" / "yaml",
        "\2cluster: {tolerance: 0.5}\nvolumes: [aabb]\nfilter: {regions: [{file: a}]}\n");
  for (const char* open :
       {"[\x11\x01", "{a: \x10\x04", "- \x11\x02", "? \x11\x02", "&a [*a,\x10\x04", "a: \x10\x03"})
    write(folder / "nested" / ("yaml" + std::to_string(static_cast<int>(*open))),
          std::string("\2a: ") + open);
}

// A heading and results of few points, and of many, as fuzz_partial wants them.
void write_partials(const fs::path& folder) {
  const auto bytes_of = [](const auto&... values) {
    std::string bytes;
    (bytes.append(reinterpret_cast<const char*>(&values), sizeof values), ...);
    return bytes;
  };
  const auto results = [&](std::uint64_t used, const std::string& points) {
    std::string ends(26 * 32, '\0');
    return "PCLBVPRT" + bytes_of(std::uint32_t{1}, std::uint32_t{4}, used, std::uint64_t{0}) + ends + points;
  };
  const auto heading = [](std::size_t points) {
    const std::string n = std::to_string(points);
    return R"({"inputs":1,"inputs_hash":7,"cloud_points":)" + n +
           R"(,"origin":[1,2,3],"filter":"0:inf","range":0,"inside":0,"shares":[[0,)" + n + "]]}\n";
  };
  const std::string point = bytes_of(std::uint64_t{0}, 1.0, 2.0, 3.0);
  const std::uint64_t none = 0, one = 1, five = 5;
  write(folder / "partial" / "few", heading(1) + results(0, bytes_of(one) + point + bytes_of(none, none)));
  const std::string node =
      bytes_of(none, five - 1, std::uint64_t{4096}, 1.0, 2.0, 3.0, 0) + std::string(72, '\0');
  write(folder / "partial" / "many",
        heading(5000) + results(5000, bytes_of(none, one) + point + bytes_of(one) + node));
}

// As fuzz_transforms wants them: kind, length, message.
void write_transforms(const fs::path& folder) {
  msg::TransformStamped step;
  step.header.frame_id = "base";
  step.child_frame_id = "front";
  std::vector<std::byte> cdr, ros1;
  write_cdr(msg::TFMessage{{step}}, cdr);
  step.header = {{0, 100'000'000}, "odom"};
  step.child_frame_id = "base";
  write_ros1(msg::TFMessage{{step}}, ros1);
  std::string all;
  for (const auto& [kind, bytes] : {std::pair(4, &cdr), {1, &ros1}}) {
    all += static_cast<char>(kind);
    all += static_cast<char>(bytes->size());
    all.append(reinterpret_cast<const char*>(bytes->data()), bytes->size());
  }
  write(folder / "transforms" / "two", all);
  write(
      folder / "urdf" / "robot",
      "<robot><link name='a'><collision><origin xyz='1 2 3' rpy='0 0 1'/><geometry><box size='1 2 3'/>"
      "</geometry></collision></link><link name='b'><collision><geometry><mesh filename='m.stl'/>"
      "</geometry></collision></link><joint name='j' type='fixed'><parent link='a'/><child link='b'/></joint>"
      "</robot>");
}

std::vector<std::byte> zstd_of(const std::string& raw) {
  std::vector<std::byte> packed;
  Compressor().compress(Compression::zstd, reinterpret_cast<const std::byte*>(raw.data()), raw.size(),
                        packed);
  return packed;
}

std::vector<std::byte> deflated(const std::string& raw, bool gzip) {
  libdeflate_compressor* const compressor = libdeflate_alloc_compressor(6);
  std::vector<std::byte> packed(raw.size() + 100);
  const auto compress = gzip ? libdeflate_gzip_compress : libdeflate_zlib_compress;
  packed.resize(compress(compressor, raw.data(), raw.size(), packed.data(), packed.size()));
  libdeflate_free_compressor(compressor);
  return packed;
}

// A cloud as a message of both encodings, recordings of it, and a packet.
void write_recordings(const fs::path& folder) {
  const std::string points(48, '\x3f');
  msg::PointCloud2 cloud;
  cloud.width = 3;
  cloud.point_step = 16;
  cloud.row_step = 48;
  cloud.fields = {{"x", 0, 7, 1}, {"y", 4, 7, 1}, {"z", 8, 7, 1}, {"ring", 12, 4, 1}};
  cloud.data = {reinterpret_cast<const std::byte*>(points.data()), points.size()};
  std::vector<std::byte> bytes, ros1;
  write_cdr(cloud, bytes);
  write_ros1(cloud, ros1);
  const auto text = [](const std::vector<std::byte>& from) {
    return std::string(reinterpret_cast<const char*>(from.data()), from.size());
  };
  write(folder / "cloud" / "cdr", text(bytes));
  write(folder / "cloud" / "ros1", text(ros1));
  using test::Encoding;
  write(folder / "cloud" / "livox_cdr", text(test::livox_message(Encoding::cdr, 3)));
  write(folder / "cloud" / "livox_big", text(test::livox_message(Encoding::big_endian_cdr, 3)));
  write(folder / "cloud" / "livox_ros1", text(test::livox_message(Encoding::ros1, 3)));
  test::CompressedCloud packed{1, 3, 16, 48, "zstd"};
  write(folder / "compressed" / "zstd",
        text(test::compressed_message(Encoding::cdr, packed, zstd_of(points))));
  packed.format = "zlib";
  for (const char* name : {"zlib", "gzip"})
    write(folder / "compressed" / name,
          text(test::compressed_message(Encoding::cdr, packed, deflated(points, *name == 'g'))));
  for (const Compression compression : {Compression::none, Compression::lz4, Compression::zstd}) {
    McapWriter writer(folder / "mcap" / std::to_string(static_cast<int>(compression)), {compression, 200});
    writer.add_topic({"/points", msg::PointCloud2::ros_type, "uint8 x\n", {}});
    for (int i = 0; i < 3; ++i)
      writer.write(0, 10 * i, 10 * i, bytes.data(), bytes.size());
    writer.attach("a", "text/plain", "b", 5);
    writer.close();
  }
  const auto field = [](const std::string& name, const std::string& value) {
    const std::string all = name + '=' + value;
    return std::string(1, static_cast<char>(all.size())) + std::string(3, '\0') + all;
  };
  const auto number = [](std::size_t value, std::size_t size) {
    std::string all;
    for (std::size_t i = 0; i < size; ++i)
      all += static_cast<char>(value >> (8 * i));
    return all;
  };
  const auto record = [&](const std::string& header, const std::string& data) {
    return number(header.size(), 4) + header + number(data.size(), 4) + data;
  };
  const std::string inside =
      record(field("op", "\x07") + field("conn", number(0, 4)) + field("topic", "/p"), field("type", "a/B")) +
      record(field("op", "\x02") + field("conn", number(0, 4)) + field("time", number(7, 8)), "data");
  write(
      folder / "bag" / "none",
      "#ROSBAG V2.0\n" +
          record(field("op", "\x03") + field("index_pos", number(0, 8)) + field("chunk_count", number(1, 4)),
                 "") +
          record(field("op", "\x05") + field("compression", "none") + field("size", number(inside.size(), 4)),
                 inside));
  write(folder / "packets" / "vlp16", pcap({packet(9000, 40, 0x37, 0x22)}));
  write(folder / "packets" / "hdl32", pcap({packet(35'900, 40, 0x39, 0x21, 3)}, 113, true));
  for (const std::size_t channels : {16U, 32U}) {
    const MadeHesai sensor{channels, channels == 32};
    write(folder / "packets" / ("hesai" + std::to_string(channels)),
          pcap({hesai_bytes(sensor, random_hesai(sensor, 35'950, 0, 1))}));
  }
  for (const unsigned type : {1U, 2U, 3U}) {
    write(folder / "packets" / ("livox" + std::to_string(type)),
          pcap({livox_packet(random_livox(type, 99'900'000, 1, 5)),
                livox_packet(random_livox(type, 100'000'000, 2, 5))}));
  }
}

// Metadata, a zero byte and a capture, as fuzz_ouster wants them.
void write_ouster(const fs::path& folder) {
  for (const char* profile :
       {"LEGACY", "RNG19_RFL8_SIG16_NIR16", "RNG19_RFL8_SIG16_NIR16_DUAL", "RNG15_RFL8_NIR8"}) {
    MadeOuster sensor = made_ouster(profile, 2, 8);
    sensor.columns_per_packet = 4;
    std::vector<std::string> fragments;
    for (const std::string& packet : packets_of_frame(sensor, 1, random_columns(sensor, 1'000'000, 3))) {
      for (const std::string& fragment :
           fragments_of(udp(packet), static_cast<unsigned>(fragments.size()), 128))
        fragments.push_back(fragment);
    }
    write(folder / "ouster" / (std::string(profile) + "_flat"),
          flat_metadata(sensor) + '\0' + pcap_of_ip(fragments));
    write(folder / "ouster" / (std::string(profile) + "_nested"),
          nested_metadata(sensor) + '\0' + pcap_of_ip(fragments));
  }
}

// An angle correction file, a zero byte and a capture, as fuzz_hesai wants them.
void write_hesai(const fs::path& folder) {
  for (const std::size_t channels : {16U, 40U, 64U}) {
    for (const bool dual : {false, true}) {
      const MadeHesai sensor{channels, dual, dual, 360};
      std::vector<std::string> packets;
      for (const MadeHesaiPacket& packet : hesai_packets(sensor, 3, 35'900, 1))
        packets.push_back(hesai_bytes(sensor, packet));
      write(folder / "hesai" / (std::to_string(channels) + (dual ? "_dual" : "")),
            hesai_correction(channels) + '\0' + pcap(packets));
    }
  }
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 2) return 2;
  const fs::path folder = arguments[1];
  for (const char* name : {"pcd",     "ply",    "lzf",   "bin",     "number", "text",       "mcap", "bag",
                           "packets", "ouster", "hesai", "partial", "cloud",  "compressed", "live", "nested",
                           "tiles",   "labels", "npy",   "npz",     "table",  "transforms", "urdf", "objects",
                           "las",     "ground", "db3",   "meshes",  "poses",  "tileset"})
    fs::create_directories(folder / name);
  write_pcds(folder);
  write_streams(folder);
  write_plys(folder);
  write_claims(folder);
  write_requests(folder);
  write_nested(folder);
  pcl_bv::test::write_format_seeds(folder);
  write_recordings(folder);
  write_ouster(folder);
  write_hesai(folder);
  write_partials(folder);
  write_objects(folder);
  write_transforms(folder);
  write(folder / "bin" / "sweep", std::string(64, '\x3f'));
  write(folder / "number" / "some", "-12.3456789e-01");
  write(folder / "text" / "rows",
        "\x03\x05"
        "1 2\n\n 3.5 -4e1\r\nnan 6\n");
}
