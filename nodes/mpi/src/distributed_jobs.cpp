// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "distributed_jobs.h"

#include <algorithm>
#include <filesystem>
#include <numeric>
#include <sstream>
#include <system_error>

#include "commands/pcd_bv/ordered_results.h"

namespace pcl_bv::detail {
namespace {

std::size_t size_of_input(const Job& job) {
  std::error_code unknown;
  const std::uintmax_t bytes = std::filesystem::file_size(job.input, unknown);
  return unknown ? 1 : std::max<std::size_t>(1, bytes);
}

// Returns the rank of each job. The jobs are assigned in order of descending file size. Each job goes to the
// rank to which the fewest bytes have been assigned so far.
std::vector<std::size_t> assign_ranks(const std::vector<Job>& jobs, std::size_t ranks) {
  std::vector<std::size_t> sizes, order(jobs.size()), owner(jobs.size()), load(ranks);
  for (const Job& job : jobs)
    sizes.push_back(size_of_input(job));
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return sizes[a] > sizes[b]; });
  for (const std::size_t job : order) {
    owner[job] = static_cast<std::size_t>(std::min_element(load.begin(), load.end()) - load.begin());
    load[owner[job]] += sizes[job];
  }
  return owner;
}

// Returns the rank of each job, computed by the first rank. The other ranks do not compute it, because they
// may see other file sizes if a file grows.
std::vector<std::size_t> broadcast_owners(Ranks& ranks, const std::vector<Job>& jobs) {
  std::ostringstream text;
  if (ranks.first()) {
    for (const std::size_t owner : assign_ranks(jobs, ranks.size()))
      text << owner << ' ';
  }
  std::istringstream in(ranks.broadcast(text.str()));
  std::vector<std::size_t> owners(jobs.size());
  for (std::size_t& owner : owners)
    in >> owner;
  return owners;
}

void append(const std::string& text, std::string& to) {
  to += std::to_string(text.size()) + ' ' + text;
}

std::string to_message(std::size_t job, const Result& result) {
  std::string message = std::to_string(job) + ' ' + std::to_string(static_cast<int>(result.status)) + ' ' +
                        std::to_string(result.points) + ' ' + std::to_string(result.messages.size()) + ' ';
  append(result.text, message);
  for (const std::string& complaint : result.messages)
    append(complaint, message);
  return message;
}

std::string read_text(std::istream& in) {
  std::size_t length = 0;
  in >> length;
  in.get();
  std::string text(length, '\0');
  in.read(text.data(), static_cast<std::streamsize>(length));
  return text;
}

void take(const std::string& message, OrderedResults& order) {
  std::istringstream in(message);
  std::size_t job = 0, complaints = 0;
  int status = 0;
  Result result;
  in >> job >> status >> result.points >> complaints;
  result.status = static_cast<Status>(status);
  result.text = read_text(in);
  for (std::size_t i = 0; i < complaints; ++i)
    result.messages.push_back(read_text(in));
  order.add_result(job, std::move(result));
}

}  // namespace

Status process_jobs(Ranks& ranks, const std::vector<Job>& jobs, const Options& options,
                    InterruptAction& interrupted) {
  const std::vector<std::size_t> owners = broadcast_owners(ranks, jobs);
  FramePipeline pipeline(options.pipeline);
  if (!ranks.first()) {
    for (std::size_t job = 0; job < jobs.size(); ++job) {
      if (owners[job] == ranks.rank()) ranks.send(to_message(job, do_job(jobs[job], options, pipeline)), 0);
    }
    return Status::done;
  }
  OrderedResults order(options, jobs.size(), ranks.size());
  interrupted.set([&] { order.interrupt(); });
  auto others =
      static_cast<std::size_t>(std::count_if(owners.begin(), owners.end(), [](auto o) { return o != 0; }));
  const auto receive = [&](bool wait) {
    while (others > 0) {
      const std::optional<std::string> message = ranks.receive_any(wait);
      if (!message) return;
      take(*message, order);
      --others;
    }
  };
  for (std::size_t job = 0; job < jobs.size(); ++job) {
    if (owners[job] != 0) continue;
    order.add_result(job, do_job(jobs[job], options, pipeline));
    receive(false);
  }
  receive(true);
  const Status status = order.finish();
  interrupted.set(nullptr);
  return status;
}

}  // namespace pcl_bv::detail
