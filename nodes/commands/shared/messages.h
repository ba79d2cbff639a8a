// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Messages on standard error, for all threads of a process: whole lines, and one status line.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace pcl_bv {

/// Sets the name with which every line begins. Must be called before the first message.
void name_command(std::string_view command);

/// Prints one line on standard error: "<command>: text". Lines of several threads do not mix. Control
/// characters become question marks, so that a file name can neither break the line nor control a terminal.
void print_message(std::string_view text);

/// Prints a problem as print_message() does, or stores it while the thread has a DeferredMessages.
void report_problem(std::string_view problem);

/// Warns that subfolders of a folder are not read, if there are any.
void warn_of_subfolders(const std::string& folder, std::size_t subfolders);

/// While this object lives, the problems that its thread reports are stored in `messages`, to be printed
/// later. Must not be nested.
class DeferredMessages {
 public:
  DeferredMessages();
  ~DeferredMessages();
  DeferredMessages(const DeferredMessages&) = delete;
  DeferredMessages& operator=(const DeferredMessages&) = delete;

  std::vector<std::string> messages;
};

/// Whether standard error is a terminal.
bool errors_go_to_a_terminal();

/// Shows `line` in the last line of the terminal, cut to the terminal's width. Replaces the previous status
/// line; messages appear above it. Only for terminals.
void show_status_line(std::string_view line);

/// Erases the status line, if there is one.
void erase_status_line();

}  // namespace pcl_bv
