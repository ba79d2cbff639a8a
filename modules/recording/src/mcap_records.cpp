// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "mcap_records.h"

namespace pcl_bv::detail {
namespace mcap {
namespace {

// The functions walk_...() visit the fields of a record in the order of the file. Put and Take use them.
template <class Visit, class S>
void walk_schema(S& m, Visit&& visit) {
  visit(m.id, m.name, m.encoding, m.data);
}
template <class Visit, class C>
void walk_channel(C& m, Visit&& visit) {
  visit(m.id, m.schema, m.topic, m.encoding, m.metadata);
}
template <class Visit, class C>
void walk_chunk_index(C& m, Visit&& visit) {
  visit(m.first_time, m.last_time, m.offset, m.bytes, m.indexes, m.index_bytes, m.compression, m.compressed,
        m.uncompressed);
}
template <class Visit, class S>
void walk_statistics(S& m, Visit&& visit) {
  visit(m.messages, m.schemas, m.channels, m.attachments, m.metadata, m.chunks, m.first_time, m.last_time,
        m.channel_messages);
}

struct Put {
  Writer& writer;

  template <class... All>
  void operator()(const All&... all) {
    (one(all), ...);
  }
  void one(const std::string& text) { writer.text(text); }
  template <class Key, class Value>
  void one(const std::map<Key, Value>& map) {
    writer.list([&] {
      for (const auto& [key, value] : map) {
        one(key);
        one(value);
      }
    });
  }
  template <class T>
  void one(const T& value) {
    writer.number(value);
  }
};

struct Take {
  Fields& fields;

  template <class... All>
  void operator()(All&... all) {
    (one(all), ...);
  }
  void one(std::string& text) { text = fields.text(); }
  template <class Key, class Value>
  void one(std::map<Key, Value>& map) {
    Fields list = fields.list();
    map.clear();
    while (list.left() > 0) {
      Key key{};
      Take{list}.one(key);
      Take{list}.one(map[key]);
    }
  }
  template <class T>
  void one(T& value) {
    value = fields.number<T>();
  }
};

}  // namespace

void put(Writer& writer, const Schema& schema) {
  writer.begin(Op::schema);
  walk_schema(schema, Put{writer});
  writer.end();
}
void put(Writer& writer, const Channel& channel) {
  writer.begin(Op::channel);
  walk_channel(channel, Put{writer});
  writer.end();
}
void put(Writer& writer, std::uint16_t channel, const std::vector<MessageTime>& index) {
  writer.begin(Op::message_index);
  writer.number(channel);
  writer.list([&] {
    for (const auto& [time, offset] : index) {
      writer.number(time);
      writer.number(offset);
    }
  });
  writer.end();
}
void put(Writer& writer, const ChunkIndex& index) {
  writer.begin(Op::chunk_index);
  walk_chunk_index(index, Put{writer});
  writer.end();
}
void put(Writer& writer, const AttachmentIndex& index) {
  writer.begin(Op::attachment_index);
  Put{writer}(index.offset, index.bytes, index.log_time, index.create_time, index.size, index.name,
              index.media_type);
  writer.end();
}
void put(Writer& writer, const Statistics& statistics) {
  writer.begin(Op::statistics);
  walk_statistics(statistics, Put{writer});
  writer.end();
}

void take(Fields fields, Schema& schema) {
  walk_schema(schema, Take{fields});
}
void take(Fields fields, Channel& channel) {
  walk_channel(channel, Take{fields});
}
void take(Fields fields, ChunkIndex& index) {
  walk_chunk_index(index, Take{fields});
}
void take(Fields fields, Statistics& statistics) {
  walk_statistics(statistics, Take{fields});
}

}  // namespace mcap
}  // namespace pcl_bv::detail
