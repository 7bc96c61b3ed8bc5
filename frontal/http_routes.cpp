#include "frontal/http_routes.hpp"

#include <charconv>
#include <exception>
#include <fstream>
#include <iterator>
#include <span>
#include <system_error>

#include "film/picture_files.hpp"
#include "frontal/http_page.hpp"
#include "frontal/telling/metrics_text.hpp"
#include "proto/control.hpp"
#include "proto/picture_rows.hpp"

namespace graycube {
namespace {

HttpAnswer silence() { return failed_answer(502, "the frontal", "it does not answer"); }

unsigned status_of(const control::Failed& failed) {
  // To the frontal, a number that no job can have is a bad request, of no job; here it is a page
  // that doesn't exist.
  const bool is_unknown = failed.code == FailureCode::kUnknownJob ||
                          (failed.code == FailureCode::kBadRequest && failed.job == 0);
  return is_unknown ? 404 : 409;
}

HttpAnswer answer_of(const std::optional<Message>& message) {
  if (!message) return silence();
  const auto decoded = decode(message->text());
  const auto* control = std::get_if<ControlMessage>(&decoded);
  if (control == nullptr) return silence();
  HttpAnswer answer;
  if (const auto* failed = std::get_if<control::Failed>(control))
    answer.status = status_of(*failed);
  answer.body = message->text();
  return answer;
}

/// The farm's figures as Prometheus reads them.
HttpAnswer metrics_answer_of(const std::optional<Message>& message) {
  if (!message) return silence();
  const auto decoded = decode(message->text());
  const auto* control = std::get_if<ControlMessage>(&decoded);
  const auto* farm = control != nullptr ? std::get_if<control::FarmMetrics>(control) : nullptr;
  if (farm == nullptr) return answer_of(message);
  return {200, metrics_text(*farm), kMetricsType};
}

/// The number between what the path begins and ends with: nothing if these are other texts, or if
/// there are no digits between them; 0, which no job has, when the number is too large.
std::optional<std::uint32_t> number_in(std::string_view path, std::string_view before,
                                       std::string_view after) {
  if (path.size() <= before.size() + after.size() || !path.starts_with(before) ||
      !path.ends_with(after)) {
    return std::nullopt;
  }
  const std::string_view digits =
      path.substr(before.size(), path.size() - before.size() - after.size());
  if (digits.find_first_not_of("0123456789") != digits.npos) return std::nullopt;
  std::uint32_t number = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  return error == std::errc{} ? number : 0;
}

std::string png_of(const std::filesystem::path& path, const Picture& picture) {
  write_png(path, picture);
  std::ifstream in(path, std::ios::binary);
  std::string bytes(std::istreambuf_iterator<char>(in), {});
  std::error_code ignored;
  std::filesystem::remove(path, ignored);
  return bytes;
}

}  // namespace

HttpAnswer failed_answer(unsigned status, std::string where, std::string why) {
  HttpAnswer answer;
  answer.status = status;
  const FailureCode code = status == 502 ? FailureCode::kFailed : FailureCode::kBadRequest;
  answer.body = encode(control::Failed{0, code, {{std::move(where), std::move(why)}}, {}});
  return answer;
}

/// A picture on its way.
struct HttpRoutes::Fetching {
  std::uint32_t job = 0, row = 0;
  Then then;
  Picture picture;
  HttpAnswer answer;
};

void HttpRoutes::answer(std::string_view method, std::string_view target, Then then) {
  const std::string_view path = target.substr(0, target.find('?'));
  if (const auto job = number_in(path, "/api/jobs/", "/cancel")) {
    if (method != "POST") return then(failed_answer(405, "method", "expected POST"));
    return forward(control::Cancel{*job}, std::move(then));
  }
  if (method != "GET" && method != "HEAD")
    return then(failed_answer(405, "method", "expected GET"));
  if (path == "/") return then({200, kHttpPage, "text/html; charset=utf-8"});
  if (path == "/metrics") {
    return world_.ask(control::Metrics{}, [then = std::move(then)](const auto& message) {
      then(metrics_answer_of(message));
    });
  }
  if (path == "/api/jobs") return forward(control::List{}, std::move(then));
  if (path == "/api/nodes") return forward(control::Nodes{}, std::move(then));
  if (const auto job = number_in(path, "/api/jobs/", ""))
    return forward(control::Status{*job}, std::move(then));
  if (const auto job = number_in(path, "/jobs/", ".png"))
    return send_picture(*job, std::move(then));
  then(failed_answer(404, "path", "no such page"));
}

void HttpRoutes::forward(const ControlMessage& question, Then then) {
  world_.ask(question, [then = std::move(then)](const std::optional<Message>& message) {
    then(answer_of(message));
  });
}

// ---- pictures

void HttpRoutes::send_picture(std::uint32_t job, Then then) {
  if (pictures_ >= most_pictures_) {
    waiting_.emplace_back(job, std::move(then));
    return;
  }
  begin_picture(job, then);
}

void HttpRoutes::begin_picture(std::uint32_t job, const Then& then) {
  ++pictures_;
  auto fetching = std::make_shared<Fetching>();
  fetching->job = job;
  fetching->then = [this, then](HttpAnswer answer) {
    end_picture();
    then(std::move(answer));
  };
  fetch_rows(fetching);
}

void HttpRoutes::end_picture() {
  --pictures_;
  if (waiting_.empty()) return;
  const auto [job, then] = std::move(waiting_.front());
  waiting_.pop_front();
  begin_picture(job, then);
}

void HttpRoutes::fetch_rows(const std::shared_ptr<Fetching>& fetching) {
  const control::Fetch question{fetching->job, fetching->row, kMaxImageSide};
  world_.ask(question, [this, fetching](const std::optional<Message>& message) {
    if (auto end = take_rows(*fetching, message)) return fetching->then(*std::move(end));
    const bool is_whole = fetching->row >= fetching->picture.height;
    is_whole ? encode_picture(fetching) : fetch_rows(fetching);
  });
}

std::optional<HttpAnswer> HttpRoutes::take_rows(Fetching& fetching,
                                                const std::optional<Message>& message) {
  if (!message) return silence();
  const auto decoded = decode(message->text());
  const auto* control = std::get_if<ControlMessage>(&decoded);
  const auto* rows = control != nullptr ? std::get_if<control::Picture>(control) : nullptr;
  if (rows == nullptr) return answer_of(message);
  Picture& picture = fetching.picture;
  const std::size_t count = std::size_t{3} * rows->width * rows->rows, first = picture.rgb.size();
  picture.rgb.resize(first + count);
  const bool is_sound =
      rows->rows > 0 &&
      decode_picture_rows(message->payload.bytes(), std::span(picture.rgb).subspan(first));
  if (!is_sound) return silence();
  picture.width = rows->width;
  picture.height = rows->height;
  fetching.row += rows->rows;
  return std::nullopt;
}

void HttpRoutes::encode_picture(const std::shared_ptr<Fetching>& fetching) {
  const auto path = folder_ / ("page-" + std::to_string(next_file_++) + ".png");
  const auto encode_it = [fetching, path] {
    try {
      fetching->answer = {200, png_of(path, fetching->picture), "image/png"};
    } catch (const std::exception& e) {
      fetching->answer = failed_answer(502, "the picture", e.what());
    }
  };
  world_.aside(encode_it, [fetching] { fetching->then(std::move(fetching->answer)); });
}

}  // namespace graycube
