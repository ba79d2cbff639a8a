// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "run_command.h"

#include <exception>
#include <new>
#include <string>

#include "messages.h"
#include "pcl_bv/io/untrusted_text.h"
#include "standard_streams.h"
#include "values.h"

namespace pcl_bv::detail {

int run_command(std::string_view command, const std::function<int()>& work) {
  name_command(command);
  prepare_standard_streams();
  try {
    return work();
  } catch (const UsageError& error) {
    report_problem(error.what());
    return 2;
  } catch (const IoError& error) {
    report_problem(error.what());
  } catch (const std::bad_alloc& error) {
    report_problem(reason_of(error));
  } catch (const std::exception& error) {
    report_problem(std::string("internal error: ") + error.what());
  }
  return 1;
}

int print_text(std::string_view text) {
  try {
    write_standard_output(text);
    return 0;
  } catch (const IoError& error) {
    throw IoError(std::string("standard output: ") + error.what());
  }
}

}  // namespace pcl_bv::detail
