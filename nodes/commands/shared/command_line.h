// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The command-line parser of all commands.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace pcl_bv::detail {

/// The options of a command. The parser is built on CLI11. Only command_line.cpp includes CLI11, because each
/// file that includes it takes 8 s to compile. Values are stored as texts and parsed later, so that all
/// errors have the same form.
class CommandLine {
 public:
  /// Adds --help and --version. `footer` is the last part of the help text.
  CommandLine(const std::string& command, const std::string& description, const std::string& footer);
  ~CommandLine();

  /// Declare an option. An option() has a value, a flag() has none. `type` is the placeholder of the value in
  /// the help text. A `name` without dashes declares positional arguments. `values` receives all positional
  /// arguments, or the values of all repetitions of the option.
  void option(const char* name, std::string& value, const char* type, const std::string& help);
  void option(const char* name, std::vector<std::string>& values, const char* type, const std::string& help);
  void flag(const char* name, bool& value, const std::string& help);

  /// Parses the command line. Returns the text of --help or --version if it was requested. Throws UsageError.
  std::optional<std::string> parse(int argc, const char* const* argv);

  /// Returns whether a declared option was on the command line.
  bool given(const char* name) const;

 private:
  struct App;
  std::unique_ptr<App> app_;
};

}  // namespace pcl_bv::detail
