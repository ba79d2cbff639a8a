// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The cars of the street: a body with a sloping hood, a cabin that tapers to the roof, and four wheels.
#include <algorithm>
#include <array>

#include "street_parts.h"

namespace pcl_bv::detail {
namespace {

/// Lengths in metres. The x positions of the cabin are fractions of the car's length, forward of its middle.
struct CarShape {
  double length, width, height;
  double belt;                                      // height at which body and cabin meet
  double screen_base, roof_front, roof_rear, rear;  // x positions of the cabin, front to rear
  double taper;                                     // inward slope of the cabin's sides, metres per metre up
};

constexpr std::array shapes{
    CarShape{4.60, 1.80, 1.45, 0.93, 0.22, 0.04, -0.20, -0.38, 0.30},  // saloon
    CarShape{4.05, 1.74, 1.50, 0.95, 0.26, 0.08, -0.34, -0.47, 0.26},  // hatchback
    CarShape{4.75, 1.82, 1.48, 0.95, 0.22, 0.05, -0.37, -0.47, 0.28},  // estate
    CarShape{4.65, 1.88, 1.70, 1.05, 0.23, 0.07, -0.37, -0.48, 0.24},  // off-roader
    CarShape{5.00, 1.90, 1.95, 1.15, 0.42, 0.27, -0.47, -0.49, 0.08},  // van
};

Part make_body(const CarShape& car) {
  const double nose = 0.5 * car.length;
  const double side = 0.5 * car.width;
  Part body = extrude(Axis::y,
                      {{-nose + 0.12, 0.26},
                       {nose - 0.15, 0.26},
                       {nose, 0.42},
                       {nose - 0.02, 0.62},
                       {nose - 0.10, 0.80},
                       {car.screen_base * car.length, car.belt},
                       {-nose + 0.10, car.belt},
                       {-nose, 0.8 * car.belt},
                       {-nose, 0.42}},
                      -side, side);
  for (const double left : {-1.0, 1.0}) {
    cut(body, {0, left, 0.35}, {0, left * side, 0.65});
    cut(body, {0, left, -0.30}, {0, left * side, 0.45});
    for (const double front : {-1.0, 1.0}) {
      cut(body, {front, 0.7 * left, 0}, {front * (nose - 0.25), left * side, 0});
      cut(body, {front, 0.15 * left, 0}, {front * (nose - 0.06), left * (side - 0.3), 0});
    }
  }
  return body;
}

Part make_cabin(const CarShape& car) {
  const double base = car.belt - 0.05;
  const double side = 0.5 * car.width - 0.08;
  const double roof_side = side - car.taper * (car.height - base);
  const double front = car.roof_front * car.length;
  const double rear = car.roof_rear * car.length;
  Part cabin = extrude(Axis::y,
                       {{car.rear * car.length, base},
                        {car.screen_base * car.length, base},
                        {front, car.height - 0.06},
                        {0.5 * (front + rear), car.height},
                        {rear, car.height - 0.07}},
                       -side, side);
  for (const double left : {-1.0, 1.0}) {
    cut(cabin, {0, left, car.taper}, {0, left * side, base});
    cut(cabin, {0, left, 1.2}, {0, left * (roof_side - 0.15), car.height});
  }
  cabin.loss_probability = 1.0 / 3;
  return cabin;
}

}  // namespace

Model make_car(SplitMix64& random) {
  CarShape car = shapes[random.next() % shapes.size()];
  car.length *= random.uniform(0.97, 1.03);
  car.width *= random.uniform(0.97, 1.0);
  car.height *= random.uniform(0.98, 1.02);

  std::vector<Part> parts{make_body(car), make_cabin(car)};
  const double side = 0.5 * car.width;
  for (const double front : {-0.3, 0.3}) {
    const double axle = front * car.length;
    for (const double left : {-1.0, 1.0}) {
      const double inner = left * (side - 0.24);
      const double outer = left * (side - 0.03);
      parts.push_back(extrude(Axis::y, regular_polygon(16, 0.32, axle, 0.32), std::min(inner, outer),
                              std::max(inner, outer)));
      const double face = left * (side + 0.01);
      parts[0].pockets.push_back(
          {{axle - 0.36, std::min(inner, face), 0.25}, {axle + 0.36, std::max(inner, face), 0.68}});
    }
  }
  return assemble(SynthObjectKind::car, std::move(parts));
}

}  // namespace pcl_bv::detail
