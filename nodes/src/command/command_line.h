// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// What every command line understands, on top of CLI11.
#pragma once

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <optional>
#include <string>

namespace pcl_bv {

/// Adds --help and the flag --version.
void declare_common(CLI::App& app, bool& version);

/// Declares an option that takes a text; what the text means is looked at later, so that every refusal reads
/// the same.
void declare_text(CLI::App& app, const char* name, std::string& text, const char* type,
                  const std::string& help);

/// Parses; gives the help if that was asked for. Throws UsageError.
std::optional<std::string> parse_command_line(CLI::App& app, int argc, const char* const* argv);

/// The command's name and version, and the instruction sets that are usable here.
std::string version_text();

}  // namespace pcl_bv
