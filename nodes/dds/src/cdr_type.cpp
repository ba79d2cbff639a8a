// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "cdr_type.h"

#include <dds/ddsi/ddsi_sertype.h>
#include <dds/ddsi/q_radmin.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <new>

namespace pcl_bv::dds {
namespace {

const CdrSample& cdr(const ddsi_serdata* sample) {
  return *static_cast<const CdrSample*>(sample);
}

bool equal_keys(const ddsi_serdata*, const ddsi_serdata*) {
  return true;
}

std::uint32_t size_of(const ddsi_serdata* sample) {
  return static_cast<std::uint32_t>(cdr(sample).size);
}

// Joins the fragments of a message. The fragments are in order and may overlap.
ddsi_serdata* from_fragments(const ddsi_sertype* type, ddsi_serdata_kind kind, const nn_rdata* fragment,
                             std::size_t size) {
  CdrSample* const sample = make_sample(type, kind, size);
  if (sample == nullptr) return nullptr;
  std::size_t have = 0;
  for (; fragment != nullptr; fragment = fragment->nextfrag) {
    const std::size_t end = std::min<std::size_t>(fragment->maxp1, size);
    if (end <= have) continue;
    const auto* const payload = NN_RMSG_PAYLOADOFF(fragment->rmsg, NN_RDATA_PAYLOAD_OFF(fragment));
    std::memcpy(sample->bytes.get() + have, payload + (have - fragment->min), end - have);
    have = end;
  }
  return sample;
}

ddsi_serdata* from_pieces(const ddsi_sertype* type, ddsi_serdata_kind kind, ddsrt_msg_iovlen_t count,
                          const ddsrt_iovec_t* pieces, std::size_t size) {
  CdrSample* const sample = make_sample(type, kind, size);
  if (sample == nullptr) return nullptr;
  std::size_t have = 0;
  for (ddsrt_msg_iovlen_t i = 0; i < count; ++i) {
    const std::size_t length = std::min<std::size_t>(pieces[i].iov_len, size - have);
    std::memcpy(sample->bytes.get() + have, pieces[i].iov_base, length);
    have += length;
  }
  return sample;
}

ddsi_serdata* from_keyhash(const ddsi_sertype* type, const ddsi_keyhash*) {
  return make_sample(type, SDK_KEY, 0);
}

// Not supported, because samples are written only as serialized bytes.
ddsi_serdata* from_sample(const ddsi_sertype*, ddsi_serdata_kind, const void*) {
  return nullptr;
}

void to_bytes(const ddsi_serdata* sample, std::size_t offset, std::size_t size, void* to) {
  std::memcpy(to, cdr(sample).bytes.get() + offset, size);
}

ddsi_serdata* to_bytes_ref(const ddsi_serdata* sample, std::size_t offset, std::size_t size,
                           ddsrt_iovec_t* ref) {
  ref->iov_base = cdr(sample).bytes.get() + offset;
  ref->iov_len = static_cast<ddsrt_iov_len_t>(size);
  return ddsi_serdata_ref(sample);
}

void to_bytes_unref(ddsi_serdata* sample, const ddsrt_iovec_t*) {
  ddsi_serdata_unref(sample);
}

bool to_sample(const ddsi_serdata*, void*, void**, void*) {
  return false;
}

ddsi_serdata* to_untyped(const ddsi_serdata* sample) {
  CdrSample* const untyped = make_sample(sample->type, SDK_KEY, 0);
  if (untyped != nullptr) untyped->type = nullptr;
  return untyped;
}

bool untyped_to_sample(const ddsi_sertype*, const ddsi_serdata*, void*, void**, void*) {
  return false;
}

void free_sample(ddsi_serdata* sample) {
  delete static_cast<CdrSample*>(sample);
}

std::size_t print(const ddsi_sertype*, const ddsi_serdata*, char* to, std::size_t size) {
  if (size > 0) *to = '\0';
  return 0;
}

void get_keyhash(const ddsi_serdata*, ddsi_keyhash* hash, bool) {
  std::memset(hash, 0, sizeof *hash);
}

const ddsi_serdata_ops& sample_operations() {
  static const ddsi_serdata_ops operations = [] {
    ddsi_serdata_ops all{};
    all.eqkey = equal_keys;
    all.get_size = size_of;
    all.from_ser = from_fragments;
    all.from_ser_iov = from_pieces;
    all.from_keyhash = from_keyhash;
    all.from_sample = from_sample;
    all.to_ser = to_bytes;
    all.to_ser_ref = to_bytes_ref;
    all.to_ser_unref = to_bytes_unref;
    all.to_sample = to_sample;
    all.to_untyped = to_untyped;
    all.untyped_to_sample = untyped_to_sample;
    all.free = free_sample;
    all.print = print;
    all.get_keyhash = get_keyhash;
    return all;
  }();
  return operations;
}

void free_type(ddsi_sertype* type) {
  ddsi_sertype_fini(type);
  delete type;
}

void no_samples(const ddsi_sertype*, void*, std::size_t) {}
void no_new_samples(void**, const ddsi_sertype*, void*, std::size_t, std::size_t) {}
void no_samples_to_free(const ddsi_sertype*, void**, std::size_t, dds_free_op_t) {}

bool equal_types(const ddsi_sertype*, const ddsi_sertype*) {
  return true;
}

std::uint32_t hash_of_type(const ddsi_sertype*) {
  return 0;
}

const ddsi_sertype_ops& type_operations() {
  static const ddsi_sertype_ops operations = [] {
    ddsi_sertype_ops all{};
    all.version = ddsi_sertype_v0;
    all.free = free_type;
    all.zero_samples = no_samples;
    all.realloc_samples = no_new_samples;
    all.free_samples = no_samples_to_free;
    all.equal = equal_types;
    all.hash = hash_of_type;
    return all;
  }();
  return operations;
}

}  // namespace

CdrSample* make_sample(const ddsi_sertype* type, ddsi_serdata_kind kind, std::size_t size) {
  const std::size_t capacity = (size + 3) / 4 * 4;
  auto sample = std::unique_ptr<CdrSample>(new (std::nothrow) CdrSample());
  if (sample == nullptr) return nullptr;
  sample->bytes.reset(new (std::nothrow) std::byte[std::max<std::size_t>(capacity, 4)]);
  if (sample->bytes == nullptr) return nullptr;
  std::memset(sample->bytes.get() + size, 0, std::max<std::size_t>(capacity, 4) - size);
  sample->size = size;
  ddsi_serdata_init(sample.get(), type, kind);
  return sample.release();
}

dds_entity_t create_cdr_topic(dds_entity_t participant, const std::string& name, const std::string& type,
                              const ddsi_sertype** registered) {
  auto made = std::make_unique<ddsi_sertype>();
  ddsi_sertype_init(made.get(), type.c_str(), &type_operations(), &sample_operations(), true);
  made->allowed_data_representation = DDS_DATA_REPRESENTATION_FLAG_XCDR1;
  ddsi_sertype* known = made.get();  // Cyclone DDS may replace it by an equal registered type
  const dds_entity_t topic =
      dds_create_topic_sertype(participant, name.c_str(), &known, nullptr, nullptr, nullptr);
  if (topic < 0) {
    ddsi_sertype_fini(made.get());
    return topic;
  }
  static_cast<void>(made.release());  // Cyclone DDS owns the type now
  if (registered != nullptr) *registered = known;
  return topic;
}

}  // namespace pcl_bv::dds
