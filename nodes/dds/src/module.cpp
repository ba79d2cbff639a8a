// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "endpoints.h"
#include "stream/middleware.h"

namespace pcl_bv::dds {
using namespace detail;
namespace {

class Dds final : public Middleware {
 public:
  std::unique_ptr<MessageReceiver> receiver(const std::string& topic, const std::vector<std::string>& types,
                                            Delivery delivery) override {
    return make_receiver(topic, types, delivery);
  }
  std::unique_ptr<MessageSender> carrier(const std::string&) override { return make_sender(); }
};

}  // namespace
}  // namespace pcl_bv::dds

extern "C" [[gnu::visibility("default")]] const char* pcl_bv_module_version() {
  return PCL_BV_VERSION;
}

extern "C" [[gnu::visibility("default")]] pcl_bv::detail::Middleware* pcl_bv_middleware() {
  static pcl_bv::dds::Dds module;
  return &module;
}
