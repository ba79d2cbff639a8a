// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The family of Velodyne sensors.

#include "sensor_family.h"
#include "velodyne_sensor.h"

namespace pcl_bv::detail {
namespace {

constexpr std::size_t kMaxVelodynes = 8;  // sensors of one model behind one address and port

// The packets of one model from one address to one port. They are usually of one sensor. If a relay or a
// program that plays a file back sends the packets, they can be of several sensors.
class VelodyneAssembler final : public SweepAssembler {
 public:
  explicit VelodyneAssembler(const VelodyneModel& model) : model_(&model) {}

  void add(const Payload& packet, SweepQueue& queue) override {
    VelodyneSensor* sensor = expecting(packet);
    if (!waiting_.empty()) {
      const Payload earlier = waiting_packet();
      // If a sensor expects `packet`, the waiting packet is from another sensor. Otherwise the azimuth has
      // jumped, and the waiting packet is the first one after the jump.
      if (sensor != nullptr && sensors_.size() < kMaxVelodynes) {
        const auto index = static_cast<std::size_t>(sensor - sensors_.data());
        add_sensor(queue).add(earlier, queue.whole);
        sensor = &sensors_[index];
      } else {
        sensors_.front().finish(queue.whole);
        sensors_.front().add(earlier, queue.whole);
        sensor = expecting(packet);
      }
      waiting_.clear();
    }
    if (sensors_.empty()) sensor = &add_sensor(queue);
    if (sensor != nullptr) return sensor->add(packet, queue.whole);
    waiting_.assign(packet.data, packet.data + packet.size);
    waiting_time_ns_ = packet.time_ns;
  }

  void finish(SweepQueue& queue) override {
    if (!waiting_.empty()) {
      sensors_.front().finish(queue.whole);
      sensors_.front().add(waiting_packet(), queue.whole);
    }
    for (VelodyneSensor& sensor : sensors_)
      sensor.finish(queue.whole);
  }

 private:
  // Returns the sensor whose predicted azimuth is closest to that of the packet, or null if none is close.
  VelodyneSensor* expecting(const Payload& packet) {
    VelodyneSensor* closest = nullptr;
    double smallest = 0;
    for (VelodyneSensor& sensor : sensors_) {
      const double difference = sensor.difference(packet);
      if (difference > VelodyneSensor::kMaxDifference || (closest != nullptr && difference >= smallest))
        continue;
      closest = &sensor;
      smallest = difference;
    }
    return closest;
  }

  VelodyneSensor& add_sensor(SweepQueue& queue) { return sensors_.emplace_back(*model_, queue.sensors++); }

  Payload waiting_packet() const { return {waiting_time_ns_, waiting_.data(), waiting_.size()}; }

  const VelodyneModel* model_;
  std::vector<VelodyneSensor> sensors_;
  std::vector<std::byte> waiting_;  // packet that no sensor expects; see add()
  std::int64_t waiting_time_ns_ = 0;
};

class VelodyneFamily final : public SensorFamily {
 public:
  std::optional<std::size_t> model_of(const Payload& packet) const override {
    const VelodyneModel* const model = velodyne_model(packet);
    if (model == nullptr) return std::nullopt;
    return index_of(*model);
  }

  std::string_view model_name(std::size_t model) const override { return velodyne_model(model).name; }

  std::unique_ptr<SweepAssembler> make_assembler(std::size_t model) const override {
    return std::make_unique<VelodyneAssembler>(velodyne_model(model));
  }

  std::string undecodable(const Payload& packet) const override {
    const int product = velodyne_product(packet);
    return product < 0 ? std::string() : "Velodyne's product " + std::to_string(product);
  }
};

}  // namespace

std::unique_ptr<SensorFamily> open_velodyne(const std::filesystem::path&) {
  return std::make_unique<VelodyneFamily>();
}

}  // namespace pcl_bv::detail
