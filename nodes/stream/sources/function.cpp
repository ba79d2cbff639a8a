// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Each call of the function runs in its own detached thread, so that the source never has to wait for the end
// of a call.

#include <future>
#include <thread>

#include "pcl_bv/nodes/frame_source.h"

namespace pcl_bv {
namespace {

class FunctionSource : public FrameSource {
 public:
  explicit FunctionSource(std::function<bool(Frame&)> function)
      : function_(std::make_shared<std::function<bool(Frame&)>>(std::move(function))) {}

  Next next(Frame& frame, std::chrono::milliseconds timeout) override {
    if (!answer_.valid()) {
      std::packaged_task<Answer()> call([function = function_] {
        Answer answer;
        answer.more = (*function)(answer.frame);
        return answer;
      });
      answer_ = call.get_future();
      std::thread(std::move(call)).detach();
    }
    if (answer_.wait_for(timeout) != std::future_status::ready) return Next::timeout;
    Answer answer = answer_.get();
    frame = std::move(answer.frame);
    return answer.more ? Next::frame : Next::end;
  }

 private:
  struct Answer {
    Frame frame;
    bool more = false;
  };

  // Shared with the thread, which may outlive the source.
  std::shared_ptr<std::function<bool(Frame&)>> function_;
  std::future<Answer> answer_;
};

}  // namespace

std::unique_ptr<FrameSource> make_source(std::function<bool(Frame&)> next) {
  return std::make_unique<FunctionSource>(std::move(next));
}

}  // namespace pcl_bv
