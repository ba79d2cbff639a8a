// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// What every command line understands.

#include "command_line.h"

#include "pcl_bv/kernels/isa.h"
#include "usage_error.h"

namespace pcl_bv {

void declare_common(CLI::App& app, bool& version) {
  app.get_formatter()->column_width(26);
  app.set_help_flag("-h,--help", "Show this text");
  app.add_flag("--version", version, "Show the version and the usable instruction sets");
}

void declare_text(CLI::App& app, const char* name, std::string& text, const char* type,
                  const std::string& help) {
  app.add_option(name, text, help)->type_name(type);
}

std::optional<std::string> parse_command_line(CLI::App& app, int argc, const char* const* argv) {
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    return app.help();
  } catch (const CLI::ParseError& error) {
    throw UsageError(error.what() + std::string("; " PCL_BV_COMMAND " --help lists the options"));
  }
  return std::nullopt;
}

std::string version_text() {
  std::string text = PCL_BV_COMMAND " " PCL_BV_VERSION "\ninstruction sets:";
  for (const Isa isa : usable_isas())
    text += ' ' + std::string(isa_name(isa));
  return text + '\n';
}

}  // namespace pcl_bv
