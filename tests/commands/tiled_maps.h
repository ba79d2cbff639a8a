// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A map with ground and classes, as one file and cut into many.
#pragma once

#include <cmath>
#include <cstdio>
#include <cstring>
#include <string>
#include <vector>

#include "../io/las_bytes.h"
#include "tiles.h"

namespace pcl_bv::test {

struct MapPoint {
  std::array<float, 3> at;
  std::int16_t value;
};
using Map = std::vector<MapPoint>;

class TiledMaps : public Tiled {
 protected:
  // A hill of 80 m with houses, trees of 12 points each and reflections. The classes are 2 (ground), 6
  // (houses) and 3 to 5 (trees).
  static Map town(unsigned seed, std::size_t count) {
    std::mt19937 random(seed);
    const auto number = [&](double low, double high) {
      return low + (high - low) * static_cast<double>(random() % 65536) / 65536;
    };
    const auto ground = [](double x, double y) { return 2 * std::sin(x / 20) + 0.05 * y; };
    Map map;
    const auto add = [&](double x, double y, double above, int value) {
      map.push_back({{static_cast<float>(x), static_cast<float>(y), static_cast<float>(ground(x, y) + above)},
                     static_cast<std::int16_t>(value)});
    };
    for (int tree = 0; tree < 150; ++tree) {
      const double x = number(-40, 40), y = number(-40, 40);
      for (int i = 0; i < 12; ++i)
        add(x + number(-0.2, 0.2), y + number(-0.2, 0.2), number(1, 1.6), 3 + tree % 3);
    }
    while (map.size() < count) {
      const double x = number(-40, 40), y = number(-40, 40);
      const bool house =
          std::abs(std::fmod(x + 100, 20) - 10) < 4 && std::abs(std::fmod(y + 100, 25) - 10) < 5;
      add(x, y, house ? number(4, 5) : number(0, 0.05), house ? 6 : 2);
    }
    for (std::size_t i = 2000; i < map.size(); i += 9973)
      map[i].at[2] -= 30;
    for (std::size_t i = 70; i < map.size(); i += 400)
      map[i].at[i % 3] = std::numeric_limits<float>::quiet_NaN();
    if (seed % 2 == 0) std::shuffle(map.begin(), map.end(), random);
    return map;
  }

  std::string pcd(const std::string& name, const Map& map, bool as_text) const {
    std::string content = header(map.size(), as_text ? "ascii" : "binary");
    const auto replace = [&](const std::string& old, const std::string& by) {
      content.replace(content.find(old), old.size(), by);
    };
    replace("x y z", "class x y z");
    replace("4 4 4", "2 4 4 4");
    replace("F F F", "I F F F");
    replace("1 1 1", "1 1 1 1");
    for (const MapPoint& p : map) {
      char text[100];
      if (as_text) {
        std::snprintf(text, sizeof text, "%d %.9g %.9g %.9g\n", p.value, p.at[0], p.at[1], p.at[2]);
        content += text;
      } else {
        content.append(reinterpret_cast<const char*>(&p.value), 2);
        content.append(reinterpret_cast<const char*>(p.at.data()), 12);
      }
    }
    return file(name, content);
  }

  // Points without a finite coordinate are left out.
  std::string las(const std::string& name, const Map& map) const {
    Map finite;
    for (const MapPoint& p : map)
      if (std::isfinite(p.at[0] + p.at[1] + p.at[2])) finite.push_back(p);
    LasFile las;
    las.points = finite.size();
    std::string bytes = las.bytes();
    const std::size_t first = las.first_record();
    for (std::size_t i = 0; i < finite.size(); ++i) {
      const std::size_t at = first + i * las.record;
      for (std::size_t axis = 0; axis < 3; ++axis)
        LasFile::put(bytes, at + 4 * axis, static_cast<std::int32_t>(std::lround(1000 * finite[i].at[axis])));
      LasFile::put(bytes, at + 15, static_cast<std::uint8_t>(finite[i].value));
    }
    return file(name, bytes);
  }

  // Cuts the map into files; write(name, part, number) writes one. Returns the folder.
  template <typename Write>
  std::string folder(const std::string& name, const Map& map, std::size_t count, const Write& write) const {
    std::filesystem::create_directories(at(name));
    std::size_t begin = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t end =
          i + 1 == count ? map.size() : begin + (map.size() - begin) * 2 / (count - i + 1);
      const auto at = [&](std::size_t n) { return map.begin() + static_cast<std::ptrdiff_t>(n); };
      write(name + "/" + std::to_string(100 + i), Map(at(begin), at(end)), i);
      begin = end;
    }
    return at(name);
  }

  std::string pcd_tiles(const std::string& name, const Map& map, std::size_t count) const {
    return folder(name, map, count, [&](const std::string& tile, const Map& part, std::size_t i) {
      pcd(tile + ".pcd", part, i % 3 == 1);
    });
  }

  Result objects(std::vector<std::string> options, const std::vector<std::string>& more,
                 const std::string& input) const {
    options.insert(options.end(), {"--format", "jsonl"});
    options.insert(options.end(), more.begin(), more.end());
    options.push_back(input);
    return run(options);
  }

  std::string classes(const std::string& rows) const {
    return file("classes.yaml", "cluster: {tolerance: 0.5, class_field: class, classes: [" + rows + "]}");
  }
};

}  // namespace pcl_bv::test
