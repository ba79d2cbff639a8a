// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/recording/velodyne.h"

#include <algorithm>
#include <fstream>
#include <map>
#include <optional>
#include <stdexcept>

#include "velodyne_sensor.h"

namespace pcl_bv {
namespace {

// Packets of one address and port, mostly of one sensor; of a relay or a played back file perhaps of several.
struct Origin {
  std::string name;
  std::vector<VelodyneSensor> sensors{};
  std::vector<std::byte> waiting{};  // a packet that none of them expects, until the next one says why
  std::int64_t waiting_time_ns = 0;

  Payload waiting_packet() const { return {waiting_time_ns, waiting.data(), waiting.size()}; }
};

constexpr std::size_t kMostSensors = 8;  // of one origin

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
  State(const std::filesystem::path& path, const std::string& sensor) : file(path), only(sensor) {
    packets.emplace(file);
    Strangers strangers;
    for (Payload packet; model == nullptr && packets->next(packet);) {
      const VelodyneModel* const found = velodyne_model(packet);
      const bool other = !only.empty() && packet.source() != only;
      if (found != nullptr && !other) model = found;
      if (found == nullptr || other) strangers.note(packet, found);
    }
    if (model == nullptr) strangers.refuse(only);
    rewind();
  }

  // What a capture without the packets that are wanted has instead.
  struct Strangers {
    std::vector<std::string> sensors, others;

    static void add(std::vector<std::string>& names, std::string name) {
      if (names.size() < 5 && std::find(names.begin(), names.end(), name) == names.end())
        names.push_back(std::move(name));
    }
    void note(const Payload& packet, const VelodyneModel* found) {
      if (found != nullptr) return add(sensors, packet.source());
      const int product = velodyne_product(packet);
      add(others, product < 0 ? std::to_string(packet.size) + " bytes from " + packet.source()
                              : "Velodyne's product " + std::to_string(product) + " from " + packet.source());
    }
    [[noreturn]] void refuse(const std::string& only) const {
      if (!only.empty() && !sensors.empty())
        throw std::invalid_argument("no packets of a sensor at " + only + "; there are " + listed(sensors));
      const std::string all = listed(others);
      throw IoError("no packet of a VLP-16, HDL-32E or VLP-32C; UDP packets: " +
                    (all.empty() ? "none" : all));
    }
  };

  void rewind() {
    packets.emplace(file);
    origins.clear();
    sensors = 0;
    whole.clear();
    done = false;
  }

  bool read_packet() {
    Payload packet;
    if (done || !packets->next(packet)) return false;
    const VelodyneModel* const found = velodyne_model(packet);
    if (found == nullptr) return true;
    Origin& origin = origin_of(packet);
    if (only.empty() || origin.name == only) take(*found, packet, origin);
    return true;
  }

  Origin& origin_of(const Payload& packet) {
    const auto [found, fresh] = origins.try_emplace(packet.key());
    if (fresh) found->second.name = packet.source();
    return found->second;
  }

  void take(const VelodyneModel& found, const Payload& packet, Origin& origin) {
    VelodyneSensor* sensor = expecting(found, packet, origin);
    if (!origin.waiting.empty()) {
      const Payload earlier = origin.waiting_packet();
      const VelodyneModel& its = *velodyne_model(earlier);
      // The sensor goes on where it was: the packet between was another's. Else it has jumped.
      if (sensor != nullptr && origin.sensors.size() < kMostSensors) {
        const auto place = static_cast<std::size_t>(sensor - origin.sensors.data());
        add_sensor(its, origin).add(earlier, whole);
        sensor = &origin.sensors[place];
      } else {
        origin.sensors.front().finish(whole);
        origin.sensors.front().add(earlier, whole);
        sensor = expecting(found, packet, origin);
      }
      origin.waiting.clear();
    }
    const bool known = std::any_of(origin.sensors.begin(), origin.sensors.end(),
                                   [&](const VelodyneSensor& one) { return &one.model() == &found; });
    if (sensor == nullptr && !known) sensor = &add_sensor(found, origin);
    if (sensor != nullptr) return sensor->add(packet, whole);
    origin.waiting.assign(packet.data, packet.data + packet.size);
    origin.waiting_time_ns = packet.time_ns;
  }

  static VelodyneSensor* expecting(const VelodyneModel& found, const Payload& packet, Origin& origin) {
    for (VelodyneSensor& sensor : origin.sensors) {
      if (&sensor.model() == &found && sensor.expects(packet)) return &sensor;
    }
    return nullptr;
  }

  VelodyneSensor& add_sensor(const VelodyneModel& found, Origin& origin) {
    if (++sensors > 1 && sensors > said_sensors) {
      std::vector<std::string> names;
      for (const auto& [key, one] : origins)
        names.push_back(one.name);
      remarks.push_back("packets of " + std::to_string(sensors) + " sensors (" + listed(names) +
                        "): each frame is a revolution of one of them" +
                        (names.size() > 1 ? ", --topic chooses one" : ""));
      said_sensors = sensors;
    }
    return origin.sensors.emplace_back(found, sensors - 1);
  }

  void finish() {
    done = true;
    const std::size_t before = whole.size();
    for (auto& [key, origin] : origins) {
      if (!origin.waiting.empty()) {
        origin.sensors.front().finish(whole);
        origin.sensors.front().add(origin.waiting_packet(), whole);
      }
      for (VelodyneSensor& sensor : origin.sensors)
        sensor.finish(whole);
    }
    std::stable_sort(whole.begin() + static_cast<std::ptrdiff_t>(before), whole.end(),
                     [](const VelodyneSweep& a, const VelodyneSweep& b) { return a.stamp_ns < b.stamp_ns; });
  }

  std::filesystem::path file;
  std::string only;
  std::optional<PacketFile> packets;
  const VelodyneModel* model = nullptr;
  std::map<std::uint64_t, Origin> origins;
  std::size_t sensors = 0, said_sensors = 0;
  std::deque<VelodyneSweep> whole;
  std::vector<std::string> remarks;
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
  if (state.whole.empty()) return false;
  sweep = std::move(state.whole.front());
  state.whole.pop_front();
  return true;
}

std::vector<std::string> VelodyneReader::remarks() const {
  std::vector<std::string> all = state_->packets->remarks();
  all.insert(all.end(), state_->remarks.begin(), state_->remarks.end());
  return all;
}

}  // namespace pcl_bv
