// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Sets a German locale for a test: a decimal comma, and a point between thousands. Programs with Qt have such
// a locale in Germany.
#pragma once

#include <clocale>
#include <cstdlib>
#include <locale>
#include <string>

#include "temporary_folder.h"

namespace pcl_bv::test {

/// Sets the locale of C and of C++ streams, and resets both in the destructor. If the machine has no German
/// locale, localedef creates one in a temporary folder. It needs the definitions in Debian's package
/// `locales`.
class GermanLocale {
 public:
  GermanLocale() : streams_(std::locale::global(std::locale(std::locale::classic(), new Commas))) {
    const std::string name = "de_DE.UTF-8";
    is_set_ = std::setlocale(LC_ALL, name.c_str()) != nullptr;
    if (is_set_) return;
    const std::string command = "localedef -i de_DE -f UTF-8 '" + (folder_ / name).string() + "' 2>/dev/null";
    if (std::system(command.c_str()) != 0) return;
    ::setenv("LOCPATH", folder_.path().c_str(), 1);
    created_ = true;
    is_set_ = std::setlocale(LC_ALL, name.c_str()) != nullptr;
  }
  ~GermanLocale() {
    std::locale::global(streams_);
    std::setlocale(LC_ALL, "C");
    if (created_) ::unsetenv("LOCPATH");
  }
  GermanLocale(const GermanLocale&) = delete;
  GermanLocale& operator=(const GermanLocale&) = delete;

  /// Returns whether C's functions use the German locale. C++ streams always use it.
  bool is_set() const { return is_set_; }

 private:
  struct Commas : std::numpunct<char> {
    char do_decimal_point() const override { return ','; }
    char do_thousands_sep() const override { return '.'; }
    std::string do_grouping() const override { return "\3"; }
  };

  TemporaryFolder folder_;
  std::locale streams_;
  bool is_set_ = false, created_ = false;
};

}  // namespace pcl_bv::test
