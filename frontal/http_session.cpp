#include "frontal/http_session.hpp"

#include <utility>

#include "frontal/http_server.hpp"
#include "version.hpp"

namespace graycube {
namespace {

namespace beast = boost::beast;
namespace http = beast::http;

/// How long, and how many bytes at a time, a refused request is read on to be dropped.
constexpr std::chrono::seconds kDrain{2};
constexpr std::size_t kDrainBytes = 16384;

std::string_view text_of(beast::string_view text) { return {text.data(), text.size()}; }

HttpRequestFacts facts_of(const http::request<http::string_body>& request) {
  const auto header = [&](http::field name) { return text_of(request[name]); };
  HttpRequestFacts facts;
  facts.target = text_of(request.target());
  facts.host = header(http::field::host);
  facts.origin = header(http::field::origin);
  facts.fetch_site = text_of(request["Sec-Fetch-Site"]);
  facts.authorization = header(http::field::authorization);
  facts.is_write = request.method() != http::verb::get && request.method() != http::verb::head;
  return facts;
}

/// Why a request isn't granted; nothing if it is.
std::optional<HttpAnswer> refusal_of(HttpVerdict verdict) {
  switch (verdict) {
    case HttpVerdict::kGranted: return std::nullopt;
    case HttpVerdict::kForeignHost: return failed_answer(403, "Host", "not this server");
    case HttpVerdict::kForeignPage: return failed_answer(403, "Origin", "another site's page");
    case HttpVerdict::kNoToken: break;
  }
  return failed_answer(401, "Authorization", "expected the farm's token");
}

}  // namespace

HttpSession::HttpSession(Socket socket, const HttpRules& rules, HttpRoutes& routes,
                         std::function<void(HttpSession&)> ended)
    : stream_(std::move(socket)),
      buffer_(kMaxHttpHeaderBytes + kMaxHttpBodyBytes),
      rules_(rules),
      routes_(routes),
      ended_(std::move(ended)) {
  beast::error_code ignored;
  stream_.socket().set_option(boost::asio::ip::tcp::no_delay(true), ignored);
}

void HttpSession::close() {
  beast::error_code ignored;
  stream_.socket().close(ignored);
  if (ended_) std::exchange(ended_, nullptr)(*this);
}

void HttpSession::read_header() {
  is_idle_ = true;
  parser_.emplace();
  parser_->header_limit(kMaxHttpHeaderBytes);
  parser_->body_limit(kMaxHttpBodyBytes);
  // The time is for the whole request, however it trickles in.
  stream_.expires_after(kHttpRequestPatience);
  http::async_read_header(stream_, buffer_, *parser_,
                          [self = shared_from_this()](Error error, std::size_t) {
                            error ? self->on_unreadable(error) : self->read_body();
                          });
}

void HttpSession::read_body() {
  http::async_read(stream_, buffer_, *parser_,
                   [self = shared_from_this()](Error error, std::size_t) {
                     error ? self->on_unreadable(error) : self->take_request();
                   });
}

void HttpSession::on_unreadable(Error error) {
  if (error == http::error::body_limit) {
    return write(
        failed_answer(413, "the body", "at most " + std::to_string(kMaxHttpBodyBytes) + " bytes"),
        true);
  }
  if (error == http::error::header_limit || error == http::error::buffer_overflow)
    return write(failed_answer(431, "the headers", "they are too long"), true);
  const bool is_nonsense =
      error.category() == http::make_error_code(http::error::bad_method).category();
  if (is_nonsense && error != http::error::end_of_stream && error != http::error::partial_message)
    return write(failed_answer(400, "the request", error.message()), true);
  close();
}

void HttpSession::take_request() {
  is_idle_ = false;
  stream_.expires_never();
  const auto& request = parser_->get();
  if (auto refusal = refusal_of(rules_.verdict(facts_of(request))))
    return write(*std::move(refusal), true);
  routes_.answer(text_of(request.method_string()), text_of(request.target()),
                 [self = shared_from_this()](HttpAnswer answer) {
                   // It may have been closed meanwhile, to make room.
                   if (self->stream_.socket().is_open()) self->write(std::move(answer), false);
                 });
}

void HttpSession::write(HttpAnswer answer, bool is_last) {
  const bool is_head = parser_->get().method() == http::verb::head;
  const bool closes = is_last || !parser_->get().keep_alive();
  response_ = {};
  response_.result(answer.status);
  response_.version(11);
  response_.set(http::field::server, std::string("graycube ") + kVersion);
  response_.set(http::field::content_type, answer.type);
  response_.set("X-Content-Type-Options", "nosniff");
  // The page may not be made part of another, where clicks could be led astray.
  response_.set("X-Frame-Options", "DENY");
  response_.set("Referrer-Policy", "no-referrer");
  response_.keep_alive(!closes);
  response_.content_length(answer.body.size());
  if (!is_head) response_.body() = std::move(answer.body);
  stream_.expires_after(kHttpAnswerPatience);
  const auto then = [self = shared_from_this(), closes](Error error, std::size_t) {
    error ? self->close() : self->on_written(closes);
  };
  http::async_write(stream_, response_, then);
}

void HttpSession::on_written(bool is_last) {
  if (!is_last) return read_header();
  Error ignored;
  stream_.socket().shutdown(Socket::shutdown_send, ignored);
  stream_.expires_after(kDrain);
  drain();
}

void HttpSession::drain() {
  is_idle_ = true;
  buffer_.clear();
  stream_.async_read_some(buffer_.prepare(kDrainBytes),
                          [self = shared_from_this()](Error error, std::size_t) {
                            error ? self->close() : self->drain();
                          });
}

}  // namespace graycube
