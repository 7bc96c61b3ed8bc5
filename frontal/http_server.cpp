#include "frontal/http_server.hpp"

#include <httplib.h>

#include <atomic>
#include <charconv>
#include <fstream>
#include <iterator>
#include <optional>
#include <stdexcept>
#include <thread>
#include <utility>

#include "film/picture_files.hpp"
#include "frontal/http_page.hpp"
#include "proto/control.hpp"
#include "proto/picture_rows.hpp"
#include "transport/zmq_sockets.hpp"

namespace graycube {
namespace {

using control::Failed;

/// How long the frontal may take to answer a request.
constexpr auto kPatience = std::chrono::seconds(5);
constexpr int kBadGateway = 502;

struct Answer {
  ControlMessage message;
  std::string text;
  SharedBytes payload;
};

/// A client for one request.
class FrontalClient {
 public:
  explicit FrontalClient(const std::string& endpoint) : connection_(context_, endpoint) {}

  std::optional<Answer> ask(const ControlMessage& question) {
    connection_.send(Message::of_text(encode(question)));
    auto reply = connection_.receive(kPatience);
    if (!reply) return std::nullopt;
    auto decoded = decode(reply->text());
    auto* message = std::get_if<ControlMessage>(&decoded);
    if (message == nullptr) return std::nullopt;
    return Answer{std::move(*message), std::string(reply->text()), std::move(reply->payload)};
  }

 private:
  ZmqContext context_;
  Connection connection_;
};

int status_of(const Failed& failed) {
  // To the frontal, a number that no job can have is a bad request; here it is a page that doesn't
  // exist.
  const bool is_unknown =
      failed.code == FailureCode::kUnknownJob || failed.code == FailureCode::kBadRequest;
  return is_unknown ? 404 : 409;
}

void reply_json(const std::optional<Answer>& answer, httplib::Response& response) {
  if (!answer) {
    response.status = kBadGateway;
    response.set_content(
        encode(Failed{0, FailureCode::kFailed, {{"the frontal", "it does not answer"}}}),
        "application/json");
    return;
  }
  if (const auto* failed = std::get_if<Failed>(&answer->message)) {
    response.status = status_of(*failed);
  }
  response.set_content(answer->text, "application/json");
}

/// The number in the request's path; 0, which no job has, when it is too large.
std::uint32_t job_of(const httplib::Request& request) {
  const std::string digits = request.matches[1];
  std::uint32_t job = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), job);
  return error == std::errc{} ? job : 0;
}

}  // namespace

struct HttpServer::Impl {
  Impl(std::string frontal_endpoint, std::filesystem::path temporary)
      : endpoint(std::move(frontal_endpoint)), folder(std::move(temporary)) {
    server.set_tcp_nodelay(true);
    server.set_keep_alive_timeout(1);
    server.Get("/", [](const httplib::Request&, httplib::Response& response) {
      response.set_content(kHttpPage, "text/html; charset=utf-8");
    });
    forward("/api/jobs", [](const httplib::Request&) { return control::List{}; });
    forward("/api/nodes", [](const httplib::Request&) { return control::Nodes{}; });
    forward(R"(/api/jobs/(\d+))",
            [](const httplib::Request& r) { return control::Status{job_of(r)}; });
    server.Get(R"(/jobs/(\d+)\.png)",
               [this](const httplib::Request& r, httplib::Response& response) {
                 send_picture(job_of(r), response);
               });
  }

  template <typename Question>
  void forward(const char* path, Question&& question) {
    server.Get(path, [this, question](const httplib::Request& r, httplib::Response& response) {
      reply_json(FrontalClient(endpoint).ask(question(r)), response);
    });
  }

  void send_picture(std::uint32_t job, httplib::Response& response) {
    FrontalClient client(endpoint);
    Picture picture;
    for (std::uint32_t row = 0;;) {
      const auto answer = client.ask(control::Fetch{job, row, kMaxImageSide});
      const auto* rows = answer ? std::get_if<control::Picture>(&answer->message) : nullptr;
      if (rows == nullptr) return reply_json(answer, response);
      const std::size_t count = std::size_t{3} * rows->width * rows->rows,
                        first = picture.rgb.size();
      picture.rgb.resize(first + count);
      if (!decode_picture_rows(answer->payload.bytes(),
                               std::span(picture.rgb).subspan(first, count))) {
        return reply_json(std::nullopt, response);
      }
      picture.width = rows->width;
      picture.height = rows->height;
      row += rows->rows;
      if (row >= rows->height || rows->rows == 0) break;
    }
    const auto path = folder / ("page-" + std::to_string(next_file++) + ".png");
    write_png(path, picture);
    std::ifstream in(path, std::ios::binary);
    response.set_content(std::string(std::istreambuf_iterator<char>(in), {}), "image/png");
    std::error_code ignored;
    std::filesystem::remove(path, ignored);
  }

  std::string endpoint;
  std::filesystem::path folder;
  std::atomic<unsigned> next_file{0};
  httplib::Server server;
  std::string url;
  std::thread thread;
};

HttpServer::HttpServer(const std::string& address, std::string frontal_endpoint,
                       std::filesystem::path folder)
    : impl_(std::make_unique<Impl>(std::move(frontal_endpoint), std::move(folder))) {
  const std::size_t colon = address.rfind(':');
  std::string host = address.substr(0, colon);
  const std::string port = address.substr(colon + 1);
  if (host.size() > 2 && host.front() == '[') host = host.substr(1, host.size() - 2);
  int bound = 0;
  if (port == "*") {
    bound = impl_->server.bind_to_any_port(host);
  } else if (impl_->server.bind_to_port(host, std::atoi(port.c_str()))) {
    bound = std::atoi(port.c_str());
  }
  if (bound <= 0) throw std::runtime_error("http: " + address + ": the address can't be bound");
  impl_->url = "http://" + address.substr(0, colon) + ":" + std::to_string(bound);
  impl_->thread = std::thread([this] { impl_->server.listen_after_bind(); });
}

HttpServer::~HttpServer() {
  impl_->server.stop();
  impl_->thread.join();
}

const std::string& HttpServer::url() const { return impl_->url; }

}  // namespace graycube
