// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// MCAP files made record by record, also with a wrong summary.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "mcap_records.h"
#include "recording_files.h"

namespace pcl_bv {
using namespace detail;

// A file record by record; with a chunk where it is asked for.
class McapBuilder {
 public:
  McapBuilder() {
    writer_.bytes(mcap::kMagic.data(), mcap::kMagic.size());
    writer_.begin(mcap::Op::header);
    writer_.text("");
    writer_.text("made");
    writer_.end();
  }
  static void describe(mcap::Writer& writer, bool schema, bool channel) {
    if (schema) mcap::put(writer, mcap::Schema{1, "sensor_msgs/PointCloud2", "ros1msg", ""});
    if (channel) mcap::put(writer, mcap::Channel{5, 1, "/points", "ros1", {}});
  }
  static void message(mcap::Writer& writer, std::uint64_t time) {
    writer.begin(mcap::Op::message);
    writer.number(std::uint16_t{5});
    writer.number(std::uint32_t{0});
    writer.number(time);
    writer.number(time);
    writer.bytes("abc", 3);
    writer.end();
  }
  McapBuilder& chunk(const std::vector<std::uint64_t>& times, bool described, const char* compression = "") {
    std::vector<std::byte> records;
    mcap::Writer inside(records);
    describe(inside, described, described);
    for (const std::uint64_t time : times)
      message(inside, time);
    mcap::ChunkIndex& index = chunks_.emplace_back();
    index.first_time = times.front();
    index.last_time = times.back();
    index.offset = bytes_.size();
    writer_.begin(mcap::Op::chunk);
    writer_.number(index.first_time);
    writer_.number(index.last_time);
    writer_.number(static_cast<std::uint64_t>(records.size()));
    writer_.number(std::uint32_t{0});
    writer_.text(compression);
    writer_.number(static_cast<std::uint64_t>(records.size()));
    writer_.bytes(records.data(), records.size());
    writer_.end();
    index.bytes = bytes_.size() - index.offset;
    return *this;
  }
  // An entry of the summary for a chunk that is not there.
  McapBuilder& index(std::uint64_t offset, std::uint64_t bytes) {
    chunks_.push_back({1, 1, offset, bytes, {}, 0, "", 0, 0});
    return *this;
  }
  McapBuilder& loose(std::uint64_t time) {
    message(writer_, time);
    return *this;
  }
  McapBuilder& described() {
    describe(writer_, true, true);
    return *this;
  }
  McapBuilder& junk(const std::string& text) {
    writer_.bytes(text.data(), text.size());
    return *this;
  }
  std::string without_summary() const {
    return {reinterpret_cast<const char*>(bytes_.data()), bytes_.size()};
  }
  // The summary says what it is told, true or not.
  std::string closed(bool schema, bool channel, const mcap::Statistics* statistics) {
    writer_.begin(mcap::Op::data_end);
    writer_.number(std::uint32_t{0});
    writer_.end();
    const std::uint64_t start = bytes_.size();
    describe(writer_, schema, channel);
    for (const mcap::ChunkIndex& index : chunks_)
      mcap::put(writer_, index);
    if (statistics != nullptr) mcap::put(writer_, *statistics);
    writer_.begin(mcap::Op::footer);
    writer_.number(start);
    writer_.number(std::uint64_t{0});
    writer_.number(std::uint32_t{0});
    writer_.end();
    writer_.bytes(mcap::kMagic.data(), mcap::kMagic.size());
    return without_summary();
  }

 private:
  std::vector<std::byte> bytes_;
  mcap::Writer writer_{bytes_};
  std::vector<mcap::ChunkIndex> chunks_;
};

inline std::vector<std::int64_t> times_of(RecordingReader& reader) {
  std::vector<std::int64_t> times;
  for (const Sent& sent : all_of(reader))
    times.push_back(sent.log_time);
  return times;
}

}  // namespace pcl_bv
