#include "transport/handshake_trouble.hpp"

namespace graycube {

const char* sentence_of(HandshakeTrouble trouble) {
  switch (trouble) {
    case HandshakeTrouble::kNobody: return "nobody listens there";
    case HandshakeTrouble::kSilent: return "something listens there, but it says nothing";
    case HandshakeTrouble::kNotAdmitted:
      return "the farm that listens there doesn't let in who holds this key";
    case HandshakeTrouble::kHangsUp:
      return "what listens there hangs up: it is another farm than this key's, or none";
    case HandshakeTrouble::kOtherMechanism:
      return "what listens there speaks ZeroMQ, but has no key, so it is no farm";
    case HandshakeTrouble::kNotZmq: return "what listens there is no farm: it doesn't speak ZeroMQ";
  }
  return "";
}

const char* sentence_of(RefusalReason reason) {
  switch (reason) {
    case RefusalReason::kWrongKey: return "it has another key";
    case RefusalReason::kNoKey: return "it hung up before it had shown a key, or has none";
    case RefusalReason::kNotZmq: return "it doesn't speak ZeroMQ";
    case RefusalReason::kSilent: return "it said nothing";
  }
  return "";
}

}  // namespace graycube
