// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Standard error, which all of a process shares: whole lines of problems, and one line that comes and goes.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace pcl_bv {

/// What every line begins with; before anything is said.
void name_command(std::string_view command);

/// One line on standard error, "<command>: text", whole whatever other threads say; control characters become
/// question marks, so that a file's name can neither break the line nor steer a terminal.
void say(std::string_view text);

/// Says it too, or, where the thread holds its complaints, keeps it.
void complain(std::string_view problem);

/// Complains of a folder's subfolders, whose clouds are not looked for.
void say_what_is_skipped(const std::string& folder, std::size_t subfolders);

/// While it lives, what its thread complains of is kept, to be said in its turn. Not to be nested.
class HeldComplaints {
 public:
  HeldComplaints();
  ~HeldComplaints();
  HeldComplaints(const HeldComplaints&) = delete;
  HeldComplaints& operator=(const HeldComplaints&) = delete;

  std::vector<std::string> kept;
};

/// Whether standard error is a terminal.
bool errors_go_to_a_terminal();

/// Shows `line` as the last one of the terminal, in place of the one shown before, cut to the terminal's
/// width; complaints appear above it. Only for terminals.
void show_status_line(std::string_view line);

/// Takes the line away, if there is one.
void erase_status_line();

}  // namespace pcl_bv
