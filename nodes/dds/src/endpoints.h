// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <memory>
#include <string>

#include "stream/middleware.h"

namespace pcl_bv::dds {

/// As Middleware says.
std::unique_ptr<MessageReceiver> make_receiver(const std::string& topic, const std::string& type);
std::unique_ptr<MessageCarrier> make_carrier();

}  // namespace pcl_bv::dds
