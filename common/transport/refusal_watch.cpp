#include "transport/refusal_watch.hpp"

#include <cerrno>

namespace graycube {
namespace {

std::optional<RefusalReason> reason_of(const SocketEvent& e) {
  switch (e.event) {
    case ZMQ_EVENT_HANDSHAKE_FAILED_AUTH: return RefusalReason::kWrongKey;
    case ZMQ_EVENT_HANDSHAKE_FAILED_PROTOCOL:
      return e.value == ZMQ_PROTOCOL_ERROR_ZMTP_CRYPTOGRAPHIC ? RefusalReason::kWrongKey
                                                              : RefusalReason::kNoKey;
    case ZMQ_EVENT_HANDSHAKE_FAILED_NO_DETAIL:
      return e.value == EAGAIN ? RefusalReason::kSilent : RefusalReason::kNoKey;
    default: return std::nullopt;
  }
}

}  // namespace

int RefusalWatch::events() {
  return ZMQ_EVENT_ACCEPTED | ZMQ_EVENT_DISCONNECTED | ZMQ_EVENT_HANDSHAKE_SUCCEEDED |
         ZMQ_EVENT_HANDSHAKE_FAILED_NO_DETAIL | ZMQ_EVENT_HANDSHAKE_FAILED_PROTOCOL |
         ZMQ_EVENT_HANDSHAKE_FAILED_AUTH;
}

std::optional<TurnedAway> RefusalWatch::on_end(const SocketEvent& event) {
  if (const auto reason = reason_of(event)) {
    reason_ = reason;
    return std::nullopt;
  }
  if (event.event == ZMQ_EVENT_HANDSHAKE_SUCCEEDED) {
    let_one_in();
    return std::nullopt;
  }
  if (event.event != ZMQ_EVENT_DISCONNECTED) return std::nullopt;
  const auto guest = shaking_hands_.extract(static_cast<int>(event.value));
  const auto reason = std::exchange(reason_, std::nullopt);
  const std::string address = guest ? guest.mapped().address : "";
  if (reason) return TurnedAway{address, *reason};
  if (guest && !guest.mapped().may_be_in) return TurnedAway{address, RefusalReason::kNotZmq};
  return std::nullopt;
}

void RefusalWatch::let_one_in() {
  // With only one it is known who; with several none is accused of anything by mistake.
  if (shaking_hands_.size() == 1) return shaking_hands_.clear();
  for (auto& [descriptor, guest] : shaking_hands_) guest.may_be_in = true;
}

}  // namespace graycube
