// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// ground_scores [SETTINGS] [SEEDS [FRAMES [BEAMS...]]]: scores of the ground that the pipeline finds on
// synth:rural-road-sequence: every tenth frame of FRAMES (300), seeds 1 to SEEDS (3), for 16, 32, 64 and 128
// beams or the given ones. SETTINGS is METHOD[:CELL_SIZE[:MAX_SLOPE_DEGREES[:DISTANCE]]], such as slope:0.5
// (zones).
#include <cctype>
#include <cmath>
#include <cstdio>
#include <exception>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "ground_score.h"
#include "pcl_bv/nodes/frame_pipeline.h"
#include "pcl_bv/synth/rural_road.h"
#include "pipeline/config/settings.h"

namespace pcl_bv::bench {
using namespace detail;
namespace {

void add_frame(FramePipeline& pipeline, const RuralRoadOptions& options, std::size_t number,
               std::vector<GroundScore>& scores) {
  const RuralRoadFrame made = make_rural_road_frame(options, number);
  const SynthCloud& cloud = made.cloud;
  Frame frame;
  frame.points = PointView::of(cloud.xyz.data(), 3 * sizeof(float), cloud.size());
  FrameResult result;
  pipeline.process(frame, result);
  const std::vector<std::uint32_t> labels = labels_of(frame, result);
  std::vector<double> range(cloud.size());
  std::vector<std::uint8_t> found(cloud.size());
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    range[i] = std::hypot(cloud.xyz[3 * i], cloud.xyz[3 * i + 1]);
    found[i] = labels[i] == kLabelGround;
  }
  for (GroundScore& score : scores)
    score.add({range, cloud.object, cloud.ground, cloud.vegetation, found});
}

void print(std::size_t beams, const char* vegetation, const GroundScore& score) {
  for (std::size_t band = 0; band <= GroundScore::all; ++band) {
    const std::string range = band == GroundScore::all
                                  ? "all"
                                  : std::to_string(std::lround(GroundScore::edges[band])) + "-" +
                                        std::to_string(std::lround(GroundScore::edges[band + 1]));
    std::printf("%5zu  %-11s  %-6s  %7.3f  %9.3f  %7zu  %5zu\n", beams, vegetation, range.c_str(),
                100 * score.recall(band), 100 * score.precision(band), score.objects(band), score.lost(band));
  }
}

/// Reads METHOD[:CELL_SIZE[:MAX_SLOPE_DEGREES[:DISTANCE]]].
GroundConfig ground_of(const std::string& text) {
  std::istringstream parts(text);
  GroundConfig ground;
  std::string part;
  std::getline(parts, part, ':');
  read_text(part, ground.method);
  for (std::optional<double>* const value :
       {&ground.cell_size, &ground.max_slope_degrees, &ground.distance}) {
    if (std::getline(parts, part, ':') && !part.empty()) *value = std::stod(part);
  }
  return ground;
}

int run(int argc, char** argv) {
  GroundConfig ground;
  if (argc > 1 && std::isalpha(static_cast<unsigned char>(argv[1][0])) != 0) {
    ground = ground_of(argv[1]);
    --argc, ++argv;
  }
  const auto argument = [&](int i, std::size_t otherwise) {
    return argc > i ? static_cast<std::size_t>(std::stoull(argv[i])) : otherwise;
  };
  std::vector<std::size_t> sensors{16, 32, 64, 128};
  if (argc > 3) sensors.clear();
  for (int i = 3; i < argc; ++i)
    sensors.push_back(argument(i, 64));
  std::puts("beams  vegetation   metres   recall  precision  objects  lost");
  for (const std::size_t beams : sensors) {
    std::vector<GroundScore> scores{GroundScore(Vegetation::ground), GroundScore(Vegetation::no_ground),
                                    GroundScore(Vegetation::not_counted)};
    for (std::size_t seed = 1; seed <= argument(1, 3); ++seed) {
      PipelineConfig config;
      config.volumes = {"aabb"};
      config.ground = ground;
      FramePipeline pipeline(config);
      for (std::size_t number = 0; number < argument(2, 300); number += 10)
        add_frame(pipeline, {seed, beams}, number, scores);
    }
    print(beams, "ground", scores[0]);
    print(beams, "no ground", scores[1]);
    print(beams, "not counted", scores[2]);
  }
  return 0;
}

}  // namespace
}  // namespace pcl_bv::bench

int main(int argc, char** argv) {
  try {
    return pcl_bv::bench::run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "ground_scores: %s\n", error.what());
    return 2;
  }
}
