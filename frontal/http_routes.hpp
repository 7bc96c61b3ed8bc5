// What a farm's web server answers to each path. It knows no sockets: the frontal is asked, and
// long work is done aside, by functions that are handed in.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "film/film.hpp"
#include "proto/messages.hpp"
#include "transport/message.hpp"

namespace graycube {

struct HttpAnswer {
  unsigned status = 200;
  std::string body;
  std::string type = "application/json";
};

/// A `failed` message as an answer.
HttpAnswer failed_answer(unsigned status, std::string where, std::string why);

class HttpRoutes {
 public:
  using Then = std::function<void(HttpAnswer)>;
  /// The frontal's answer; nothing when it gives none in time.
  using Heard = std::function<void(std::optional<Message>)>;
  struct World {
    /// Asks the frontal. `heard` is called once, later, on this thread.
    std::function<void(const ControlMessage& question, Heard heard)> ask;
    /// Does work on another thread, then calls `then` on this one.
    std::function<void(std::function<void()> work, std::function<void()> then)> aside;
  };

  /// `folder` takes temporary files; at most `most_pictures` pictures are fetched at a time.
  HttpRoutes(World world, std::filesystem::path folder, std::size_t most_pictures)
      : world_(std::move(world)), folder_(std::move(folder)), most_pictures_(most_pictures) {}

  /// Calls `then` once, now or later.
  void answer(std::string_view method, std::string_view target, Then then);

 private:
  struct Fetching;

  void forward(const ControlMessage& question, Then then);
  void send_picture(std::uint32_t job, Then then);
  void begin_picture(std::uint32_t job, const Then& then);
  void fetch_rows(const std::shared_ptr<Fetching>& fetching);
  /// Adds the rows that came; nothing, or the answer if they end the fetching.
  std::optional<HttpAnswer> take_rows(Fetching& fetching, const std::optional<Message>& message);
  void encode_picture(const std::shared_ptr<Fetching>& fetching);
  void end_picture();

  World world_;
  std::filesystem::path folder_;
  std::size_t most_pictures_, pictures_ = 0;
  /// Pictures that wait for others.
  std::deque<std::pair<std::uint32_t, Then>> waiting_;
  std::uint64_t next_file_ = 0;
};

}  // namespace graycube
