// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/recording/rosbag2_writer.h"

#include <sqlite3.h>
#include <unistd.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

#include "pcl_bv/io/atomic_file.h"
#include "pcl_bv/io/growing_file.h"
#include "pcl_bv/io/raw_cloud.h"
#include "sqlite_error.h"

namespace pcl_bv::detail {
namespace {

namespace fs = std::filesystem;

// The tables have Humble's schema version 3. Writes are not synchronous. A crash of the process loses at most
// the last transaction, but a power failure can lose more.
constexpr const char* kBegin = R"(
PRAGMA journal_mode = WAL;
PRAGMA synchronous = OFF;
CREATE TABLE schema(schema_version INTEGER PRIMARY KEY, ros_distro TEXT NOT NULL);
INSERT INTO schema VALUES(3, 'humble');
CREATE TABLE metadata(id INTEGER PRIMARY KEY, metadata_version INTEGER NOT NULL, metadata TEXT NOT NULL);
CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT NOT NULL, type TEXT NOT NULL,
  serialization_format TEXT NOT NULL, offered_qos_profiles TEXT NOT NULL);
CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER NOT NULL, timestamp INTEGER NOT NULL,
  data BLOB NOT NULL);
CREATE INDEX timestamp_idx ON messages (timestamp ASC);
)";

// Minimum duration of a transaction.
constexpr std::chrono::milliseconds kMinTransaction{50};

// Returns the folder's name, such as "bag" for "bag" and "bag/".
std::string name_of(const fs::path& folder) {
  const fs::path whole = fs::absolute(folder).lexically_normal();
  return (whole.has_filename() ? whole : whole.parent_path()).filename().string();
}

// Numbers become text here, because yaml-cpp would follow the locale of the program, such as 1.000 for 1000.
YAML::Node nanoseconds(const char* name, std::int64_t value) {
  YAML::Node node;
  node[name] = std::to_string(value);
  return node;
}

}  // namespace

class Rosbag2Writer::State {
 public:
  explicit State(const fs::path& folder) : folder_(folder), file_(name_of(folder) + "_0.db3") {
    create_folder(folder);
    if (::access(folder_.c_str(), W_OK | X_OK) != 0) throw IoError(system_reason(errno));
    lock_ = lock_folder(folder_, true);
  }
  ~State() { release(); }
  State(const State&) = delete;
  State& operator=(const State&) = delete;

  // Replaces an existing recording. open() is called at the first message, attachment or close(), so that a
  // writer that is never used leaves the old recording unchanged.
  void open() {
    if (database_ != nullptr) return;
    if (closed_) throw IoError("the recording is closed");
    std::error_code unknown;
    for (const char* more : {"", "-wal", "-shm"})
      fs::remove(folder_ / (file_ + more), unknown);
    fs::remove(folder_ / "metadata.yaml", unknown);
    if (sqlite3_open((folder_ / file_).c_str(), &database_) != SQLITE_OK) {
      const std::string why = sqlite_error_message(database_);
      sqlite3_close(std::exchange(database_, nullptr));
      throw IoError(why);
    }
    try {
      run(kBegin);
      prepare("INSERT INTO topics VALUES(?, ?, ?, 'cdr', ?)", &topic_);
      prepare("INSERT INTO messages(topic_id, timestamp, data) VALUES(?, ?, ?)", &message_);
      for (std::size_t number = 0; number < topics_.size(); ++number)
        insert(number);
    } catch (const IoError&) {
      release();
      throw;
    }
  }
  bool has_begun() const { return database_ != nullptr; }

  std::size_t add_topic(const WrittenTopic& topic) {
    if (topics_.size() == std::numeric_limits<std::uint16_t>::max())
      throw std::length_error("a recording of more than 65535 topics");
    const auto qos = topic.metadata.find("offered_qos_profiles");
    topics_.push_back({topic.name, topic.type, qos == topic.metadata.end() ? "" : qos->second, 0});
    if (has_begun()) insert(topics_.size() - 1);
    return topics_.size() - 1;
  }

  void write(std::size_t number, std::int64_t time, const std::byte* data, std::size_t size) {
    Topic& topic = topics_.at(number);
    if (size > static_cast<std::size_t>(std::numeric_limits<int>::max()))
      throw IoError("a message of 2 GiB or more");
    open();
    begin();
    const std::size_t id = number + 1;
    sqlite3_bind_int64(message_, 1, static_cast<sqlite3_int64>(id));
    sqlite3_bind_int64(message_, 2, time);
    sqlite3_bind_blob(message_, 3, size == 0 ? "" : static_cast<const void*>(data), static_cast<int>(size),
                      SQLITE_STATIC);
    step(message_);
    ++topic.messages;
    first_ = std::min(first_, time);
    last_ = std::max(last_, time);
    if (Clock::now() - begun_ >= kMinTransaction) commit();
  }

  void attach(const std::string& name, const std::string& content) {
    open();
    write_file_atomically(folder_ / fs::path(name).filename(), content);
  }

  void close() {
    if (closed_) return;
    open();
    closed_ = true;
    commit();
    run("PRAGMA journal_mode = DELETE");  // moves all data into the database file
    release();
    write_file_atomically(folder_ / "metadata.yaml", metadata());
  }

 private:
  using Clock = std::chrono::steady_clock;
  struct Topic {
    std::string name, type, qos;
    std::uint64_t messages;
  };

  [[noreturn]] void fail() const { throw IoError(sqlite_error_message(database_)); }
  void run(const char* sql) {
    if (sqlite3_exec(database_, sql, nullptr, nullptr, nullptr) != SQLITE_OK) fail();
  }
  void prepare(const char* sql, sqlite3_stmt** statement) {
    if (sqlite3_prepare_v2(database_, sql, -1, statement, nullptr) != SQLITE_OK) fail();
  }
  static void bind(sqlite3_stmt* statement, int parameter, const std::string& text) {
    sqlite3_bind_text(statement, parameter, text.data(), static_cast<int>(text.size()), SQLITE_STATIC);
  }
  void step(sqlite3_stmt* statement) {
    const bool done = sqlite3_step(statement) == SQLITE_DONE;
    const std::string why = done ? "" : sqlite_error_message(database_);
    sqlite3_reset(statement);
    if (!done) throw IoError(why);
  }
  void insert(std::size_t number) {
    const Topic& topic = topics_[number];
    sqlite3_bind_int64(topic_, 1, static_cast<sqlite3_int64>(number) + 1);
    bind(topic_, 2, topic.name);
    bind(topic_, 3, topic.type);
    bind(topic_, 4, topic.qos);
    step(topic_);
  }
  void begin() {
    if (sqlite3_get_autocommit(database_) == 0) return;
    run("BEGIN");
    begun_ = Clock::now();
  }
  void commit() {
    if (sqlite3_get_autocommit(database_) == 0) run("COMMIT");
  }
  void release() {
    sqlite3_finalize(std::exchange(topic_, nullptr));
    sqlite3_finalize(std::exchange(message_, nullptr));
    sqlite3_close(std::exchange(database_, nullptr));
  }

  std::string metadata() const {
    std::uint64_t messages = 0;
    YAML::Node info, topics(YAML::NodeType::Sequence);
    for (const Topic& topic : topics_) {
      YAML::Node entry, about;
      about["name"] = topic.name;
      about["type"] = topic.type;
      about["serialization_format"] = "cdr";
      about["offered_qos_profiles"] = topic.qos;
      entry["topic_metadata"] = about;
      entry["message_count"] = std::to_string(topic.messages);
      topics.push_back(entry);
      messages += topic.messages;
    }
    const auto begins = [&] {
      return nanoseconds("nanoseconds_since_epoch", messages > 0 ? first_ : 0);
    };  // a new node each time, because yaml-cpp writes a shared node as an alias
    const auto lasts = [&] { return nanoseconds("nanoseconds", messages > 0 ? last_ - first_ : 0); };
    YAML::Node part;
    part["path"] = file_;
    part["starting_time"] = begins();
    part["duration"] = lasts();
    part["message_count"] = std::to_string(messages);
    info["version"] = 5;
    info["storage_identifier"] = "sqlite3";
    info["duration"] = lasts();
    info["starting_time"] = begins();
    info["message_count"] = std::to_string(messages);
    info["topics_with_message_count"] = topics;
    info["compression_format"] = "";
    info["compression_mode"] = "";
    info["relative_file_paths"].push_back(file_);
    info["files"].push_back(part);
    YAML::Node root;
    root["rosbag2_bagfile_information"] = info;
    YAML::Emitter emitter;
    emitter << root;
    return std::string(emitter.c_str()) + '\n';
  }

  fs::path folder_;
  std::shared_ptr<const FileDescriptor> lock_;
  std::string file_;
  bool closed_ = false;
  sqlite3* database_ = nullptr;  // null before open()
  sqlite3_stmt *topic_ = nullptr, *message_ = nullptr;
  std::vector<Topic> topics_;
  Clock::time_point begun_{};
  std::int64_t first_ = std::numeric_limits<std::int64_t>::max(),
               last_ = std::numeric_limits<std::int64_t>::min();
};

Rosbag2Writer::Rosbag2Writer(const fs::path& folder) : state_(std::make_unique<State>(folder)) {}

Rosbag2Writer::~Rosbag2Writer() {
  try {
    if (state_->has_begun()) state_->close();
  } catch (const std::exception&) {  // a destructor cannot report errors
  }
}

std::size_t Rosbag2Writer::add_topic(const WrittenTopic& topic) {
  return state_->add_topic(topic);
}
void Rosbag2Writer::write(std::size_t topic, std::int64_t log_time_ns, std::int64_t /*publish_time_ns*/,
                          const std::byte* data, std::size_t size) {
  state_->write(topic, log_time_ns, data, size);
}
void Rosbag2Writer::attach(const std::string& name, const std::string& /*media_type*/,
                           const std::string& content, std::int64_t /*log_time_ns*/) {
  state_->attach(name, content);
}
void Rosbag2Writer::close() {
  state_->close();
}

}  // namespace pcl_bv::detail
