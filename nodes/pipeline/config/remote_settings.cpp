// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/nodes/frame_sink.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>
#include <nlohmann/json.hpp>
#include <sstream>
#include <type_traits>
#include <utility>

#include "check.h"
#include "pcl_bv/io/read_json.h"
#include "pcl_bv/io/untrusted_text.h"
#include "pcl_bv/nodes/frame_pipeline.h"
#include "pcl_bv/nodes/stream_runner.h"
#include "pcl_bv/points/isa.h"
#include "settings.h"
#include "stream/remote_parameters.h"

namespace pcl_bv {
using namespace detail;
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array<std::string_view, 3> kFixed{"filter.regions", "cluster.class_field", "cluster.classes"};

bool is_fixed(std::string_view key) {
  return key.starts_with("rig.") || std::find(kFixed.begin(), kFixed.end(), key) != kFixed.end();
}

template <class T>
struct Plain {
  using type = T;
};
template <class T>
struct Plain<std::optional<T>> {
  using type = T;
};

template <class Value>
constexpr const char* kind_of() {
  using T = typename Plain<std::decay_t<Value>>::type;
  if constexpr (std::is_same_v<T, bool>) return "bool";
  if constexpr (std::is_same_v<T, double>) return "number";
  if constexpr (std::is_same_v<T, std::size_t>) return "count";
  if constexpr (std::is_enum_v<T>) return "choice";
  return "text";
}

// Returns the choices of a setting, which are listed in its unit: "drop, keep, split".
Json choices_in(const std::string& unit) {
  Json choices = Json::array();
  std::istringstream words(unit);
  for (std::string word; std::getline(words >> std::ws, word, ',');)
    choices.push_back(word);
  return choices;
}

Json instruction_sets() {
  Json choices = Json::array({std::string("auto")});
  for (const Isa isa : usable_isas())
    choices.push_back(std::string(isa_name(isa)));
  return choices;
}

template <class Value>
Json described(const Setting& setting, const Value&) {
  const std::string kind = setting.key == "isa" ? "choice" : kind_of<Value>();
  Json json{{"key", std::string(setting.key)},
            {"kind", kind},
            {"unit", std::string(setting.unit)},
            {"about", std::string(setting.help)}};
  if (kind == "number" || kind == "count") {
    json["least"] = setting.range.min;
    if (setting.range.max < kFinite) json["most"] = setting.range.max;
    if (!setting.range.closed) json["closed"] = false;
  }
  if (kind == "choice")
    json["choices"] = setting.key == "isa" ? instruction_sets() : choices_in(std::string(setting.unit));
  if (!setting.unset.empty()) json["unset"] = std::string(setting.unset);
  if (is_fixed(setting.key)) json["fixed"] = true;
  return json;
}

template <class Value>
Json json_of(const Value& value) {
  if constexpr (std::is_same_v<Value, bool>) return value;
  if constexpr (std::is_same_v<Value, double>)
    if (std::abs(value) <= kFinite) return value;
  if constexpr (std::is_same_v<Value, std::size_t>)
    if (value != std::numeric_limits<std::size_t>::max()) return value;
  return to_text(value);
}
Json json_of(const std::string& value) {
  return value.empty() ? "null" : value;
}
template <class Value>
Json json_of(const std::optional<Value>& value) {
  return value ? json_of(*value) : Json("null");
}

// Returns the value in the syntax of the configuration file.
std::string text_of(const UntrustedJson& value) {
  if (value.is_string()) return value.get<std::string>();
  if (!value.is_array()) return value.dump(-1, ' ', false, UntrustedJson::error_handler_t::replace);
  std::string list;
  for (const UntrustedJson& one : value)
    list += (list.empty() ? "" : ",") + text_of(one);
  return list;
}

template <class Value>
void set(const Setting& setting, const std::string& text, Value& value) {
  read_setting(setting, text, value);
}
void set(const Setting&, const std::string& text, std::vector<std::string>& names) {
  names.clear();
  if (!text.empty()) read_text(text, names);
}

class PipelineSettings final : public RemoteParameters {
 public:
  PipelineSettings(FramePipeline& pipeline, const StreamConfig& stream)
      : pipeline_(pipeline), stream_{{}, stream.runner, stream.rig} {}

  std::string description() const override {
    Json all = Json::array();
    visit(PipelineConfig(),
          [&](const Setting& setting, const auto& value) { all.push_back(described(setting, value)); });
    return all.dump();
  }

  std::string values() const override {
    Json all = Json::object();
    visit(pipeline_.config(),
          [&](const Setting& setting, const auto& value) { all[std::string(setting.key)] = json_of(value); });
    return all.dump(-1, ' ', false, Json::error_handler_t::replace);
  }

  const StreamConfig& stream() const override { return stream_; }

  std::string change(const std::string& object) override {
    UntrustedJson wanted;
    try {
      wanted = read_json(object);
    } catch (const IoError& error) {
      return std::string("settings are not an object of keys and values: ") + error.what();
    }
    if (!wanted.is_object()) return "settings are not an object of keys and values";
    const std::lock_guard lock(mutex_);
    PipelineConfig config = pipeline_.config();
    for (const auto& [key, value] : wanted.items()) {
      if (std::string problem = put(key, value, config); !problem.empty()) return message_line(problem);
    }
    try {
      pipeline_.set_config(std::move(config));
    } catch (const std::exception& error) {
      return reason_of(error);
    }
    return {};
  }

 private:
  // The rig is shown only if there is one.
  template <class Visit>
  void visit(const PipelineConfig& pipeline, const Visit& show) const {
    visit_pipeline(pipeline, show);
    if (!stream_.rig.frame.empty()) visit_rig(stream_.rig, show);
  }

  // Parses a value. Returns why it cannot be parsed; set_config() checks what it parsed.
  static std::string put(const std::string& key, const UntrustedJson& value, PipelineConfig& config) {
    if (is_fixed(key)) return key + ": cannot be changed while frames come";
    std::string problem = key + ": no such setting";
    visit_pipeline(config, [&](const Setting& setting, auto& field) {
      if (setting.key != key) return;
      try {
        set(setting, text_of(value), field);
        problem.clear();
      } catch (const std::exception& error) {
        problem = key + ": " + reason_of(error);
      }
    });
    return problem;
  }

  FramePipeline& pipeline_;
  const StreamConfig stream_;
  std::mutex mutex_;
};

}  // namespace

std::shared_ptr<RemoteParameters> remote_settings(FramePipeline& pipeline) {
  return remote_settings(pipeline, {});
}

std::shared_ptr<RemoteParameters> remote_settings(FramePipeline& pipeline, const StreamConfig& stream) {
  return std::make_shared<PipelineSettings>(pipeline, stream);
}

}  // namespace pcl_bv
