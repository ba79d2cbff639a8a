// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "message_adapter.h"

#include <stdexcept>

namespace pcl_bv::detail {

const std::vector<AdapterKind>& adapter_kinds() {
  static const std::vector<AdapterKind> kinds{
      {"moveit", make_moveit_adapter}, {"nav2", make_nav2_adapter}, {"vision", make_vision_adapter}};
  return kinds;
}

const AdapterKind& adapter_kind(std::string_view name) {
  std::string names;
  for (const AdapterKind& kind : adapter_kinds()) {
    if (kind.name == name) return kind;
    if (!names.empty()) names += &kind == &adapter_kinds().back() ? " or " : ", ";
    names += kind.name;
  }
  throw std::invalid_argument("'" + std::string(name) + "' is not " + names);
}

MessageTopic topic_of_objects(const std::string& name) {
  MessageTopic topic{name, {}};
  topic.history = 1000;
  return topic;
}

}  // namespace pcl_bv::detail
