// The farm's web page and its JSON, on a loopback address. A client like any other: each request
// asks the frontal over its own socket, so the brain knows nothing of HTTP.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

namespace graycube {

/// GET /              the page: jobs with their progress and pictures, and nodes
/// GET /api/jobs      a `jobs` message
/// GET /api/jobs/N    a `job_info` message
/// GET /api/nodes     a `node_list` message
/// GET /jobs/N.png    the picture of a job that is done, 8-bit sRGB
/// Errors are a `failed` message with status 404, 409 or 502.
class HttpServer {
 public:
  /// `address` is HOST:PORT, HOST a loopback address (endpoint_problem); `folder` takes temporary
  /// files. Throws std::runtime_error when the address can't be bound.
  HttpServer(const std::string& address, std::string frontal_endpoint,
             std::filesystem::path folder);
  ~HttpServer();
  HttpServer(const HttpServer&) = delete;
  HttpServer& operator=(const HttpServer&) = delete;

  /// The page's address, http://HOST:PORT, with the port that was picked.
  const std::string& url() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace graycube
