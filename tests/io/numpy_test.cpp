// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// What NumPy writes is compared in tests/peers/write_numpy.py.

#include "pcl_bv/io/numpy.h"

#include <gmock/gmock.h>
#include <libdeflate.h>

#include "files.h"
#include "pcl_bv/io/cloud_file.h"
#include "pcl_bv/io/read_cloud.h"

namespace pcl_bv::detail {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

template <typename T>
std::string little(T value, std::size_t bytes = sizeof(T)) {
  return {reinterpret_cast<const char*>(&value), bytes};
}

std::string npy(const std::string& dict, const std::string& data) {
  return "\x93NUMPY" + std::string("\1\0", 2) + little(static_cast<std::uint16_t>(dict.size())) + dict + data;
}

std::string floats(const std::vector<float>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * 4};
}

std::string points(const std::string& shape, const std::string& more = "", const char* order = "False") {
  return "{'descr': '<f4', 'fortran_order': " + std::string(order) + ", 'shape': " + shape + ", }" + more;
}

struct Zipped {
  std::string name, array;
  bool deflate = false;
};

std::string npz(const std::vector<Zipped>& entries) {
  std::string file, directory;
  for (const auto& [name, array, deflate] : entries) {
    std::string packed = array;
    if (deflate) {
      packed.resize(array.size() + 100);
      libdeflate_compressor* const compressor = libdeflate_alloc_compressor(6);
      packed.resize(
          libdeflate_deflate_compress(compressor, array.data(), array.size(), packed.data(), packed.size()));
      libdeflate_free_compressor(compressor);
    }
    const auto sizes =
        little(static_cast<std::uint32_t>(packed.size())) + little(static_cast<std::uint32_t>(array.size()));
    const auto method = little(static_cast<std::uint16_t>(deflate ? 8 : 0));
    const auto length = little(static_cast<std::uint16_t>(name.size()));
    const std::string none(2, '\0');
    const auto crc = little(libdeflate_crc32(0, array.data(), array.size()));
    directory += "PK\1\2" + none + none + none + method + none + none + crc + sizes + length +
                 std::string(12, '\0') + little(static_cast<std::uint32_t>(file.size())) + name;
    file += "PK\3\4" + none + none + method + std::string(8, '\0') + sizes + length + none + name + packed;
  }
  const auto count = little(static_cast<std::uint16_t>(entries.size()));
  return file + directory + "PK\5\6" + std::string(4, '\0') + count + count +
         little(static_cast<std::uint32_t>(directory.size())) +
         little(static_cast<std::uint32_t>(file.size())) + std::string(2, '\0');
}

class Numpy : public FileTest {
 protected:
  RawCloud read(const std::string& content, const char* extension = ".npy") const {
    write_text(file(std::string("a") + extension), content);
    return read_cloud(file(std::string("a") + extension));
  }
  std::string reason(const std::string& content, const char* extension = ".npy") const {
    return reason_for_content(content, extension);
  }
};

TEST_F(Numpy, ArraysAreReadInBothOrders) {
  const std::string data = floats({1, 2, 3, 4, 5, 6});
  EXPECT_THAT(coordinates_of(read(npy(points("(2, 3)"), data))), ElementsAre(1, 2, 3, 4, 5, 6));
  EXPECT_THAT(coordinates_of(read(npy(points("(2, 3)", "\n", "True"), data))), ElementsAre(1, 3, 5, 2, 4, 6));
  const RawCloud organized = read(npy(points("(1, 2, 3)"), data));
  EXPECT_EQ(organized.height, 1U);
  EXPECT_EQ(organized.width, 2U);
  EXPECT_EQ(read(npy(points("(0, 3)"), "")).size(), 0U);
  const RawCloud four = read(npy(points("(1, 4)"), data.substr(0, 16)));
  EXPECT_EQ(four.fields[3].name, "intensity");
}

TEST_F(Numpy, RecordsHaveAllFields) {
  const std::string dict =
      "{'descr': [('n', '|u1'), ('', '|V3'), ('x', '<f4'), ('y', '<f4'), ('z', '<f4'), ('rgb', '|u1', "
      "(3,))], "
      "'fortran_order': False, 'shape': (1,), }";
  const RawCloud cloud = read(npy(dict, std::string("\7\0\0\0", 4) + floats({1, 2, 3}) + "abc"));
  EXPECT_EQ(cloud.point_step, 19U);
  EXPECT_EQ(cloud.fields.back().count, 3U);
  EXPECT_THAT(coordinates_of(cloud), ElementsAre(1, 2, 3));
}

TEST_F(Numpy, SizesMayBeLongNumbersOfPython2) {
  const std::string data = floats({1, 2, 3, 4, 5, 6});
  const std::string records =
      "{'descr': [('x', '<f4'), ('yz', '<f4', (1L,)), ('y', '<f4'), ('z', '<f4')], 'fortran_order': False, "
      "'shape': (1L,), }";
  const std::string array = npy(points("(2L, 3L)"), data);
  EXPECT_THAT(coordinates_of(read(array)), ElementsAre(1, 2, 3, 4, 5, 6));
  EXPECT_THAT(coordinates_of(read(npy(points("(1L, 2L, 3L)"), data))), ElementsAre(1, 2, 3, 4, 5, 6));
  EXPECT_THAT(coordinates_of(read(npy(points("(2L, 3L)", "", "True"), data))), ElementsAre(1, 3, 5, 2, 4, 6));
  EXPECT_THAT(coordinates_of(read(npy(records, floats({1, 9, 2, 3})))), ElementsAre(1, 2, 3));
  std::string version2 = array;
  version2[6] = 2;
  version2.insert(10, 2, '\0');
  EXPECT_THAT(coordinates_of(read(version2)), ElementsAre(1, 2, 3, 4, 5, 6));
  for (const bool deflate : {false, true})
    EXPECT_THAT(coordinates_of(read(npz({{"points.npy", array, deflate}}), ".npz")),
                ElementsAre(1, 2, 3, 4, 5, 6));
  for (const char* shape : {"(2LL, 3)", "(L, 3)", "(-2L, 3L)", "(2.0L, 3)"})
    EXPECT_THAT(reason(npy(points(shape), data)), HasSubstr("is no size")) << shape;
  EXPECT_THAT(reason(npy(points("(2, 3)", "", "1"), data)), HasSubstr("not True or False"));
}

TEST_F(Numpy, LargeArraysAreReadInChunks) {
  std::vector<float> values(3 * 100000);
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] = static_cast<float>(i);
  write_text(file("a.npy"), npy(points("(100000, 3)"), floats(values)));
  const auto opened = CloudFile::open(file("a.npy"));
  ASSERT_TRUE(opened);
  EXPECT_EQ(opened->header().size(), 100000U);
  EXPECT_TRUE(read_cloud_header(file("a.npy")).random_access);
  write_text(file("a.npy"), npy(points("(100000, 3)", "", "True"), floats(values)));
  EXPECT_FALSE(CloudFile::open(file("a.npy")));
}

TEST_F(Numpy, DamagedAndOtherArraysAreRefusedByName) {
  const std::string good = npy(points("(2, 3)"), floats({1, 2, 3, 4, 5, 6}));
  for (std::size_t size = 1; size < good.size(); ++size)
    EXPECT_NE(reason(good.substr(0, size)), "") << size;
  EXPECT_THAT(reason("hello, world"), HasSubstr("is no .npy array"));
  EXPECT_THAT(reason(npy(points("(2, 3)"), floats({1}))), HasSubstr("truncated: 2 points"));
  EXPECT_THAT(reason(npy(points("(2, 3)", "", "True"), floats({1}))), HasSubstr("truncated: 2 points"));
  EXPECT_THAT(reason(npy(points("(2, 2)"), floats({1, 2, 3, 4}))), HasSubstr("2 columns, not 3 or more"));
  EXPECT_THAT(reason(npy(points("(6,)"), "")), HasSubstr("one column"));
  EXPECT_THAT(reason(npy(points("(1, 1, 1, 3)"), "")), HasSubstr("number of dimensions"));
  EXPECT_THAT(reason(npy(points("(18446744073709551615, 3)"), "")), HasSubstr("more points than a file"));
  EXPECT_THAT(reason(npy(points("(-1, 3)"), "")), HasSubstr("'-1' is no size"));
  EXPECT_THAT(reason(npy(points("(1, 99999)"), "")), HasSubstr("more than 4096 columns"));
  const auto of_type = [](const std::string& type) {
    return npy("{'descr': " + type + ", 'fortran_order': False, 'shape': (1, 3), }", "");
  };
  EXPECT_THAT(reason(of_type("'>f4'")), HasSubstr("big-endian"));
  for (const char* type : {"'|O'", "'<c8'", "'<f2'", "'|b1'", "'<U4'"})
    EXPECT_THAT(reason(of_type(type)), HasSubstr("are not float32, float64 or integers")) << type;
  EXPECT_THAT(reason(of_type("[('x', '<f4')]")), HasSubstr("no field y, z"));
  EXPECT_THAT(reason(npy("{'descr': [('x', '<f4')], 'fortran_order': False, 'shape': (1,), }", floats({1}))),
              HasSubstr("y"));
  EXPECT_THAT(reason(npy("{'shape': (1, 3)", "")), HasSubstr("header: "));
  EXPECT_THAT(reason(npy("{'other': 3}", "")), HasSubstr("unknown key 'other'"));
}

TEST_F(Numpy, ArchivesHaveStoredAndDeflatedArrays) {
  const std::string array = npy(points("(2, 3)"), floats({1, 2, 3, 4, 5, 6}));
  for (const bool deflate : {false, true}) {
    const RawCloud cloud =
        read(npz({{"labels.npy", "x"}, {"points.npy", array, deflate}, {"readme", "x"}}), ".npz");
    EXPECT_THAT(coordinates_of(cloud), ElementsAre(1, 2, 3, 4, 5, 6));
    EXPECT_THAT(cloud.note, HasSubstr("of 2 arrays, only 'points' is read"));
  }
  EXPECT_EQ(read(npz({{"any.npy", array}}), ".npz").note, "");
  EXPECT_EQ(read_cloud_header(file("a.npz")).cloud.size(), 2U);
}

TEST_F(Numpy, AChangedByteOfAnArchiveIsFoundByItsCheckSum) {
  const std::string array = npy(points("(2, 3)"), floats({1, 2, 3, 4, 5, 6}));
  for (const bool deflate : {false, true}) {
    const std::string good = npz({{"points.npy", array, deflate}});
    std::size_t found = 0;
    for (std::size_t i = good.find("PK\1\2") - 20; i < good.find("PK\1\2"); ++i) {
      std::string changed = good;
      changed[i] = static_cast<char>(changed[i] ^ 1);
      const std::string text = reason(changed, ".npz");
      EXPECT_THAT(text, HasSubstr("array 'points' is damaged")) << i;
      found += text.find("its check sum (CRC-32) differs") != std::string::npos;
    }
    EXPECT_GT(found, 0U);
  }
}

TEST_F(Numpy, AnArrayThatLooksTransposedIsReadWithANote) {
  const std::vector<float> values(3 * 100, 1.0f);
  const RawCloud cloud = read(npy(points("(3, 100)"), floats(values)));
  EXPECT_EQ(cloud.size(), 3U);
  EXPECT_THAT(cloud.note, HasSubstr("3 points with 100 columns: if the array has a column for each point"));
  EXPECT_NE(read(npy(points("(8, 17)"), floats(values).substr(0, 4 * 136))).note, "");
  EXPECT_EQ(read(npy(points("(3, 16)"), floats(values).substr(0, 4 * 48))).note, "");
  EXPECT_EQ(read(npy(points("(2, 100)"), floats(values).substr(0, 4 * 200))).note, "");
}

TEST_F(Numpy, DamagedArchivesAreRefusedByName) {
  const std::string array = npy(points("(2, 3)"), floats({1, 2, 3, 4, 5, 6}));
  const std::string good = npz({{"points.npy", array, true}});
  for (std::size_t size = 1; size < good.size(); ++size)
    EXPECT_NE(reason(good.substr(0, size), ".npz"), "") << size;
  EXPECT_THAT(reason("no zip", ".npz"), HasSubstr("is no .npz file"));
  EXPECT_THAT(reason(npz({}), ".npz"), HasSubstr("has no array"));
  EXPECT_THAT(reason(npz({{"a.npy", array}, {"b.npy", array}}), ".npz"), HasSubstr("'a, b'"));
  std::string bomb = good;  // sizes of the directory: 4 GB from some bytes
  bomb.replace(good.find("PK\1\2") + 24, 4, std::string(3, '\xFF') + '\x7F');
  EXPECT_THAT(reason(bomb, ".npz"), HasSubstr("its size cannot be right"));
  std::string changed = good;
  changed[45] = static_cast<char>(changed[45] ^ 0x55);
  EXPECT_THAT(reason(changed, ".npz"), HasSubstr("'points'"));
  std::string encrypted = good;
  encrypted[good.find("PK\1\2") + 8] = 1;
  EXPECT_THAT(reason(encrypted, ".npz"), HasSubstr("encrypted"));
  std::string other = good;
  other[good.find("PK\1\2") + 10] = 12;
  EXPECT_THAT(reason(other, ".npz"), HasSubstr("compression 12"));
}

}  // namespace
}  // namespace pcl_bv::detail
