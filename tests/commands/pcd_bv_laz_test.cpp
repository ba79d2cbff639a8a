// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Results of compressed files are those of the same points in a .las file.
#include <gmock/gmock.h>

#include <cstdint>
#include <cstring>

#include "../io/copc_files.h"
#include "../io/las_bytes.h"
#include "command.h"

namespace pcl_bv::test {
namespace {

using testing::HasSubstr;

class PcdBvLaz : public PcdBv {
 protected:
  void SetUp() override {
    made_ = make_copc(nodes_, folder());
    file("a.las", made_.las);
    file("a.copc.laz", made_.copc);
    file("keep.json", R"([{"shape":"sphere","center":[-40,-40,-40],"radius":9}])");
  }

  std::filesystem::path folder() const { return std::filesystem::path(at("x")).parent_path(); }

  // The output and the warnings for a file, without its name.
  std::string output(const std::string& name, std::vector<std::string> options) const {
    options.insert(options.end(), {"--format", "json", at(name)});
    const Result result = run(options);
    EXPECT_EQ(result.status, 0) << result.err;
    std::string out = result.out + result.err;
    const std::string path = at(name);
    for (std::size_t begin = out.find(path); begin != std::string::npos; begin = out.find(path))
      out.replace(begin, path.size(), "FILE");
    return out;
  }

  const std::vector<CopcNode> nodes_{{0, {0, 0, 0}, 100},
                                     {1, {0, 0, 0}, 500},
                                     {1, {1, 1, 1}, 700},
                                     {2, {3, 3, 3}, 200, true},
                                     {2, {0, 1, 0}, 300, true}};
  CopcFile made_;
};

TEST_F(PcdBvLaz, ResultsAreThoseOfTheLasFileWhateverTheFilterKeeps) {
  const std::vector<std::vector<std::string>> all = {
      {},
      {"--range", "0:20"},
      {"--range", "60:80"},
      {"--range", "0:60", "--cluster", "8", "--min-size", "2"},
      {"--range", "0:inf", "--keep-inside", at("keep.json")},
      {"--range", "10:70", "--keep-inside", at("keep.json"), "--padding", "2", "--cluster", "5", "--min-size",
       "1"},
      {"--range", "0:40", "--drop-inside", at("keep.json"), "--threads", "2"},
      {"--range", "0:60", "--ground", "zones"},
      {"--range", "0:inf", "--ground", "zones", "--keep-inside", at("keep.json")},
      {"--range", "0:60", "--ground", "plane", "--cluster", "8"},
      {"--range", "0:60", "--ground", "slope"},
      {"--range", "0:60", "--cluster", "8", "--refine", "neck"},
      {"--range", "0:40", "--info"},
      {"--range", "0:40", "--origin", "1,2,3"},
      {"--range", "0:40", "--cluster", "8", "--class", "classification"},
      {"--together", "--range", "0:40"}};
  for (const std::vector<std::string>& options : all) {
    const std::string expected = output("a.las", options);
    EXPECT_THAT(expected, HasSubstr("\"points\":1800")) << testing::PrintToString(options);
    EXPECT_EQ(output("a.copc.laz", options), expected) << testing::PrintToString(options);
  }
}

TEST_F(PcdBvLaz, LabelsAreThoseOfTheLasFile) {
  for (const std::string name : {"a.las", "a.copc.laz"})
    ASSERT_EQ(run({"--range", "0:60", "--cluster", "8", "--labels", at(name + ".pcd"), at(name)}).status, 0);
  EXPECT_EQ(read_file(at("a.las.pcd")), read_file(at("a.copc.laz.pcd")));
}

// A node that cannot be decompressed shows which nodes are.
TEST_F(PcdBvLaz, DecompressesOnlyNodesThatMayHoldKeptPoints) {
  std::string bytes = made_.copc;
  std::uint64_t chunk = 0;  // of the node from 0 to 64 m; it is the third entry of the root
  std::memcpy(&chunk, bytes.data() + made_.first_entry + 4 * 32 + 16, sizeof chunk);
  LasFile::put(bytes, chunk + 36 + 4, 0x7FFFFFFFU);
  const std::string damaged = file("b.copc.laz", bytes);
  file("near.json", R"([{"shape":"sphere","center":[10,10,10],"radius":3}])");
  const Result all = run({"--range", "0:inf", damaged});
  EXPECT_EQ(all.status, 1);
  EXPECT_EQ(all.error_lines(), 1U) << all.err;
  EXPECT_THAT(all.err, HasSubstr("does not have the bytes of its layers"));
  EXPECT_EQ(run({"--range", "0:inf", "--keep-inside", at("keep.json"), damaged}).status, 0);
  EXPECT_EQ(run({"--range", "0:inf", "--keep-inside", at("near.json"), damaged}).status, 1);
}

TEST_F(PcdBvLaz, IsFoundInFolders) {
  const std::string sweeps = at("sweeps");
  std::filesystem::create_directory(sweeps);
  std::filesystem::copy(at("a.copc.laz"), sweeps + "/1.laz");
  const Result result = run({"--format", "jsonl", sweeps});
  EXPECT_EQ(result.status, 0);
  EXPECT_THAT(result.out, HasSubstr("1.laz"));
}

}  // namespace
}  // namespace pcl_bv::test
