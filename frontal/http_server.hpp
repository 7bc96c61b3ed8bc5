// The farm's web page and its JSON, on a loopback address, served by a thread of its own. A client
// like any other: each request asks the frontal, so the brain knows nothing of HTTP.
#pragma once

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>

#include "frontal/http_desk.hpp"

namespace graycube {

/// Connections at a time. Beyond them the one is closed that hasn't sent a whole request, or has
/// waited for the next, for the longest time.
inline constexpr std::size_t kMaxHttpConnections = 256;
/// Bytes of a request's headers, and of its body, which isn't read if it is longer.
inline constexpr std::size_t kMaxHttpHeaderBytes = 8192, kMaxHttpBodyBytes = 65536;
/// How long a request may take to come whole, and an answer to be taken.
inline constexpr std::chrono::seconds kHttpRequestPatience{10}, kHttpAnswerPatience{30};
/// How long the frontal may take to answer a request.
inline constexpr std::chrono::seconds kHttpFrontalPatience{5};
/// Pictures that are fetched and encoded at a time; others wait.
inline constexpr std::size_t kMaxHttpPictures = 2;

/// GET /                     the page: jobs with their progress and pictures, and nodes
/// GET /api/jobs             a `jobs` message
/// GET /api/jobs/N           a `job_info` message
/// GET /api/nodes            a `node_list` message
/// GET /metrics              the farm's figures, in Prometheus' text format
/// GET /jobs/N.png           the picture of a job that is done, 8-bit sRGB
/// POST /api/jobs/N/cancel   with the token: cancels the job; a `job_info` message
/// Errors are a `failed` message with status 400, 401, 403, 404, 405, 409, 413 or 502.
class HttpServer {
 public:
  /// `address` is HOST:PORT, HOST a loopback address (endpoint_problem); `folder` takes temporary
  /// files; `token` is what requests show that change something. Throws std::runtime_error when the
  /// address can't be bound.
  HttpServer(const std::string& address, std::string token, std::filesystem::path folder,
             HttpDesk& desk);
  ~HttpServer();
  HttpServer(const HttpServer&) = delete;
  HttpServer& operator=(const HttpServer&) = delete;

  /// The page's address, http://HOST:PORT, with the port that was picked.
  const std::string& url() const;

  /// The frontal's answer to a question of the desk; called by the frontal's thread.
  void answer(std::uint64_t number, Message message);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace graycube
