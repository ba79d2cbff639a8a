// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include <yaml-cpp/yaml.h>

#include <cmath>
#include <map>
#include <set>
#include <sstream>
#include <stdexcept>
#include <type_traits>

#include "check.h"
#include "names.h"
#include "pcl_bv/io/number_text.h"
#include "pcl_bv/io/untrusted_text.h"
#include "pcl_bv/io/yaml_error.h"
#include "rows.h"
#include "settings.h"

namespace pcl_bv {
using namespace detail;
namespace {

// Line numbers of keys in the file, from 1. 0 means that the key is not in the file.
using Lines = std::map<std::string, int>;

// Maximum number of keys, of rows, and of entries of a list in a row.
constexpr std::size_t kMaxEntries = 4096;

// `what` may quote keys and values of the file, which may be a megabyte long and contain line ends.
[[noreturn]] void fail(const std::string& name, int line, const std::string& what) {
  const std::string where = line > 0 ? ": line " + std::to_string(line) : "";
  throw ConfigError(message_line(name.empty() ? what : name + where + ": " + what));
}

// Reads a number with a decimal point in every locale. yaml-cpp follows the locale of the program, but knows
// ".inf" and ".nan".
bool read_yaml_number(const YAML::Node& node, double& value) {
  if (!node.IsScalar()) return false;
  const std::string& text = node.Scalar();
  if (text.find_first_of("nN") != std::string::npos) return YAML::convert<double>::decode(node, value);
  const char* const end = text.data() + text.size();
  return parse_number(text.data(), end, value) == end && std::isfinite(value);
}

// Returns the unit of a number, to be appended to errors. For other types, returns an empty text, because
// their errors list the allowed names.
template <typename T>
std::string in_unit(const Setting& setting) {
  constexpr bool number = std::is_same_v<T, double> || std::is_same_v<T, std::optional<double>> ||
                          std::is_same_v<T, std::size_t> || std::is_same_v<T, std::optional<std::size_t>>;
  return number && !setting.unit.empty() ? " (" + std::string(setting.unit) + ")" : "";
}

class Reader {
 public:
  Reader(const YAML::Node& root, std::string name) : name_(std::move(name)) { add_keys(root, ""); }

  template <typename T>
  void operator()(const Setting& setting, T& value) {
    const YAML::Node* const node = take(std::string(setting.key));
    if (node == nullptr) return;
    try {
      read(setting, *node, value);
    } catch (const std::invalid_argument& error) {
      fail(name_, line(*node), std::string(setting.key) + ": " + error.what() + in_unit<T>(setting));
    }
  }

  template <ConfigRow Row>
  void operator()(const Setting& setting, std::vector<Row>& rows) {
    const YAML::Node* const list = take(std::string(setting.key));
    if (list == nullptr) return;
    rows.clear();
    require_few(*list, std::string(setting.key));
    const std::string key = std::string(setting.key) + ": ";
    constexpr RowNames names = row_names<Row>();
    if (!list->IsSequence()) fail_at(*list, key + shown(*list) + " is not a list of " + names.many);
    for (const YAML::Node& element : *list) {
      if (!element.IsMap())
        fail_at(element, key + shown(element) + " is not " + names.one + ", " + names.example);
      read_row(element, key, rows.emplace_back());
    }
  }

  // Rejects keys that no setting has taken. Called after all settings have been visited.
  void finish() const {
    for (const auto& [key, line_number] : maps_) {
      if (sections_.count(key) == 0)
        fail(name_, line_number, "unknown key '" + key + "', or a key without nested keys");
    }
    for (const auto& [key, node] : nodes_) {
      if (node.IsNull() && sections_.count(key) > 0) continue;  // an empty stage
      if (lines_.count(key) == 0) fail(name_, line(node), "unknown key '" + key + "'");
    }
  }

  void reject(const std::vector<ConfigProblem>& problems) const {
    if (problems.empty()) return;
    const auto found = lines_.find(problems.front().key);
    fail(name_, found == lines_.end() ? 0 : found->second,
         problems.front().key + ": " + problems.front().what);
  }

 private:
  static int line(const YAML::Node& node) { return node.Mark().line + 1; }

  void add_keys(const YAML::Node& node, const std::string& prefix) {
    if (node.IsNull()) return;
    if (!node.IsMap()) fail(name_, line(node), "the document must consist of keys and values");
    for (const auto& item : node) {
      const std::string name = item.first.as<std::string>();
      std::string key = prefix;
      if (!prefix.empty()) key += '.';
      key += name;
      if (name.find('.') != std::string::npos) fail(name_, line(item.first), "unknown key '" + key + "'");
      if (prefix.empty() && item.second.IsMap()) {
        if (!maps_.emplace(key, line(item.first)).second)
          fail(name_, line(item.first), key + ": is given twice");
        add_keys(item.second, key);
      } else if (!nodes_.emplace(key, item.second).second) {
        fail(name_, line(item.first), key + ": is given twice");
      }
      if (nodes_.size() + maps_.size() > kMaxEntries)
        fail(name_, line(item.first), "has more than " + std::to_string(kMaxEntries) + " keys");
    }
  }

  template <ConfigRow Row>
  void read_row(const YAML::Node& node, const std::string& where, Row& row) const {
    std::map<std::string, YAML::Node> fields;
    require_few(node, where.substr(0, where.size() - 2));
    for (const auto& item : node) {
      const auto key = item.first.as<std::string>();
      if (!fields.emplace(key, item.second).second) fail_at(item.first, where + key + ": is given twice");
    }
    if (std::is_same_v<Row, ClassConfig> && fields.count("value") == 0)
      fail_at(node, where + "a class lacks the key 'value'");
    visit_row(row, [&](const Setting& field, auto& value) {
      const auto found = fields.find(std::string(field.key));
      if (found == fields.end()) return;
      try {
        read(field, found->second, value);
      } catch (const std::invalid_argument& error) {
        fail_at(found->second, where + found->first + ": " + error.what());
      }
      fields.erase(found);
    });
    if (fields.empty()) return;
    const auto& [key, value] = *fields.begin();
    fail_at(value, where + "unknown key '" + key + "' of " + row_names<Row>().one);
  }

  // An alias repeats a list of any length with a few bytes.
  void require_few(const YAML::Node& list, const std::string& key) const {
    if (list.size() > kMaxEntries)
      fail_at(list, key + ": has more than " + std::to_string(kMaxEntries) + " entries");
  }

  [[noreturn]] void fail_at(const YAML::Node& node, const std::string& what) const {
    fail(name_, line(node), what);
  }

  // Returns the node of a key, or null, and marks the key as known.
  const YAML::Node* take(const std::string& key) {
    if (key.find('.') != std::string::npos) sections_.insert(key.substr(0, key.find('.')));
    const auto found = nodes_.find(key);
    if (found == nodes_.end()) return nullptr;
    lines_[key] = line(found->second);
    return &found->second;
  }

  template <typename T>
  static void read(const Setting& setting, const YAML::Node& node, T& value) {
    read_setting(setting, node.IsNull() ? "null" : scalar(node), value);
  }
  static void read(const Setting& /*any*/, const YAML::Node& node, double& value) {
    if (!read_yaml_number(node, value)) reject(node, "a number");
  }
  static void read(const Setting& /*any*/, const YAML::Node& node, bool& value) {
    if (!YAML::convert<bool>::decode(node, value)) reject(node, "true or false");  // accepts yes and no, too
  }
  static void read(const Setting& setting, const YAML::Node& node, std::optional<double>& value) {
    value.reset();
    if (!node.IsNull()) read(setting, node, value.emplace());
  }
  static void read(const Setting& /*any*/, const YAML::Node& node, std::optional<Eigen::Vector3d>& value) {
    read_text(node.IsNull() ? "null" : elements(node, "a list of three numbers or null"), value);
  }
  static void read(const Setting& /*any*/, const YAML::Node& node, std::optional<UprightSize>& value) {
    read_text(node.IsNull() ? "null" : elements(node, "a list of three numbers or null"), value);
  }
  static void read(const Setting& /*any*/, const YAML::Node& node, Eigen::Vector3d& value) {
    read_text(node.IsSequence() ? elements(node, "") : scalar(node), value);
  }
  static void read(const Setting& /*any*/, const YAML::Node& node, std::string& text) {
    text = node.IsNull() ? "" : scalar(node);
  }
  static void read(const Setting& /*any*/, const YAML::Node& node, std::vector<double>& numbers) {
    if (!node.IsSequence()) reject(node, "a list of numbers");
    if (node.size() > kMaxEntries)
      throw std::invalid_argument("has more than " + std::to_string(kMaxEntries) + " entries");
    numbers.clear();
    for (const YAML::Node& element : node)
      if (!read_yaml_number(element, numbers.emplace_back())) reject(element, "a number");
  }
  static void read(const Setting& /*any*/, const YAML::Node& node, std::filesystem::path& file) {
    file = scalar(node);
  }
  static void read(const Setting& /*any*/, const YAML::Node& node, std::int64_t& value) {
    if (!node.IsScalar() || !read_whole_text(node.Scalar(), value)) reject(node, "a whole number");
  }
  static void read(const Setting& /*any*/, const YAML::Node& node, std::vector<std::string>& names) {
    const std::string list = elements(node, "a list of methods");
    names.clear();
    if (!list.empty()) read_text(list, names);
  }

  [[noreturn]] static void reject(const YAML::Node& node, const std::string& allowed) {
    throw std::invalid_argument(shown(node) + " is not " + allowed);
  }

  static std::string shown(const YAML::Node& node) {
    return node.IsScalar() ? "'" + node.Scalar() + "'" : "the value";
  }

  static std::string scalar(const YAML::Node& node) {
    if (!node.IsScalar()) reject(node, "a single value");
    return node.Scalar();
  }

  static std::string elements(const YAML::Node& node, const std::string& allowed) {
    if (!node.IsSequence()) reject(node, allowed);
    if (node.size() > kMaxEntries)
      throw std::invalid_argument("has more than " + std::to_string(kMaxEntries) + " entries");
    std::string list;
    for (const YAML::Node& element : node)
      list += (list.empty() ? "" : ",") + scalar(element);
    return list;
  }

  std::string name_;
  std::map<std::string, YAML::Node> nodes_;
  Lines lines_;
  std::set<std::string> sections_;
  Lines maps_;
};

// Stores the line where the last document begins.
class DocumentStart final : public YamlCounter {
 public:
  int line = 0;  // from 1

  void OnDocumentStart(const YAML::Mark& mark) override { line = mark.line + 1; }
};

// Returns the line where a second document begins, or 0 if there is none. YAML::LoadAll() is not used,
// because in yaml-cpp 0.7 a comma outside of brackets ends a document, but no document contains it. So
// LoadAll() would append empty documents until the memory is full.
int line_of_second_document(const std::string& text) {
  std::istringstream stream(text);
  YAML::Parser parser(stream);
  DocumentStart start;
  return parser.HandleNextDocument(start) && parser.HandleNextDocument(start) ? start.line : 0;
}

class Writer {
 public:
  template <typename T>
  void operator()(const Setting& setting, const T& value) {
    constexpr bool list =
        std::is_same_v<T, std::vector<std::string>> || std::is_same_v<T, std::optional<Eigen::Vector3d>> ||
        std::is_same_v<T, std::optional<UprightSize>> || std::is_same_v<T, std::vector<RegionConfig>> ||
        std::is_same_v<T, std::vector<ClassConfig>> || std::is_same_v<T, std::vector<RigSensor>>;
    std::string text = to_text(value);
    // Frame ids and file names may have any characters; names of instruction sets need no quotes.
    if constexpr (std::is_same_v<T, std::string>)
      if (setting.key != "isa") text = value.empty() ? "null" : yaml_quoted(value);
    if (text == "inf") text = ".inf";
    std::string comment(setting.unit);
    if (!setting.unset.empty()) comment.append(text.empty() ? "; []: " : "; null: ").append(setting.unset);
    put(std::string(setting.key), list && text != "null" ? '[' + text + ']' : text, comment);
  }

  const std::string& yaml() const { return yaml_; }

 private:
  void put(const std::string& key, const std::string& value, const std::string& comment) {
    const std::size_t dot = key.find('.');
    const std::string section = dot == std::string::npos ? "" : key.substr(0, dot);
    if (section != section_ && !section.empty()) yaml_ += section + ":\n";
    section_ = section;
    yaml_ += (section.empty() ? "" : "  ") + key.substr(dot == std::string::npos ? 0 : dot + 1) + ": " +
             value + (comment.empty() ? "" : "  # " + comment) + '\n';
  }

  std::string section_, yaml_;
};

}  // namespace

StreamConfig parse_stream_config(const std::string& text, const std::string& name,
                                 const StreamConfig& defaults) {
  StreamConfig config = defaults;
  if (text.size() > kMaxConfigBytes)
    fail(name, 0, "has more than " + std::to_string(kMaxConfigBytes) + " bytes");
  try {
    if (const int second = line_of_second_document(text); second > 0)
      fail(name, second, "a second YAML document begins; only one is allowed");
    Reader reader(YAML::Load(text), name);
    visit_stream(config, reader);
    reader.finish();
    reader.reject(problems_of(config));
  } catch (const YAML::Exception& error) {
    fail(name, 0, yaml_error_message(error));
  } catch (const IoError& error) {
    fail(name, 0, error.what());
  }
  return config;
}

StreamConfig read_stream_config(const std::filesystem::path& file, const StreamConfig& defaults) {
  std::string text;
  try {
    text = read_untrusted_text(file, kMaxConfigBytes);
  } catch (const IoError& error) {
    fail(file.string(), 0, error.what());
  }
  return parse_stream_config(text, file.string(), defaults);
}

std::string to_yaml(const StreamConfig& config) {
  Writer writer;
  visit_stream(config, writer);
  return writer.yaml();
}

}  // namespace pcl_bv
