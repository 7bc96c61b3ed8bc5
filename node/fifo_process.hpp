// The process that holds this node's FIFO, graycube-fifo: started, talked to and ended by the
// thread that owns the node's sockets, which never waits for it.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "node/parts/fifo/fifo_apart.hpp"
#include "node/parts/fifo/fifo_words.hpp"

namespace graycube {

class FifoProcess {
 public:
  /// `program` is graycube-fifo.
  explicit FifoProcess(std::filesystem::path program);
  /// Ends the process.
  ~FifoProcess();
  FifoProcess(const FifoProcess&) = delete;
  FifoProcess& operator=(const FifoProcess&) = delete;

  /// Starts a process for this order, unless there is one already, or it has ended or could not be
  /// started; ends one for any other order. False when it couldn't be started just now.
  [[nodiscard]] bool serve(const std::optional<FifoOrder>& order);
  /// Hands these messages over in order, as soon as there is room for them on the way.
  void send(const std::vector<Bytes>& messages);
  /// Takes in what has come: calls `on_ray` for each ray that is handed out.
  void receive(const std::function<void(std::span<const std::byte>)>& on_ray);
  /// Why the process could not be started, or how it ended, if nobody has been told so yet: "FIFO
  /// (process 71): killed by signal 9".
  std::optional<std::string> take_failure();
  /// Readable when something has come, or when there is room for what waits to be handed over.
  int descriptor() const { return descriptor_; }
  /// CPU seconds that the process has used so far.
  double cpu_s() const;

 private:
  void start();
  void end();
  void fail(const std::string& why);
  void note_end();
  void write();
  void watch();

  std::filesystem::path program_;
  /// An epoll descriptor of the socket.
  int descriptor_;
  std::optional<FifoOrder> order_;
  /// This end of the pair of sockets, and the process at the other; -1 if there is none.
  int socket_ = -1;
  pid_t pid_ = -1;
  FifoStream stream_;
  /// What waits to be handed over. The queue's places bound it.
  Bytes unsent_;
  bool waits_for_room_ = false;
  std::optional<std::string> failure_;
};

}  // namespace graycube
