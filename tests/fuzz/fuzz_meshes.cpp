// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Meshes of robot models. The first byte selects the format, which readers know from the name of the file.
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "memory_file.h"
#include "stream/rig/urdf.h"

namespace {

/// Another name of a file, with an extension.
class NamedFile {
 public:
  NamedFile(const std::filesystem::path& file, const std::string& extension)
      : path_(std::filesystem::temp_directory_path() /
              ("fuzz_meshes" + std::to_string(getpid()) + extension)) {
    std::filesystem::remove(path_);
    std::filesystem::create_symlink(file, path_);
  }
  ~NamedFile() { std::filesystem::remove(path_); }

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace pcl_bv;
  if (size == 0) return 0;
  static MemoryFile memory;
  static const NamedFile stl(memory.path(), ".stl"), obj(memory.path(), ".obj");
  memory.assign({reinterpret_cast<const char*>(data) + 1, size - 1});
  try {
    if (read_mesh_vertices(data[0] % 2 == 0 ? stl.path() : obj.path()).empty()) std::abort();
  } catch (const IoError&) {
  }
  return 0;
}
