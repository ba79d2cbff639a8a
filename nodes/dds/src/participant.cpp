// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "participant.h"

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "pcl_bv/io/raw_cloud.h"

namespace pcl_bv::dds {
using namespace detail;
namespace {

// The socket buffer has up to 8 MB. With Linux's default of 212 kB, hundreds of clouds of some megabytes are
// lost. WhcHigh is the number of unacknowledged bytes above which a writer waits for its readers. A stuck
// reader must not block the writer. With 256 MB, the writer stores the unacknowledged messages (five per
// topic) and continues. With the default of 500 kB, the writer would wait.
constexpr const char* kBufferConfig =
    "<Internal><SocketReceiveBufferSize "
    "max=\"8MB\"/><Watermarks><WhcHigh>256MB</WhcHigh></Watermarks></Internal>";

std::string environment(const char* name) {
  const char* const value = std::getenv(name);
  return value == nullptr ? "" : value;
}

dds_domainid_t domain_of_environment() {
  const std::string text = environment("ROS_DOMAIN_ID");
  if (text.empty()) return 0;
  unsigned id = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), id);
  if (error != std::errc() || end != text.data() + text.size() || id > 232)
    throw std::invalid_argument("ROS_DOMAIN_ID: " + in_quotes(text) + " is not a whole number from 0 to 232");
  return id;
}

std::string peers_of(const std::string& text) {
  std::string peers;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find(';', begin), text.size());
    const std::string peer = text.substr(begin, end - begin);
    if (peer.find_first_of("<>&\"' ") != std::string::npos)
      throw std::invalid_argument("ROS_STATIC_PEERS: " + in_quotes(peer) + " is not an address");
    if (!peer.empty()) peers += "<Peer Address=\"" + peer + "\"/>";
    begin = end + 1;
  }
  return peers;
}

// Returns Cyclone DDS's configuration from the environment variables that rmw_cyclonedds also reads. The
// peers are the addresses in ROS_STATIC_PEERS. If only the loopback interface is used, 127.0.0.1 is a peer,
// too, because this interface usually has no multicast. Discovery probes each peer at the ports of the
// participant indices 0 to 32. Two values of ROS_AUTOMATIC_DISCOVERY_RANGE are exceptions. With
// SYSTEM_DEFAULT, ROS_STATIC_PEERS is ignored. With OFF, there are no peers and no multicast.
std::string cyclone_config() {
  const std::string range = environment("ROS_AUTOMATIC_DISCOVERY_RANGE");
  for (const char* known : {"", "SUBNET", "SYSTEM_DEFAULT", "LOCALHOST", "OFF"}) {
    if (range == known) break;
    if (std::string_view(known) == "OFF")
      throw std::invalid_argument("ROS_AUTOMATIC_DISCOVERY_RANGE: " + in_quotes(range) +
                                  " is not SUBNET, LOCALHOST, OFF or SYSTEM_DEFAULT");
  }
  const bool loopback_only = range == "LOCALHOST" || environment("ROS_LOCALHOST_ONLY") == "1";
  std::string peers = range == "SYSTEM_DEFAULT" ? "" : peers_of(environment("ROS_STATIC_PEERS"));
  if (loopback_only) peers += "<Peer Address=\"127.0.0.1\"/>";
  std::string general = "<MaxMessageSize>65500B</MaxMessageSize>";
  if (loopback_only) general += "<Interfaces><NetworkInterface address=\"127.0.0.1\"/></Interfaces>";
  if (range == "OFF") general += "<AllowMulticast>false</AllowMulticast>";
  std::string discovery;
  if (!peers.empty() && range != "OFF") {
    discovery =
        "<Discovery><ParticipantIndex>auto</ParticipantIndex><MaxAutoParticipantIndex>32</"
        "MaxAutoParticipantIndex>"
        "<Peers>" +
        peers + "</Peers></Discovery>";
  }
  return "<General>" + general + "</General>" + discovery + kBufferConfig;
}

bool is_word(std::string_view word) {
  const auto letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; };
  if (word.empty() || !letter(word.front())) return false;
  for (const char c : word)
    if (!letter(c) && !(c >= '0' && c <= '9')) return false;
  return true;
}

}  // namespace

Entity::Entity(dds_entity_t entity, const std::string& what) : entity_(entity) {
  if (entity < 0) throw IoError(what + ": " + dds_strretcode(entity));
}
Entity::Entity(Entity&& other) noexcept : entity_(std::exchange(other.entity_, 0)) {}
Entity& Entity::operator=(Entity&& other) noexcept {
  std::swap(entity_, other.entity_);
  return *this;
}
Entity::~Entity() {
  if (entity_ > 0) dds_delete(entity_);
}

Participant::Log::Log() {
  dds_set_log_sink(note, this);
}
Participant::Log::~Log() {
  dds_set_log_sink(nullptr, nullptr);
}

void Participant::Log::note(void* log, const dds_log_data_t* data) {
  Log& self = *static_cast<Log*>(log);
  std::string_view text(data->message, data->size);
  while (text.ends_with('\n'))
    text.remove_suffix(1);
  // Skip this message, which appears on nearly every machine. Discovery on the loopback interface needs no
  // multicast.
  if (text.find("\"lo\" is not multicast-capable") != std::string_view::npos) return;
  const std::lock_guard lock(self.mutex_);
  if (self.lines_.size() < 100) self.lines_.emplace_back(text);
}

std::vector<std::string> Participant::Log::take() {
  const std::lock_guard lock(mutex_);
  return std::exchange(lines_, {});
}

std::string Participant::Log::last() const {
  const std::lock_guard lock(mutex_);
  return lines_.empty() ? "" : ": " + lines_.back();
}

Participant::Participant() {
  const dds_domainid_t id = domain_of_environment();
  const std::string what = "DDS domain " + std::to_string(id);
  if (environment("CYCLONEDDS_URI").empty()) {
    const dds_entity_t domain = dds_create_domain(id, cyclone_config().c_str());
    // If this process has already created the domain, the domain keeps its first configuration.
    if (domain != DDS_RETCODE_PRECONDITION_NOT_MET) {
      if (domain < 0) throw IoError(what + ": " + dds_strretcode(domain) + log_.last());
      domain_ = Entity(domain, what);
    }
  }
  const Qos qos = make_qos();
  constexpr std::string_view node = "enclave=/;";  // user data of a ROS participant without nodes
  dds_qset_userdata(qos.get(), node.data(), node.size());
  const dds_entity_t participant = dds_create_participant(id, qos.get(), nullptr);
  if (participant < 0) throw IoError(what + ": " + dds_strretcode(participant) + log_.last());
  participant_ = Entity(participant, what);
}

std::shared_ptr<Participant> Participant::shared() {
  static std::mutex mutex;
  static std::weak_ptr<Participant> existing;
  const auto remove = [](const Participant* last) {  // locked, because another thread may be in shared()
    const std::lock_guard lock(mutex);
    delete last;
  };
  const std::lock_guard lock(mutex);
  std::shared_ptr<Participant> participant = existing.lock();
  if (participant == nullptr)
    existing = participant = std::shared_ptr<Participant>(new Participant(), remove);
  return participant;
}

std::vector<std::string> Participant::take_log() {
  return log_.take();
}

std::string dds_topic(const std::string& topic) {
  const std::string_view name = std::string_view(topic).substr(topic.starts_with('/') ? 1 : 0);
  for (std::size_t begin = 0; begin <= name.size();) {
    const std::size_t end = std::min(name.find('/', begin), name.size());
    if (!is_word(name.substr(begin, end - begin)))
      throw std::invalid_argument(in_quotes(topic) +
                                  " is not a valid topic name (examples: /points, /lidar/points)");
    begin = end + 1;
  }
  return "rt/" + std::string(name);
}

std::string dds_type(const std::string& type) {
  std::string name;
  std::size_t begin = 0;
  for (std::size_t slash = type.find('/'); slash != std::string::npos; slash = type.find('/', begin)) {
    name += type.substr(begin, slash - begin) + "::";
    begin = slash + 1;
  }
  return name + "dds_::" + type.substr(begin) + '_';
}

std::string ros_type(std::string type) {
  if (const std::size_t own = type.find("dds_::"); own != std::string::npos && type.ends_with('_')) {
    type.pop_back();
    type.erase(own, 6);
  }
  for (std::size_t colons = type.find("::"); colons != std::string::npos; colons = type.find("::"))
    type.replace(colons, 2, "/");
  return type;
}

Qos make_qos() {
  return {dds_create_qos(), dds_delete_qos};
}

}  // namespace pcl_bv::dds
