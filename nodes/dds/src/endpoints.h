// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Creation of the module's receivers and senders.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "stream/middleware.h"

namespace pcl_bv::dds {
using namespace detail;

/// The implementations of Middleware::receiver() and Middleware::carrier().
std::unique_ptr<MessageReceiver> make_receiver(const std::string& topic,
                                               const std::vector<std::string>& types, Delivery delivery);
std::unique_ptr<MessageSender> make_sender();

}  // namespace pcl_bv::dds
