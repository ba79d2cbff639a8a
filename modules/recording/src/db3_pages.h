// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Recovers the rows of a damaged SQLite file directly from its leaf pages
// (https://www.sqlite.org/fileformat2.html). The inner pages of the B-trees, the list of tables and the
// file's header may be damaged.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <vector>

#include "pcl_bv/io/posix_file.h"
#include "pcl_bv/recording/recording.h"

namespace pcl_bv::detail {

/// The topics and messages in the leaf pages of a rosbag2 database.
class Db3Pages {
 public:
  /// A row of the table of messages. Its data may continue on overflow pages.
  struct Message {
    std::int64_t id = 0, topic = 0, time = 0;
    std::uint64_t data = 0;       ///< Position of the data in the file.
    std::uint64_t local = 0;      ///< Bytes of the data on the leaf page.
    std::uint64_t size = 0;       ///< Bytes of the data on all pages.
    std::uint32_t next_page = 0;  ///< First overflow page, counted from 1; 0 if there is none.
  };

  /// Reads all leaf pages. Throws IoError if the file cannot be read.
  explicit Db3Pages(const std::filesystem::path& file);

  const std::map<std::int64_t, RecordedTopic>& topics() const { return topics_; }
  const std::vector<Message>& messages() const { return messages_; }

  /// Replaces `to` by the message's data. Throws IoError if the chain of overflow pages is broken.
  void load(const Message& message, std::vector<std::byte>& to) const;

 private:
  void read_leaf(std::uint64_t page);
  void read_row(std::uint64_t page, std::uint64_t cell);

  InputFile file_;
  std::uint64_t page_size_ = 4096, usable_ = 4096;
  std::vector<std::byte> bytes_;  // content of the current page
  std::map<std::int64_t, RecordedTopic> topics_;
  std::vector<Message> messages_;
};

}  // namespace pcl_bv::detail
