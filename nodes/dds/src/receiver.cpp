// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include <chrono>
#include <fstream>
#include <set>
#include <utility>

#include "cdr_type.h"
#include "endpoints.h"
#include "participant.h"

namespace pcl_bv::dds {
using namespace detail;
namespace {

using Clock = std::chrono::steady_clock;

constexpr long kMinReceiveBuffer = 8 << 20;

struct Unref {
  void operator()(ddsi_serdata* sample) const { ddsi_serdata_unref(sample); }
};

// Returns the QoS of a reader. For clouds, it matches the writers of all drivers: a best-effort reader also
// matches reliable writers. For transforms, it is that of ROS's tf2 listener.
Qos reader_qos(Delivery delivery) {
  Qos qos = make_qos();
  const bool newest = delivery == Delivery::newest;
  constexpr int waiting_transforms = 1000;
  dds_qset_reliability(qos.get(), newest ? DDS_RELIABILITY_BEST_EFFORT : DDS_RELIABILITY_RELIABLE,
                       DDS_MSECS(100));
  dds_qset_history(qos.get(), DDS_HISTORY_KEEP_LAST, newest ? 2 : waiting_transforms);
  if (delivery == Delivery::latched) dds_qset_durability(qos.get(), DDS_DURABILITY_TRANSIENT_LOCAL);
  dds_qset_ignorelocal(qos.get(), DDS_IGNORELOCAL_PARTICIPANT);
  return qos;
}

// Returns a warning if Linux limits a socket's receive buffer (rmem_max) to less than kMinReceiveBuffer,
// otherwise "".
std::string receive_buffer_warning() {
  long limit = kMinReceiveBuffer;
  std::ifstream("/proc/sys/net/core/rmem_max") >> limit;
  if (limit >= kMinReceiveBuffer) return "";
  return "the kernel limits socket receive buffers to " + std::to_string(limit) +
         " bytes: large clouds may be lost. Fix: sudo sysctl -w net.core.rmem_max=" +
         std::to_string(kMinReceiveBuffer);
}

class Receiver final : public MessageReceiver {
 public:
  Receiver(const std::string& topic, const std::string& type, Delivery delivery)
      : type_(dds_type(type)),
        name_(dds_topic(topic)),
        participant_(Participant::shared()),
        topic_(create_cdr_topic(participant_->get(), name_, type_), topic),
        reader_(dds_create_reader(participant_->get(), topic_.get(), reader_qos(delivery).get(), nullptr), topic),
        read_condition_(dds_create_readcondition(reader_.get(), DDS_ANY_STATE), topic),
        publications_(
            dds_create_reader(participant_->get(), DDS_BUILTIN_TOPIC_DCPSPUBLICATION, nullptr, nullptr),
            topic),
        waitset_(dds_create_waitset(participant_->get()), topic) {
    dds_waitset_attach(waitset_.get(), read_condition_.get(), 0);
    if (std::string warning = receive_buffer_warning(); !warning.empty())
      pending_warnings_.push_back(std::move(warning));
  }

  bool next(ReceivedMessage& message, std::chrono::milliseconds timeout) override {
    const Clock::time_point until = Clock::now() + timeout;
    do {
      if (take(message)) return true;
      const auto left = std::max(until - Clock::now(), Clock::duration(0));
      dds_waitset_wait(waitset_.get(), nullptr, 0, std::chrono::nanoseconds(left).count());
    } while (Clock::now() < until);
    return take(message);
  }

  std::vector<std::string> take_warnings() override {
    std::vector<std::string> all = std::exchange(pending_warnings_, {});
    for (std::string& line : participant_->take_log())
      all.push_back(std::move(line));
    report_losses(all);
    if (Clock::now() >= next_check_) report_mismatched_publishers(all);
    return all;
  }

 private:
  bool take(ReceivedMessage& message) {
    for (;;) {
      ddsi_serdata* sample = nullptr;
      dds_sample_info_t info;
      if (dds_takecdr(reader_.get(), &sample, 1, &info, DDS_ANY_STATE) <= 0) return false;
      std::shared_ptr<ddsi_serdata> owner(sample, Unref());
      if (!info.valid_data) continue;  // no message: a writer has left
      const CdrSample& cdr = *static_cast<const CdrSample*>(sample);
      message = {cdr.bytes.get(), cdr.size, std::move(owner), info.source_timestamp};
      return true;
    }
  }

  // Reports messages lost because of missing fragments or an overloaded network.
  void report_losses(std::vector<std::string>& all) {
    dds_sample_lost_status_t lost{};
    if (dds_get_sample_lost_status(reader_.get(), &lost) < 0 || lost.total_count_change == 0) return;
    all.push_back(std::to_string(lost.total_count_change) + " messages lost, " +
                  std::to_string(lost.total_count) + " in total");
  }

  // Reports publishers on this topic with another type or with incompatible QoS.
  void report_mismatched_publishers(std::vector<std::string>& all) {
    next_check_ = Clock::now() + std::chrono::seconds(1);
    void* samples[32] = {};
    dds_sample_info_t infos[32];
    const dds_return_t count = dds_take(publications_.get(), samples, infos, 32, 32);
    for (dds_return_t i = 0; i < count; ++i) {
      const auto& writer = *static_cast<const dds_builtintopic_endpoint_t*>(samples[i]);
      if (!infos[i].valid_data || name_ != writer.topic_name || type_ == writer.type_name) continue;
      if (mismatched_types_.insert(writer.type_name).second)
        all.push_back("published as " + ros_type(writer.type_name) + ": publisher ignored, expected " +
                      ros_type(type_));
    }
    if (count > 0) dds_return_loan(publications_.get(), samples, count);
    dds_requested_incompatible_qos_status_t refused{};
    dds_get_requested_incompatible_qos_status(reader_.get(), &refused);
    if (refused.total_count_change > 0)
      all.push_back(std::to_string(refused.total_count_change) + " publishers with incompatible QoS");
  }

  std::string type_, name_;
  std::shared_ptr<Participant> participant_;
  Entity topic_, reader_, read_condition_, publications_, waitset_;
  std::vector<std::string> pending_warnings_;
  std::set<std::string> mismatched_types_;
  Clock::time_point next_check_{};
};

}  // namespace

std::unique_ptr<MessageReceiver> make_receiver(const std::string& topic, const std::string& type,
                                               Delivery delivery) {
  return std::make_unique<Receiver>(topic, type, delivery);
}

}  // namespace pcl_bv::dds
