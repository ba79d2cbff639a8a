// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Requests, volumes and settings that are nested as deep, and repeat as often, as some kilobytes of a fuzzer
// cannot say: in its inputs a byte 1 to 18 doubles the bytes before it, of which the next byte says how many,
// so many times. What comes out is what the reader gives, or one line in our words.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "memory_file.h"
#include "pcl_bv/nodes/frame_pipeline.h"
#include "pcl_bv/nodes/frame_sink.h"
#include "pcl_bv/nodes/stream_runner.h"
#include "pcl_bv/report/read_volumes.h"
#include "protocol.h"
#include "stream/remote_parameters.h"

namespace pcl_bv::detail {
namespace {

std::string expanded(const std::uint8_t* data, std::size_t size) {
  constexpr std::size_t longest = 400'000;
  std::string text;
  for (std::size_t i = 0; i < size && text.size() < longest; ++i) {
    const bool doubles =
        data[i] >= 1 && data[i] <= 18 && data[i] != '\n' && data[i] != '\r' && data[i] != '\t';
    if (!doubles || i + 1 == size) {
      text += static_cast<char>(data[i]);
      continue;
    }
    const int times = data[i++];
    std::string part = text.substr(text.size() - std::min<std::size_t>(data[i], text.size()));
    for (int k = 0; k < times && part.size() + text.size() < longest; ++k)
      part += part;
    text += part;
  }
  return text;
}

// A message may quote the input, so only words that the input lacks are the words of a library.
void check_message(std::string_view said, std::string_view input) {
  for (const char* words : {"exception", "yaml-cpp", "std::"})
    if (said.find(words) != std::string_view::npos && input.find(words) == std::string_view::npos)
      std::abort();
  if (std::any_of(said.begin(), said.end(), [](char c) { return c >= 0 && c < ' '; })) std::abort();
  if (said.size() > 3000) std::abort();  // 2 kB of quotation, and where it is
}

void read_request(const std::string& text) {
  static FramePipeline pipeline;
  static const auto settings = remote_settings(pipeline);
  check_message(settings->change(text), text);
  const live::Request request = live::parse_request(text);
  if (const auto* set = std::get_if<live::SetParameters>(&request))
    check_message(settings->change(set->object), text);
  if (const auto* unknown = std::get_if<live::InvalidRequest>(&request))
    if (live::status(live::Level::error, unknown->why).size() > 4 * kMaxMessageBytes) std::abort();
}

void read_file_of_volumes(const std::string& text) {
  static MemoryFile memory;
  memory.assign(text);
  try {
    static_cast<void>(read_volumes(memory.path()));
  } catch (const IoError& error) {
    check_message(error.what(), text);
  }
}

void read_settings(const std::string& text) {
  try {
    const StreamConfig config = parse_stream_config(text, "f");
    if (!config.validate().empty()) std::abort();
    parse_stream_config(to_yaml(config), "again");
  } catch (const ConfigError& error) {
    check_message(error.what(), text);
  }
}

}  // namespace
}  // namespace pcl_bv::detail

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace pcl_bv;
  using namespace pcl_bv::detail;
  if (size < 2) return 0;
  const std::string text = expanded(data + 1, size - 1);
  switch (data[0] % 3) {
    case 0:
      read_request(text);
      break;
    case 1:
      read_file_of_volumes(text);
      break;
    default:
      read_settings(text);
  }
  return 0;
}
