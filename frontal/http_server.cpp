#include "frontal/http_server.hpp"

#include <algorithm>
#include <boost/asio/io_context.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/thread_pool.hpp>
#include <cstdlib>
#include <list>
#include <map>
#include <stdexcept>
#include <thread>
#include <utility>

#include "frontal/http_session.hpp"
#include "proto/control.hpp"

namespace graycube {
namespace {

namespace asio = boost::asio;
using asio::ip::tcp;

/// Connections that the system holds until they are accepted.
constexpr int kBacklog = 1024;
/// How long the server waits for descriptors when it has none for a connection that came.
constexpr std::chrono::milliseconds kNoDescriptorPause{100};

}  // namespace

struct HttpServer::Impl {
  Impl(const std::string& address, std::string token, std::filesystem::path folder,
       HttpDesk& frontal)
      : desk(frontal),
        acceptor(context),
        pause(context),
        routes(world(), std::move(folder), kMaxHttpPictures) {
    const std::size_t colon = address.rfind(':');
    const std::string host = address.substr(0, colon);
    listen(address, host, address.substr(colon + 1));
    const std::uint16_t port = acceptor.local_endpoint().port();
    rules.emplace(host, port, std::move(token));
    url = "http://" + host + ":" + std::to_string(port);
    accept();
    thread = std::thread([this] { context.run(); });
  }
  ~Impl() {
    context.stop();
    thread.join();
    painter.join();
  }

  void listen(const std::string& address, std::string host, const std::string& port) {
    if (host.starts_with('[')) host = host.substr(1, host.size() - 2);
    if (host == "localhost") host = "127.0.0.1";
    boost::system::error_code error;
    const auto ip = asio::ip::make_address(host, error);
    const int number = port == "*" ? 0 : std::atoi(port.c_str());
    const tcp::endpoint endpoint(ip, static_cast<std::uint16_t>(number));
    if (!error) acceptor.open(endpoint.protocol(), error);
    if (!error) acceptor.set_option(tcp::acceptor::reuse_address(true), error);
    if (!error) acceptor.bind(endpoint, error);
    if (!error) acceptor.listen(kBacklog, error);
    if (error) {
      throw std::runtime_error("http: " + address +
                               ": the address can't be bound: " + error.message());
    }
  }

  // ---- connections, on the server's thread

  void accept() {
    acceptor.async_accept([this](boost::system::error_code error, tcp::socket socket) {
      if (error == asio::error::operation_aborted) return;
      if (!error) {
        begin(std::move(socket));
        return accept();
      }
      // Most likely out of descriptors: others may be closed soon, the oldest idle one at once.
      close_one();
      pause.expires_after(kNoDescriptorPause);
      pause.async_wait([this](boost::system::error_code aborted) {
        if (!aborted) accept();
      });
    });
  }

  void begin(tcp::socket socket) {
    if (sessions.size() >= kMaxHttpConnections) close_one();
    const auto session = std::make_shared<HttpSession>(
        std::move(socket), *rules, routes, [this](HttpSession& ended) {
          sessions.remove_if([&](const auto& s) { return s.get() == &ended; });
        });
    sessions.push_back(session);
    session->start();
  }

  /// The idle one that has been connected for the longest time, or the oldest if none is idle.
  void close_one() {
    if (sessions.empty()) return;
    auto found = std::ranges::find_if(sessions, [](const auto& s) { return s->is_idle(); });
    if (found == sessions.end()) found = sessions.begin();
    // It takes itself out of the list.
    const std::shared_ptr<HttpSession> session = *found;
    session->close();
  }

  // ---- questions to the frontal

  HttpRoutes::World world() {
    return {.ask = [this](const ControlMessage& question,
                          HttpRoutes::Heard heard) { ask(question, std::move(heard)); },
            .aside =
                [this](std::function<void()> work, std::function<void()> then) {
                  asio::post(painter, [this, work = std::move(work), then = std::move(then)] {
                    work();
                    asio::post(context, then);
                  });
                }};
  }

  void ask(const ControlMessage& question, HttpRoutes::Heard heard) {
    const std::uint64_t number = next_number++;
    Question& asked =
        questions.try_emplace(number, Question{std::move(heard), asio::steady_timer(context)})
            .first->second;
    asked.patience.expires_after(kHttpFrontalPatience);
    asked.patience.async_wait([this, number](boost::system::error_code aborted) {
      if (!aborted) hear(number, std::nullopt);
    });
    desk.ask({number, Message::of_text(encode(question))});
  }

  void hear(std::uint64_t number, std::optional<Message> message) {
    const auto found = questions.find(number);
    if (found == questions.end()) return;
    const HttpRoutes::Heard heard = std::move(found->second.heard);
    questions.erase(found);
    heard(std::move(message));
  }

  struct Question {
    HttpRoutes::Heard heard;
    asio::steady_timer patience;
  };

  HttpDesk& desk;
  asio::io_context context{1};
  tcp::acceptor acceptor;
  asio::steady_timer pause;
  asio::thread_pool painter{1};
  HttpRoutes routes;
  std::optional<HttpRules> rules;
  std::string url;
  std::map<std::uint64_t, Question> questions;
  std::uint64_t next_number = 0;
  /// Those that began first are first.
  std::list<std::shared_ptr<HttpSession>> sessions;
  std::thread thread;
};

HttpServer::HttpServer(const std::string& address, std::string token, std::filesystem::path folder,
                       HttpDesk& desk)
    : impl_(std::make_unique<Impl>(address, std::move(token), std::move(folder), desk)) {}

HttpServer::~HttpServer() = default;

const std::string& HttpServer::url() const { return impl_->url; }

void HttpServer::answer(std::uint64_t number, Message message) {
  // Functions that are posted must be copyable, and a message is costly to copy.
  auto shared = std::make_shared<Message>(std::move(message));
  asio::post(impl_->context,
             [impl = impl_.get(), number, shared] { impl->hear(number, std::move(*shared)); });
}

}  // namespace graycube
