// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace pcl_bv {

/// The options of a command, on top of CLI11, which only its source includes: each file that does takes 8 s to
/// compile. Values are texts; what they mean is looked at later, so that every refusal reads the same.
class CommandLine {
 public:
  /// With --help and --version. `footer` ends the help.
  CommandLine(const std::string& command, const std::string& description, const std::string& footer);
  ~CommandLine();

  /// `type` stands for the value in the help. A name without dashes is an argument in its place. A list takes all
  /// of them; an option that is repeated, too.
  void option(const char* name, std::string& value, const char* type, const std::string& help);
  void option(const char* name, std::vector<std::string>& values, const char* type, const std::string& help);
  void flag(const char* name, bool& value, const std::string& help);

  /// Gives the text of --help or --version, if it was asked for. Throws UsageError.
  std::optional<std::string> parse(int argc, const char* const* argv);

  /// Whether a declared option was on the command line.
  bool given(const char* name) const;

 private:
  struct App;
  std::unique_ptr<App> app_;
};

}  // namespace pcl_bv
