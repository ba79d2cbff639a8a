// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Base class of readers for formats that store messages in chunks. Messages are returned in the order of
// time, so chunks with overlapping times are in memory at the same time.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include "chunk_cache.h"
#include "codecs.h"
#include "pcl_bv/recording/recording.h"

namespace pcl_bv::detail {

class ChunkedReader : public RecordingReader {
 public:
  const std::vector<RecordedTopic>& topics() const override { return topics_; }
  void select(const std::vector<std::size_t>& topics) override;
  bool next(RecordedMessage& message) override;

 protected:
  /// A chunk, or a run of messages outside of chunks.
  struct Part {
    std::uint64_t offset = 0;           ///< Position in the file.
    std::int64_t first_time_ns = 0;     ///< Time of the part's earliest message.
    std::vector<std::size_t> topics{};  ///< Topics of the part's messages; empty if unknown.
  };
  /// Memory that the messages of a loaded part refer to.
  struct Buffers {
    std::vector<std::byte> raw, unpacked;
    UnpackedChunk shared;

    std::size_t bytes() const { return raw.size() + unpacked.size() + (shared ? shared->size() : 0); }
  };

  /// Sets the topics, and the parts in the order of the file. Must be called once, before all other
  /// functions.
  void start(std::vector<RecordedTopic> topics, std::vector<Part> parts);

  /// Appends those messages of a part whose topic is wanted(), in the order of the file. Throws IoError for a
  /// damaged part. The messages appended before the exception are used, and the rest of the part is skipped.
  virtual void load(std::size_t part, Buffers& buffers, std::vector<RecordedMessage>& messages) = 0;

  /// Returns whether the topic is selected.
  bool wanted(std::size_t topic) const { return wanted_[topic]; }
  std::uint64_t part_offset(std::size_t part) const { return parts_[part].offset; }
  /// For load(). It is not a member of Buffers, because it takes 160 kB, more than many small chunks.
  Decompressor& decompressor() { return decompressor_; }

 private:
  struct LoadedPart {
    std::size_t part = 0, next = 0;         // index of the part, and index in `messages` of its next message
    std::vector<RecordedMessage> messages;  // sorted by time
    Buffers buffers;

    std::int64_t time() const { return messages[next].log_time_ns; }
  };

  static bool is_later(const std::unique_ptr<LoadedPart>& a, const std::unique_ptr<LoadedPart>& b);
  void put_back();
  void load_next();
  void push(std::unique_ptr<LoadedPart> part);

  std::vector<RecordedTopic> topics_;
  std::vector<Part> parts_;
  std::vector<bool> wanted_;
  std::vector<std::size_t> order_;  // indices of the parts, sorted by first_time_ns
  std::size_t next_part_ = 0;
  // A heap: first the part with the earliest next message or, if times are equal, the first in the file.
  std::vector<std::unique_ptr<LoadedPart>> loaded_;
  std::unique_ptr<LoadedPart> current_;  // has the message that next() returned; not in loaded_
  std::vector<std::unique_ptr<LoadedPart>> spare_;
  std::size_t loaded_bytes_ = 0;  // of loaded_ and current_
  Decompressor decompressor_;
};

/// The topics of a recording. If several senders have topics of the same name, type and encoding, these
/// become one topic, whose number of messages is the sum.
class TopicList {
 public:
  /// Returns the index of the topic, which is appended if it is new. O(log n).
  std::size_t add(const RecordedTopic& topic);

  std::vector<RecordedTopic>& all() { return topics_; }
  const std::vector<RecordedTopic>& all() const { return topics_; }

 private:
  std::vector<RecordedTopic> topics_;
  std::map<std::tuple<std::string, std::string, std::string>, std::size_t> numbers_;
};

}  // namespace pcl_bv::detail
