// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "command_line.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <utility>

#include "pcl_bv/points/isa.h"
#include "values.h"

namespace pcl_bv::detail {
namespace {

std::string version_text(const std::string& command) {
  std::string text = command + " " PCL_BV_VERSION "\ninstruction sets:";
  for (const Isa isa : usable_isas())
    text += ' ' + std::string(isa_name(isa));
  return text + '\n';
}

// Breaks lines at spaces, so that the column of help texts has at most 74 characters.
std::string wrapped(std::string text) {
  constexpr std::size_t max_width = 74;
  std::size_t begin = 0, space = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '\n') begin = i + 1;
    if (text[i] == ' ') space = i;
    if (i - begin < max_width || space <= begin) continue;
    text[space] = '\n';
    begin = space + 1;
  }
  return text;
}

// Returns the arguments in the order that CLI11 expects, the last one first. If the value of an option is
// empty ("--output= scan.pcd"), inserts an empty argument. Otherwise CLI11 would take the next argument, an
// input, as the value.
std::vector<std::string> last_first(const CLI::App& app, int argc, const char* const* argv) {
  const auto inputs = std::find(argv, argv + argc, std::string_view("--")) - argv;
  std::vector<std::string> arguments;
  for (int i = argc - 1; i > 0; --i) {
    std::string argument = argv[i];
    if (i < inputs && argument.size() > 1 && argument.find('=') == argument.size() - 1) {
      const CLI::Option* option = app.get_option_no_throw(argument.substr(0, argument.size() - 1));
      if (option != nullptr && option->get_items_expected_max() > 0) {
        arguments.emplace_back();
        argument.pop_back();
      }
    }
    arguments.push_back(std::move(argument));
  }
  return arguments;
}

// Rejects texts such as "--loop --track", where a value is missing and CLI11 would take the next option as
// the value.
void reject_options_as_values(const CLI::App& app, int argc, const char* const* argv) {
  const auto option_of = [&](std::string_view argument) -> const CLI::Option* {
    return argument.starts_with("--") && argument.size() > 2 ? app.get_option_no_throw(std::string(argument))
                                                             : nullptr;
  };
  for (int i = 1; i + 1 < argc && std::string_view(argv[i]) != "--"; ++i) {
    const CLI::Option* const option = option_of(argv[i]);
    if (option == nullptr || option->get_items_expected_max() == 0) continue;
    ++i;
    if (option_of(argv[i]) != nullptr)
      throw UsageError(option->get_name() + " needs a value (" + option->get_type_name() +
                       "), but the option " + argv[i] + " comes next");
  }
}

void reject_empty_values(const CLI::App& app) {
  for (const CLI::Option* option : app.get_options()) {
    const std::vector<std::string>& values = option->results();
    if (option->get_positional() || std::find(values.begin(), values.end(), "") == values.end()) continue;
    const std::string type = option->get_type_name();
    const bool is_name = type.starts_with("FILE") || type == "SOURCE" || type == "SINK";
    throw UsageError(option->get_name() + (is_name ? ": the name is empty" : ": the value is empty"));
  }
}

}  // namespace

struct CommandLine::App : CLI::App {
  using CLI::App::App;
  bool version = false;
};

CommandLine::CommandLine(const std::string& command, const std::string& description,
                         const std::string& footer)
    : app_(std::make_unique<App>(description, command)) {
  app_->footer(footer);
  app_->get_formatter()->column_width(26);
  app_->set_help_flag("-h,--help", "Show this text");
  flag("--version", app_->version, "Show the version and the usable instruction sets");
}

CommandLine::~CommandLine() = default;

void CommandLine::option(const char* name, std::string& value, const char* type, const std::string& help) {
  app_->add_option(name, value, wrapped(help))->type_name(type);
}

void CommandLine::option(const char* name, std::vector<std::string>& values, const char* type,
                         const std::string& help) {
  CLI::Option* const option = app_->add_option(name, values, wrapped(help))->type_name(type);
  // An option takes only one value, because the next argument may be an input.
  if (name[0] == '-')
    option->expected(1)->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)->allow_extra_args(false);
}

void CommandLine::flag(const char* name, bool& value, const std::string& help) {
  app_->add_flag(name, value, wrapped(help));
}

std::optional<std::string> CommandLine::parse(int argc, const char* const* argv) {
  try {
    reject_options_as_values(*app_, argc, argv);
    app_->parse(last_first(*app_, argc, argv));
    reject_empty_values(*app_);
  } catch (const CLI::CallForHelp&) {
    return app_->help();
  } catch (const CLI::ArgumentMismatch& error) {
    const std::string text = error.what();
    const std::size_t repeated = text.find(": At Most 1 required");
    throw UsageError(text.substr(0, repeated) + (repeated < text.size() ? ": given more than once" : "") +
                     "; " + app_->get_name() + " --help lists the options");
  } catch (const CLI::ParseError& error) {
    throw UsageError(error.what() + ("; " + app_->get_name() + " --help lists the options"));
  }
  if (app_->version) return version_text(app_->get_name());
  return std::nullopt;
}

bool CommandLine::given(const char* name) const {
  return app_->count(name) > 0;
}

}  // namespace pcl_bv::detail
