// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Whole or not there, with the mode and the neighbours as they were.
#include "pcl_bv/io/atomic_file.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fstream>
#include <functional>
#include <iterator>
#include <thread>
#include <vector>

#include "devices.h"
#include "file_size_limit.h"
#include "files.h"
#include "pcl_bv/io/posix_file.h"
#include "pcl_bv/io/raw_cloud.h"

namespace {
std::function<int(bool is_folder)> on_fsync;
}

// In place of the system's: no test waits for the disk.
extern "C" int fsync(int descriptor) {
  struct stat status;
  ::fstat(descriptor, &status);
  return on_fsync ? on_fsync(S_ISDIR(status.st_mode)) : 0;
}

namespace pcl_bv::detail {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class AtomicFile : public FileTest {
 protected:
  ~AtomicFile() override { on_fsync = nullptr; }

  static std::string reason(const fs::path& path, std::string_view content) {
    try {
      write_file_atomically(path, content);
    } catch (const IoError& error) {
      return error.what();
    }
    return "";
  }

  long entries() const { return std::distance(fs::directory_iterator(folder()), fs::directory_iterator()); }

  static unsigned mode(const fs::path& path) { return static_cast<unsigned>(fs::status(path).permissions()); }
};

TEST_F(AtomicFile, WritesTheContent) {
  write_file_atomically(file("a"), std::string_view("one\0two", 7));
  EXPECT_EQ(file_content(file("a")), std::string("one\0two", 7));
  EXPECT_EQ(entries(), 1);
}

TEST_F(AtomicFile, WritesPiecesInOrder) {
  write_file_atomically(file("a"), {"head ", "", "body"});
  EXPECT_EQ(file_content(file("a")), "head body");
}

TEST_F(AtomicFile, WritesAnEmptyFile) {
  write_file_atomically(file("a"), "");
  EXPECT_TRUE(fs::exists(file("a")));
  EXPECT_EQ(fs::file_size(file("a")), 0u);
}

TEST_F(AtomicFile, ReplacesALongerFile) {
  write_text(file("a"), "a long old content");
  write_file_atomically(file("a"), "new");
  EXPECT_EQ(file_content(file("a")), "new");
  EXPECT_EQ(entries(), 1);
}

TEST_F(AtomicFile, LeavesTheOldFileWhenTheDiskIsFull) {
  write_text(file("a"), "old");
  const std::string content(100000, 'n');
  std::string why;
  {
    const test::FileSizeLimit limit(50000);
    why = reason(file("a"), content);
  }
  EXPECT_EQ(why, "cannot write: file too large");
  EXPECT_EQ(file_content(file("a")), "old");
  EXPECT_EQ(entries(), 1) << "the temporary file must be gone";
}

TEST_F(AtomicFile, LeavesNothingWhenTheDiskIsFull) {
  {
    const test::FileSizeLimit limit(50000);
    EXPECT_THROW(write_file_atomically(file("a"), std::string(100000, 'n')), IoError);
  }
  EXPECT_EQ(entries(), 0);
}

TEST_F(AtomicFile, IsOnTheDiskBeforeItTakesTheNameAndTheNameIsWhenItHas) {
  write_text(file("a"), "old");
  std::vector<std::pair<bool, std::string>> synced;
  on_fsync = [&](bool is_folder) {
    synced.emplace_back(is_folder, file_content(file("a")));
    return 0;
  };
  write_file_atomically(file("a"), "new");
  EXPECT_THAT(synced, testing::ElementsAre(std::pair(false, "old"), std::pair(true, "new")));
}

TEST_F(AtomicFile, ADiskThatFailsIsAnErrorOfTheWrite) {
  for (const bool fails_for_folder : {false, true}) {
    write_text(file("a"), "old");
    on_fsync = [&](bool is_folder) {
      errno = EIO;
      return is_folder == fails_for_folder ? -1 : 0;
    };
    EXPECT_EQ(reason(file("a"), "new"), "cannot write: input/output error");
    EXPECT_EQ(file_content(file("a")), fails_for_folder ? "new" : "old");
    EXPECT_EQ(entries(), 1);
  }
}

TEST_F(AtomicFile, AFileSystemThatCannotSynchroniseFoldersIsNone) {
  on_fsync = [](bool is_folder) {
    errno = EINVAL;
    return is_folder ? -1 : 0;
  };
  EXPECT_EQ(reason(file("a"), "new"), "");
}

TEST_F(AtomicFile, AnUnfinishedOneIsRemovedAndNoneIsWrittenAnyMore) {
  write_text(file("a"), "old");
  const auto write_and_end = [&] {
    on_fsync = [&](bool) {
      if (entries() != 2) _exit(1);  // the old file and the temporary one
      remove_temporary_files();
      if (entries() != 1) _exit(2);
      return 0;
    };
    const std::string why = "cannot write: the program is terminating";
    if (reason(file("a"), "new") != why || file_content(file("a")) != "old") _exit(3);
    if (reason(file("b"), "new") != why || entries() != 1) _exit(4);
    _exit(0);
  };
  EXPECT_EXIT(write_and_end(), testing::ExitedWithCode(0), "");
}

TEST_F(AtomicFile, IsReplacedByWhatAFunctionWritesToAnotherPath) {
  write_text(file("a"), "old");
  fs::permissions(file("a"), static_cast<fs::perms>(0600));
  replace_file_atomically(file("a"), [&](const fs::path& path) {
    EXPECT_EQ(fs::file_size(path), 0U);
    std::ofstream(path) << "new";
    EXPECT_EQ(file_content(file("a")), "old");
  });
  EXPECT_EQ(file_content(file("a")), "new");
  EXPECT_EQ(mode(file("a")), 0600U);
  EXPECT_EQ(entries(), 1);
}

TEST_F(AtomicFile, StaysIfTheFunctionThatWritesItThrows) {
  write_text(file("a"), "old");
  const auto fail = [](const fs::path& path) {
    write_text(path, "ne");
    throw std::out_of_range("no more");
  };
  EXPECT_THROW(replace_file_atomically(file("a"), fail), std::out_of_range);
  EXPECT_EQ(file_content(file("a")), "old");
  EXPECT_EQ(entries(), 1);
}

TEST_F(AtomicFile, HasThePiecesThatAFunctionGivesToASink) {
  const fs::path path = folder() / "a";
  write_file_atomically(path, [&](const FileSink& write) {
    write("one ");
    EXPECT_FALSE(fs::exists(path));
    write("two");
  });
  EXPECT_EQ(file_content(path), "one two");
  const auto failing = [](const FileSink& write) {
    write("three");
    throw std::length_error("no more");
  };
  EXPECT_THROW(write_file_atomically(path, failing), std::length_error);
  EXPECT_EQ(file_content(path), "one two");
  EXPECT_EQ(entries(), 1);
}

TEST_F(AtomicFile, IsWrittenByTheFunctionItselfIfItIsADevice) {
  const fs::path null = test::device_in(folder(), test::Device::null);
  if (null.empty()) GTEST_SKIP() << "no device can be made";
  fs::path written;
  replace_file_atomically(null, [&](const fs::path& path) { written = path; });
  EXPECT_EQ(written, null);
  EXPECT_TRUE(fs::is_character_file(null));
}

TEST_F(AtomicFile, AFolderIsCreatedOnlyInAFolderThatExists) {
  for (const char* name : {"new", "new", "other/"}) {
    create_folder(file(name));
    EXPECT_TRUE(fs::is_directory(file(name)));
  }
  EXPECT_THROW(create_folder(file("missing/folder")), IoError);
  EXPECT_FALSE(fs::exists(file("missing")));
  write_text(file("blocked"), "old");
  EXPECT_THROW(create_folder(file("blocked")), IoError);
  EXPECT_THROW(create_folder(file("blocked/folder")), IoError);
  create_folder_of(file("third/a"));
  create_folder_of(file("third/b"));
  create_folder_of("plain");
  EXPECT_TRUE(fs::is_directory(file("third")));
  for (const char* name : {"missing/folder/a", "blocked/folder/a"})
    EXPECT_THROW(create_folder_of(file(name)), IoError) << name;
  EXPECT_FALSE(fs::exists(file("missing")));
}

TEST_F(AtomicFile, AReaderSeesTheOldOrTheNewContentNeverAPart) {
  const std::string contents[2] = {std::string(200000, 'a'), std::string(100000, 'b')};
  write_file_atomically(file("a"), contents[0]);
  std::thread writer([&] {
    for (int i = 1; i <= 200; ++i)
      write_file_atomically(file("a"), contents[i % 2]);
  });
  int torn = 0;
  for (int i = 0; i < 200; ++i) {
    const std::string seen = file_content(file("a"));
    if (seen != contents[0] && seen != contents[1]) ++torn;
  }
  writer.join();
  EXPECT_EQ(torn, 0);
}

TEST_F(AtomicFile, ANewFileFollowsTheUmask) {
  const mode_t old = ::umask(027);
  write_file_atomically(file("a"), "x");
  ::umask(old);
  EXPECT_EQ(mode(file("a")), 0640u);
}

TEST_F(AtomicFile, AnOldFileKeepsItsMode) {
  write_text(file("a"), "old");
  for (const unsigned bits : {0600u, 0664u, 0755u}) {
    fs::permissions(file("a"), static_cast<fs::perms>(bits));
    write_file_atomically(file("a"), "new");
    EXPECT_EQ(mode(file("a")), bits);
  }
}

TEST_F(AtomicFile, AFileThatMayNotBeWrittenIsLeftAlone) {
  write_text(file("a"), "old");
  fs::permissions(file("a"), static_cast<fs::perms>(0444));
  fs::permissions(folder(), fs::perms::all);
  const WithoutRoot nobody;
  EXPECT_EQ(reason(file("a"), "new"), "cannot write: permission denied");
  EXPECT_EQ(file_content(file("a")), "old");
}

TEST_F(AtomicFile, AFolderThatMayNotBeWrittenIsNamedAsTheReason) {
  fs::permissions(folder(), static_cast<fs::perms>(0555));
  {
    const WithoutRoot nobody;
    EXPECT_EQ(reason(file("a"), "new"), "cannot write: permission denied");
  }
  fs::permissions(folder(), fs::perms::all);
}

TEST_F(AtomicFile, AMissingFolderIsAnError) {
  EXPECT_EQ(reason(file("gone") / "a", "x"), "cannot write: no such file or directory");
}

TEST_F(AtomicFile, AFolderIsNoFile) {
  EXPECT_EQ(reason(folder(), "x"), "cannot write: is a directory");
}

TEST_F(AtomicFile, ALinkStaysALinkAndItsTargetIsWritten) {
  write_text(file("target"), "a long old content");
  fs::create_symlink(file("target"), file("link"));
  write_file_atomically(file("link"), "new");
  EXPECT_TRUE(fs::is_symlink(file("link")));
  EXPECT_EQ(file_content(file("target")), "new");
}

TEST_F(AtomicFile, ALinkToAMissingFileCreatesThatFileInItsOwnFolder) {
  fs::create_directories(file("far"));
  fs::create_symlink("far/second", file("first"));
  fs::create_symlink("target", file("far/second"));
  replace_file_atomically(file("first"), [&](const fs::path& path) {
    EXPECT_EQ(path.parent_path(), file("far"));
    write_text(path, "new");
  });
  EXPECT_EQ(fs::read_symlink(file("first")), "far/second");
  EXPECT_EQ(fs::read_symlink(file("far/second")), "target");
  EXPECT_EQ(file_content(file("far/target")), "new");
  fs::create_symlink(file("gone") / "target", file("lost"));
  EXPECT_EQ(reason(file("lost"), "new"), "cannot write: no such file or directory");
  EXPECT_TRUE(fs::is_symlink(file("lost")));
}

TEST_F(AtomicFile, LinksInACircleAreAnError) {
  fs::create_symlink("b", file("a"));
  fs::create_symlink("a", file("b"));
  EXPECT_EQ(reason(file("a"), "new"), "cannot write: too many levels of symbolic links");
  EXPECT_EQ(entries(), 2);
}

TEST_F(AtomicFile, ALinkToAFolderIsNoFile) {
  fs::create_directories(file("folder"));
  fs::create_directory_symlink("folder", file("link"));
  EXPECT_EQ(reason(file("link"), "new"), "cannot write: is a directory");
  EXPECT_TRUE(fs::is_symlink(file("link")));
  write_file_atomically(file("link") / "a", "through");
  EXPECT_EQ(file_content(file("folder/a")), "through");
}

TEST_F(AtomicFile, ALinkToAnOpenFileWritesToThisFileAndReplacesNothing) {
  write_text(file("open"), "old");
  const FileDescriptor open(file("open"), O_WRONLY, 0, "");
  fs::create_symlink("/dev/fd/" + std::to_string(open.get()), file("link"));
  const fs::path renamed = file("renamed");
  fs::rename(file("open"), renamed);
  write_file_atomically(file("link"), "new");
  EXPECT_EQ(file_content(renamed), "new");
  EXPECT_FALSE(fs::exists(file("open")));
  EXPECT_EQ(entries(), 2);
}

TEST_F(AtomicFile, AnOldFileKeepsItsOwner) {
  if (::geteuid() != 0) GTEST_SKIP() << "only root can give files away";
  write_text(file("a"), "old");
  ASSERT_EQ(::chown(file("a").c_str(), 1234, 2345), 0);
  fs::permissions(file("a"), static_cast<fs::perms>(0660));
  write_file_atomically(file("a"), "new");
  struct stat status;
  ASSERT_EQ(::stat(file("a").c_str(), &status), 0);
  EXPECT_EQ(status.st_uid, 1234U);
  EXPECT_EQ(status.st_gid, 2345U);
  EXPECT_EQ(mode(file("a")), 0660U);
}

TEST_F(AtomicFile, ADeviceIsWrittenAndStaysADevice) {
  const fs::path null = test::device_in(folder(), test::Device::null);
  if (null.empty()) GTEST_SKIP() << "no device can be made";
  write_file_atomically(null, "x");
  EXPECT_TRUE(fs::is_character_file(null));
}

TEST_F(AtomicFile, APipeReceivesTheContent) {
  ASSERT_EQ(::mkfifo(file("pipe").c_str(), 0600), 0);
  std::string received;
  std::thread reader([&] { received = file_content(file("pipe")); });
  write_file_atomically(file("pipe"), "through");
  reader.join();
  EXPECT_EQ(received, "through");
  EXPECT_TRUE(fs::is_fifo(file("pipe")));
}

TEST_F(AtomicFile, AFullDeviceIsAnError) {
  const fs::path full = test::device_in(folder(), test::Device::full);
  if (full.empty()) GTEST_SKIP() << "no device can be made";
  EXPECT_THAT(reason(full, "x"), HasSubstr("no space left on device"));
  EXPECT_TRUE(fs::is_character_file(full));
}

TEST_F(AtomicFile, ALongNameIsNoObstacle) {
  const std::string name(255, 'n');
  write_file_atomically(file(name), "x");
  EXPECT_EQ(file_content(file(name)), "x");
}

TEST_F(AtomicFile, ANameWithoutAFolderMeansTheCurrentOne) {
  const fs::path before = fs::current_path();
  fs::current_path(folder());
  write_file_atomically("plain", "x");
  fs::current_path(before);
  EXPECT_EQ(file_content(file("plain")), "x");
}

}  // namespace
}  // namespace pcl_bv::detail
