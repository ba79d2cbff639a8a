// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/recording/velodyne.h"

#include <algorithm>
#include <fstream>
#include <map>
#include <optional>
#include <stdexcept>

#include "velodyne_sensor.h"

namespace pcl_bv::detail {
namespace {

// The packets of one model from one address to one port. They are usually of one sensor. If a relay or a
// program that plays a file back sends the packets, they can be of several sensors.
struct UdpSource {
  std::vector<VelodyneSensor> sensors{};
  std::vector<std::byte> waiting{};  // packet that no sensor expects; see take()
  std::int64_t waiting_time_ns = 0;

  Payload waiting_packet() const { return {waiting_time_ns, waiting.data(), waiting.size()}; }
};

constexpr std::size_t kMaxSensors = 8;      // sensors per source
constexpr std::size_t kMaxListedNames = 5;  // names in a message

std::string listed(const std::vector<std::string>& names) {
  std::string list;
  for (const std::string& name : names)
    list += (list.empty() ? "" : ", ") + name;
  return list;
}

}  // namespace

RawCloud raw_cloud_of(const VelodyneSweep& sweep) {
  RawCloud cloud;
  cloud.fields = {{"x", 'F', 4, 1, 0},          {"y", 'F', 4, 1, 4},     {"z", 'F', 4, 1, 8},
                  {"intensity", 'F', 4, 1, 12}, {"ring", 'U', 4, 1, 16}, {"time_ns", 'U', 4, 1, 20}};
  static_assert(sizeof(VelodynePoint) == 24);
  cloud.point_step = sizeof(VelodynePoint);
  cloud.width = sweep.points.size();
  const auto* const begin = reinterpret_cast<const std::byte*>(sweep.points.data());
  cloud.data.assign(begin, begin + cloud.width * cloud.point_step);
  return cloud;
}

bool is_capture(const std::filesystem::path& file) {
  std::error_code unknown;
  if (!std::filesystem::is_regular_file(file, unknown)) return false;
  char start[4] = {};
  std::ifstream(file, std::ios::binary).read(start, sizeof start);
  return is_packet_file({start, sizeof start});
}

struct VelodyneReader::State {
  State(const std::filesystem::path& path, const std::string& sensor) : file(path), wanted_sensor(sensor) {
    packets.emplace(file);
    OtherPackets other_packets;
    for (Payload packet; model == nullptr && packets->next(packet);) {
      const VelodyneModel* const found = velodyne_model(packet);
      const bool other = !wanted_sensor.empty() && packet.source() != wanted_sensor;
      if (found != nullptr && !other) model = found;
      if (found == nullptr || other) other_packets.note(packet, found);
    }
    if (model == nullptr) other_packets.refuse(wanted_sensor);
    rewind();
  }

  // The packets that are not used. The error message for a capture without usable packets describes them.
  struct OtherPackets {
    std::vector<std::string> sensors, others;

    static void add(std::vector<std::string>& names, std::string name) {
      if (names.size() < kMaxListedNames && std::find(names.begin(), names.end(), name) == names.end())
        names.push_back(std::move(name));
    }
    void note(const Payload& packet, const VelodyneModel* found) {
      if (found != nullptr) return add(sensors, packet.source());
      const int product = velodyne_product(packet);
      add(others, product < 0 ? std::to_string(packet.size) + " bytes from " + packet.source()
                              : "Velodyne's product " + std::to_string(product) + " from " + packet.source());
    }
    [[noreturn]] void refuse(const std::string& wanted_sensor) const {
      if (!wanted_sensor.empty() && !sensors.empty())
        throw std::invalid_argument("no packets of a sensor at " + wanted_sensor + "; there are " +
                                    listed(sensors));
      const std::string all = listed(others);
      throw IoError("no packet of a VLP-16, HDL-32E or VLP-32C; UDP packets: " +
                    (all.empty() ? "none" : all));
    }
  };

  void rewind() {
    packets.emplace(file);
    addresses.clear();
    sensors = 0;
    whole.clear();
    done = false;
  }

  bool read_packet() {
    Payload packet;
    if (done || !packets->next(packet)) return false;
    const VelodyneModel* const found = velodyne_model(packet);
    if (found == nullptr || (!wanted_sensor.empty() && packet.source() != wanted_sensor)) return true;
    Address& address = addresses[packet.key()];
    if (address.name.empty()) address.name = packet.source();
    take(*found, packet, address.sources[found]);
    return true;
  }

  void take(const VelodyneModel& found, const Payload& packet, UdpSource& source) {
    VelodyneSensor* sensor = expecting(packet, source);
    if (!source.waiting.empty()) {
      const Payload earlier = source.waiting_packet();
      // If a sensor expects `packet`, the waiting packet is from another sensor. Otherwise the azimuth has
      // jumped, and the waiting packet is the first one after the jump.
      if (sensor != nullptr && source.sensors.size() < kMaxSensors) {
        const auto index = static_cast<std::size_t>(sensor - source.sensors.data());
        add_sensor(found, source).add(earlier, whole);
        sensor = &source.sensors[index];
      } else {
        source.sensors.front().finish(whole);
        source.sensors.front().add(earlier, whole);
        sensor = expecting(packet, source);
      }
      source.waiting.clear();
    }
    if (source.sensors.empty()) sensor = &add_sensor(found, source);
    if (sensor != nullptr) return sensor->add(packet, whole);
    source.waiting.assign(packet.data, packet.data + packet.size);
    source.waiting_time_ns = packet.time_ns;
  }

  static VelodyneSensor* expecting(const Payload& packet, UdpSource& source) {
    for (VelodyneSensor& sensor : source.sensors) {
      if (sensor.expects(packet)) return &sensor;
    }
    return nullptr;
  }

  VelodyneSensor& add_sensor(const VelodyneModel& found, UdpSource& source) {
    if (++sensors == 2 && !warnings_before_note) warnings_before_note = warnings.lines().size();
    return source.sensors.emplace_back(found, sensors - 1);
  }

  // Updates the warning about several sensors, a single line that names the sensors found until now.
  void update_sensors_note() {
    if (sensors <= noted_sensors || sensors < 2) return;
    noted_sensors = sensors;
    std::vector<std::string> names;
    for (auto it = addresses.begin(); it != addresses.end() && names.size() < kMaxListedNames; ++it)
      names.push_back(it->second.name);
    const std::size_t others = addresses.size() - names.size();
    sensors_note = "packets of " + std::to_string(sensors) + " sensors (" + listed(names) +
                   (others > 0 ? " and " + std::to_string(others) + " others" : "") +
                   "): each frame is a revolution of one of them" +
                   (addresses.size() > 1 ? ", --topic chooses one" : "");
  }

  void finish() {
    done = true;
    const std::size_t before = whole.size();
    for (auto& [key, address] : addresses) {
      for (auto& [found, source] : address.sources)
        finish(source);
    }
    std::stable_sort(whole.begin() + static_cast<std::ptrdiff_t>(before), whole.end(),
                     [](const VelodyneSweep& a, const VelodyneSweep& b) { return a.stamp_ns < b.stamp_ns; });
  }

  void finish(UdpSource& source) {
    if (!source.waiting.empty()) {
      source.sensors.front().finish(whole);
      source.sensors.front().add(source.waiting_packet(), whole);
    }
    for (VelodyneSensor& sensor : source.sensors)
      sensor.finish(whole);
  }

  // A source address and destination port, and the sensors there.
  struct Address {
    std::string name;
    std::map<const VelodyneModel*, UdpSource> sources{};
  };

  std::filesystem::path file;
  std::string wanted_sensor;
  std::optional<PacketFile> packets;
  const VelodyneModel* model = nullptr;
  std::map<std::uint64_t, Address> addresses;
  std::size_t sensors = 0, noted_sensors = 0;
  std::deque<VelodyneSweep> whole;
  // Warnings about packets. rewind() keeps the list and warnings_added, so to read the file again adds no
  // warning twice.
  WarningList warnings;
  std::uint64_t warnings_added = 0;  // number of warnings of `packets` that are in `warnings`
  std::optional<std::size_t> warnings_before_note;  // number of `warnings` that precede sensors_note
  std::string sensors_note;
  bool done = false;
};

VelodyneReader::VelodyneReader(const std::filesystem::path& file, const std::string& sensor)
    : state_(std::make_unique<State>(file, sensor)) {}
VelodyneReader::~VelodyneReader() = default;

std::string_view VelodyneReader::model() const {
  return name_of(*state_->model);
}

void VelodyneReader::rewind() {
  state_->rewind();
}

bool VelodyneReader::next(VelodyneSweep& sweep) {
  State& state = *state_;
  while (state.whole.empty() && state.read_packet()) {
  }
  if (state.whole.empty() && !state.done) state.finish();
  state.warnings.append_new(state.packets->warnings(), state.warnings_added);
  state.update_sensors_note();
  if (state.whole.empty()) return false;
  sweep = std::move(state.whole.front());
  state.whole.pop_front();
  return true;
}

std::vector<std::string> VelodyneReader::warning_lines() const {
  std::vector<std::string> all = state_->warnings.lines();
  if (!state_->sensors_note.empty())
    all.insert(all.begin() + static_cast<std::ptrdiff_t>(*state_->warnings_before_note),
               state_->sensors_note);
  return all;
}

}  // namespace pcl_bv::detail
