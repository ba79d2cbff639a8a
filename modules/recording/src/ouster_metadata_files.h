// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The files with metadata of Ouster sensors next to a capture.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "ouster_metadata.h"
#include "udp_payload.h"

namespace pcl_bv::detail {

/// Finds the metadata of the sensor that sent a packet.
///
/// A capture NAME.pcap has its own files NAME.json and, as Ouster's tools write them, NAME_0.json,
/// NAME_1.json and so on, one for each sensor. The packets' serial number, initialization id and port, in
/// this order, decide among them. NAME.json is preferred if nothing decides. Without an own file that fits,
/// other .json files in the folder are used: the one with the packets' serial number, or the only metadata in
/// the folder.
class OusterMetadataFiles {
 public:
  /// Reads the own files. The other files are read by read_folder().
  explicit OusterMetadataFiles(std::filesystem::path capture);

  bool has_read_folder() const { return has_read_folder_; }
  bool is_empty() const { return files_.empty(); }

  /// Reads the other .json files in the folder, which may be many. Never throws for a bad file.
  void read_folder();

  /// Returns the number of the metadata of the packet's sensor. Returns nullopt if there is none, or if
  /// several metadata that give other points fit alike.
  std::optional<std::size_t> find(const Payload& packet) const;

  const OusterMetadata& metadata(std::size_t number) const { return files_[number].metadata; }

  /// Returns the serial number of the packet, or 0 if it is unknown.
  std::uint64_t serial_of(const Payload& packet) const;

  /// Returns what is missing to decode such a packet, as the end of a message.
  std::string missing_for(const Payload& packet) const;

 private:
  struct File {
    std::string name;
    bool is_own = false;
    OusterMetadata metadata{};
  };

  template <typename Wanted>
  void read_files(const Wanted& wanted, bool own);
  void read(const std::filesystem::path& file, bool is_own);
  int rank(const File& file, const Payload& packet) const;
  std::vector<const File*> best_files(const Payload& packet) const;

  std::filesystem::path capture_;
  std::vector<File> files_;
  std::string problem_;  // of the first own file that cannot be used
  bool has_read_folder_ = false, folder_is_cut_ = false;
};

}  // namespace pcl_bv::detail
