// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "command_line.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include "pcl_bv/kernels/isa.h"
#include "usage_error.h"

namespace pcl_bv {
namespace {

std::string version_text(const std::string& command) {
  std::string text = command + " " PCL_BV_VERSION "\ninstruction sets:";
  for (const Isa isa : usable_isas())
    text += ' ' + std::string(isa_name(isa));
  return text + '\n';
}

}  // namespace

struct CommandLine::App : CLI::App {
  using CLI::App::App;
  bool version = false;
};

CommandLine::CommandLine(const std::string& command, const std::string& description, const std::string& footer)
    : app_(std::make_unique<App>(description, command)) {
  app_->footer(footer);
  app_->get_formatter()->column_width(26);
  app_->set_help_flag("-h,--help", "Show this text");
  flag("--version", app_->version, "Show the version and the usable instruction sets");
}

CommandLine::~CommandLine() = default;

void CommandLine::option(const char* name, std::string& value, const char* type, const std::string& help) {
  app_->add_option(name, value, help)->type_name(type);
}

void CommandLine::option(const char* name, std::vector<std::string>& values, const char* type,
                         const std::string& help) {
  CLI::Option* const option = app_->add_option(name, values, help)->type_name(type);
  if (name[0] == '-') option->allow_extra_args(false);  // one at a time: what follows may be an input
}

void CommandLine::flag(const char* name, bool& value, const std::string& help) {
  app_->add_flag(name, value, help);
}

std::optional<std::string> CommandLine::parse(int argc, const char* const* argv) {
  try {
    app_->parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    return app_->help();
  } catch (const CLI::ParseError& error) {
    throw UsageError(error.what() + ("; " + app_->get_name() + " --help lists the options"));
  }
  if (app_->version) return version_text(app_->get_name());
  return std::nullopt;
}

bool CommandLine::given(const char* name) const {
  return app_->count(name) > 0;
}

}  // namespace pcl_bv
