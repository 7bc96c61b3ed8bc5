#include "transport/connection_watch.hpp"

namespace graycube {

int ConnectionWatch::events() {
  return ZMQ_EVENT_CONNECTED | ZMQ_EVENT_CLOSED | ZMQ_EVENT_DISCONNECTED |
         ZMQ_EVENT_HANDSHAKE_SUCCEEDED | ZMQ_EVENT_HANDSHAKE_FAILED_NO_DETAIL |
         ZMQ_EVENT_HANDSHAKE_FAILED_PROTOCOL | ZMQ_EVENT_HANDSHAKE_FAILED_AUTH;
}

void ConnectionWatch::on_event(const SocketEvent& e, Clock::time_point now) {
  switch (e.event) {
    case ZMQ_EVENT_CLOSED: trouble_ = HandshakeTrouble::kNobody; break;
    case ZMQ_EVENT_CONNECTED:
      connected_at_ = now;
      has_failed_ = false;
      if (trouble_ == HandshakeTrouble::kNobody) trouble_.reset();
      break;
    case ZMQ_EVENT_HANDSHAKE_SUCCEEDED:
      is_open_ = true;
      trouble_.reset();
      break;
    case ZMQ_EVENT_HANDSHAKE_FAILED_AUTH:
      has_failed_ = true;
      trouble_ = HandshakeTrouble::kNotAdmitted;
      break;
    case ZMQ_EVENT_HANDSHAKE_FAILED_PROTOCOL:
      has_failed_ = true;
      trouble_ = HandshakeTrouble::kOtherMechanism;
      break;
    case ZMQ_EVENT_HANDSHAKE_FAILED_NO_DETAIL:
      has_failed_ = true;
      if (++hang_ups_ >= kHangUpsMeant) trouble_ = HandshakeTrouble::kHangsUp;
      break;
    case ZMQ_EVENT_DISCONNECTED: on_close(); break;
    default: break;
  }
}

void ConnectionWatch::on_close() {
  if (is_open_) {
    is_lost_ = true;
  } else if (!has_failed_) {
    trouble_ = HandshakeTrouble::kNotZmq;
  }
  connected_at_.reset();
}

std::optional<HandshakeTrouble> ConnectionWatch::trouble(Clock::time_point now) const {
  if (is_open_) return std::nullopt;
  if (!trouble_ && connected_at_ && now - *connected_at_ > kSilenceInHandshake)
    return HandshakeTrouble::kSilent;
  return trouble_;
}

}  // namespace graycube
