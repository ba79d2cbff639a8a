// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The processes of a run, by the few ways in which they talk. What comes of an error of MPI's own is MPI's
// business: it ends the run and says why.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "pcl_bv/fitting/smallest_sphere.h"

namespace pcl_bv {

class Ranks {
 public:
  Ranks(int* argc, char*** argv);  ///< Not to be made twice.
  ~Ranks();
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;

  std::size_t rank() const { return rank_; }
  std::size_t size() const { return size_; }
  bool first() const { return rank_ == 0; }

  /// Ends all ranks, with status 1.
  [[noreturn]] static void abort();

  // All ranks have to call these in the same order. Texts are of up to 2^31 - 1 bytes.

  /// The first rank's.
  std::string broadcast(const std::string& text, std::size_t from = 0);

  /// Those of all, by rank.
  std::vector<std::string> all(const std::string& text);

  /// What all add up to, by place.
  std::vector<std::size_t> sum(std::vector<std::size_t> numbers);

  /// The least of all, by place.
  std::vector<double> least(std::vector<double> numbers);

  /// For the first rank the farthest of all; whether some rank has `failed`, for all.
  bool farthest(const OctantPoints& own, bool failed, OctantPoints& of_all);

  // Messages of one rank to another.

  void send(const std::string& text, std::size_t to);
  std::string receive(std::size_t from);

  /// A message of any rank to the first, if one is there; with `wait`, when one is.
  std::optional<std::string> receive_any(bool wait);

  std::size_t bytes_sent() const { return bytes_sent_; }        ///< By this rank, in send() and broadcast().
  std::size_t messages_sent() const { return messages_sent_; }  ///< The same.

 private:
  std::size_t rank_ = 0, size_ = 1, bytes_sent_ = 0, messages_sent_ = 0;
};

}  // namespace pcl_bv
