// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "browser.h"

#include <cairo.h>
#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <boost/asio/connect.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/http.hpp>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstring>
#include <memory>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <thread>
#include <utility>

namespace pcl_bv::test {
namespace {

namespace asio = boost::asio;
namespace http = boost::beast::http;
using Json = nlohmann::json;
using Clock = std::chrono::steady_clock;

constexpr int patience_seconds = 60;  // a page on a busy machine of two cores

// Until the text is in what the pipe brings, which is returned up to its end of line.
std::string line_with(int pipe, const std::string& text) {
  std::string all;
  const auto end = Clock::now() + std::chrono::seconds(patience_seconds);
  while (Clock::now() < end) {
    pollfd waiting{pipe, POLLIN, 0};
    if (poll(&waiting, 1, 100) <= 0) continue;
    std::array<char, 512> part{};
    const ssize_t read_bytes = read(pipe, part.data(), part.size());
    if (read_bytes <= 0) break;
    all.append(part.data(), static_cast<std::size_t>(read_bytes));
    const std::size_t at = all.find(text);
    if (at != std::string::npos && all.find('\n', at) != std::string::npos) return all.substr(at);
  }
  throw std::runtime_error("chromedriver does not start: " + all);
}

// A request that nobody answers ends after a minute: Beast's own timeouts are for asynchronous calls only.
void limit_waiting(asio::ip::tcp::socket& socket) {
  const timeval limit{patience_seconds, 0};
  setsockopt(socket.native_handle(), SOL_SOCKET, SO_RCVTIMEO, &limit, sizeof limit);
  setsockopt(socket.native_handle(), SOL_SOCKET, SO_SNDTIMEO, &limit, sizeof limit);
}

constexpr std::string_view base64_digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

// WebDriver's code points of keys without a character.
std::string key_code(const std::string& key) {
  if (key == "Escape") return "\uE00C";
  if (key == "ArrowLeft") return "\uE012";
  if (key == "ArrowRight") return "\uE014";
  return key;
}

}  // namespace

Browser::Browser(int width, int height) {
  try {
    start_driver();
    start_session(width, height);
  } catch (...) {
    stop();
    throw;
  }
}

Browser::~Browser() {
  stop();
}

void Browser::stop() noexcept {
  try {
    if (!session_.empty())
      request("DELETE", session_, {});  // ends the browser; killing the driver may leave it
  } catch (const std::exception&) {     // it is gone already
  }
  if (driver_ > 0) {
    kill(driver_, SIGTERM);
    for (int tries = 0; tries < 50 && waitpid(driver_, nullptr, WNOHANG) == 0; ++tries) {
      if (tries == 49) kill(driver_, SIGKILL);
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
  }
  if (output_ >= 0) close(output_);
}

void Browser::start_driver() {
  std::array<int, 2> pipe{};
  if (pipe2(pipe.data(), O_CLOEXEC) != 0) throw std::system_error(errno, std::generic_category(), "pipe");
  const pid_t test = getpid();
  driver_ = fork();
  if (driver_ == 0) {
    prctl(PR_SET_PDEATHSIG, SIGTERM);  // a test that is killed leaves none behind
    if (getppid() != test) _exit(1);
    dup2(pipe[1], STDOUT_FILENO);
    dup2(pipe[1], STDERR_FILENO);
    execlp("chromedriver", "chromedriver", "--port=0", nullptr);
    _exit(127);
  }
  close(pipe[1]);
  output_ = pipe[0];
  if (driver_ < 0) throw std::system_error(errno, std::generic_category(), "fork");
  const std::string text = "successfully on port ";
  port_ = static_cast<std::uint16_t>(std::stoi(line_with(output_, text).substr(text.size())));
}

void Browser::start_session(int width, int height) {
  const Json arguments = {"--headless",
                          "--no-sandbox",
                          "--disable-quic",
                          "--no-first-run",
                          "--disable-background-networking",
                          "--disable-component-update",
                          "--disable-sync",
                          "--disable-dev-shm-usage",
                          "--hide-scrollbars",
                          "--force-color-profile=srgb",
                          "--use-gl=angle",
                          "--use-angle=swiftshader",
                          "--enable-unsafe-swiftshader",
                          "--user-data-dir=" + profile_.path().string()};
  const Json wanted = {{"browserName", "chrome"}, {"goog:chromeOptions", {{"args", arguments}}}};
  const Json answer = request("POST", "/session", {{"capabilities", {{"alwaysMatch", wanted}}}});
  session_ = "/session/" + answer.at("sessionId").get<std::string>();
  // The window's size would count a frame that a headless browser does not have.
  command("Emulation.setDeviceMetricsOverride",
          {{"width", width}, {"height", height}, {"deviceScaleFactor", 1}, {"mobile", false}});
}

Json Browser::command(const std::string& cmd, const Json& parameters) {
  return request("POST", session_ + "/goog/cdp/execute", {{"cmd", cmd}, {"params", parameters}});
}

Json Browser::request(const std::string& verb, const std::string& path, const Json& body) {
  asio::io_context context;
  asio::ip::tcp::socket socket(context);
  socket.connect({asio::ip::address_v4::loopback(), port_});
  limit_waiting(socket);
  http::request<http::string_body> message{http::string_to_verb(verb), path, 11};
  message.set(http::field::host, "127.0.0.1:" + std::to_string(port_));
  message.set(http::field::content_type, "application/json");
  if (!body.is_null()) message.body() = body.dump();
  message.prepare_payload();
  http::write(socket, message);
  boost::beast::flat_buffer buffer;
  http::response_parser<http::string_body> parser;
  parser.body_limit(std::uint64_t{256} << 20);  // screenshots
  http::read(socket, buffer, parser);
  Json value = Json::parse(parser.get().body()).at("value");
  if (parser.get().result() != http::status::ok)
    throw std::runtime_error(verb + " " + path + ": " + value.value("message", value.dump()));
  return value;
}

void Browser::open(const std::string& url) {
  request("POST", session_ + "/url", {{"url", url}});
}

Json Browser::run(const std::string& body) {
  return request("POST", session_ + "/execute/sync", {{"script", body}, {"args", Json::array()}});
}

void Browser::until(const std::string& expression, double seconds) {
  const auto end = Clock::now() + std::chrono::duration<double>(seconds);
  while (run("return !!(" + expression + ")") != true) {
    if (Clock::now() > end) throw std::runtime_error("never came true: " + expression);
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
}

Picture Browser::screenshot() {
  return decode_png(from_base64(request("GET", session_ + "/screenshot", {}).get<std::string>()));
}

void Browser::click(double x, double y) {
  const Json move = {{"type", "pointerMove"}, {"duration", 0}, {"x", std::lround(x)}, {"y", std::lround(y)}};
  const Json down = {{"type", "pointerDown"}, {"button", 0}};
  const Json up = {{"type", "pointerUp"}, {"button", 0}};
  const Json mouse = {{"type", "pointer"}, {"id", "mouse"}, {"actions", {move, down, up}}};
  request("POST", session_ + "/actions", {{"actions", Json::array({mouse})}});
}

void Browser::wheel(double x, double y, int turned) {
  const Json scroll = {{"type", "scroll"},    {"duration", 0}, {"x", std::lround(x)},
                       {"y", std::lround(y)}, {"deltaX", 0},   {"deltaY", turned}};
  const Json wheel = {{"type", "wheel"}, {"id", "wheel"}, {"actions", Json::array({scroll})}};
  request("POST", session_ + "/actions", {{"actions", Json::array({wheel})}});
}

void Browser::press(const std::string& key) {
  const Json down = {{"type", "keyDown"}, {"value", key_code(key)}};
  const Json up = {{"type", "keyUp"}, {"value", key_code(key)}};
  const Json keys = {{"type", "key"}, {"id", "keys"}, {"actions", {down, up}}};
  request("POST", session_ + "/actions", {{"actions", Json::array({keys})}});
}

void Browser::prefer(const std::string& theme) {
  const Json feature = {{"name", "prefers-color-scheme"}, {"value", theme}};
  command("Emulation.setEmulatedMedia", {{"features", Json::array({feature})}});
}

Picture decode_png(const std::string& png) {
  std::string_view rest = png;
  const auto next = [](void* from, unsigned char* to, unsigned count) {
    auto& bytes = *static_cast<std::string_view*>(from);
    if (bytes.size() < count) return CAIRO_STATUS_READ_ERROR;
    std::memcpy(to, bytes.data(), count);
    bytes.remove_prefix(count);
    return CAIRO_STATUS_SUCCESS;
  };
  const std::unique_ptr<cairo_surface_t, void (*)(cairo_surface_t*)> surface(
      cairo_image_surface_create_from_png_stream(next, &rest), cairo_surface_destroy);
  if (cairo_surface_status(surface.get()) != CAIRO_STATUS_SUCCESS) throw std::runtime_error("not a PNG");
  Picture picture{
      cairo_image_surface_get_width(surface.get()), cairo_image_surface_get_height(surface.get()), {}};
  const unsigned char* data = cairo_image_surface_get_data(surface.get());
  const int stride = cairo_image_surface_get_stride(surface.get());
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      std::uint32_t argb = 0;
      std::memcpy(&argb, data + static_cast<std::ptrdiff_t>(y) * stride + 4 * x, 4);
      for (const int shift : {16, 8, 0, 24})
        picture.rgba.push_back(static_cast<std::uint8_t>(argb >> shift));
    }
  }
  return picture;
}

std::string base64(const std::string& bytes) {
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k)
      bits = bits << 8 | (i + k < bytes.size() ? static_cast<std::uint8_t>(bytes[i + k]) : 0U);
    for (std::size_t k = 0; k < 4; ++k)
      text += i + k > bytes.size() ? '=' : base64_digits[bits >> (18 - 6 * k) & 63];
  }
  return text;
}

std::string from_base64(const std::string& text) {
  std::string bytes;
  std::uint32_t bits = 0;
  int count = 0;
  for (const char digit : text) {
    const std::size_t value = base64_digits.find(digit);
    if (value == std::string_view::npos) continue;  // `=` at the end
    bits = bits << 6 | static_cast<std::uint32_t>(value);
    count += 6;
    if (count < 8) continue;
    count -= 8;
    bytes += static_cast<char>(bits >> count & 255);
  }
  return bytes;
}

}  // namespace pcl_bv::test
