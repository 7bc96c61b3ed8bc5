// One connection of a web browser: reads requests within limits of size and time, has each
// answered, and writes the answers.
#pragma once

#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "frontal/http_routes.hpp"
#include "frontal/http_rules.hpp"

namespace graycube {

class HttpSession : public std::enable_shared_from_this<HttpSession> {
 public:
  using Socket = boost::asio::ip::tcp::socket;
  /// Both outlive all sessions. `ended` is called once, with this session.
  HttpSession(Socket socket, const HttpRules& rules, HttpRoutes& routes,
              std::function<void(HttpSession&)> ended);
  HttpSession(const HttpSession&) = delete;
  HttpSession& operator=(const HttpSession&) = delete;

  void start() { read_header(); }
  /// Whether no whole request has come since the last answer.
  bool is_idle() const { return is_idle_; }
  /// Closes the connection, whatever is under way.
  void close();

 private:
  using Error = boost::beast::error_code;
  using Parser = boost::beast::http::request_parser<boost::beast::http::string_body>;
  using Response = boost::beast::http::response<boost::beast::http::string_body>;

  void read_header();
  void read_body();
  void on_unreadable(Error error);
  void take_request();
  /// `is_last`: the rest of what the peer sends isn't looked at.
  void write(HttpAnswer answer, bool is_last);
  void on_written(bool is_last);
  /// Reads what the peer still sends and drops it, for a moment: a connection that is closed before
  /// would be reset, and the peer might never see the answer.
  void drain();

  boost::beast::tcp_stream stream_;
  boost::beast::flat_buffer buffer_;
  const HttpRules& rules_;
  HttpRoutes& routes_;
  std::function<void(HttpSession&)> ended_;
  std::optional<Parser> parser_;
  Response response_;
  bool is_idle_ = true;
};

}  // namespace graycube
