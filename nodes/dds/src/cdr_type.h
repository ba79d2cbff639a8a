// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A type of Cyclone DDS whose samples are serialized bytes, in and out: no code generated from IDL, no copy into fields.
#pragma once

#include <dds/dds.h>
#include <dds/ddsi/ddsi_serdata.h>

#include <cstddef>
#include <memory>
#include <string>

namespace pcl_bv::dds {

/// A serialized sample of Cyclone's, which counts its references.
struct CdrSample : ddsi_serdata {
  std::unique_ptr<std::byte[]> bytes;  // up to a multiple of 4, as the protocol reads them
  std::size_t size = 0;                // with the four bytes of the encapsulation
};

/// `size` uninitialised bytes but those of the padding; null without memory. One reference.
CdrSample* make_sample(const ddsi_sertype* type, ddsi_serdata_kind kind, std::size_t size);

/// A topic without keys; negative, as DDS's errors are, if it cannot be made. Its samples are of `registered`, if asked for.
dds_entity_t create_cdr_topic(dds_entity_t participant, const std::string& name, const std::string& type,
                              const ddsi_sertype** registered = nullptr);

}  // namespace pcl_bv::dds
