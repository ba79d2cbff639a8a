// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Error messages for SQLite's error codes.
#pragma once

#include <sqlite3.h>

#include <string>

namespace pcl_bv::detail {

/// Returns the error message for the last failed call on the database.
inline std::string sqlite_error_message(sqlite3* database) {
  const int code = sqlite3_errcode(database) & 0xFF;  // primary result code
  switch (code) {
    case SQLITE_NOTADB:
      return "is no database of SQLite";
    case SQLITE_CORRUPT:
      return "the database is damaged";
    case SQLITE_CANTOPEN:
      return "the database cannot be opened";
    case SQLITE_READONLY:
    case SQLITE_PERM:
      return "the database may not be written";
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
      return "the database is in use by another program";
    case SQLITE_FULL:
      return "no space left for the database";
    case SQLITE_IOERR:
      return "the system cannot read or write the database";
    case SQLITE_NOMEM:
      return "not enough memory for the database";
    case SQLITE_TOOBIG:
      return "a message is too large for the database";
    case SQLITE_ERROR:
      return "the database lacks a table or a column of rosbag2";
    default:
      return "the database fails with SQLite's code " + std::to_string(code);
  }
}

}  // namespace pcl_bv::detail
