// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Labels of the inputs of shares: --merge --cluster --labels.

#include <gmock/gmock.h>

#include <boost/crc.hpp>
#include <cstdint>
#include <cstring>
#include <fstream>

#include "tiled_objects.h"

namespace pcl_bv::test {
namespace {

using testing::HasSubstr;

class PcdBvShareLabels : public TiledObjects {
 protected:
  // Expects that the labels of shares of the inputs are those of one process, and so are the objects.
  void expect_labels_of_one_process(const std::string& name, const std::vector<std::string>& options,
                                    const std::vector<std::string>& reading,
                                    const std::vector<std::string>& inputs, std::size_t files) const {
    std::vector<std::string> together = options, share = options;
    together.insert(together.end(), {"--together", "--format", "jsonl", "--labels", at(name + "_expected")});
    for (auto* list : {&together, &share})
      list->insert(list->end(), reading.begin(), reading.end());
    together.insert(together.end(), inputs.begin(), inputs.end());
    const Result expected = run(together);
    EXPECT_EQ(expected.status, 0) << expected.err;
    for (const std::size_t count : {1UL, 2UL, 5UL}) {
      SCOPED_TRACE(count);
      const std::string parts = shares(name + "_parts" + std::to_string(count), count, share, inputs);
      for (const char* const memory : {"1", "600"}) {
        const std::string labels = at(name + "_" + std::to_string(count) + "_" + memory);
        const Result merged =
            objects(options, {"--merge", "--memory", memory, "--labels", labels, "--threads", "3"}, parts);
        EXPECT_EQ(merged.status, 0) << merged.err;
        EXPECT_TRUE(merged.out == expected.out);
        expect_same_files(labels, at(name + "_expected"), files);
      }
    }
  }

  // Renames the list of inputs in a file of one share, as if an older version had written it.
  static void remove_inputs(const std::string& path) {
    std::string content = read_file(path);
    std::uint64_t sizes[2];
    constexpr std::size_t preamble = 72, sum_bytes = 4;
    std::memcpy(sizes, content.data() + 24, sizeof sizes);
    content.replace(content.find("\"inputs\":["), 8, "\"others\"");
    boost::crc_32_type sum;
    sum.process_bytes(content.data(), preamble);
    const std::size_t index = preamble + sizes[0] + sizes[1];
    sum.process_bytes(content.data() + index, content.size() - index - sum_bytes);
    const std::uint32_t value = sum.checksum();
    std::memcpy(content.data() + content.size() - sum_bytes, &value, sum_bytes);
    std::ofstream(path, std::ios::binary) << content;
  }
};

TEST_F(PcdBvShareLabels, AreThoseOfOneProcessForAnySharesAndMemory) {
  std::vector<std::vector<std::string>> options = cluster_options();
  options.push_back({"--cluster", "0.001", "--min-points", "3"});
  options.push_back({"--cluster", "100"});
  for (unsigned seed = 1; seed <= options.size(); ++seed) {
    SCOPED_TRACE(seed);
    const std::size_t count = 3 + seed;
    const std::string folder = tiles("tiles" + std::to_string(seed), yard(seed), count);
    std::vector<std::string> reading;
    if (seed % 3 == 1) reading = {"--range", "3:25"};
    if (seed % 3 == 2) reading = {"--origin", "10.1,-20.3,0.7"};
    expect_labels_of_one_process("of" + std::to_string(seed), options[seed - 1], reading, {folder}, count);
  }
}

TEST_F(PcdBvShareLabels, OfOtherInputsAreThoseOfOneProcess) {
  const Points points = yard(7);
  std::string bin, rows;
  for (std::size_t i = 0; i < 5000; ++i) {
    const float row[5] = {points[i][0], points[i][1], points[i][2], 1, 2};
    bin.append(reinterpret_cast<const char*>(row), sizeof row);
    rows += "7 " + std::to_string(i % 50) + " " + std::to_string(i / 50) + " 1\n";
  }
  expect_labels_of_one_process("bin", {"--cluster", "0.5"}, {"--bin-fields", "5"},
                               {file("a.bin", bin), binary("b.pcd", points)}, 2);
  expect_labels_of_one_process("txt", {"--cluster", "1.2"}, {"--columns", "_,y,x,z"}, {file("a.txt", rows)},
                               1);
  expect_labels_of_one_process("synth", {"--cluster", "0.5"}, {},
                               {"synth:street:6400:1", "synth:gauss:1000:2", binary("c.pcd", {})}, 3);
  expect_labels_of_one_process("none", {"--cluster", "0.5"}, {}, {binary("d.pcd", {}), binary("e.pcd", {})},
                               2);
}

TEST_F(PcdBvShareLabels, OfInputsWithAnyBytesInTheirNamesAreThoseOfOneProcess) {
  std::string all = "t";
  for (int byte = 1; byte < 256; ++byte)
    if (byte != '/' && byte != '#') all += static_cast<char>(byte);
  all.resize(240);
  expect_labels_of_one_process("names", {"--cluster", "0.4"}, {},
                               {binary(all + ".pcd", yard(1)), binary("\xe9t\xc3\xa9.pcd", yard(2))}, 2);
}

TEST_F(PcdBvShareLabels, OfIndependentInputsAreThoseOfOneCloud) {
  const Points points = yard(2);
  const auto half = points.begin() + static_cast<std::ptrdiff_t>(points.size() / 2);
  const std::string a = binary("9.pcd", Points(points.begin(), half)),
                    b = binary("10.pcd", Points(half, points.end()));
  const std::vector<std::string> options = {"--cluster", "0.4"};
  const std::string parts = shares("parts", 1, options, {b});
  std::filesystem::rename(shares("more", 1, options, {a}) + "/0", parts + "/1");
  EXPECT_EQ(run({"--merge", "--partial", at("all"), "--cluster", "0.4", parts}).status, 0);
  EXPECT_EQ(objects(options, {"--together", "--labels", at("expected"), a}, b).status, 0);
  for (const std::string& input : {parts, at("all")}) {
    const Result merged = objects(options, {"--merge", "--labels", at("labels")}, input);
    EXPECT_EQ(merged.status, 0) << merged.err;
    expect_same_files(at("labels"), at("expected"), 2);
    std::filesystem::remove_all(at("labels"));
  }
}

TEST_F(PcdBvShareLabels, NameInputsThatAreMissingOrHaveChangedAndWriteTheOthers) {
  const Points points = yard(3);
  const std::string folder = tiles("tiles", points, 6);
  const std::vector<std::string> options = {"--cluster", "0.4"};
  const std::string parts = shares("parts", 3, options, {folder});
  EXPECT_EQ(objects(options, {"--together", "--labels", at("expected")}, folder).status, 0);
  std::filesystem::remove(path_of(folder, 0));
  Points changed;
  const RawCloud cloud = read_cloud(path_of(folder, 3));
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const auto [x, y, z] = load_point(cloud.xyz(), i);
    changed.push_back({static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)});
  }
  ASSERT_GT(changed.size(), 100U);
  changed[changed.size() - 3][2] += 0.001F;
  binary("tiles/03.pcd", changed);
  binary("tiles/05.pcd", gaussian(7, 1));
  const Result merged = objects(options, {"--merge", "--labels", at("labels")}, parts);
  EXPECT_EQ(merged.status, 1);
  EXPECT_EQ(merged.error_lines(), 3U) << merged.err;
  EXPECT_THAT(merged.err, HasSubstr(path_of(folder, 0) + ": no such file"));
  EXPECT_THAT(merged.err, HasSubstr(path_of(folder, 3) + ": has changed since the shares were made"));
  EXPECT_THAT(merged.err, HasSubstr(path_of(folder, 5) + ": has changed since the shares were made"));
  for (const std::size_t bad : {0, 3, 5})
    std::filesystem::remove(path_of(at("expected"), bad));
  expect_same_files(at("labels"), at("expected"), 3);
}

TEST_F(PcdBvShareLabels, AreRefusedBeforeTheWorkIfFilesWouldBeLost) {
  const std::vector<std::string> options = {"--cluster", "0.4"};
  const std::string folder = tiles("tiles", yard(1), 3), other = tiles("other", yard(2), 3);
  const auto expect_error = [&](const std::string& parts, const std::string& labels, int status,
                                const std::string& what) {
    const Result result = objects(options, {"--merge", "--labels", labels}, parts);
    EXPECT_EQ(result.status, status);
    EXPECT_EQ(result.error_lines(), 1U) << result.err;
    EXPECT_THAT(result.err, HasSubstr(what));
  };
  const std::string parts = shares("parts", 2, options, {folder});
  expect_error(parts, at("l.pcd"), 2, "is no folder, which --merge needs");
  expect_error(parts, folder, 2, "is an input and would be overwritten");
  expect_error(shares("same", 1, options, {folder, other}), at("labels"), 2, "more than one result");
  std::filesystem::rename(parts + "/0", parts + "/00.pcd");
  expect_error(parts, parts, 2, "is an input and would be overwritten");
  remove_inputs(parts + "/1");
  expect_error(parts, at("labels"), 1, "parts/1: was written by an older version, without the paths of its");
  EXPECT_EQ(objects(options, {"--merge"}, parts).status, 0);
  EXPECT_FALSE(std::filesystem::exists(at("labels")));
}

TEST_F(PcdBvShareLabels, ThatCannotBeWrittenAreOneLineForEach) {
  const std::vector<std::string> options = {"--cluster", "0.4"};
  const std::string parts = shares("parts", 2, options, {tiles("tiles", yard(1), 3)});
  std::filesystem::create_directories(at("labels/01.pcd"));
  const Result result = objects(options, {"--merge", "--labels", at("labels")}, parts);
  EXPECT_EQ(result.status, 1);
  EXPECT_EQ(result.error_lines(), 1U) << result.err;
  EXPECT_THAT(result.err, HasSubstr("labels/01.pcd: "));
  EXPECT_TRUE(std::filesystem::exists(at("labels/02.pcd")));
}

}  // namespace
}  // namespace pcl_bv::test
