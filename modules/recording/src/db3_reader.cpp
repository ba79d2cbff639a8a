// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Reads a .db3 file of rosbag2, which is a SQLite database with the tables topics and messages.

#include <sqlite3.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <map>
#include <memory>
#include <stdexcept>

#include "chunked_reader.h"
#include "db3_pages.h"
#include "formats.h"
#include "pcl_bv/io/raw_cloud.h"
#include "sqlite_error.h"

namespace pcl_bv::detail {
namespace {

// An error of SQLite.
class DatabaseError : public IoError {
 public:
  explicit DatabaseError(sqlite3* database)
      : IoError(sqlite_error_message(database)), code_(sqlite3_errcode(database) & 0xFF) {}
  bool is_damage() const { return code_ == SQLITE_CORRUPT || code_ == SQLITE_NOTADB; }

 private:
  int code_;
};

class Database {
 public:
  // Opens the file with its journal, which has the latest messages of a recording in progress. To read the
  // journal, SQLite must create files. If this is not possible, as on a read-only disk, opens the database
  // file alone.
  explicit Database(const std::filesystem::path& file) {
    if (open(file, "mode=ro") && works()) return;
    if (!open(file, "mode=ro&immutable=1") || !works()) fail();
  }

  [[noreturn]] void fail() const { throw DatabaseError(get()); }
  sqlite3* get() const { return database_.get(); }

 private:
  struct Close {
    void operator()(sqlite3* database) const { sqlite3_close(database); }
  };

  bool open(const std::filesystem::path& file, const char* options) {
    std::string uri = "file:";
    for (const char c : file.string()) {
      char code[4] = {c};
      if (c == '?' || c == '#' || c == '%')
        std::snprintf(code, sizeof code, "%%%02X", static_cast<unsigned>(c));
      uri += code;
    }
    sqlite3* database = nullptr;  // set even if opening fails; then it has the reason
    const int status = sqlite3_open_v2((uri + '?' + options).c_str(), &database,
                                       SQLITE_OPEN_READONLY | SQLITE_OPEN_URI, nullptr);
    database_.reset(database);
    return status == SQLITE_OK;
  }
  bool works() const {
    return sqlite3_exec(get(), "SELECT count(*) FROM topics", nullptr, nullptr, nullptr) == SQLITE_OK;
  }

  std::unique_ptr<sqlite3, Close> database_;
};

// The rows of a query. The member functions throw IoError if the file is damaged.
class Query {
 public:
  Query(const Database& database, const std::string& sql) : database_(database) {
    if (sqlite3_prepare_v2(database.get(), sql.c_str(), -1, &statement_, nullptr) != SQLITE_OK)
      database.fail();
  }
  ~Query() { sqlite3_finalize(statement_); }
  Query(const Query&) = delete;
  Query& operator=(const Query&) = delete;

  // Restarts the query with this number as the query's parameter.
  void begin(std::int64_t number) {
    sqlite3_reset(statement_);
    sqlite3_bind_int64(statement_, 1, number);
  }
  bool next() {
    const int status = sqlite3_step(statement_);
    if (status != SQLITE_ROW && status != SQLITE_DONE) database_.fail();
    return status == SQLITE_ROW;
  }
  std::int64_t number(int column) const { return sqlite3_column_int64(statement_, column); }
  std::string text(int column) const {
    const unsigned char* const text = sqlite3_column_text(statement_, column);
    return text == nullptr ? "" : reinterpret_cast<const char*>(text);
  }
  // Throws IoError if the overflow pages of the value are damaged.
  const std::byte* blob(int column, std::size_t& size) const {
    const void* const data = sqlite3_column_blob(statement_, column);
    size = static_cast<std::size_t>(sqlite3_column_bytes(statement_, column));
    const int status = sqlite3_errcode(database_.get());
    if (status != SQLITE_OK && status != SQLITE_ROW) database_.fail();
    return static_cast<const std::byte*>(data);
  }

 private:
  const Database& database_;
  sqlite3_stmt* statement_ = nullptr;
};

// A message. `id` is the message's row in the table or, for a damaged file, its index in
// Db3Pages::messages(). Db3Reader sorts the rows by time, because the database's index of times can be
// damaged.
struct Row {
  std::int64_t time = 0, id = 0;
  std::size_t topic = 0;
};

class Db3Reader final : public RecordingReader {
 public:
  explicit Db3Reader(const std::filesystem::path& file) {
    try {
      read_tables(file);
    } catch (const DatabaseError& error) {
      if (!error.is_damage()) throw;
      read_pages(file, error.what());
    }
    if (messages_without_topic_ > 0)
      add_warning(std::to_string(messages_without_topic_) + " messages of unknown topics are skipped");
    for (const Row& row : rows_)
      ++topics_.all()[row.topic].messages;
    std::stable_sort(rows_.begin(), rows_.end(), [](const Row& a, const Row& b) { return a.time < b.time; });
    wanted_.assign(topics().size(), true);
  }

  const std::vector<RecordedTopic>& topics() const override { return topics_.all(); }

  void select(const std::vector<std::size_t>& topics) override {
    std::vector<bool> wanted(topics_.all().size(), false);
    for (const std::size_t topic : topics)
      wanted.at(topic) = true;
    wanted_ = std::move(wanted);
    next_ = 0;
  }

  bool next(RecordedMessage& message) override {
    while (next_ < rows_.size()) {
      const Row& row = rows_[next_++];
      if (!wanted_[row.topic]) continue;
      message.topic = row.topic;
      message.log_time_ns = message.publish_time_ns = row.time;
      try {
        if (!load(row, message)) continue;
        unpack(message);
        return true;
      } catch (const IoError& error) {
        add_warning(error.what() + std::string(", in the message of ") + std::to_string(row.time));
      }
    }
    return false;
  }

 private:
  void read_tables(const std::filesystem::path& file) {
    database_ = std::make_unique<Database>(file);
    for (Query rows(*database_, "SELECT id, name, type, serialization_format FROM topics ORDER BY id");
         rows.next();)
      add(rows.number(0), {rows.text(1), ros2_type(rows.text(2)), rows.text(3)});
    for (Query rows(*database_, "SELECT id, topic_id, timestamp FROM messages NOT INDEXED ORDER BY id");
         rows.next();)
      add(rows.number(1), Row{rows.number(2), rows.number(0)});
    data_ = std::make_unique<Query>(*database_, "SELECT data FROM messages NOT INDEXED WHERE id = ?");
  }

  void read_pages(const std::filesystem::path& file, const std::string& problem) {
    topics_ = {};
    topic_of_.clear();
    rows_.clear();
    messages_without_topic_ = 0;
    pages_ = std::make_unique<Db3Pages>(file);
    for (const auto& [id, topic] : pages_->topics())
      add(id, topic);
    std::int64_t index = 0;
    for (const Db3Pages::Message& message : pages_->messages())
      add(message.topic, Row{message.time, index++});
    if (topics().empty()) throw IoError(problem);
    add_warning(problem + ": " + std::to_string(rows_.size()) +
                " messages were recovered; those on damaged pages are lost");
  }

  void add(std::int64_t id, const RecordedTopic& topic) { topic_of_[id] = topics_.add(topic); }
  void add(std::int64_t topic, Row row) {
    const auto found = topic_of_.find(topic);
    if (found == topic_of_.end()) {
      ++messages_without_topic_;
      return;
    }
    row.topic = found->second;
    rows_.push_back(row);
  }

  // Returns false if the row has been deleted in the meantime.
  bool load(const Row& row, RecordedMessage& message) {
    if (pages_) {
      pages_->load(pages_->messages()[static_cast<std::size_t>(row.id)], raw_);
      message.data = raw_.data();
      message.size = raw_.size();
      return true;
    }
    data_->begin(row.id);
    if (!data_->next()) return false;
    message.data = data_->blob(0, message.size);
    return true;
  }

  // Decompresses a message that begins with zstd's magic number, because rosbag2 can compress each message
  // separately. An uncompressed message in CDR never begins with this number.
  void unpack(RecordedMessage& message) {
    constexpr unsigned char zstd[] = {0x28, 0xB5, 0x2F, 0xFD};
    if (message.size < sizeof zstd || std::memcmp(message.data, zstd, sizeof zstd) != 0) return;
    decompressor_.decompress_zstd(message.data, message.size, unpacked_);
    message.data = unpacked_.data();
    message.size = unpacked_.size();
  }

  std::unique_ptr<Database> database_;
  std::unique_ptr<Query> data_;      // declared after the database, which must outlive it
  std::unique_ptr<Db3Pages> pages_;  // set only if the file is damaged; used instead of database_ and data_
  TopicList topics_;
  std::map<std::int64_t, std::size_t> topic_of_;
  std::uint64_t messages_without_topic_ = 0;
  std::vector<Row> rows_;  // sorted by time, equal times by id
  std::vector<bool> wanted_;
  std::size_t next_ = 0;
  Decompressor decompressor_;
  std::vector<std::byte> raw_, unpacked_;
};

}  // namespace

std::unique_ptr<RecordingReader> open_db3(const std::filesystem::path& file) {
  return std::make_unique<Db3Reader>(file);
}

}  // namespace pcl_bv::detail
