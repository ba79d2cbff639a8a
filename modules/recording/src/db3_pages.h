// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Rows of a damaged SQLite file, from the pages that hold them (https://www.sqlite.org/fileformat2.html): the
// tree above them, the list of tables and the file's own header need not be whole.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <vector>

#include "pcl_bv/io/posix_file.h"
#include "pcl_bv/recording/recording.h"

namespace pcl_bv {

class Db3Pages {
 public:
  /// A row of the table of messages, whose data may go on in other pages.
  struct Message {
    std::int64_t id = 0, topic = 0, time = 0;
    std::uint64_t data = 0;       ///< Where in the file they begin.
    std::uint64_t local = 0;      ///< How many of them are there.
    std::uint64_t size = 0;       ///< All of them.
    std::uint32_t next_page = 0;  ///< Where the others are, counted from 1.
  };

  /// Reads all pages that can hold rows. Throws IoError if the file cannot be read.
  explicit Db3Pages(const std::filesystem::path& file);

  const std::map<std::int64_t, RecordedTopic>& topics() const { return topics_; }
  const std::vector<Message>& messages() const { return messages_; }

  /// Replaces `to`. Throws IoError where the pages do not follow one another.
  void load(const Message& message, std::vector<std::byte>& to) const;

 private:
  void read_leaf(std::uint64_t page);
  void read_row(std::uint64_t page, std::uint64_t cell);

  InputFile file_;
  std::uint64_t page_size_ = 4096, usable_ = 4096;
  std::vector<std::byte> bytes_;  // of the page that is read
  std::map<std::int64_t, RecordedTopic> topics_;
  std::vector<Message> messages_;
};

}  // namespace pcl_bv
