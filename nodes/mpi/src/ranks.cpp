// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "ranks.h"

#include <mpi.h>
#include <sched.h>

#include <chrono>
#include <cstdlib>
#include <limits>
#include <stdexcept>
#include <thread>
#include <type_traits>

namespace pcl_bv {
using namespace detail;
namespace {

static_assert(std::is_trivially_copyable_v<OctantPoints>);
static_assert(sizeof(std::size_t) == sizeof(unsigned long));

int length(const std::string& text) {
  if (text.size() > static_cast<std::size_t>(std::numeric_limits<int>::max()))
    throw std::length_error(
        "a message would be larger than 2 GiB, the limit of MPI: use fewer ranks, or --partial and --merge");
  return static_cast<int>(text.size());
}

struct FarthestMessage {
  OctantPoints farthest;
  bool failed;
};

extern "C" void merge_messages(void* from, void* to, int* count, MPI_Datatype*) {
  const auto* const a = static_cast<const FarthestMessage*>(from);
  auto* const b = static_cast<FarthestMessage*>(to);
  for (int i = 0; i < *count; ++i) {
    update_farthest(a[i].farthest, b[i].farthest);
    b[i].failed = b[i].failed || a[i].failed;
  }
}

}  // namespace

Ranks::Ranks(int* argc, char*** argv) {
  int level = 0, rank = 0, size = 1;
  MPI_Init_thread(argc, argv, MPI_THREAD_FUNNELED, &level);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &size);
  rank_ = static_cast<std::size_t>(rank);
  size_ = static_cast<std::size_t>(size);
}

Ranks::~Ranks() {
  MPI_Finalize();
}

void Ranks::abort() {
  MPI_Abort(MPI_COMM_WORLD, 1);
  std::abort();  // in case MPI_Abort() returns
}

std::string Ranks::broadcast(const std::string& text, std::size_t from) {
  unsigned long bytes = static_cast<unsigned long>(length(text));
  MPI_Bcast(&bytes, 1, MPI_UNSIGNED_LONG, static_cast<int>(from), MPI_COMM_WORLD);
  std::string copy = rank_ == from ? text : std::string(bytes, '\0');
  MPI_Bcast(copy.data(), static_cast<int>(bytes), MPI_BYTE, static_cast<int>(from), MPI_COMM_WORLD);
  if (rank_ == from) bytes_sent_ += (size_ - 1) * bytes;
  if (rank_ == from) messages_sent_ += size_ - 1;
  return copy;
}

std::vector<std::string> Ranks::all_gather(const std::string& text) {
  const int own = length(text);
  std::vector<int> lengths(size_), offsets(size_);
  MPI_Allgather(&own, 1, MPI_INT, lengths.data(), 1, MPI_INT, MPI_COMM_WORLD);
  std::size_t bytes = 0;
  for (std::size_t i = 0; i < size_; ++i) {
    offsets[i] = static_cast<int>(bytes);
    bytes += static_cast<std::size_t>(lengths[i]);
  }
  std::string joined(bytes, '\0');
  length(joined);
  MPI_Allgatherv(text.data(), own, MPI_BYTE, joined.data(), lengths.data(), offsets.data(), MPI_BYTE,
                 MPI_COMM_WORLD);
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < size_; ++i)
    texts.push_back(
        joined.substr(static_cast<std::size_t>(offsets[i]), static_cast<std::size_t>(lengths[i])));
  return texts;
}

void Ranks::work_on_first(const std::function<void(std::size_t ranks)>& work) {
  MPI_Comm machine = MPI_COMM_NULL;
  int ranks = 1;
  MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &machine);
  MPI_Comm_size(machine, &ranks);
  // mpirun binds each rank to processors of its own.
  cpu_set_t own{}, all{};
  sched_getaffinity(0, sizeof own, &own);
  MPI_Allreduce(&own, &all, sizeof own, MPI_BYTE, MPI_BOR, machine);
  MPI_Comm_free(&machine);
  if (first()) {
    sched_setaffinity(0, sizeof all, &all);
    work(static_cast<std::size_t>(ranks));
    sched_setaffinity(0, sizeof own, &own);
  }
  MPI_Request all_here = MPI_REQUEST_NULL;
  MPI_Ibarrier(MPI_COMM_WORLD, &all_here);
  for (int done = 0; done == 0;) {
    MPI_Test(&all_here, &done, MPI_STATUS_IGNORE);
    if (done == 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

std::vector<std::size_t> Ranks::sum(std::vector<std::size_t> numbers) {
  MPI_Allreduce(MPI_IN_PLACE, numbers.data(), static_cast<int>(numbers.size()), MPI_UNSIGNED_LONG, MPI_SUM,
                MPI_COMM_WORLD);
  return numbers;
}

std::vector<double> Ranks::min_over_ranks(std::vector<double> numbers) {
  MPI_Allreduce(MPI_IN_PLACE, numbers.data(), static_cast<int>(numbers.size()), MPI_DOUBLE, MPI_MIN,
                MPI_COMM_WORLD);
  return numbers;
}

bool Ranks::merge_farthest(const OctantPoints& own, bool failed, OctantPoints& of_all) {
  FarthestMessage message{own, failed}, merged{};
  MPI_Datatype type = MPI_DATATYPE_NULL;
  MPI_Op op = MPI_OP_NULL;
  MPI_Type_contiguous(sizeof message, MPI_BYTE, &type);
  MPI_Type_commit(&type);
  MPI_Op_create(merge_messages, 1, &op);
  MPI_Allreduce(&message, &merged, 1, type, op, MPI_COMM_WORLD);
  MPI_Op_free(&op);
  MPI_Type_free(&type);
  bytes_sent_ += sizeof message;
  ++messages_sent_;
  of_all = merged.farthest;
  return merged.failed;
}

void Ranks::send(const std::string& text, std::size_t to) {
  MPI_Send(text.data(), length(text), MPI_BYTE, static_cast<int>(to), 0, MPI_COMM_WORLD);
  bytes_sent_ += text.size();
  ++messages_sent_;
}

std::string Ranks::receive(std::size_t from) {
  MPI_Status status;
  int bytes = 0;
  MPI_Probe(static_cast<int>(from), 0, MPI_COMM_WORLD, &status);
  MPI_Get_count(&status, MPI_BYTE, &bytes);
  std::string text(static_cast<std::size_t>(bytes), '\0');
  MPI_Recv(text.data(), bytes, MPI_BYTE, static_cast<int>(from), 0, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
  return text;
}

std::optional<std::string> Ranks::receive_any(bool wait) {
  MPI_Status status;
  int there = 1;
  if (wait) {
    MPI_Probe(MPI_ANY_SOURCE, 0, MPI_COMM_WORLD, &status);
  } else {
    MPI_Iprobe(MPI_ANY_SOURCE, 0, MPI_COMM_WORLD, &there, &status);
  }
  if (there == 0) return std::nullopt;
  return receive(static_cast<std::size_t>(status.MPI_SOURCE));
}

}  // namespace pcl_bv
