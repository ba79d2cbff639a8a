// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A function that may wait for ever, in a thread that nobody has to wait for.

#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>

#include "pcl_bv/nodes/frame_source.h"

namespace pcl_bv {
namespace {

// What the source and its thread share; the thread may outlive the source.
struct Shared {
  enum class State { idle, asked, answered, over };

  void serve() {
    std::unique_lock lock(mutex);
    for (;;) {
      changed.wait(lock, [this] { return state == State::asked || state == State::over; });
      if (state == State::over) return;
      lock.unlock();
      Frame came;
      bool has_more = false;
      std::exception_ptr thrown;
      try {
        has_more = function(came);
      } catch (...) {
        thrown = std::current_exception();
      }
      lock.lock();
      if (state == State::over) return;
      frame = std::move(came);
      more = has_more;
      error = thrown;
      state = State::answered;
      changed.notify_all();
    }
  }

  std::function<bool(Frame&)> function;
  std::mutex mutex;
  std::condition_variable changed;
  State state = State::idle;
  Frame frame;
  bool more = false;
  std::exception_ptr error;
};

class FunctionSource : public FrameSource {
 public:
  explicit FunctionSource(std::function<bool(Frame&)> function) {
    shared_->function = std::move(function);
    thread_ = std::thread([shared = shared_] { shared->serve(); });
  }

  ~FunctionSource() override {
    bool waits = false;
    {
      const std::lock_guard lock(shared_->mutex);
      waits = shared_->state == Shared::State::asked;
      shared_->state = Shared::State::over;
    }
    shared_->changed.notify_all();
    waits ? thread_.detach() : thread_.join();
  }

  Next next(Frame& frame, std::chrono::milliseconds patience) override {
    std::unique_lock lock(shared_->mutex);
    if (shared_->state == Shared::State::idle) {
      shared_->state = Shared::State::asked;
      shared_->changed.notify_all();
    }
    const auto answered = [this] { return shared_->state == Shared::State::answered; };
    if (!shared_->changed.wait_for(lock, patience, answered)) return Next::nothing;
    shared_->state = Shared::State::idle;
    if (shared_->error) std::rethrow_exception(std::exchange(shared_->error, nullptr));
    frame = std::move(shared_->frame);
    return shared_->more ? Next::frame : Next::end;
  }

 private:
  std::shared_ptr<Shared> shared_ = std::make_shared<Shared>();
  std::thread thread_;
};

}  // namespace

std::unique_ptr<FrameSource> make_source(std::function<bool(Frame&)> next) {
  return std::make_unique<FunctionSource>(std::move(next));
}

}  // namespace pcl_bv
