// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "ouster_metadata_files.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "pcl_bv/io/untrusted_text.h"

namespace pcl_bv::detail {
namespace {

constexpr std::size_t kMaxOusterBytes = std::size_t{1} << 20;  // real metadata has about 10 kB
constexpr std::size_t kMaxOusterFiles = 64;                    // .json files of a folder that are parsed
constexpr std::size_t kMaxNamedFiles = 3;                      // in a message

// Returns a number in the header of a packet, or 0 if packets of this profile have none.
std::uint64_t header_number(const Payload& packet, const OusterProfile& profile, std::size_t at,
                            std::size_t bytes) {
  std::uint64_t number = 0;
  if (!profile.is_legacy()) std::memcpy(&number, packet.data + at, bytes);
  return number;
}

std::uint64_t serial_in(const Payload& packet, const OusterProfile& profile) {
  return header_number(packet, profile, 7, 5);
}

std::string printable_name(const std::filesystem::path& file) {
  return printable(file.filename().string());
}

// Returns whether the file is NAME.json or NAME_0.json, NAME_1.json, ... of the capture NAME.pcap.
// NAME_1.json belongs to NAME_1.pcap instead, if that capture exists.
bool is_own_file(const std::filesystem::path& file, const std::filesystem::path& capture) {
  const std::string stem = file.stem().string(), name = capture.stem().string();
  if (stem == name) return true;
  if (!stem.starts_with(name + '_') || stem.size() < name.size() + 2 ||
      stem.find_first_not_of("0123456789", name.size() + 1) != std::string::npos)
    return false;
  std::error_code unknown;
  return !std::filesystem::exists(std::filesystem::path(file).replace_extension(capture.extension()),
                                  unknown);
}

// Returns the .json files in the folder of a capture, sorted.
std::vector<std::filesystem::path> json_files_next_to(const std::filesystem::path& capture) {
  std::vector<std::filesystem::path> files;
  const std::filesystem::path folder = capture.has_parent_path() ? capture.parent_path() : ".";
  std::error_code error;
  for (std::filesystem::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
    std::error_code unknown;
    if (it->path().extension() == ".json" && it->is_regular_file(unknown)) files.push_back(it->path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

// Returns "a, b and c", with at most kMaxNamedFiles texts.
std::string enumerated(const std::vector<std::string>& texts) {
  std::string list;
  const std::size_t shown = std::min(texts.size(), kMaxNamedFiles);
  for (std::size_t i = 0; i < shown; ++i)
    list.append(i == 0 ? "" : i + 1 == texts.size() ? " and " : ", ").append(texts[i]);
  if (shown < texts.size()) list += " and " + std::to_string(texts.size() - shown) + " others";
  return list;
}

std::string description_of(const OusterMetadata& metadata) {
  return (metadata.serial == 0 ? "an unknown sensor" : "sensor " + std::to_string(metadata.serial)) +
         " with packets of " + std::to_string(metadata.packet_size()) + " bytes (" +
         std::string(metadata.profile->name) + ", " + std::to_string(metadata.beams) + " beams)";
}

// Returns whether both describe the same sensor in the same mode.
bool give_same_points(const OusterMetadata& a, const OusterMetadata& b) {
  return a.profile == b.profile && a.columns_per_frame == b.columns_per_frame && a.altitudes == b.altitudes &&
         a.azimuths == b.azimuths && a.beam_x_mm == b.beam_x_mm && a.beam_z_mm == b.beam_z_mm &&
         a.lidar_to_sensor == b.lidar_to_sensor;
}

}  // namespace

// Reads the first kMaxOusterFiles of the .json files that are wanted.
template <typename Wanted>
void OusterMetadataFiles::read_files(const Wanted& wanted, bool own) {
  std::size_t count = 0;
  for (const std::filesystem::path& file : json_files_next_to(capture_)) {
    if (!wanted(file)) continue;
    if (++count > kMaxOusterFiles) {
      folder_is_cut_ = true;
      return;
    }
    read(file, own);
  }
}

OusterMetadataFiles::OusterMetadataFiles(std::filesystem::path capture) : capture_(std::move(capture)) {
  std::filesystem::path same_name = capture_;
  std::error_code unknown;
  if (std::filesystem::exists(same_name.replace_extension(".json"), unknown)) read(same_name, true);
  read_files(
      [&](const std::filesystem::path& file) {
        return is_own_file(file, capture_) && file.stem() != capture_.stem();
      },
      true);
}

void OusterMetadataFiles::read_folder() {
  has_read_folder_ = true;
  read_files([&](const std::filesystem::path& file) { return !is_own_file(file, capture_); }, false);
}

void OusterMetadataFiles::read(const std::filesystem::path& file, bool is_own) {
  try {
    files_.push_back(
        {printable_name(file), is_own, parse_ouster_metadata(read_untrusted_text(file, kMaxOusterBytes))});
  } catch (const IoError& error) {
    if (is_own && problem_.empty())
      problem_ = printable_name(file) + " is no usable metadata of an Ouster sensor: " + error.what();
  }
}

// Returns how well a file fits the packet, or -1 if it does not.
int OusterMetadataFiles::rank(const File& file, const Payload& packet) const {
  const OusterMetadata& m = file.metadata;
  if (packet.size != m.packet_size()) return -1;
  const std::uint64_t serial = serial_in(packet, *m.profile),
                      init_id = header_number(packet, *m.profile, 4, 3);
  if (serial != 0 && m.serial != 0 && serial != m.serial) return -1;
  const bool same_serial = serial != 0 && serial == m.serial;
  if (!file.is_own && !same_serial && (!problem_.empty() || files_.size() > 1)) return -1;
  return (file.is_own ? 8 : 0) + (same_serial ? 4 : 0) + (init_id != 0 && init_id == m.init_id ? 2 : 0) +
         (packet.destination_port == m.port ? 1 : 0);
}

// Returns the files that fit the packet best.
std::vector<const OusterMetadataFiles::File*> OusterMetadataFiles::best_files(const Payload& packet) const {
  std::vector<const File*> best;
  int best_rank = 0;
  for (const File& file : files_) {
    const int its_rank = rank(file, packet);
    if (its_rank < best_rank) continue;
    if (its_rank > best_rank) best.clear();
    best_rank = its_rank;
    best.push_back(&file);
  }
  return best;
}

std::optional<std::size_t> OusterMetadataFiles::find(const Payload& packet) const {
  const std::vector<const File*> best = best_files(packet);
  if (best.empty()) return std::nullopt;
  const bool has_capture_name = best[0]->name == printable_name(capture_.stem()) + ".json";
  const bool alike = std::all_of(best.begin(), best.end(), [&](const File* file) {
    return give_same_points(file->metadata, best[0]->metadata);
  });
  if (!has_capture_name && !alike) return std::nullopt;
  return static_cast<std::size_t>(best[0] - files_.data());
}

std::uint64_t OusterMetadataFiles::serial_of(const Payload& packet) const {
  for (const File& file : files_)
    if (file.metadata.packet_size() == packet.size) return serial_in(packet, *file.metadata.profile);
  return 0;
}

std::string OusterMetadataFiles::missing_for(const Payload& packet) const {
  const std::string name = printable_name(capture_.stem()), own = name + ".json";
  std::vector<const File*> files = best_files(packet);
  bool fit = !files.empty();
  const auto add_files = [&](bool only_own) {
    for (const File& file : files_)
      if (!fit && (file.is_own || !only_own)) files.push_back(&file);
  };
  add_files(true);
  if (files.empty() && !problem_.empty()) return problem_;
  if (files.empty()) add_files(false);
  if (files.empty())
    return "the metadata of the Ouster sensor is missing: put its .json file next to the capture, as " + own +
           (folder_is_cut_ ? " (only the first 64 .json files of the folder were read)" : "");
  // Without a serial number, several files with the right size of packets may fit.
  const auto has_size = [&](const File* file) { return file->metadata.packet_size() == packet.size; };
  if (files.size() > 1 && serial_of(packet) == 0)
    fit = fit || std::any_of(files.begin(), files.end(), has_size);
  std::vector<std::string> texts;
  for (const File* const file : files)
    texts.push_back(fit ? file->name : file->name + " is of " + description_of(file->metadata));
  if (fit) return enumerated(texts) + " are metadata of Ouster sensors: name one of them " + own;
  return enumerated(texts) + ": put the metadata of the packets' sensor next to the capture, as " + own +
         " or " + name + "_0.json";
}

}  // namespace pcl_bv::detail
