// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The page while frames come, in a browser.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <mutex>
#include <thread>

#include "browser.h"
#include "pcl_bv/nodes/frame_pipeline.h"
#include "pcl_bv/nodes/frame_sink.h"

namespace pcl_bv::test {
using namespace detail;
namespace {

using testing::HasSubstr;

// Two cubes of 1 m with 1331 points each, 6 m apart, of which one moves by 0.1 m a frame; above a ground.
std::vector<float> cubes(std::uint64_t frame, bool left) {
  std::vector<float> xyz;
  for (int i = 0; i < 2 * 1331; ++i) {
    const int k = i % 1331;
    const float x = 0.1F * static_cast<float>(k % 11), y = 0.1F * static_cast<float>(k / 11 % 11),
                z = 0.1F * static_cast<float>(k / 121);
    const float moved = i < 1331 ? 0 : 0.1F * static_cast<float>(frame % 40);
    xyz.insert(xyz.end(), {x + moved + (left ? 50.F : 0.F), i < 1331 ? y - 3.5F : y + 2.5F, z});
  }
  return xyz;
}

// A pipeline that shows its results on a port, at 20 Hz, while it is told to run.
class Streaming {
 public:
  explicit Streaming(const std::string& address = "0") {
    PipelineConfig config;
    config.filter.range_min = 0;
    config.ground.method = GroundMethod::none;
    config.volumes = {"aabb"};
    config.track.enabled = true;
    pipeline_.set_config(config);
    sink_ = make_sink(parse_sink("ws:" + address));
    const std::string shows = sink_->take_warnings().at(0);
    port = shows.substr(shows.rfind(':') + 1, shows.find('/', shows.rfind(':')) - shows.rfind(':') - 1);
    sink_->offer_settings(remote_settings(pipeline_));
    thread_ = std::thread([this] { run(); });
  }
  ~Streaming() {
    running_ = false;
    thread_.join();
  }

  std::string url() const { return "http://127.0.0.1:" + port + "/"; }
  PipelineConfig config() const { return pipeline_.config(); }
  void lose_one() { lose_ = true; }
  /// The cubes are replaced by others, so that their tracks end.
  void replace() { left_ = true; }

  std::string port;

 private:
  void run() {
    for (std::uint64_t i = 0; running_; ++i) {
      const std::vector<float> xyz = cubes(i, left_);
      Frame frame;
      frame.header = {i, static_cast<std::int64_t>(i) * 50'000'000, "<i>lidar</i>"};
      frame.points = PointView::of(xyz.data(), 12, xyz.size() / 3);
      pipeline_.process(frame, result_);
      if (lose_.exchange(false)) {
        sink_->write_lost(frame, "the queue was full");
      } else {
        sink_->write(frame, result_);
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    sink_->close();
  }

  FramePipeline pipeline_;
  FrameResult result_;
  std::unique_ptr<FrameSink> sink_;
  std::atomic<bool> running_{true}, lose_{false}, left_{false};
  std::thread thread_;
};

struct LivePage : testing::Test {
  void open(const Streaming& streaming) {
    browser.open(streaming.url());
    browser.until("window.pclBv && pclBv.connected && pclBv.frames > 5 && pclBv.state.objects === 2");
  }
  std::string text_of(const char* id) {
    return browser.run(std::string("return document.getElementById('") + id + "').textContent")
        .get<std::string>();
  }

  Browser browser{1000, 700};
};

TEST_F(LivePage, DrawsObjectsWhereTheyAreAndNamesThemByTheirTracks) {
  const Streaming streaming;
  open(streaming);
  browser.until("pclBv.state.seq > 20");
  browser.press(" ");
  const nlohmann::json at = browser.run("return pclBv.project(0.5, -3, 0.5)");
  const std::string key =
      browser.run("return pclBv.pick(" + at[0].dump() + "," + at[1].dump() + ")").get<std::string>();
  EXPECT_THAT(key, HasSubstr("track "));
  browser.click(at[0], at[1]);
  browser.until("pclBv.picked === '" + key + "'");
  browser.until("/1.331.*aabb/s.test(document.getElementById('picked-rows').textContent)");
  EXPECT_THAT(text_of("frame-text"), HasSubstr("<i>lidar</i>"));  // as text
  const Picture picture = browser.screenshot();
  const auto pixel = [&](const nlohmann::json& place) {
    const std::uint8_t* const rgb = picture.at(place[0].get<int>(), place[1].get<int>());
    return std::vector<int>(rgb, rgb + 3);
  };
  EXPECT_NE(pixel(at), pixel({5, 60}));  // the background
  EXPECT_EQ(browser.run("return pclBv.state.error"), "");
}

TEST_F(LivePage, SaysWhenTheConnectionIsGoneAndComesBack) {
  auto streaming = std::make_unique<Streaming>();
  const std::string port = streaming->port;
  open(*streaming);
  streaming.reset();
  browser.until("!pclBv.connected && !document.getElementById('banner').hidden");
  EXPECT_THAT(text_of("banner"), HasSubstr("connection lost"));
  const Streaming again(port);
  browser.until("pclBv.connected && document.getElementById('banner').hidden");
  const nlohmann::json drawn = browser.run("return pclBv.frames");
  browser.until("pclBv.frames > " + drawn.dump() + " + 5");
}

TEST_F(LivePage, ChangesSettingsAndShowsWhyAValueIsRefused) {
  const Streaming streaming;
  open(streaming);
  const auto set = [&](const char* value) {
    browser.run(
        std::string("const field = document.getElementById('setting-cluster.tolerance'); field.value = '") +
        value + "'; field.dispatchEvent(new Event('change'))");
  };
  browser.until("document.getElementById('setting-cluster.tolerance')?.value === '0.5'");
  set("8");  // both cubes become one object
  browser.until("pclBv.state.objects === 1");
  EXPECT_EQ(streaming.config().cluster.tolerance, 8);
  set("-1");
  browser.until("document.getElementById('settings').textContent.includes('-1 is not at least 0')");
  browser.until("document.getElementById('setting-cluster.tolerance').value === '8'");
  EXPECT_EQ(streaming.config().cluster.tolerance, 8);
  EXPECT_EQ(browser.run("return document.getElementById('setting-filter.regions').disabled"), true);
}

TEST_F(LivePage, StepsThroughTheLastFramesWhileItIsPaused) {
  const Streaming streaming;
  open(streaming);
  browser.press(" ");
  browser.until("pclBv.state.paused");
  const int seq = browser.run("return pclBv.state.seq").get<int>();
  browser.press("ArrowLeft");
  browser.until("pclBv.state.seq < " + std::to_string(seq));
  browser.press("ArrowRight");
  browser.until("pclBv.state.seq === " + std::to_string(seq));
  browser.press("ArrowRight");  // the next that comes
  browser.until("pclBv.state.seq > " + std::to_string(seq));
  browser.press(" ");
  browser.until("!pclBv.state.paused && pclBv.state.seq > " + std::to_string(seq + 10));
}

TEST_F(LivePage, PicksATrackNoMoreThatHasEnded) {
  Streaming streaming;
  open(streaming);
  browser.until(
      "[...document.querySelectorAll('#object-rows tr')].some((row) => row.dataset.key === 'track 0')");
  browser.run("document.querySelector('#object-rows tr[data-key=\"track 0\"]').click()");
  browser.until("pclBv.picked === 'track 0'");
  streaming.replace();
  browser.until("!document.getElementById('picked-gone').hidden");
  EXPECT_EQ(text_of("picked-gone"), "track 0 is not in this frame.");
  browser.until("pclBv.picked === null && document.getElementById('picked-gone').hidden");
  EXPECT_EQ(text_of("notice"), "track 0 has ended.");
}

TEST_F(LivePage, ShowsAllOfItsFooterOnAPhone) {
  const Streaming streaming;
  for (const auto& [width, height] : {std::pair(360, 640), {390, 844}, {640, 360}}) {
    Browser phone(width, height);
    phone.open(streaming.url());
    phone.until(
        "window.pclBv && pclBv.frames > 5 && document.getElementById('drop-text').textContent !== ''");
    EXPECT_EQ(phone.run("return innerWidth"), width);
    EXPECT_EQ(
        phone.run("return document.querySelector('footer').getBoundingClientRect().bottom <= innerHeight"),
        true);
    for (const char* text : {"total-text", "rate-text", "drop-text"}) {
      const std::string whole =
          std::string("const text = document.getElementById('") + text +
          "'), caption = text.closest('figcaption');"
          "const range = document.createRange(); range.selectNodeContents(text);"
          "const a = range.getBoundingClientRect(), b = caption.getBoundingClientRect();"
          "return a.bottom <= b.bottom + 1 && a.right <= b.right + 1";
      EXPECT_EQ(phone.run(whole), true) << text << " at " << width;
    }
  }
}

TEST_F(LivePage, CountsLostFrames) {
  Streaming streaming;
  open(streaming);
  EXPECT_EQ(browser.run("return pclBv.state.dropped"), 0);
  streaming.lose_one();
  browser.until("pclBv.state.dropped === 1");
  browser.until("document.getElementById('drop-text').textContent.includes('dropped 1')");
}

}  // namespace
}  // namespace pcl_bv::test
