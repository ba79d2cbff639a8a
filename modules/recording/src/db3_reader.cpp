// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// One file of rosbag2's SQLite storage: the tables topics and messages.

#include <sqlite3.h>

#include <cstring>
#include <map>
#include <memory>
#include <stdexcept>

#include "chunked_reader.h"
#include "formats.h"
#include "pcl_bv/io/io_error.h"
#include "sqlite_problem.h"

namespace pcl_bv {
namespace {

class Database {
 public:
  // Beside a file that is still written to its journal must be read, too; where that cannot be made, as on a
  // disc that is read-only, the file alone.
  explicit Database(const std::filesystem::path& file) {
    if (open(file, "mode=ro") && works()) return;
    if (!open(file, "mode=ro&immutable=1") || !works()) fail();
  }

  [[noreturn]] void fail() const { throw IoError(sqlite_problem(get())); }
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
    sqlite3* database = nullptr;  // given even where opening fails, for the reason
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

// Rows of a query. Throws IoError where the file is damaged.
class Query {
 public:
  Query(const Database& database, const std::string& sql) : database_(database) {
    if (sqlite3_prepare_v2(database.get(), sql.c_str(), -1, &statement_, nullptr) != SQLITE_OK)
      database.fail();
  }
  ~Query() { sqlite3_finalize(statement_); }
  Query(const Query&) = delete;
  Query& operator=(const Query&) = delete;

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
  const std::byte* blob(int column, std::size_t& size) const {
    const void* const data = sqlite3_column_blob(statement_, column);
    size = static_cast<std::size_t>(sqlite3_column_bytes(statement_, column));
    return static_cast<const std::byte*>(data);
  }

 private:
  const Database& database_;
  sqlite3_stmt* statement_ = nullptr;
};

class Db3Reader final : public RecordingReader {
 public:
  explicit Db3Reader(const std::filesystem::path& file) : database_(file) {
    std::map<std::int64_t, std::uint64_t> counts;
    for (Query rows(database_, "SELECT topic_id, count(*) FROM messages GROUP BY topic_id"); rows.next();)
      counts[rows.number(0)] = static_cast<std::uint64_t>(rows.number(1));
    for (Query rows(database_, "SELECT id, name, type, serialization_format FROM topics ORDER BY id");
         rows.next();) {
      const std::int64_t id = rows.number(0);
      topic_of_[id] = add_topic(topics_, {rows.text(1), ros2_type(rows.text(2)), rows.text(3), counts[id]});
    }
    start(std::vector<bool>(topics_.size(), true));
  }

  const std::vector<RecordedTopic>& topics() const override { return topics_; }

  void select(const std::vector<std::size_t>& topics) override {
    std::vector<bool> wanted(topics_.size(), false);
    for (const std::size_t topic : topics)
      wanted.at(topic) = true;
    start(wanted);
  }

  bool next(RecordedMessage& message) override {
    while (rows_) {
      try {
        if (!rows_->next()) break;
        message.topic = topic_of_.at(rows_->number(0));
        message.log_time_ns = message.publish_time_ns = rows_->number(1);
        message.data = rows_->blob(2, message.size);
        unpack(message);
        return true;
      } catch (const IoError& error) {
        remark(error.what() + std::string(", after the message of ") + std::to_string(message.log_time_ns));
        if (sqlite3_errcode(database_.get()) != SQLITE_ROW) break;  // the file; else only the message
      }
    }
    rows_.reset();
    return false;
  }

 private:
  void start(const std::vector<bool>& wanted) {
    std::string ids;
    for (const auto& [id, topic] : topic_of_) {
      if (wanted[topic]) ids += (ids.empty() ? "" : ",") + std::to_string(id);
    }
    rows_ = std::make_unique<Query>(
        database_, "SELECT topic_id, timestamp, data FROM messages WHERE topic_id IN (" + ids +
                       ") ORDER BY timestamp, id");
  }

  // rosbag2 can compress each message; CDR never begins as a frame of zstd does.
  void unpack(RecordedMessage& message) {
    constexpr unsigned char zstd[] = {0x28, 0xB5, 0x2F, 0xFD};
    if (message.size < sizeof zstd || std::memcmp(message.data, zstd, sizeof zstd) != 0) return;
    decompressor_.decompress_zstd(message.data, message.size, unpacked_);
    message.data = unpacked_.data();
    message.size = unpacked_.size();
  }

  Database database_;
  std::vector<RecordedTopic> topics_;
  std::map<std::int64_t, std::size_t> topic_of_;
  std::unique_ptr<Query> rows_;  // after the database, which must outlive it
  Decompressor decompressor_;
  std::vector<std::byte> unpacked_;
};

}  // namespace

std::unique_ptr<RecordingReader> open_db3(const std::filesystem::path& file) {
  return std::make_unique<Db3Reader>(file);
}

}  // namespace pcl_bv
