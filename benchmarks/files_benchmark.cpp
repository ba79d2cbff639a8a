// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Whole processes, from their start to their end, files in the page cache: pcd_bv, and a program that does
// the same with PCL (pcl_load.cpp) or with LASzip's reader (laz_load.cpp), in turns. Counters: the ratio of
// their times (timing.h), and the most memory that each had resident, in MiB.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "child_process.h"
#include "pcl_bv/io/raw_cloud_edit.h"
#include "pcl_bv/io/read_cloud.h"
#include "pcl_bv/synth/synth.h"
#include "timing.h"

namespace pcl_bv::bench {
using namespace detail;
namespace {

namespace fs = std::filesystem;
using Command = std::vector<std::string>;

constexpr int kSweeps = 200;

// Of CI's run, which only shows that every row works.
bool is_tiny() {
  return std::getenv("PCL_BV_BENCH_TINY") != nullptr;
}

std::size_t points(std::size_t wanted) {
  return is_tiny() ? std::min<std::size_t>(wanted, 6400) : wanted;
}

fs::path program(const char* name) {
  return fs::read_symlink("/proc/self/exe").parent_path() / name;
}

// A folder for the files of this run.
class Folder {
 public:
  Folder() {
    std::string name = (fs::temp_directory_path() / "bench_files_XXXXXX").string();
    if (!::mkdtemp(name.data())) throw std::runtime_error("no temporary folder");
    path_ = name;
  }
  ~Folder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

// Its coordinates alone.
RawCloud scene(const std::string& name, std::size_t count, int seed) {
  const std::string text = name + ":" + std::to_string(points(count)) + ":" + std::to_string(seed);
  return make_cloud(make_synth(parse_synth(text)).xyz);
}

// Builds with LASzip also read a compressed file.
#ifdef PCL_BV_LASZIP
constexpr bool kLaz = true;
#else
constexpr bool kLaz = false;
#endif

void make_laz(const fs::path& folder, const RawCloud& cloud) {
  std::vector<double> xyz;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Coordinates p = load_point(cloud.xyz(), i);
    xyz.insert(xyz.end(), {p.x, p.y, p.z});
  }
  const std::string plain = folder / "street.xyz64";
  std::ofstream(plain, std::ios::binary)
      .write(reinterpret_cast<const char*>(xyz.data()), static_cast<std::streamsize>(xyz.size() * 8));
  run_process({program("laz_load"), "--write", plain, folder / "street.laz"});
}

// In a process of its own, whose memory must not be counted to those that are measured.
void make_files(const fs::path& folder) {
  write_pcd(folder / "big.pcd", scene("gauss", 16'000'000, 1));
  const RawCloud street = scene("street", 1'024'000, 1);
  write_pcd(folder / "ascii.pcd", street, PcdEncoding::ascii);
  write_pcd(folder / "compressed.pcd", street, PcdEncoding::binary_compressed);
  if (kLaz) make_laz(folder, street);
  write_pcd(folder / "sweep.pcd", scene("street", 128'000, 2));
  fs::create_directory(folder / "sweeps");
  for (int i = 0; i < kSweeps; ++i) {
    const fs::path sweep = folder / "sweeps" / (std::to_string(i) + ".pcd");
    if (i < 10) {
      write_pcd(sweep, scene("street", 128'000, i));
    } else {
      fs::create_hard_link(folder / "sweeps" / (std::to_string(i % 10) + ".pcd"), sweep);
    }
  }
}

void compare_processes(benchmark::State& state, const Command& peer, const Command& ours) {
  double peer_mib = 0, ours_mib = 0;
  try {
    compare(
        state, [&] { peer_mib = std::max(peer_mib, run_process(peer).resident_mib); },
        [&] { ours_mib = std::max(ours_mib, run_process(ours).resident_mib); });
  } catch (const std::runtime_error& error) {
    state.SkipWithError(error.what());
  }
  state.counters["first_mib"] = peer_mib;
  state.counters["second_mib"] = ours_mib;
}

void add(const std::string& name, int times, const Command& peer, const Command& ours) {
  benchmark::RegisterBenchmark(name.c_str(),
                               [=](benchmark::State& state) { compare_processes(state, peer, ours); })
      ->Iterations(is_tiny() ? 2 : times)
      ->Repetitions(1)
      ->UseManualTime()
      ->Unit(benchmark::kMicrosecond);
}

void add_rows(const fs::path& folder) {
  const auto pcd_bv = [&](const std::string& options, int threads, const std::string& file) {
    Command command{program("pcd_bv"), "--threads", std::to_string(threads), "--volume", "aabb,dop26"};
    if (!options.empty()) command.insert(command.end(), {"--cluster", options});
    command.push_back(folder / file);
    return command;
  };
  const auto pcl = [&](const std::string& tolerance, const std::string& file) {
    return Command{program("pcl_load"), tolerance, folder / file};
  };
  add("files/over-pcl/start-up", 15, {program("pcl_load")}, {program("pcd_bv"), "--version"});
  for (const int threads : {1, 2}) {
    const std::string end = "/threads:" + std::to_string(threads);
    add("files/over-pcl/binary/n:16000000" + end, 9, pcl("0", "big.pcd"), pcd_bv("", threads, "big.pcd"));
    add("files/over-pcl/ascii/n:1024000" + end, 7, pcl("0", "ascii.pcd"), pcd_bv("", threads, "ascii.pcd"));
    add("files/over-pcl/binary_compressed/n:1024000" + end, 9, pcl("0", "compressed.pcd"),
        pcd_bv("", threads, "compressed.pcd"));
    if (kLaz)
      add("files/over-laszip/laz/n:1024000" + end, 5, {program("laz_load"), folder / "street.laz"},
          pcd_bv("", threads, "street.laz"));
    add("files/over-pcl/clusters-0.5/n:128000" + end, 3, pcl("0.5", "sweep.pcd"),
        pcd_bv("0.5", threads, "sweep.pcd"));
    Command all = pcl("0", "sweeps/0.pcd");
    for (int i = 1; i < kSweeps; ++i)
      all.push_back(folder / "sweeps" / (std::to_string(i) + ".pcd"));
    add("files/over-pcl/200-sweeps/n:128000" + end, 5, all, pcd_bv("", threads, "sweeps"));
  }
}

int run(int count, char** arguments) {
  if (count == 3 && std::string_view(arguments[1]) == "--make-files") {
    make_files(arguments[2]);
    return 0;
  }
  benchmark::Initialize(&count, arguments);
  if (benchmark::ReportUnrecognizedArguments(count, arguments)) return 2;
  const Folder folder;
  run_process({program("bench_files"), "--make-files", folder.path()});
  add_rows(folder.path());
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}

}  // namespace
}  // namespace pcl_bv::bench

int main(int count, char** arguments) {
  try {
    return pcl_bv::bench::run(count, arguments);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_files: %s\n", error.what());
    return 1;
  }
}
