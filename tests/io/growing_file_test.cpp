// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Whole pieces at every moment, and one writer.
#include "pcl_bv/io/growing_file.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <functional>
#include <memory>
#include <thread>

#include "file_size_limit.h"
#include "files.h"
#include "pcl_bv/io/raw_cloud.h"

namespace pcl_bv::detail {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class GrowingFiles : public FileTest {
 protected:
  static std::string reason(const std::function<void()>& open) {
    try {
      open();
    } catch (const IoError& error) {
      return error.what();
    }
    return "";
  }
  static std::string reason(const fs::path& path) {
    return reason([&] { GrowingFile another(path); });
  }
};

// Runs `work` in a child, which is then killed. Returns after `meanwhile` has seen the child at work.
void with_killed_child(const std::function<void()>& work, const std::function<void()>& meanwhile) {
  int ready[2];
  ASSERT_EQ(::pipe(ready), 0);
  const pid_t child = ::fork();
  if (child == 0) {
    work();
    ASSERT_EQ(::write(ready[1], "x", 1), 1);
    for (;;)
      ::pause();
  }
  char byte = 0;
  ASSERT_EQ(::read(ready[0], &byte, 1), 1);
  meanwhile();
  ::kill(child, SIGKILL);
  ::waitpid(child, nullptr, 0);
  ::close(ready[0]);
  ::close(ready[1]);
}

TEST_F(GrowingFiles, AppendEmptiesTheOldContentFirst) {
  write_text(file("a"), "a long old content");
  GrowingFile growing(file("a"));
  EXPECT_EQ(file_content(file("a")), "a long old content");
  EXPECT_EQ(growing.append("one\n"), 0);
  EXPECT_EQ(file_content(file("a")), "one\n");
  EXPECT_EQ(growing.append("two\n"), 0);
  EXPECT_EQ(growing.close(), 0);
  EXPECT_EQ(growing.close(), 0);
  EXPECT_EQ(file_content(file("a")), "one\ntwo\n");
}

TEST_F(GrowingFiles, HoldWholePiecesWhenTheDiskIsFull) {
  const std::string piece(40'000, 'p');
  GrowingFile growing(file("a"));
  const test::FileSizeLimit limit(100'000);
  EXPECT_EQ(growing.append(piece), 0);
  EXPECT_EQ(growing.append(piece), 0);
  EXPECT_EQ(growing.append(piece), EFBIG);
  EXPECT_TRUE(file_content(file("a")) == piece + piece);
  EXPECT_EQ(growing.append("small"), 0);
  EXPECT_EQ(growing.append(piece), EFBIG);
  EXPECT_TRUE(file_content(file("a")) == piece + piece + "small");
}

TEST_F(GrowingFiles, HaveTheirTailAgainWhenTheDiskIsFull) {
  const std::string tail(9'000, 't');
  GrowingFile growing(file("a"));
  const test::FileSizeLimit limit(100'000);
  ASSERT_EQ(growing.append("head" + tail, tail.size()), 0);
  ASSERT_EQ(growing.append("body" + tail, tail.size()), 0);
  EXPECT_TRUE(file_content(file("a")) == "headbody" + tail);
  EXPECT_EQ(growing.append(std::string(200'000, 'x') + tail, tail.size()), EFBIG);
  EXPECT_TRUE(file_content(file("a")) == "headbody" + tail);
  EXPECT_EQ(growing.append("more" + tail, tail.size()), 0);
  EXPECT_TRUE(file_content(file("a")) == "headbodymore" + tail);
}

// As standard output is by `COMMAND >> FILE`.
TEST_F(GrowingFiles, AnAppendedPieceIsWholeButTheEndOfAnotherProgramStays) {
  write_text(file("a"), "first\n");
  write_text(file("b"), std::string(60'000, 'o'));
  const FileDescriptor appended(file("a"), O_WRONLY | O_APPEND, 0, "");
  const FileDescriptor within(file("b"), O_WRONLY, 0, "");
  ASSERT_EQ(::lseek(within.get(), 45'000, SEEK_SET), 45'000);
  const test::FileSizeLimit limit(50'000);
  EXPECT_EQ(write_whole(appended.get(), std::string(60'000, 'p')), EFBIG);
  EXPECT_EQ(file_content(file("a")), "first\n");
  EXPECT_EQ(write_whole(within.get(), std::string(10'000, 'p')), EFBIG);
  EXPECT_EQ(fs::file_size(file("b")), 60'000U);
}

TEST_F(GrowingFiles, HaveOneWriterUnderEveryName) {
  write_text(file("a"), "old");
  fs::create_symlink("a", file("link"));
  fs::create_hard_link(file("a"), file("hard"));
  {
    GrowingFile first(file("a"));
    for (const char* name : {"a", "link", "hard"})
      EXPECT_THAT(reason(file(name)), HasSubstr("locked")) << name;
    EXPECT_EQ(file_content(file("a")), "old");
    EXPECT_EQ(first.append("first"), 0);
    EXPECT_THAT(reason(file("hard")), HasSubstr("locked"));
    EXPECT_EQ(first.close(), 0);
    EXPECT_EQ(reason(file("hard")), "");
  }
  EXPECT_EQ(file_content(file("a")), "first");
}

TEST_F(GrowingFiles, AWriterThatWasKilledLeavesNoLock) {
  std::unique_ptr<GrowingFile> growing;
  with_killed_child(
      [&] {
        growing = std::make_unique<GrowingFile>(file("a"));
        if (growing->append("whole\n") != 0) _exit(1);
      },
      [&] { EXPECT_THAT(reason(file("a")), HasSubstr("locked")); });
  EXPECT_EQ(file_content(file("a")), "whole\n");
  EXPECT_EQ(reason(file("a")), "");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder()), fs::directory_iterator()), 1);
}

// The shell's `flock FILE COMMAND` locks FILE with flock(2) while COMMAND writes to it.
TEST_F(GrowingFiles, AreWrittenUnderTheLockOfAShell) {
  write_text(file("a"), "old");
  const FileDescriptor shell(file("a"), O_RDONLY, 0, "");
  ASSERT_EQ(::flock(shell.get(), LOCK_EX | LOCK_NB), 0);
  EXPECT_EQ(reason(file("a")), "");
}

TEST_F(GrowingFiles, OpenedInVainLeaveWhatWasThere) {
  write_text(file("old"), "old");
  fs::create_symlink("target", file("dangling"));
  for (const char* name : {"old", "new", "dangling"})
    GrowingFile unused(file(name));
  EXPECT_EQ(file_content(file("old")), "old");
  EXPECT_FALSE(fs::exists(file("new")));
  EXPECT_TRUE(fs::is_symlink(file("dangling")));
  EXPECT_FALSE(fs::exists(file("target")));
}

TEST_F(GrowingFiles, FollowALinkToAMissingFile) {
  fs::create_symlink("target", file("link"));
  GrowingFile growing(file("link"));
  EXPECT_EQ(growing.append("new"), 0);
  EXPECT_EQ(file_content(file("target")), "new");
  fs::create_symlink("circle", file("circle"));
  EXPECT_THAT(reason(file("circle")), HasSubstr("too many levels of symbolic links"));
}

TEST_F(GrowingFiles, PipesAndDevicesHaveAnyNumberOfWriters) {
  GrowingFile null("/dev/null");
  EXPECT_EQ(reason("/dev/null"), "");
  EXPECT_EQ(null.append("x", 1), 0);
  ASSERT_EQ(::mkfifo(file("pipe").c_str(), 0600), 0);
  std::string received;
  std::thread reader([&] { received = file_content(file("pipe")); });
  {
    GrowingFile first(file("pipe"));
    EXPECT_EQ(first.append("through"), 0);
    EXPECT_EQ(first.close(), 0);
  }
  reader.join();
  EXPECT_EQ(received, "through");
  EXPECT_TRUE(fs::is_fifo(file("pipe")));
}

TEST_F(GrowingFiles, AFolderIsLockedAgainstOtherProcesses) {
  const auto lock = [&] { (void)lock_folder(folder()); };
  std::shared_ptr<const FileDescriptor> locked;
  with_killed_child([&] { locked = lock_folder(folder()); },
                    [&] { EXPECT_THAT(reason(lock), HasSubstr("locked")); });
  locked = lock_folder(folder());
  EXPECT_NE(locked, nullptr);
  EXPECT_EQ(lock_folder(folder() / "."), locked);
  EXPECT_EQ(lock_folder(file("missing")), nullptr);
}

}  // namespace
}  // namespace pcl_bv::detail
