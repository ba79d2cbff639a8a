// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The table of sources: files of clouds, synthetic frames, recordings and topics.

#include <algorithm>
#include <array>
#include <tuple>
#include <utility>

#include "cloud_message.h"
#include "message_source.h"
#include "pcl_bv/io/list_clouds.h"
#include "pcl_bv/io/raw_cloud.h"
#include "pcl_bv/io/raw_cloud_edit.h"
#include "pcl_bv/io/read_cloud.h"
#include "pcl_bv/synth/rural_road.h"
#include "pcl_bv/synth/street.h"
#include "pcl_bv/synth/synth.h"
#include "sources.h"

namespace pcl_bv {
using namespace detail;
namespace {

constexpr std::string_view kSynth = "synth:", kDds = "dds:";

// Returns the times of the files. Sorts the files by time if their names are in another order.
NameTimes times_of(std::vector<std::filesystem::path>& files) {
  std::vector<std::string> stems;
  stems.reserve(files.size());
  for (const std::filesystem::path& file : files)
    stems.push_back(file.stem().string());
  NameTimes times = times_of_names(stems);
  if (std::all_of(times.stamps.begin(), times.stamps.end(), [](std::int64_t stamp) { return stamp < 0; }))
    throw std::invalid_argument(
        files.front().string() +
        ": no file name has a time, which --stamps name and --rate recorded need; a whole number is the "
        "number of a frame, except seconds of 2001 to 2033, milli- and microseconds of 2001 to 2262, and "
        "nanoseconds from 1e16 on");
  if (!times.sort) return times;
  std::vector<std::pair<std::int64_t, std::filesystem::path>> sorted;
  for (std::size_t i = 0; i < files.size(); ++i)
    sorted.emplace_back(times.stamps[i], std::move(files[i]));
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  for (std::size_t i = 0; i < files.size(); ++i)
    std::tie(times.stamps[i], files[i]) = std::move(sorted[i]);
  times.warning = "the frames are sorted by the times in their names, since the names are in another order";
  return times;
}

std::unique_ptr<FrameSource> open_folder(const std::string& name, const ReplayOptions& options) {
  std::error_code unknown;
  if (!std::filesystem::exists(name, unknown)) throw IoError(name + ": no such file or folder");
  std::vector<std::filesystem::path> files{name};
  if (std::filesystem::is_directory(name, unknown)) files = list_clouds(name);
  if (files.empty()) throw IoError(name + ": no cloud in this folder");
  NameTimes times;
  if (options.own_stamps) times = times_of(files);
  const std::size_t length = files.size();
  return make_replay(
      length, std::move(files), options,
      [fields = options.bin_fields, classes = options.class_field](std::size_t, Frame& frame) {
        check_recording_content(frame.file);
        const auto cloud = std::make_shared<RawCloud>(read_cloud(frame.file, {fields}));
        frame.points = cloud->xyz();
        frame.intensity = intensity_of(cloud->fields, cloud->data.data(), cloud->point_step);
        frame.times = times_of(cloud->fields, cloud->data.data(), cloud->point_step);
        if (!classes.empty())
          frame.classes = std::make_shared<std::vector<std::int64_t>>(integers_of(*cloud, classes));
        frame.note = cloud->note;
        frame.sensor = sensor_of(*cloud);
        frame.owner = cloud;
      },
      std::move(times));
}

Pose pose_of(const std::array<double, 12>& rows) {
  Pose pose = Pose::Identity();
  for (std::size_t i = 0; i < 12; ++i)
    pose(static_cast<Eigen::Index>(i / 4), static_cast<Eigen::Index>(i % 4)) = rows[i];
  return pose;
}

// The sequence generates poses. A file of poses, if given, replaces them.
std::unique_ptr<FrameSource> open_rural_road(const std::string& name, const ReplayOptions& options) {
  const RuralRoadSequenceOptions spec = parse_rural_road_sequence(name.substr(kSynth.size()));
  const bool own_poses = options.poses.empty();
  return make_replay(spec.frames, {}, options, [spec, own_poses](std::size_t index, Frame& frame) {
    RuralRoadFrame generated = make_rural_road_frame(spec.options, index);
    if (own_poses) frame.pose = pose_of(generated.pose);
    const auto xyz = std::make_shared<std::vector<float>>(std::move(generated.cloud.xyz));
    frame.points = PointView::of(xyz->data(), 3 * sizeof(float), xyz->size() / 3);
    frame.owner = xyz;
    if (frame.header.frame_id.empty()) frame.header.frame_id = "rural_road";
  });
}

std::unique_ptr<FrameSource> open_synth(const std::string& name, const ReplayOptions& options) {
  if (options.own_stamps) throw std::invalid_argument("'" + name + "' has no names with times");
  if (is_rural_road_sequence(name.substr(kSynth.size()))) return open_rural_road(name, options);
  const StreetSequenceOptions spec = parse_street_sequence(name.substr(kSynth.size()));
  StreetOptions street;
  street.seed = spec.seed;
  return make_replay(spec.frames, {}, options, [street](std::size_t index, Frame& frame) {
    const auto xyz =
        std::make_shared<std::vector<float>>(std::move(make_street_frame(street, index).cloud.xyz));
    frame.points = PointView::of(xyz->data(), 3 * sizeof(float), xyz->size() / 3);
    frame.owner = xyz;
    if (frame.header.frame_id.empty()) frame.header.frame_id = "street";
  });
}

}  // namespace

std::unique_ptr<FrameSource> detail::open_dds(const std::string& name, const ReplayOptions& options) {
  const std::string topic = name.substr(kDds.size());
  return make_message_source(middleware("dds").receiver(topic, cloud_type_names()), name, options);
}

bool detail::has_recording_extension(const std::filesystem::path& file) {
  constexpr std::array extensions{".bag", ".mcap", ".db3", ".pcap", ".pcapng"};
  return std::find(extensions.begin(), extensions.end(), lower_case_extension(file)) != extensions.end();
}

const std::vector<SourceKind>& source_kinds() {
  static const std::vector<SourceKind> kinds = [] {
    std::vector<SourceKind> all{
        {"synth:street-sequence[:FRAMES[:SEED]]\nor synth:rural-road-sequence[-BEAMS][:FRAMES[:SEED]]",
         FrameTimes::none, [](const std::string& name) { return name.starts_with(kSynth); }, open_synth},
        {"dds:TOPIC of ROS 2 with clouds", FrameTimes::live,
         [](const std::string& name) { return name.starts_with(kDds); }, open_dds},
        {"A folder of clouds, one file", FrameTimes::names, [](const std::string&) { return true; },
         open_folder}};
    const std::vector<SourceKind> recordings = recording_kinds();
    all.insert(all.end() - 1, recordings.begin(), recordings.end());
    return all;
  }();
  return kinds;
}

const SourceKind& source_kind(const std::string& name) {
  return *std::find_if(source_kinds().begin(), source_kinds().end() - 1,
                       [&](const SourceKind& kind) { return kind.accepts(name); });
}

std::string source_syntax() {
  std::string all;
  for (auto kind = source_kinds().rbegin(); kind != source_kinds().rend(); ++kind)
    all += (all.empty() ? "" : "\nor ") + std::string(kind->syntax);
  return all;
}

std::unique_ptr<FrameSource> open_source(const std::string& name, const ReplayOptions& options) {
  if (!(options.rate_hz >= kMinRate && options.rate_hz <= kMaxRate))
    throw std::invalid_argument("rate: is not a number from 0.001 to 1000000");
  const SourceKind& kind = source_kind(name);
  if (!options.topic.empty() && kind.times != FrameTimes::messages)
    throw std::invalid_argument("topic: only useful with a recording");
  return kind.open(name, options);
}

}  // namespace pcl_bv
