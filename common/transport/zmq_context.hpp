// What ZmqContext holds, for those few files that know ZeroMQ.
#pragma once

#include <zmq.hpp>

#include "transport/zmq_sockets.hpp"

namespace graycube {

struct ZmqContext::Impl {
  zmq::context_t context{1};
};

}  // namespace graycube
