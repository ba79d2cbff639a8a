// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// label_scores: scores of what bv_stream finds on drives with public labels (docs/scores.md).
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "kitti_score.h"
#include "pcl_bv/io/read_cloud.h"
#include "pcl_bv/report/report.h"
#include "score_program.h"
#include "semantic_score.h"

namespace pcl_bv::bench {
namespace {

namespace fs = std::filesystem;

constexpr const char* kUsage =
    "usage: label_scores kitti RESULTS.jsonl LABELS.txt CALIBRATION.txt [further triples]\n"
    "                    [--classes Car,Pedestrian,Cyclist] [--min-iou 0.3] [--method NAME] "
    "[--count-unlabelled]\n"
    "       label_scores semantic-kitti FOUND_FOLDER LABELS_FOLDER [further pairs] [--sensor-height 1.73]\n";

std::string shown(double number) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", number);
  return text;
}

// The words of the command line: options with their values, flags, and all others.
struct Arguments {
  Arguments(int argc, char** argv, const std::vector<std::string>& known, const std::string& flag) {
    for (int i = 2; i < argc; ++i) {
      const std::string word = argv[i];
      if (word.rfind("--", 0) != 0) {
        files.push_back(word);
      } else if (word == flag) {
        flagged = true;
      } else if (std::find(known.begin(), known.end(), word) == known.end()) {
        throw UsageError(word + ": unknown option");
      } else if (i + 1 == argc) {
        throw UsageError(word + ": lacks its value");
      } else {
        options[word] = argv[++i];
      }
    }
  }

  std::string text(const std::string& name, const std::string& otherwise) const {
    const auto found = options.find(name);
    return found == options.end() ? otherwise : found->second;
  }

  double number(const std::string& name, double otherwise, double min, double max) const {
    if (options.count(name) == 0) return otherwise;
    const std::string& value = options.at(name);
    char* end = nullptr;
    const double read = std::strtod(value.c_str(), &end);
    if (value.empty() || *end != 0 || !(read >= min && read <= max))
      throw UsageError(name + ": '" + value + "' is not a number from " + shown(min) + " to " + shown(max));
    return read;
  }

  std::vector<std::string> files;
  std::map<std::string, std::string> options;
  bool flagged = false;
};

std::set<std::string> split(const std::string& list) {
  std::set<std::string> names;
  std::istringstream stream(list);
  for (std::string name; std::getline(stream, name, ',');)
    names.insert(name);
  return names;
}

void run_kitti(const Arguments& arguments) {
  KittiProtocol protocol;
  protocol.classes = split(arguments.text("--classes", "Car,Pedestrian,Cyclist"));
  protocol.min_iou = arguments.number("--min-iou", protocol.min_iou, 0.01, 1);
  protocol.count_unlabelled = arguments.flagged;
  const std::vector<std::string>& files = arguments.files;
  if (files.empty() || files.size() % 3 != 0)
    throw UsageError("kitti needs RESULTS.jsonl, LABELS.txt and CALIBRATION.txt for each sequence");
  TrackScore score;
  for (std::size_t i = 0; i < files.size(); i += 3) {
    const KittiCalibration calibration(files[i + 2]);
    add_kitti_sequence(read_kitti_labels(files[i + 1], calibration), calibration,
                       read_result_lines(files[i], arguments.text("--method", "")), protocol, score);
  }
  const TrackScores s = score.result();
  std::string classes;
  for (const std::string& name : protocol.classes)
    classes += (classes.empty() ? "" : ", ") + name;
  std::printf(
      "KITTI tracking labels, %s as one class; bird's-eye IoU >= %g for MOTA and MOTP; boxes without a label "
      "%s\n",
      classes.c_str(), protocol.min_iou, protocol.count_unlabelled ? "are wrong" : "are ignored");
  std::printf(
      "| HOTA | DetA | AssA | MOTA | MOTP | switches | fragmentations | objects | missed | wrong |\n"
      "|---|---|---|---|---|---|---|---|---|---|\n"
      "| %.2f | %.2f | %.2f | %.2f | %.2f | %zu | %zu | %zu | %zu | %zu |\n",
      100 * s.hota, 100 * s.detection, 100 * s.association, 100 * s.mota, 100 * s.motp, s.switches,
      s.fragments, s.truths, s.misses, s.wrong);
}

// Returns the files of a folder by the number at the end of their names: frame000012.pcd, 000012.label.
std::map<std::size_t, fs::path> numbered_files(const fs::path& folder, const std::string& extension) {
  std::map<std::size_t, fs::path> files;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    const std::string stem = entry.path().stem().string();
    const std::string digits = stem.substr(stem.find_last_not_of("0123456789") + 1);  // npos + 1 is 0
    if (entry.path().extension() != extension || digits.empty() || digits.size() > 18) continue;
    if (!files.emplace(std::stoull(digits), entry.path()).second)
      throw std::runtime_error(folder.string() + ": has two files of number " + digits);
  }
  if (error) throw std::runtime_error(folder.string() + ": " + error.message());
  if (files.empty()) throw std::runtime_error(folder.string() + ": no files named NUMBER" + extension);
  return files;
}

std::vector<std::uint32_t> read_labels(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
  if (!stream && !stream.eof()) throw std::runtime_error(file.string() + ": cannot be read");
  if (bytes.size() % 4 != 0) throw std::runtime_error(file.string() + ": its size is no multiple of 4 bytes");
  std::vector<std::uint32_t> labels(bytes.size() / 4);
  std::memcpy(labels.data(), bytes.data(), bytes.size());
  return labels;
}

struct SemanticScores {
  static constexpr std::size_t protocols = 3;
  SweepMean recall[protocols], precision[protocols], f1[protocols], accuracy[protocols], under, over;
};

// Reads the field `label` of a cloud that the sink labels: of bv_stream wrote.
std::vector<std::uint32_t> read_found(const RawCloud& cloud, const fs::path& file) {
  for (const PointField& field : cloud.fields) {
    if (field.name != "label" || field.type != 'U' || field.size != 4) continue;
    std::vector<std::uint32_t> labels(cloud.size());
    for (std::size_t i = 0; i < labels.size(); ++i)
      std::memcpy(&labels[i], cloud.data.data() + i * cloud.point_step + field.offset, 4);
    return labels;
  }
  throw std::runtime_error(file.string() + ": has no field label of type U 4");
}

void add_sweep(const fs::path& found_file, const fs::path& label_file, double low, SemanticScores& scores) {
  const RawCloud cloud = [&] {
    try {
      return read_cloud(found_file);
    } catch (const IoError& error) {
      throw std::runtime_error(found_file.string() + ": " + error.what());
    }
  }();
  const std::vector<std::uint32_t> labels = read_labels(label_file), found = read_found(cloud, found_file);
  if (labels.size() != found.size())
    throw std::runtime_error(label_file.string() + ": has " + std::to_string(labels.size()) +
                             " labels, but " + found_file.string() + " has " + std::to_string(found.size()) +
                             " points");
  const PointView points = cloud.xyz();
  std::vector<float> z;
  std::vector<std::uint8_t> ground;
  std::vector<std::uint32_t> clusters;
  for (std::size_t i = 0; i < found.size(); ++i) {
    z.push_back(static_cast<float>(load_point(points, i).z));
    ground.push_back(found[i] == kLabelGround);
    clusters.push_back(found[i] == kLabelGround || found[i] == kLabelNone ? 0 : found[i] + 1);
  }
  constexpr Vegetation kinds[] = {Vegetation::ground, Vegetation::not_counted, Vegetation::no_ground};
  for (std::size_t k = 0; k < SemanticScores::protocols; ++k) {
    const GroundCounts counts = count_ground(labels, z, ground, kinds[k], low);
    scores.recall[k].add(counts.recall());
    scores.precision[k].add(counts.precision());
    scores.f1[k].add(counts.f1());
    scores.accuracy[k].add(counts.accuracy());
  }
  const SegmentEntropy entropy = segment_entropy(true_segments(points, labels), clusters);
  scores.under.add(entropy.under);
  scores.over.add(entropy.over);
}

void print_semantic(const SemanticScores& scores, double low) {
  const auto percent = [](const SweepMean& of) {
    char text[64];
    std::snprintf(text, sizeof text, "%.2f / %.2f", 100 * of.mean(), 100 * of.deviation());
    return std::string(text);
  };
  std::printf("SemanticKITTI labels, mean / standard deviation over %zu sweeps, %%\n", scores.under.sweeps());
  std::printf("| ground | recall | precision | F1 | accuracy |\n|---|---|---|---|---|\n");
  const std::string names[] = {"vegetation below z = " + shown(low) + " m is ground",
                               "vegetation is not counted", "vegetation is no ground"};
  for (std::size_t k = 0; k < SemanticScores::protocols; ++k)
    std::printf("| %s | %s | %s | %s | %s |\n", names[k].c_str(), percent(scores.recall[k]).c_str(),
                percent(scores.precision[k]).c_str(), percent(scores.f1[k]).c_str(),
                percent(scores.accuracy[k]).c_str());
  std::printf("\n| USE | OSE |\n|---|---|\n| %.2f / %.2f | %.2f / %.2f |\n", scores.under.mean(),
              scores.under.deviation(), scores.over.mean(), scores.over.deviation());
}

void run_semantic(const Arguments& arguments) {
  const double low = -0.75 * arguments.number("--sensor-height", 1.73, 0.1, 100);
  const std::vector<std::string>& folders = arguments.files;
  if (folders.empty() || folders.size() % 2 != 0)
    throw UsageError("semantic-kitti needs FOUND_FOLDER and LABELS_FOLDER for each sequence");
  SemanticScores scores;
  for (std::size_t i = 0; i < folders.size(); i += 2) {
    const auto found = numbered_files(folders[i], ".pcd"), labels = numbered_files(folders[i + 1], ".label");
    for (const auto& [number, file] : found) {
      if (labels.count(number) == 0)
        throw std::runtime_error(file.string() + ": has no .label of this number");
      add_sweep(file, labels.at(number), low, scores);
    }
  }
  print_semantic(scores, low);
}

int run(int argc, char** argv) {
  const std::string kind = argc > 1 ? argv[1] : "";
  if (kind == "--help") {
    std::fputs(kUsage, stdout);
  } else if (kind == "kitti") {
    run_kitti({argc, argv, {"--classes", "--min-iou", "--method"}, "--count-unlabelled"});
  } else if (kind == "semantic-kitti") {
    run_semantic({argc, argv, {"--sensor-height"}, ""});
  } else {
    throw UsageError("'" + kind + "' is not kitti or semantic-kitti; see label_scores --help");
  }
  return 0;
}

}  // namespace
}  // namespace pcl_bv::bench

int main(int argc, char** argv) {
  return pcl_bv::bench::run_scores("label_scores", [&] { return pcl_bv::bench::run(argc, argv); });
}
