// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The family of Hesai sensors.

#include <array>
#include <map>

#include "hesai_correction.h"
#include "hesai_sensor.h"
#include "pcl_bv/io/untrusted_text.h"
#include "sensor_family.h"

namespace pcl_bv::detail {
namespace {

constexpr std::size_t kMaxHesaiBytes = std::size_t{1} << 16;  // real correction files have 1 to 47 kB

// The content of the correction file, or the reason why it cannot be used. Both are empty without a file.
struct FoundCorrection {
  HesaiCorrection content{};
  std::string reason{};

  bool has_file() const { return !content.is_empty() || !reason.empty(); }
};

FoundCorrection find_correction(const std::filesystem::path& file, bool has_mirrors) {
  FoundCorrection found;
  std::error_code unknown;
  if (!std::filesystem::exists(file, unknown)) return found;
  try {
    const std::string bytes = read_untrusted_text(file, kMaxHesaiBytes);
    if (has_mirrors) {
      found.content.mirrors = parse_hesai_mirrors(bytes);
    } else {
      found.content.angles = parse_hesai_correction(bytes);
    }
  } catch (const IoError& error) {
    found.reason = printable(file.filename().string()) +
                   " is no usable angle correction file of a Hesai sensor: " + error.what();
  }
  return found;
}

class HesaiFamily final : public SensorFamily {
 public:
  explicit HesaiFamily(const std::filesystem::path& capture) : capture_(capture) {}

  std::optional<std::size_t> model_of(const Payload& packet) const override {
    const HesaiModel* const model = hesai_model(packet);
    if (model == nullptr || correction_of(*model).is_empty()) return std::nullopt;
    return static_cast<std::size_t>(model - hesai_models().data());
  }

  std::string_view model_name(std::size_t model) const override { return hesai_models()[model].name; }

  std::unique_ptr<SweepAssembler> make_assembler(std::size_t model) const override {
    std::shared_ptr<const HesaiGeometry>& geometry = geometries_[model];
    if (!geometry) {
      const HesaiModel& sensor = hesai_models()[model];
      geometry = std::make_shared<const HesaiGeometry>(sensor, correction_of(sensor));
    }
    return std::make_unique<HesaiSensor>(geometry);
  }

  std::string undecodable(const Payload& packet) const override {
    if (const HesaiModel* const model = hesai_model(packet)) {
      requirement_ = missing_for(*model);
      return "a packet of a Hesai " + std::string(model->name);
    }
    constexpr std::size_t shortest = 500;  // bytes, of Hesai's packets with points
    if (packet.size < shortest || packet.data[0] != std::byte{0xEE} || packet.data[1] != std::byte{0xFF})
      return {};
    requirement_.clear();
    return "a Hesai packet of version " + std::to_string(std::to_integer<int>(packet.data[2])) + "." +
           std::to_string(std::to_integer<int>(packet.data[3])) + " with " + std::to_string(packet.size) +
           " bytes";
  }

  std::string requirement() const override { return requirement_; }

 private:
  std::filesystem::path file_for(const HesaiModel& model) const {
    return own_hesai_correction(capture_, model.has_mirrors);
  }

  // The file is not read before the first packet that needs it, because it may belong to something else.
  const FoundCorrection& file_content(const HesaiModel& model) const {
    std::optional<FoundCorrection>& found = found_[model.has_mirrors ? 1 : 0];
    if (!found) found = find_correction(file_for(model), model.has_mirrors);
    return *found;
  }

  // Returns the angles of the model's channels. They are empty if they are unknown, see missing_for().
  const HesaiCorrection& correction_of(const HesaiModel& model) const {
    std::optional<HesaiCorrection>& known =
        corrections_[static_cast<std::size_t>(&model - hesai_models().data())];
    if (known) return *known;
    const FoundCorrection& found = file_content(model);
    known = found.has_file() ? found.content : HesaiCorrection{published_angles(model), {}};
    if (!known->is_for(model)) known = HesaiCorrection();
    return *known;
  }

  std::string missing_for(const HesaiModel& model) const {
    const FoundCorrection& found = file_content(model);
    if (!found.reason.empty()) return found.reason;
    const std::filesystem::path file = file_for(model);
    const std::string name = printable(file.filename().string());
    if (found.has_file())
      return name + " has " + std::to_string(found.content.angles.size()) + " channels, the sensor has " +
             std::to_string(model.channels);
    return "the angle correction file of the Hesai sensor is missing: put its " + file.extension().string() +
           " file next to the capture, as " + name;
  }

  std::filesystem::path capture_;
  mutable std::array<std::optional<FoundCorrection>, 2> found_{};  // without and with mirrors
  mutable std::map<std::size_t, std::optional<HesaiCorrection>> corrections_;
  mutable std::map<std::size_t, std::shared_ptr<const HesaiGeometry>> geometries_;
  mutable std::string requirement_;  // of the last packet that could not be decoded
};

}  // namespace

std::unique_ptr<SensorFamily> open_hesai(const std::filesystem::path& capture) {
  return std::make_unique<HesaiFamily>(capture);
}

}  // namespace pcl_bv::detail
