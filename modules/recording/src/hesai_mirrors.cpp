// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "hesai_mirrors.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

#include "packet_numbers.h"
#include "pcl_bv/io/untrusted_text.h"

namespace pcl_bv::detail {
namespace {

constexpr std::size_t kMirrorHeader = 16, kMirrorChecksum = 32, kMirrorChannels = 128, kMaxMirrors = 8;
constexpr double kMirrorCircle = 36'000;  // hundredths of a degree

// Reads the parts of the file in their order.
class MirrorFile {
 public:
  explicit MirrorFile(std::string_view bytes)
      : at_(reinterpret_cast<const std::byte*>(bytes.data()) + kMirrorHeader) {}

  // `unit` is in hundredths of a degree.
  template <class Integer>
  std::vector<double> take(std::size_t count, double unit) {
    std::vector<double> numbers(count);
    for (double& number : numbers) {
      number = little_endian<Integer>(at_) * unit;
      at_ += sizeof(Integer);
    }
    return numbers;
  }

 private:
  const std::byte* at_;
};

bool are_within(const std::vector<double>& angles, double limit) {
  return std::all_of(angles.begin(), angles.end(), [=](double angle) { return std::abs(angle) <= limit; });
}

}  // namespace

long long HesaiMirrors::frame_at(double unwrapped) const {
  const double revolution = std::floor(unwrapped / kMirrorCircle);
  const double within = unwrapped - revolution * kMirrorCircle;
  const auto begun = std::upper_bound(starts.begin(), starts.end(), within) - starts.begin();
  return static_cast<long long>(revolution) * static_cast<long long>(starts.size()) + begun;
}

double HesaiMirrors::start_of(double azimuth) const {
  const auto after = std::upper_bound(starts.begin(), starts.end(), azimuth);
  return after == starts.begin() ? starts.back() - kMirrorCircle : *(after - 1);
}

HesaiMirrors parse_hesai_mirrors(std::string_view bytes) {
  if (bytes.size() < kMirrorHeader || bytes.substr(0, 2) != "\xEE\xFF")
    throw IoError("does not begin with 0xEE 0xFF");
  const auto byte = [&](std::size_t at) { return static_cast<std::uint8_t>(bytes[at]); };
  if (byte(2) != 1 || byte(3) != 5)
    throw IoError("has version " + std::to_string(byte(2)) + "." + std::to_string(byte(3)) +
                  ", and only version 1.5 is supported");
  const std::size_t channels = byte(4), mirrors = byte(5), unit = byte(15);
  if (channels != kMirrorChannels || mirrors == 0 || mirrors > kMaxMirrors || unit == 0)
    throw IoError("has " + std::to_string(channels) + " channels, " + std::to_string(mirrors) +
                  " mirrors and the unit " + std::to_string(unit) +
                  "; 128, 1 to 8 and at least 1 are allowed");
  const std::size_t size =
      kMirrorHeader + 8 * mirrors + 8 * channels + 2 * channels * HesaiMirrors::kSteps + kMirrorChecksum;
  if (bytes.size() != size)
    throw IoError("has " + std::to_string(bytes.size()) + " bytes instead of " + std::to_string(size));
  MirrorFile file(bytes);
  const auto fine = static_cast<double>(unit) / 256, coarse = static_cast<double>(unit);
  HesaiMirrors read;
  read.starts = file.take<std::uint32_t>(mirrors, fine);
  const std::vector<double> ends = file.take<std::uint32_t>(mirrors, fine);
  read.azimuths = file.take<std::int32_t>(channels, fine);
  read.elevations = file.take<std::int32_t>(channels, fine);
  read.azimuth_corrections = file.take<std::int8_t>(channels * HesaiMirrors::kSteps, coarse);
  read.elevation_corrections = file.take<std::int8_t>(channels * HesaiMirrors::kSteps, coarse);
  if (!are_within(read.starts, kMirrorCircle) || !are_within(ends, kMirrorCircle) ||
      !are_within(read.azimuths, kMirrorCircle) || !are_within(read.elevations, 9'000))
    throw IoError("has an elevation beyond 90 or an azimuth beyond 360 degrees");
  std::sort(read.starts.begin(), read.starts.end());
  return read;
}

}  // namespace pcl_bv::detail
