// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/io/raw_cloud.h"
#include "server.h"

namespace pcl_bv::live {
using namespace detail;
namespace {

class WebSockets final : public Middleware {
 public:
  std::unique_ptr<MessageReceiver> receiver(const std::string& topic, const std::vector<std::string>&,
                                            Delivery) override {
    throw std::invalid_argument(in_quotes(topic) + ": ws: cannot be used as a source");
  }
  std::unique_ptr<MessageSender> carrier(const std::string& address) override {
    return std::make_unique<Server>(address);
  }
};

}  // namespace
}  // namespace pcl_bv::live

extern "C" [[gnu::visibility("default")]] const char* pcl_bv_module_version() {
  return PCL_BV_VERSION;
}

extern "C" [[gnu::visibility("default")]] pcl_bv::detail::Middleware* pcl_bv_middleware() {
  static pcl_bv::live::WebSockets module;
  return &module;
}
