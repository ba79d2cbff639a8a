// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The ranks of a run and their messages, by MPI. In case of an error, MPI prints the reason and ends the run.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "pcl_bv/fitting/smallest_sphere.h"

namespace pcl_bv::detail {

class Ranks {
 public:
  Ranks(int* argc, char*** argv);  ///< Initializes MPI. A process may construct only one object.
  ~Ranks();
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;

  std::size_t rank() const { return rank_; }
  std::size_t size() const { return size_; }
  bool first() const { return rank_ == 0; }

  /// Ends the processes of all ranks with status 1.
  [[noreturn]] static void abort();

  // The following functions are collective calls: all ranks must call them in the same order. A text has at
  // most 2^31 - 1 bytes.

  /// Returns the text of the rank `from`.
  std::string broadcast(const std::string& text, std::size_t from = 0);

  /// Returns the texts of all ranks, by rank.
  std::vector<std::string> all_gather(const std::string& text);

  /// Returns the element-wise sums over all ranks.
  std::vector<std::size_t> sum(std::vector<std::size_t> numbers);

  /// Returns the element-wise minima over all ranks.
  std::vector<double> min_over_ranks(std::vector<double> numbers);

  /// Sets `of_all` to the farthest points of all ranks. Returns whether `failed` is true on any rank.
  bool merge_farthest(const detail::OctantPoints& own, bool failed, detail::OctantPoints& of_all);

  /// Calls work(ranks) on the first rank, while the others sleep. During the call the first rank may use the
  /// processors of the other ranks of its machine; `ranks` is the number of ranks there.
  void work_on_first(const std::function<void(std::size_t ranks)>& work);

  // The following functions send a message from one rank to another.

  void send(const std::string& text, std::size_t to);
  std::string receive(std::size_t from);

  /// Returns a message from any rank. If there is none, waits for one if `wait` is true, otherwise returns
  /// nothing.
  std::optional<std::string> receive_any(bool wait);

  // The following functions count what this rank has sent by send(), broadcast() and merge_farthest(). Other
  // calls are not counted.

  std::size_t bytes_sent() const { return bytes_sent_; }
  std::size_t messages_sent() const { return messages_sent_; }

 private:
  std::size_t rank_ = 0, size_ = 1, bytes_sent_ = 0, messages_sent_ = 0;
};

}  // namespace pcl_bv::detail
