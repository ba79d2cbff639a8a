// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// SIGINT, SIGTERM and SIGHUP at any moment: what is complete stays, nothing half done does.

#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <map>
#include <random>
#include <sstream>
#include <thread>

#include "command.h"
#include "pcl_bv/io/read_cloud.h"

namespace pcl_bv::test {
using namespace detail;
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;
using testing::HasSubstr;

void nap() {
  std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

class PcdBvSignals : public PcdBv {
 protected:
  // Sends the signal once `text` is in what the command has written to this file.
  std::function<void(int)> kill_after(const std::string& captured, const std::string& text,
                                      int signal) const {
    return [this, captured, text, signal](int process) {
      while (read_file(at(captured)).find(text) == std::string::npos)
        nap();
      kill(process, signal);
    };
  }

  // A problem, which is said when its result is written, and work that takes many seconds.
  std::vector<std::string> a_missing_one_and_much_work(std::vector<std::string> options) const {
    options.insert(options.end(), {"--threads", "1", at("missing.pcd"), "synth:gauss:30000000"});
    return options;
  }

  std::size_t temporary_files() const {
    std::size_t count = 0;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(at("")))
      count += entry.path().extension() == ".tmp" ? 1 : 0;
    return count;
  }

  // Of many small clouds.
  std::vector<std::string> inputs() const {
    std::vector<std::string> names;
    for (int i = 0; i < 40; ++i)
      names.push_back("synth:gauss:2000:" + std::to_string(i + 1));
    return names;
  }
};

struct Attempt {
  std::string format, output;  // no output: standard output
  int signal;
};

TEST_F(PcdBvSignals, AtAnyMomentLeaveWholeResultsOfTheFirstInputsAndNoTemporaryFile) {
  constexpr int kRuns = 40;
  const std::vector<std::string> clouds = inputs();
  const auto with = [&](const std::string& number, const Attempt& attempt, double delay) {
    std::vector<std::string> arguments = {"--format", attempt.format,     "--threads", "2",
                                          "--labels", at("l" + number),   "--mesh",    at("m" + number),
                                          "--volume", "aabb,dop26,sphere"};
    if (!attempt.output.empty()) arguments.insert(arguments.end(), {"--output", attempt.output});
    arguments.insert(arguments.end(), clouds.begin(), clouds.end());
    Surroundings surroundings;
    surroundings.meanwhile = [=](int process) {
      if (delay < 0) return;
      std::this_thread::sleep_for(std::chrono::duration<double>(delay));
      kill(process, attempt.signal);
    };
    return run(arguments, surroundings);
  };
  double whole = 1e9;  // the fastest: beside other tests a slow one would have most signals come too late
  for (const char* number : {"first", "second", "third"}) {
    const auto begin = Clock::now();
    EXPECT_EQ(with(number, {"jsonl", "", 0}, -1).status, 0);
    whole = std::min(whole, std::chrono::duration<double>(Clock::now() - begin).count());
  }
  std::mt19937 random(7);
  int interrupted = 0;
  for (int i = 0; i < kRuns; ++i) {
    const int signal = std::array{SIGINT, SIGTERM, SIGHUP}[static_cast<std::size_t>(i % 3)];
    const std::string number = std::to_string(i);
    const Attempt attempt =
        i % 2 == 0 ? Attempt{"jsonl", "", signal} : Attempt{"json", at("o" + number + ".json"), signal};
    const double delay = whole * static_cast<double>(random() % 1000) / 1000;
    SCOPED_TRACE("run " + number + ", seconds: " + std::to_string(delay));
    const Result result = with(number, attempt, delay);
    EXPECT_TRUE(result.status == 128 + signal || result.status == 0) << result.status;
    interrupted += result.status == 0 ? 0 : 1;
    EXPECT_EQ(temporary_files(), 0U);
    Json reports = Json::array();
    if (attempt.output.empty()) {
      EXPECT_TRUE(result.out.empty() || result.out.back() == '\n');
      std::istringstream lines(result.out);
      for (std::string line; std::getline(lines, line);)
        reports.push_back(Json::parse(line));
    } else if (fs::exists(attempt.output)) {
      reports = Json::parse(read_file(attempt.output));
    }
    ASSERT_LE(reports.size(), clouds.size());
    for (std::size_t j = 0; j < reports.size(); ++j) {
      EXPECT_EQ(reports[j]["file"], clouds[j]);
      EXPECT_FALSE(reports[j].contains("error"));
      EXPECT_EQ(read_pcd(at("l" + number) + "/gauss-2000-" + std::to_string(j + 1) + ".pcd").size(), 2000U);
    }
  }
  EXPECT_GT(interrupted, kRuns / 4);
}

TEST_F(PcdBvSignals, EndWithTheirStatusAndMakeTheArrayWhole) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    const std::string output = at("out.json");
    const Result result = run(a_missing_one_and_much_work({"--format", "json", "--output", output}),
                              {.meanwhile = kill_after("captured.err", "missing.pcd", signal)});
    EXPECT_EQ(result.status, 128 + signal);
    EXPECT_THAT(result.err, HasSubstr("pcd_bv: interrupted: 1 of 2 files done\n"));
    const Json reports = Json::parse(read_file(output));
    ASSERT_EQ(reports.size(), 1U);
    EXPECT_EQ(reports[0]["file"], at("missing.pcd"));
    fs::remove(output);
    const Result printed = run(a_missing_one_and_much_work({"--format", "json"}),
                               {.meanwhile = kill_after("captured.out", "missing.pcd", signal)});
    EXPECT_EQ(printed.status, 128 + signal);
    EXPECT_EQ(printed.json(), reports);
  }
}

TEST_F(PcdBvSignals, LeaveTheOldOutputWhereNothingIsDone) {
  const std::string output = file("out.json", "old");
  const Result result = run({"--output", output, "synth:gauss:30000000"}, {.meanwhile = [](int process) {
                              std::this_thread::sleep_for(std::chrono::milliseconds(100));
                              kill(process, SIGINT);
                            }});
  EXPECT_EQ(result.status, 130);
  EXPECT_EQ(read_file(output), "old");
}

TEST_F(PcdBvSignals, AreLeftToOneThread) {
  const auto look = [&](int process) {
    while (read_file(at("captured.err")).find("missing.pcd") == std::string::npos)
      nap();
    std::size_t threads = 0;
    std::map<int, int> open;  // threads that a signal can come to; the system unblocks it for one that waits
    const std::map<int, int> one{{SIGINT, 1}, {SIGTERM, 1}, {SIGHUP, 1}};
    for (int tries = 0; tries < 100 && (threads < 3 || open != one); ++tries) {  // until they have begun
      threads = 0;
      open.clear();
      nap();
      for (const fs::directory_entry& task :
           fs::directory_iterator("/proc/" + std::to_string(process) + "/task")) {
        std::istringstream lines(read_file(task.path() / "status"));
        for (std::string line; std::getline(lines, line);) {
          if (!line.starts_with("SigBlk:")) continue;
          const unsigned long blocked = std::stoul(line.substr(7), nullptr, 16);
          for (const int signal : {SIGINT, SIGTERM, SIGHUP})
            open[signal] += (blocked >> (signal - 1) & 1) == 0;
          ++threads;
        }
      }
    }
    EXPECT_GE(threads, 3U);  // the main one, one of the pool, and the one that waits
    EXPECT_EQ(open, one);
    kill(process, SIGTERM);
  };
  const Result result =
      run({"--threads", "3", at("missing.pcd"), "synth:gauss:30000000:1", "synth:gauss:30000000:2"},
          {.meanwhile = look});
  EXPECT_EQ(result.status, 143);
}

/// Standard output is a pipe that is full: its reader is there, and waits.
class PcdBvFullPipe : public PcdBvSignals {
 protected:
  PcdBvFullPipe() : pipe_(at("pipe")) {
    EXPECT_EQ(mkfifo(pipe_.c_str(), 0600), 0);
    reader_ = open(pipe_.c_str(), O_RDONLY | O_NONBLOCK);
    arguments_ = {"--format", "jsonl", "--threads", "2"};
    for (int i = 0; i < 300; ++i)
      arguments_.push_back("synth:gauss:10:" + std::to_string(i + 1));
  }
  ~PcdBvFullPipe() override { close(reader_); }

  int waiting() const {
    int bytes = 0;
    ioctl(reader_, FIONREAD, &bytes);
    return bytes;
  }

  // A page of the pipe's 64 KiB takes only whole lines of the writer: half of it may stay empty.
  void wait_until_full() const {
    for (int before = -1; waiting() <= 32'768 || waiting() != before;
         std::this_thread::sleep_for(std::chrono::milliseconds(100)))
      before = waiting();
  }

  std::string pipe_;
  int reader_ = -1;
  std::vector<std::string> arguments_;
};

TEST_F(PcdBvFullPipe, ASecondSignalEndsWhatTheFirstOneCannot) {
  const Result result = run(arguments_, {.output = pipe_, .meanwhile = [&](int process) {
                                           wait_until_full();
                                           kill(process, SIGINT);
                                           kill(process, SIGTERM);
                                         }});
  EXPECT_EQ(result.status, 143);
}

TEST_F(PcdBvFullPipe, ASignalThatTheCallerIgnoresStaysIgnored) {
  std::string command = "trap '' HUP; exec \"$0\" \"$@\"";
  std::vector<std::string> arguments = {"-c", command, PCL_BV_BIN_DIR "/pcd_bv"};
  arguments.insert(arguments.end(), arguments_.begin(), arguments_.end());
  std::string read;
  const Result result =
      run(arguments, {.program = "/bin/sh", .output = pipe_, .meanwhile = [&](int process) {
                        wait_until_full();
                        kill(process, SIGHUP);
                        char buffer[4096];
                        for (ssize_t n; (n = ::read(reader_, buffer, sizeof buffer)) != 0;) {
                          n > 0 ? void(read.append(buffer, static_cast<std::size_t>(n))) : nap();
                        }
                      }});
  EXPECT_EQ(result.status, 0);
  EXPECT_EQ(std::count(read.begin(), read.end(), '\n'), 300);
}

}  // namespace
}  // namespace pcl_bv::test
