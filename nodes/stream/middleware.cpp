// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "middleware.h"

#include <dlfcn.h>

#include <array>
#include <cstring>
#include <filesystem>
#include <map>
#include <mutex>

#include "pcl_bv/io/raw_cloud.h"

namespace pcl_bv::detail {
namespace {

namespace fs = std::filesystem;

// Returns the folder of the program, and the folder of this library if it is a shared library.
std::array<fs::path, 2> folders() {
  std::error_code unknown;
  Dl_info info{};
  dladdr(reinterpret_cast<const void*>(&middleware), &info);
  return {fs::read_symlink("/proc/self/exe", unknown).parent_path(),
          fs::path(info.dli_fname == nullptr ? "" : info.dli_fname).parent_path()};
}

fs::path module_of(const std::string& name) {
  const fs::path file = fs::path("pcl_bv") / ("pcl_bv_" + name + ".so");
  std::error_code unknown;
  for (const fs::path& folder : folders()) {
    for (const fs::path& path : {folder / file, folder / ".." / PCL_BV_LIBRARY_FOLDER / file})
      if (fs::exists(path, unknown)) return path;
  }
  throw IoError(file.filename().string() + " is not installed; it belongs to the component `" + name + "`");
}

// Loads a module and checks its version.
void* load(const std::string& name) {
  const fs::path file = module_of(name);
  void* const module = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (module == nullptr) {
    const char* const why = dlerror();
    throw IoError(why == nullptr ? file.string() + ": cannot be loaded" : why);
  }
  const auto version = reinterpret_cast<ModuleVersion>(dlsym(module, kModuleVersion));
  if (version == nullptr || std::strcmp(version(), PCL_BV_VERSION) != 0)
    throw IoError(file.string() + ": its version is not " PCL_BV_VERSION ", that of this library");
  return module;
}

}  // namespace

void* module_function(const std::string& name, const char* function) {
  static std::mutex mutex;
  static std::map<std::string, void*> loaded;
  const std::lock_guard lock(mutex);
  void*& module = loaded[name];
  if (module == nullptr) module = load(name);
  void* const found = dlsym(module, function);
  if (found == nullptr) throw IoError("the module " + name + " has no function " + function);
  return found;
}

Middleware& middleware(const std::string& name) {
  return *reinterpret_cast<MiddlewareInstance>(module_function(name, kMiddlewareInstance))();
}

}  // namespace pcl_bv::detail
