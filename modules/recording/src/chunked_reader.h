// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// What formats have in common whose messages lie in chunks: chunks whose times overlap are held side by side,
// and the earliest message of all is given.
#pragma once

#include <memory>
#include <vector>

#include "codecs.h"
#include "pcl_bv/recording/recording.h"

namespace pcl_bv {

class ChunkedReader : public RecordingReader {
 public:
  const std::vector<RecordedTopic>& topics() const override { return topics_; }
  void select(const std::vector<std::size_t>& topics) override;
  bool next(RecordedMessage& message) override;

 protected:
  /// A chunk, or messages that lie together.
  struct Part {
    std::uint64_t offset = 0;
    std::int64_t first_time_ns = 0;
    std::vector<std::size_t> topics{};  ///< Of its messages; if empty, nobody says.
  };
  /// What a part's messages look into.
  struct Buffers {
    std::vector<std::byte> raw, unpacked;
    Decompressor decompressor;
  };

  /// Called once, before anything else; parts as they lie in the file.
  void start(std::vector<RecordedTopic> topics, std::vector<Part> parts);

  /// Appends the messages of a part whose topics are wanted(), in their order in the file. Throws IoError for
  /// a part that is damaged: what comes behind those that it has appended is passed over.
  virtual void load(std::size_t part, Buffers& buffers, std::vector<RecordedMessage>& messages) = 0;

  bool wanted(std::size_t topic) const { return wanted_[topic]; }
  std::uint64_t part_offset(std::size_t part) const { return parts_[part].offset; }

 private:
  struct Loaded {
    std::size_t part = 0, next = 0;
    std::vector<RecordedMessage> messages;  // by time
    Buffers buffers;
  };

  Loaded* earliest() const;
  void release();
  void load_next();

  std::vector<RecordedTopic> topics_;
  std::vector<Part> parts_;
  std::vector<bool> wanted_;
  std::vector<std::size_t> order_;  // of the parts, by their first times
  std::size_t next_part_ = 0;
  std::vector<std::unique_ptr<Loaded>> loaded_, spare_;
};

/// The place of the topic in the list, at its end if it is new; its messages are added to those of the same
/// name, type and encoding, which several senders have.
std::size_t add_topic(std::vector<RecordedTopic>& topics, const RecordedTopic& topic);

}  // namespace pcl_bv
