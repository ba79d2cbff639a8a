// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Prints messages of all threads on standard error, as whole lines, and one status line.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace pcl_bv::detail {

/// Sets the name with which every line begins. Must be called before the first message.
void name_command(std::string_view command);

/// Prints one line, "<command>: text", on standard error. Lines of several threads do not mix. Control
/// characters become question marks, so that a file name can neither break the line nor control a terminal.
/// Long names and lines lose their middle (message_line()).
void print_message(std::string_view text);

/// Prints a problem as print_message() does. While the calling thread has a DeferredMessages object, stores
/// the problem in that object instead. Without name_command(), the program is no command, and the problem is
/// stored for take_problems().
void report_problem(std::string_view problem);

/// Returns and removes the stored problems of all threads, if the program is no command.
std::vector<std::string> take_problems();

/// If `subfolders` is not 0, warns that the subfolders of a folder are not read.
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

/// Returns whether standard error is a terminal.
bool errors_go_to_a_terminal();

/// Shows `line` in the last line of the terminal, cut to the terminal's width. Replaces the previous status
/// line. Messages appear above the status line. Must be called only if standard error is a terminal.
void show_status_line(std::string_view line);

/// Erases the status line, if there is one.
void erase_status_line();

}  // namespace pcl_bv::detail
