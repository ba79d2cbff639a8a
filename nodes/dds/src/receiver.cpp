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
namespace {

using Clock = std::chrono::steady_clock;

constexpr long kWantedBuffer = 8 << 20;

struct Loan {
  void operator()(ddsi_serdata* sample) const { ddsi_serdata_unref(sample); }
};

// Compatible with the QoS of every driver: a best-effort reader also matches reliable writers.
Qos reader_qos() {
  Qos qos = make_qos();
  dds_qset_reliability(qos.get(), DDS_RELIABILITY_BEST_EFFORT, 0);
  dds_qset_history(qos.get(), DDS_HISTORY_KEEP_LAST, 2);
  dds_qset_ignorelocal(qos.get(), DDS_IGNORELOCAL_PARTICIPANT);
  return qos;
}

// Returns a warning if Linux limits a socket's receive buffer (rmem_max) to less than kWantedBuffer,
// otherwise "".
std::string small_buffers() {
  long most = kWantedBuffer;
  std::ifstream("/proc/sys/net/core/rmem_max") >> most;
  if (most >= kWantedBuffer) return "";
  return "the kernel's receive buffers are small (" + std::to_string(most) +
         " bytes), large clouds may be lost: sudo sysctl -w net.core.rmem_max=" +
         std::to_string(kWantedBuffer);
}

class Receiver final : public MessageReceiver {
 public:
  Receiver(const std::string& topic, const std::string& type)
      : type_(dds_type(type)),
        name_(dds_topic(topic)),
        participant_(Participant::shared()),
        topic_(create_cdr_topic(participant_->get(), name_, type_), topic),
        reader_(dds_create_reader(participant_->get(), topic_.get(), reader_qos().get(), nullptr), topic),
        ready_(dds_create_readcondition(reader_.get(), DDS_ANY_STATE), topic),
        publications_(
            dds_create_reader(participant_->get(), DDS_BUILTIN_TOPIC_DCPSPUBLICATION, nullptr, nullptr),
            topic),
        waits_(dds_create_waitset(participant_->get()), topic) {
    dds_waitset_attach(waits_.get(), ready_.get(), 0);
    if (std::string remark = small_buffers(); !remark.empty()) remarks_.push_back(std::move(remark));
  }

  bool next(ReceivedMessage& message, std::chrono::milliseconds patience) override {
    const Clock::time_point until = Clock::now() + patience;
    do {
      if (take(message)) return true;
      const auto left = std::max(until - Clock::now(), Clock::duration(0));
      dds_waitset_wait(waits_.get(), nullptr, 0, std::chrono::nanoseconds(left).count());
    } while (Clock::now() < until);
    return take(message);
  }

  std::vector<std::string> take_remarks() override {
    std::vector<std::string> all = std::exchange(remarks_, {});
    for (std::string& line : participant_->take_log())
      all.push_back(std::move(line));
    note_losses(all);
    if (Clock::now() >= look_again_) note_others(all);
    return all;
  }

 private:
  bool take(ReceivedMessage& message) {
    for (;;) {
      ddsi_serdata* sample = nullptr;
      dds_sample_info_t info;
      if (dds_takecdr(reader_.get(), &sample, 1, &info, DDS_ANY_STATE) <= 0) return false;
      std::shared_ptr<ddsi_serdata> owner(sample, Loan());
      if (!info.valid_data) continue;  // a writer has left
      const CdrSample& cdr = *static_cast<const CdrSample*>(sample);
      message = {cdr.bytes.get(), cdr.size, std::move(owner), info.source_timestamp};
      return true;
    }
  }

  // Reports messages lost because of missing fragments or an overloaded network.
  void note_losses(std::vector<std::string>& all) {
    dds_sample_lost_status_t lost{};
    if (dds_get_sample_lost_status(reader_.get(), &lost) < 0 || lost.total_count_change == 0) return;
    all.push_back(std::to_string(lost.total_count_change) + " lost on the way, " +
                  std::to_string(lost.total_count) + " so far");
  }

  // Reports publishers on this topic with another type or with incompatible QoS.
  void note_others(std::vector<std::string>& all) {
    look_again_ = Clock::now() + std::chrono::seconds(1);
    void* samples[32] = {};
    dds_sample_info_t infos[32];
    const dds_return_t count = dds_take(publications_.get(), samples, infos, 32, 32);
    for (dds_return_t i = 0; i < count; ++i) {
      const auto& writer = *static_cast<const dds_builtintopic_endpoint_t*>(samples[i]);
      if (!infos[i].valid_data || name_ != writer.topic_name || type_ == writer.type_name) continue;
      if (others_.insert(writer.type_name).second)
        all.push_back("published as " + ros_type(writer.type_name) + ", which is not read: only " +
                      ros_type(type_) + " is");
    }
    if (count > 0) dds_return_loan(publications_.get(), samples, count);
    dds_requested_incompatible_qos_status_t refused{};
    dds_get_requested_incompatible_qos_status(reader_.get(), &refused);
    if (refused.total_count_change > 0)
      all.push_back(std::to_string(refused.total_count_change) + " publishers with QoS that do not fit");
  }

  std::string type_, name_;
  std::shared_ptr<Participant> participant_;
  Entity topic_, reader_, ready_, publications_, waits_;
  std::vector<std::string> remarks_;
  std::set<std::string> others_;
  Clock::time_point look_again_{};
};

}  // namespace

std::unique_ptr<MessageReceiver> make_receiver(const std::string& topic, const std::string& type) {
  return std::make_unique<Receiver>(topic, type);
}

}  // namespace pcl_bv::dds
