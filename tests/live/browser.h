// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A headless Chromium for tests, driven through chromedriver by W3C WebDriver.
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "temporary_folder.h"

namespace pcl_bv::test {

/// A picture of the page: red, green, blue and alpha of each pixel, row by row from the upper left corner.
struct Picture {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgba;

  const std::uint8_t* at(int x, int y) const { return &rgba[4 * (static_cast<std::size_t>(y) * width + x)]; }
};

/// One page in a browser of its own, with WebGL2 in software (SwiftShader) and an empty profile. Everything
/// that fails or takes longer than a minute throws std::runtime_error.
class Browser {
 public:
  /// The page's size in pixels; both processes are ended by the destructor.
  explicit Browser(int width = 800, int height = 600);
  ~Browser();
  Browser(const Browser&) = delete;
  Browser& operator=(const Browser&) = delete;

  void open(const std::string& url);
  /// What the body of a function returns: `run("return 1 + 1")`. A promise is waited for.
  nlohmann::json run(const std::string& body);
  /// Waits until an expression is true.
  void until(const std::string& expression, double seconds = 60);
  Picture screenshot();
  /// The left button, at a pixel of the page.
  void click(double x, double y);
  /// Turns the wheel at a pixel of the page; negative: towards the user's scene, nearer.
  void wheel(double x, double y, int turned);
  /// A key with the focus where it is: a character, or a name of WebDriver's: "Escape", "ArrowLeft",
  /// "ArrowRight".
  void press(const std::string& key);
  /// "dark" or "light", as the system would prefer it; takes effect on pages that are open, too.
  void prefer(const std::string& theme);

 private:
  void start_driver();
  void start_session(int width, int height);
  void stop() noexcept;
  nlohmann::json command(const std::string& cmd, const nlohmann::json& parameters);
  nlohmann::json request(const std::string& verb, const std::string& path, const nlohmann::json& body);

  TemporaryFolder profile_;
  int driver_ = 0;  // its process
  int output_ = -1;
  std::uint16_t port_ = 0;
  std::string session_;  // "/session/ID"
};

/// The picture that PNG bytes are.
Picture decode_png(const std::string& png);
std::string base64(const std::string& bytes);
std::string from_base64(const std::string& text);

}  // namespace pcl_bv::test
