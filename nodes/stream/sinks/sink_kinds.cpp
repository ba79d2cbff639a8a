// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The table of sinks.

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "sinks.h"
#include "stream/topics/message_sink.h"

namespace pcl_bv {
using namespace detail;
namespace {

// Removes an option of the kind from the end of the target, and returns it without its comma. Returns an
// empty text if there is none.
std::string take_option(const SinkKind& kind, std::string& target) {
  const std::size_t comma = target.rfind(',');
  if (comma == std::string::npos) return {};
  const std::string option = target.substr(comma);
  if (option.size() == 1 || kind.target.find('[' + option + ']') == std::string_view::npos) return {};
  target.resize(comma);
  return option.substr(1);
}

// Throws std::invalid_argument if the target, without its options, ends with a comma and a word that begins
// with a letter, or with a comma: a mistyped option would become a part of the file name.
void reject_unknown_option(const SinkKind& kind, const std::string& target) {
  const std::size_t comma = target.rfind(',');
  const std::size_t options = kind.target.find("[,");
  if (comma == std::string::npos || options == std::string_view::npos) return;
  const std::string word = target.substr(comma + 1);
  const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  const auto is_of_word = [&](char c) {
    return is_letter(c) || (c >= '0' && c <= '9') || c == '_' || c == '-';
  };
  if (!word.empty() && !(is_letter(word.front()) && std::all_of(word.begin(), word.end(), is_of_word)))
    return;
  throw std::invalid_argument(std::string(kind.name) + ": '" + word + "' is not one of its options " +
                              std::string(kind.target.substr(options)));
}

class FunctionSink : public FrameSink {
 public:
  explicit FunctionSink(std::function<void(const Frame&, const FrameResult&)> on_result)
      : on_result_(std::move(on_result)) {}
  void write(const Frame& frame, const FrameResult& result) override { on_result_(frame, result); }

 private:
  std::function<void(const Frame&, const FrameResult&)> on_result_;
};

}  // namespace

// Labelled clouds are made only while there are subscribers. Scenes are not sent, because Foxglove, the only
// viewer of scenes, also shows markers.
std::unique_ptr<FrameSink> detail::open_dds_sink(const SinkOptions& description) {
  MessageTopics topics;
  topics.prefix = description.target.string();
  topics.points = true;
  topics.scene = topics.poses = false;
  topics.adapters = description.adapters;
  return make_message_sink(middleware("dds").carrier(""), topics);
}

std::unique_ptr<FrameSink> detail::open_ws_sink(const SinkOptions& description) {
  MessageTopics topics;
  topics.points = topics.frames = true;
  return make_message_sink(middleware("ws").carrier(description.target.string()), topics);
}

const std::vector<SinkKind>& sink_kinds() {
  static const std::vector<SinkKind> kinds = [] {
    std::vector<SinkKind> all{{"jsonl", "FILE", "", open_jsonl},
                              {"csv", "FILE", "", open_csv},
                              {"kitti", "FILE", "", open_kitti},
                              {"dds", "PREFIX[,moveit][,nav2][,vision]", "", open_dds_sink, true},
                              {"ws", "[HOST:]PORT", "", open_ws_sink, true},
                              {"vtp", "FOLDER[,points]", ".vtp", open_vtp},
                              {"image", "FOLDER", ".png", open_image},
                              {"labels", "FOLDER", ".pcd", open_labels}};
    const std::vector<SinkKind> recordings = recording_sinks();
    all.insert(all.begin() + 3, recordings.begin(), recordings.end());
    return all;
  }();
  return kinds;
}

std::string sink_syntax() {
  std::string all;
  for (const SinkKind& kind : sink_kinds()) {
    if (!all.empty()) all += &kind == &sink_kinds().back() ? " or " : ", ";
    all += std::string(kind.name) + ':' + std::string(kind.target);
  }
  return all;
}

SinkOptions parse_sink(const std::string& description) {
  const std::size_t colon = std::min(description.find(':'), description.size());
  for (const SinkKind& kind : sink_kinds()) {
    if (description.compare(0, colon, kind.name) != 0) continue;
    std::string target = description.substr(std::min(colon + 1, description.size()));
    SinkOptions options{&kind, {}};
    for (std::string option = take_option(kind, target); !option.empty();
         option = take_option(kind, target)) {
      if (option == "points") {
        options.points = true;
      } else if (std::find(options.adapters.begin(), options.adapters.end(), option) ==
                 options.adapters.end()) {
        options.adapters.insert(options.adapters.begin(), option);
      }
    }
    reject_unknown_option(kind, target);
    options.target = target;
    const bool may_be_printed = kind.target == "FILE";  // lines of text
    if (target == "-" && !may_be_printed)
      throw std::invalid_argument("'" + description +
                                  "': only jsonl, csv and kitti write to standard output");
    if (!target.empty()) return options;
  }
  throw std::invalid_argument("'" + description + "' is not " + sink_syntax());
}

std::unique_ptr<FrameSink> make_sink(const SinkOptions& description) {
  if (description.kind == nullptr) throw std::invalid_argument("make_sink: no kind of sink");
  return description.kind->open(description);
}

std::unique_ptr<FrameSink> make_sink(std::function<void(const Frame&, const FrameResult&)> on_result) {
  if (!on_result) throw std::invalid_argument("make_sink: no function");
  return std::make_unique<FunctionSink>(std::move(on_result));
}

}  // namespace pcl_bv
