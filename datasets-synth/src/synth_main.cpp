// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The command synth: generated clouds as .pcd files.
#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <new>
#include <stdexcept>
#include <string>
#include <string_view>

#include "pcl_bv/io/pcd.h"
#include "pcl_bv/synth/street.h"
#include "pcl_bv/synth/synth.h"

namespace {

enum Status { done = 0, not_written = 1, wrong_use = 2 };

constexpr std::string_view sequence_name = "street-sequence";

std::string footer() {
  return "Scenes: " + pcl_bv::synth_names() +
         "\n\n"
         "For street, POINTS counts rays (a multiple of 64, one row per beam; no return: 0,0,0), and the "
         "uint32\n"
         "fields object (0: none) and ground (1: ground) say what each point is. A sequence is written as\n"
         "OUT/0000000000.pcd, OUT/0000000001.pcd, ... at ten sweeps a second. Same NAME:POINTS:SEED, same "
         "points.\n\n"
         "Examples:\n"
         "  synth street street.pcd                  128000 rays, seed 1\n"
         "  synth street:256000:7 street.pcd         4000 azimuths, seed 7\n"
         "  synth paper-4010 frog.pcd                as many points as the paper's frog\n"
         "  synth street-sequence sweeps             22 sweeps in the folder sweeps\n"
         "  synth street-sequence:100:7 sweeps       100 sweeps, seed 7\n\n"
         "Exit status: 0 done, 1 output not written, 2 wrong use.\n";
}

std::string frame_name(std::size_t frame) {
  const std::string digits = std::to_string(frame);
  return std::string(10 - digits.size(), '0') + digits + ".pcd";
}

/// Runs write(), which writes to `path`; false, with a line on standard error, if it could not.
template <typename Write>
bool try_write(const std::filesystem::path& path, Write write) {
  std::string reason;
  try {
    write();
    return true;
  } catch (const pcl_bv::IoError& error) {
    reason = error.what();
  } catch (const std::filesystem::filesystem_error& error) {
    reason = error.code().message();
  } catch (const std::bad_alloc&) {
    reason = "not enough memory for so many points";
  }
  std::cerr << "synth: " << path.string() << ": " << reason << '\n';
  return false;
}

bool write_cloud(const pcl_bv::SynthSpec& spec, const std::filesystem::path& path) {
  return try_write(path, [&] { write_pcd(path, to_raw_cloud(make_synth(spec))); });
}

bool write_sequence(const pcl_bv::StreetSequenceSpec& spec, const std::filesystem::path& folder) {
  if (!try_write(folder, [&] { std::filesystem::create_directories(folder); })) return false;
  pcl_bv::StreetOptions options;
  options.seed = spec.seed;
  for (std::size_t frame = 0; frame < spec.frames; ++frame) {
    const std::filesystem::path path = folder / frame_name(frame);
    const auto write = [&] { write_pcd(path, to_raw_cloud(make_street_frame(options, frame).cloud)); };
    if (!try_write(path, write)) return false;
  }
  return true;
}

bool write_scene(const std::string& scene, const std::filesystem::path& output) {
  if (scene.substr(0, scene.find(':')) == sequence_name) {
    return write_sequence(pcl_bv::parse_street_sequence(scene), output);
  }
  return write_cloud(pcl_bv::parse_synth(scene), output);
}

int run(int argc, char** argv) {
  CLI::App app{"Generated point clouds with known answers, as .pcd files.", "synth"};
  std::string scene;
  std::string output;
  app.add_option("SCENE", scene, "NAME[:POINTS[:SEED]] or street-sequence[:FRAMES[:SEED]]")->required();
  app.add_option("OUT", output, "The .pcd file or, for a sequence, the folder")->required();
  app.footer(footer());
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    std::cout << app.help();
    return done;
  } catch (const CLI::ParseError& error) {
    std::cerr << "synth: " << error.what() << "; synth --help says how\n";
    return wrong_use;
  }
  return write_scene(scene, output) ? done : not_written;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::invalid_argument& error) {
    std::cerr << "synth: " << error.what() << '\n';
    return wrong_use;
  } catch (const std::exception& error) {
    std::cerr << "synth: " << error.what() << '\n';
    return not_written;
  }
}
