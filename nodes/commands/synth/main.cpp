// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include <filesystem>
#include <new>
#include <stdexcept>
#include <string>
#include <string_view>

#include "commands/shared/command_line.h"
#include "commands/shared/interruption.h"
#include "commands/shared/output_claims.h"
#include "commands/shared/run_command.h"
#include "commands/shared/values.h"
#include "pcl_bv/io/atomic_file.h"
#include "pcl_bv/io/raw_cloud.h"
#include "pcl_bv/io/read_cloud.h"
#include "pcl_bv/synth/rig_drive.h"
#include "pcl_bv/synth/rural_road.h"
#include "pcl_bv/synth/rural_road_truth.h"
#include "pcl_bv/synth/street.h"
#include "pcl_bv/synth/synth.h"
#include "pcl_bv/synth/town.h"
#include "rig_recording.h"
#include "town_files.h"

namespace pcl_bv::detail {
namespace {

constexpr std::string_view sequence_name = "street-sequence";

std::string footer() {
  return "Scenes: " + synth_names() +
         "\n\n"
         "For street, POINTS counts rays (rounded to a multiple of 64, one row per beam; no return: "
         "0,0,0),\n"
         "and the uint32 fields object (0: none) and ground (1: ground) say what each point is. A sequence "
         "is written as\n"
         "OUT/0000000000.pcd, OUT/0000000001.pcd, ... at ten sweeps a second. Same NAME:POINTS:SEED, same "
         "points.\n\n"
         "rural-road is a road over hills with grass, ditches, bridges and traffic. The sensor has 64 beams\n"
         "(rural-road-16, -32, -128: 16, 32, 128 beams) and is on a car that turns and brakes. The points\n"
         "also have the fields vegetation (1: grass) and class (0: none, 1 car, 2 pedestrian, 3 pole,\n"
         "4 house, 5 wall, 6 hedge, 7 tree, 8 cyclist, 9 bridge). Its sequences, of 100 sweeps, also give\n"
         "OUT/poses.txt (for bv_stream --poses) and OUT/truth.jsonl: a line for each sweep, with boxes and\n"
         "velocities of all objects.\n\n"
         "rig is a recording (MCAP) of a robot with two LiDARs that turns at 30 degrees a second: the "
         "clouds\n"
         "/front/points and /rear/points with the time of each point, and the transforms /tf and\n"
         "/tf_static.\n\n"
         "town is the map of a town without a sensor: terrain, roads, houses, plants, poles, fences and "
         "cars,\n"
         "in square tiles of 100 m, OUT/COLUMN_ROW.pcd. Objects lie across borders of tiles. POINTS (200000) "
         "is\n"
         "the mean number of points of a tile. The field object is 0 for the ground. town-objects has no "
         "points\n"
         "of the ground, so its objects are clusters. Tiles are written by all threads.\n\n"
         "Examples:\n"
         "  synth street street.pcd                  128000 rays, seed 1\n"
         "  synth street:256000:7 street.pcd         4000 azimuths, seed 7\n"
         "  synth paper-4010 frog.pcd                as many points as the paper's frog\n"
         "  synth street-sequence sweeps             22 sweeps in the folder sweeps\n"
         "  synth street-sequence:100:7 sweeps       100 sweeps, seed 7\n"
         "  synth rural-road-sequence-16:300:2 road  300 sweeps with 16 beams, seed 2, with poses and "
         "truth\n"
         "  synth rig:100 rig.mcap                   10 s of two LiDARs\n"
         "  synth town:64 tiles                      8 x 8 tiles, 13 million points\n"
         "  synth town-objects:100:7:500000 tiles    10 x 10 tiles, seed 7, denser\n\n"
         "Exit status: 0 done, 1 output not written, 2 wrong use, 128 + N ended by the signal N.\n";
}

std::string frame_name(std::size_t frame) {
  const std::string digits = std::to_string(frame);
  return std::string(10 - digits.size(), '0') + digits + ".pcd";
}

/// Runs write(), which writes to `path`. If write() throws, adds the path to the message of the exception.
template <typename Write>
void naming(const std::filesystem::path& path, Write write) {
  try {
    write();
  } catch (const IoError& error) {
    throw IoError(path.string() + ": " + error.what());
  } catch (const std::bad_alloc&) {
    throw IoError(path.string() + ": not enough memory for so many points");
  }
}

void write_sequence(const StreetSequenceOptions& spec, const std::filesystem::path& folder) {
  naming(folder, [&] { create_folder(folder); });
  StreetOptions options;
  options.seed = spec.seed;
  for (std::size_t frame = 0; frame < spec.frames; ++frame) {
    const std::filesystem::path path = folder / frame_name(frame);
    naming(path, [&] { write_pcd(path, to_raw_cloud(make_street_frame(options, frame).cloud)); });
  }
}

void write_sequence(const RuralRoadSequenceOptions& spec, const std::filesystem::path& folder) {
  naming(folder, [&] { create_folder(folder); });
  std::string poses, truth;
  for (std::size_t number = 0; number < spec.frames; ++number) {
    const std::filesystem::path path = folder / frame_name(number);
    naming(path, [&] {
      const RuralRoadFrame frame = make_rural_road_frame(spec.options, number);
      write_pcd(path, to_raw_cloud(frame.cloud));
      poses += pose_line(frame);
      truth += truth_line(frame, number);
    });
  }
  naming(folder / "poses.txt", [&] { write_file_atomically(folder / "poses.txt", poses); });
  naming(folder / "truth.jsonl", [&] { write_file_atomically(folder / "truth.jsonl", truth); });
}

void require_suffix(const std::filesystem::path& output, const char* suffix) {
  if (lower_case_extension(output) != suffix && !needs_no_suffix(output))
    reject_value("OUT", output.string(), std::string("does not end in ") + suffix);
}

void write_scene(const std::string& scene, const std::filesystem::path& output) {
  if (scene.substr(0, scene.find(':')) == sequence_name) {
    write_sequence(parse_street_sequence(scene), output);
  } else if (is_rural_road_sequence(scene)) {
    write_sequence(parse_rural_road_sequence(scene), output);
  } else if (is_rig_sequence(scene)) {
    const RigSequence spec = parse_rig_sequence(scene);
    require_suffix(output, ".mcap");
    naming(output, [&] { write_rig_recording(spec, output); });
  } else if (is_town(scene)) {
    const TownSequence spec = parse_town(scene);
    naming(output, [&] { create_folder(output); });
    write_town(spec, output);
  } else {
    const SynthOptions spec = parse_synth(scene);
    require_suffix(output, ".pcd");
    naming(output, [&] { write_pcd(output, to_raw_cloud(make_synth(spec))); });
  }
}

int run(int argc, char** argv) {
  CommandLine line("synth", "Synthetic point clouds with ground truth, as .pcd files.", footer());
  std::string scene, output;
  line.option("SCENE", scene, "",
              "NAME[:POINTS[:SEED]], street-sequence[:FRAMES[:SEED]],\n"
              "rural-road-sequence[-BEAMS][:FRAMES[:SEED]], rig[:FRAMES[:SEED]]\n"
              "or town[-objects][:TILES[:SEED[:POINTS]]]");
  line.option("OUT", output, "", "The .pcd file; the folder of a sequence or town; the .mcap file of rig");
  if (const auto text = line.parse(argc, argv)) return print_text(*text);
  if (!line.given("OUT")) throw UsageError("no SCENE or no OUT; synth --help lists the options");
  reject_dash(output);
  const Interruption interruption([] {});
  try {
    write_scene(scene, output);
  } catch (const std::invalid_argument& error) {
    throw UsageError(error.what());
  }
  return 0;
}

}  // namespace
}  // namespace pcl_bv::detail

int main(int argc, char** argv) {
  return pcl_bv::detail::run_command("synth", [&] { return pcl_bv::detail::run(argc, argv); });
}
