// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A Cyclone DDS type whose samples are serialized CDR bytes. It needs no code generated from IDL and no
// deserialization.
#pragma once

#include <dds/dds.h>
#include <dds/ddsi/ddsi_serdata.h>

#include <cstddef>
#include <memory>
#include <string>

namespace pcl_bv::dds {

/// A serialized sample, reference-counted by Cyclone DDS.
struct CdrSample : ddsi_serdata {
  std::unique_ptr<std::byte[]> bytes;  // `size` bytes, then zeros up to a multiple of 4
  std::size_t size = 0;                // includes the encapsulation header (4 bytes), but not the zeros
};

/// Allocates a sample of `size` uninitialised bytes and zeroed padding, with one reference. Returns null if
/// there is not enough memory.
CdrSample* make_sample(const ddsi_sertype* type, ddsi_serdata_kind kind, std::size_t size);

/// Creates a topic without keys. Returns a negative DDS error code on failure. `registered`, if not null,
/// receives the type that the topic's samples must have.
dds_entity_t create_cdr_topic(dds_entity_t participant, const std::string& name, const std::string& type,
                              const ddsi_sertype** registered = nullptr);

}  // namespace pcl_bv::dds
