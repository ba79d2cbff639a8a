// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/recording/packet_reader.h"

#include <algorithm>
#include <cstring>
#include <fstream>
#include <map>
#include <optional>
#include <set>
#include <stdexcept>
#include <utility>

#include "packet_file.h"
#include "sensor_family.h"

namespace pcl_bv::detail {
namespace {

constexpr std::size_t kMaxListedNames = 5;  // names in a message
// Each address has a sweep that is being assembled. A packet with a false address must not take its memory.
constexpr std::size_t kMaxAddresses = 256;

std::string listed(const std::vector<std::string>& names) {
  std::string list;
  for (const std::string& name : names)
    list += (list.empty() ? "" : ", ") + name;
  return list;
}

void add_name(std::vector<std::string>& names, std::string name) {
  if (names.size() < kMaxListedNames && std::find(names.begin(), names.end(), name) == names.end())
    names.push_back(std::move(name));
}

std::string supported_models() {
  std::string list;
  for (const SensorFamilyRow& row : sensor_families())
    list += (list.empty() ? "" : ", ") + std::string(row.models);
  return list;
}

using Families = std::vector<std::unique_ptr<SensorFamily>>;

Families open_families(const std::filesystem::path& capture) {
  Families families;
  for (const SensorFamilyRow& row : sensor_families())
    families.push_back(row.open(capture));
  return families;
}

// A family by its index in Families, and one of its models.
using Model = std::pair<std::size_t, std::size_t>;

std::optional<Model> model_in(const Families& families, const Payload& packet) {
  for (std::size_t i = 0; i < families.size(); ++i) {
    if (const auto model = families[i]->model_of(packet)) return Model{i, *model};
  }
  return std::nullopt;
}

// The packets that are not used. The error message for a capture without usable packets describes them.
struct OtherPackets {
  std::vector<std::string> sensors{}, others{}, requirements{};

  void add_undecodable(const Families& families, const Payload& packet) {
    for (const std::unique_ptr<SensorFamily>& family : families) {
      const std::string what = family->undecodable(packet);
      if (what.empty()) continue;
      if (const std::string requirement = family->requirement(); !requirement.empty())
        add_name(requirements, requirement);
      return add_name(others, what + " from " + packet.source());
    }
    add_name(others, std::to_string(packet.size) + " bytes from " + packet.source());
  }

  [[noreturn]] void refuse(const std::string& wanted_sensor) const {
    if (!wanted_sensor.empty() && !sensors.empty())
      throw std::invalid_argument("no packets of a sensor at " + wanted_sensor + "; there are " +
                                  listed(sensors));
    std::string message = "no packet that can be decoded (" + supported_models() +
                          "); UDP packets: " + (others.empty() ? "none" : listed(others));
    for (const std::string& requirement : requirements)
      message += "; " + requirement;
    throw IoError(message);
  }
};

}  // namespace

RawCloud raw_cloud_of(const SensorSweep& sweep) {
  RawCloud cloud;
  cloud.fields = {
      {"x", 'F', 4, 1, 0}, {"y", 'F', 4, 1, 4}, {"z", 'F', 4, 1, 8}, {"intensity", 'F', 4, 1, 12}};
  std::size_t size = 16;
  const auto add_field = [&](const char* name) {
    cloud.fields.push_back({name, 'U', 4, 1, size});
    size += 4;
  };
  if (sweep.has_ring || sweep.has_tag) add_field(sweep.has_ring ? "ring" : "tag");
  add_field("time_ns");
  if (sweep.has_reflectivity) add_field("reflectivity");
  static_assert(sizeof(SensorPoint) == 28);
  cloud.point_step = size;
  cloud.width = sweep.points.size();
  cloud.data.resize(cloud.width * size);
  std::byte* to = cloud.data.data();
  const std::size_t skipped =
      sweep.has_ring || sweep.has_tag ? 16 : 20;  // where the members after `intensity` begin
  for (const SensorPoint& point : sweep.points) {
    std::memcpy(to, &point, 16);
    std::memcpy(to + 16, reinterpret_cast<const std::byte*>(&point) + skipped, size - 16);
    to += size;
  }
  return cloud;
}

bool is_capture(const std::filesystem::path& file) {
  std::error_code unknown;
  if (!std::filesystem::is_regular_file(file, unknown)) return false;
  char start[4] = {};
  std::ifstream(file, std::ios::binary).read(start, sizeof start);
  return is_packet_file({start, sizeof start});
}

std::vector<std::string> sensors_in_capture(const std::filesystem::path& file) {
  constexpr int max_packets = 20'000;  // 3 to 30 s of one sensor; a whole capture may take minutes to read
  PacketFile packets(file);
  const Families families = open_families(file);
  std::set<std::string> sensors;
  Payload packet;
  for (int i = 0; i < max_packets && packets.next(packet); ++i)
    if (model_in(families, packet)) sensors.insert(packet.source());
  return {sensors.begin(), sensors.end()};
}

struct PacketReader::State {
  State(const std::filesystem::path& path, const std::string& sensor) : file(path), wanted_sensor(sensor) {
    packets.emplace(file);
    families = open_families(file);
    OtherPackets other_packets;
    for (Payload packet; !first_model && packets->next(packet);) {
      const std::optional<Model> model = model_in(families, packet);
      const bool other = !wanted_sensor.empty() && packet.source() != wanted_sensor;
      if (!model) {
        other_packets.add_undecodable(families, packet);
      } else if (other) {
        add_name(other_packets.sensors, packet.source());
      } else {
        first_model = model;
      }
    }
    if (!first_model) other_packets.refuse(wanted_sensor);
    rewind();
  }

  void rewind() {
    packets.emplace(file);
    addresses.clear();
    queue = {};
    done = false;
  }

  bool read_packet() {
    Payload packet;
    if (done || !packets->next(packet)) return false;
    if (!wanted_sensor.empty() && packet.source() != wanted_sensor) return true;
    const std::optional<Model> model = model_in(families, packet);
    if (!model) {
      note_undecodable(packet);
      return true;
    }
    if (addresses.size() >= kMaxAddresses && !addresses.contains(packet.key())) {
      if (!std::exchange(warned_of_addresses, true))
        warnings.add("packets of more than " + std::to_string(kMaxAddresses) +
                     " addresses: those of further ones are skipped");
      return true;
    }
    Address& address = addresses[packet.key()];
    if (address.name.empty()) address.name = packet.source();
    std::unique_ptr<SweepAssembler>& assembler = address.assemblers[*model];
    if (!assembler) assembler = families[model->first]->make_assembler(model->second);
    assembler->add(packet, queue);
    return true;
  }

  // Adds a warning for the first packet of each family that cannot be decoded, because the capture has other
  // packets that can.
  void note_undecodable(const Payload& packet) {
    for (std::size_t i = 0; i < families.size(); ++i) {
      if (noted_families.contains(i)) continue;
      const std::string what = families[i]->undecodable(packet);
      if (what.empty()) continue;
      noted_families[i] = true;
      const std::string requirement = families[i]->requirement();
      warnings.add("cannot decode " + what + " from " + packet.source() +
                   (requirement.empty() ? "" : ": " + requirement));
      return;
    }
  }

  // Adds the new warnings, and updates the warning about several sensors, a single line that names the
  // sensors found until now.
  void update_warnings() {
    const std::size_t before = warnings.lines().size();
    warnings.append_new(packets->warnings(), packet_warnings_added);
    warnings.append_new(queue.warnings, sweep_warnings_added);
    if (queue.sensors <= noted_sensors || queue.sensors < 2) return;
    if (!warnings_before_note) warnings_before_note = before;
    noted_sensors = queue.sensors;
    std::vector<std::string> names;
    for (auto it = addresses.begin(); it != addresses.end() && names.size() < kMaxListedNames; ++it)
      names.push_back(it->second.name);
    const std::size_t others = addresses.size() - names.size();
    sensors_note = "packets of " + std::to_string(queue.sensors) + " sensors (" + listed(names) +
                   (others > 0 ? " and " + std::to_string(others) + " others" : "") +
                   "): each frame is from one of them" +
                   (addresses.size() > 1 ? ", --topic chooses one" : "");
  }

  void finish() {
    done = true;
    std::deque<SensorSweep>& whole = queue.whole;
    const std::size_t before = whole.size();
    for (auto& [key, address] : addresses) {
      for (auto& [model, assembler] : address.assemblers)
        assembler->finish(queue);
    }
    std::stable_sort(whole.begin() + static_cast<std::ptrdiff_t>(before), whole.end(),
                     [](const SensorSweep& a, const SensorSweep& b) { return a.stamp_ns < b.stamp_ns; });
  }

  // A source address and destination port, and the sensors there.
  struct Address {
    std::string name{};
    std::map<Model, std::unique_ptr<SweepAssembler>> assemblers{};
  };

  std::filesystem::path file;
  std::string wanted_sensor;
  Families families;
  std::optional<PacketFile> packets;
  std::optional<Model> first_model;
  std::map<std::pair<IpAddress, std::uint16_t>, Address> addresses;
  SweepQueue queue;
  std::size_t noted_sensors = 0;
  std::map<std::size_t, bool> noted_families;
  // All warnings. rewind() keeps the list and the numbers of warnings of `packets` and `queue` in it, so to
  // read the file again adds no warning twice.
  WarningList warnings;
  std::uint64_t packet_warnings_added = 0, sweep_warnings_added = 0;
  std::optional<std::size_t> warnings_before_note;  // number of `warnings` that precede sensors_note
  std::string sensors_note;
  bool done = false, warned_of_addresses = false;
};

PacketReader::PacketReader(const std::filesystem::path& file, const std::string& sensor)
    : state_(std::make_unique<State>(file, sensor)) {}
PacketReader::~PacketReader() = default;

std::string_view PacketReader::model() const {
  const auto& [family, model] = *state_->first_model;
  return state_->families[family]->model_name(model);
}

void PacketReader::rewind() {
  state_->rewind();
}

bool PacketReader::next(SensorSweep& sweep) {
  State& state = *state_;
  while (state.queue.whole.empty() && state.read_packet()) {
  }
  if (state.queue.whole.empty() && !state.done) state.finish();
  state.update_warnings();
  if (state.queue.whole.empty()) return false;
  state.queue.recycle(std::move(sweep.points));
  sweep = std::move(state.queue.whole.front());
  state.queue.whole.pop_front();
  return true;
}

std::vector<std::string> PacketReader::warning_lines() const {
  std::vector<std::string> all = state_->warnings.lines();
  if (!state_->sensors_note.empty())
    all.insert(all.begin() + static_cast<std::ptrdiff_t>(*state_->warnings_before_note),
               state_->sensors_note);
  return all;
}

}  // namespace pcl_bv::detail
