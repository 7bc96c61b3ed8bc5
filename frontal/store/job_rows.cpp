#include "frontal/store/job_rows.hpp"

#include <algorithm>
#include <bit>
#include <variant>

#include "proto/control.hpp"

namespace graycube {
namespace {

constexpr double kSecondsPerDay = 86'400;

constexpr const char* kEndedColumns =
    "SELECT number, info, is_deadlocked, coalesce(json, '{}') "
    "FROM jobs LEFT JOIN statistics ON job = number "
    "WHERE finished_s IS NOT NULL AND state != 'damaged' ";

std::string ended_by(const char* rest) { return std::string(kEndedColumns) + rest; }

template <typename M>
std::optional<M> message_in(const std::string& text) {
  const auto decoded = decode(text);
  const auto* message = std::get_if<ControlMessage>(&decoded);
  const auto* wanted = message != nullptr ? std::get_if<M>(message) : nullptr;
  return wanted != nullptr ? std::optional<M>(*wanted) : std::nullopt;
}

std::uint32_t number_in(const Statement& row) { return static_cast<std::uint32_t>(row.integer(0)); }

std::vector<std::uint32_t> numbers_in(Statement& rows) {
  std::vector<std::uint32_t> numbers;
  while (rows.next()) numbers.push_back(number_in(rows));
  return numbers;
}

}  // namespace

JobRows::JobRows(Database& db)
    : add_(db.handle(),
           "INSERT INTO jobs (number, state, info, request, submit_key, content) "
           "VALUES (?, ?, ?, ?, ?, ?)"),
      add_scene_(db.handle(), "INSERT INTO scenes (job, text) VALUES (?, ?)"),
      end_(db.handle(),
           "INSERT INTO jobs (number, state, info, request, content, is_deadlocked, finished_s) "
           "VALUES (?, ?, ?, '', 0, ?, ?) ON CONFLICT (number) DO UPDATE SET "
           "state = excluded.state, info = excluded.info, is_deadlocked = excluded.is_deadlocked, "
           "finished_s = excluded.finished_s"),
      drop_scene_(db.handle(), "DELETE FROM scenes WHERE job = ?"),
      keep_statistics_(db.handle(), "INSERT OR REPLACE INTO statistics (job, json) VALUES (?, ?)"),
      remove_(db.handle(), "DELETE FROM jobs WHERE number = ?"),
      begin_(db.handle(),
             "UPDATE jobs SET begun = begun + 1, begun_ever = begun_ever + 1 WHERE number = ? "
             "RETURNING begun, begun_ever"),
      got_on_(db.handle(), "UPDATE jobs SET begun = 0 WHERE number = ?"),
      by_key_(db.handle(), "SELECT number, content FROM jobs WHERE submit_key = ?"),
      scene_(db.handle(), "SELECT text FROM scenes WHERE job = ?"),
      last_(db.handle(), "SELECT seq FROM sqlite_sequence WHERE name = 'jobs'"),
      ended_(db.handle(), ended_by("AND number = ?").c_str()),
      newest_ended_(db.handle(), ended_by("ORDER BY number DESC LIMIT ?").c_str()),
      accepted_(db.handle(),
                "SELECT number, info, request, content FROM jobs "
                "WHERE finished_s IS NULL AND state != 'damaged' ORDER BY number"),
      not_ended_(db.handle(), "SELECT number FROM jobs WHERE finished_s IS NULL"),
      damaged_(db.handle(), "UPDATE jobs SET state = 'damaged' WHERE number = ?"),
      beyond_count_(db.handle(),
                    "SELECT number FROM jobs WHERE finished_s IS NOT NULL "
                    "ORDER BY number DESC LIMIT ? OFFSET ?"),
      beyond_time_(db.handle(), "SELECT number FROM jobs WHERE finished_s < ? LIMIT ?") {}

void JobRows::add(const AcceptedJob& job) {
  const std::string info = encode(job.info);
  const std::string request = encode(control::Submit{job.info.scene, job.options, job.key});
  add_.set(std::int64_t{job.info.job}).set(to_string(job.info.state)).set(info).set(request);
  job.key.empty() ? add_.set_nothing() : add_.set(job.key);
  add_.set(std::bit_cast<std::int64_t>(job.content)).run();
}

void JobRows::add_scene(std::uint32_t job, std::span<const std::byte> scene) {
  add_scene_.set(std::int64_t{job}).set(scene).run();
}

void JobRows::end(const EndedJob& job) {
  const std::string info = encode(job.info);
  const std::int64_t number = job.info.job;
  end_.set(number).set(to_string(job.info.state)).set(info);
  end_.set(std::int64_t{job.is_deadlocked}).set(job.info.finished_s.value_or(0)).run();
  drop_scene_.set(number).run();
  if (job.has_stats()) keep_statistics_.set(number).set(job.stats_json).run();
}

void JobRows::remove(std::uint32_t job) { remove_.set(std::int64_t{job}).run(); }

JobStore::Begun JobRows::begin(std::uint32_t job) {
  JobStore::Begun begun;
  begin_.set(std::int64_t{job});
  while (begin_.next()) {
    begun = {static_cast<std::uint32_t>(begin_.integer(0)),
             static_cast<std::uint32_t>(begin_.integer(1))};
  }
  return begun;
}

void JobRows::got_on(std::uint32_t job) { got_on_.set(std::int64_t{job}).run(); }

std::optional<KeyedJob> JobRows::find_key(const std::string& key) {
  std::optional<KeyedJob> found;
  by_key_.set(key);
  while (by_key_.next())
    found = KeyedJob{number_in(by_key_), std::bit_cast<std::uint64_t>(by_key_.integer(1))};
  return found;
}

std::optional<Bytes> JobRows::scene(std::uint32_t job) {
  std::optional<Bytes> scene;
  scene_.set(std::int64_t{job});
  while (scene_.next()) scene = scene_.bytes(0);
  return scene;
}

std::uint32_t JobRows::last_number() {
  const auto numbers = numbers_in(last_);
  return numbers.empty() ? 0 : numbers.front();
}

std::optional<EndedJob> JobRows::read_ended(Statement& row) {
  auto info = message_in<control::JobInfo>(row.text(1));
  if (!info || info->job != number_in(row)) return std::nullopt;
  return EndedJob{std::move(*info), row.text(3), row.integer(2) != 0};
}

std::optional<AcceptedJob> JobRows::read_accepted(Statement& row) {
  auto info = message_in<control::JobInfo>(row.text(1));
  auto request = message_in<control::Submit>(row.text(2));
  if (!info || !request || info->job != number_in(row)) return std::nullopt;
  return AcceptedJob{std::move(*info), std::move(request->options), std::move(request->key),
                     std::bit_cast<std::uint64_t>(row.integer(3))};
}

std::optional<EndedJob> JobRows::ended(std::uint32_t job) {
  std::optional<EndedJob> found;
  ended_.set(std::int64_t{job});
  while (ended_.next()) found = read_ended(ended_);
  return found;
}

std::vector<EndedJob> JobRows::newest_ended(std::size_t most, const Warn& warn) {
  std::vector<EndedJob> jobs;
  std::vector<std::uint32_t> damaged;
  newest_ended_.set(static_cast<std::int64_t>(most));
  while (newest_ended_.next()) {
    if (auto job = read_ended(newest_ended_)) {
      jobs.push_back(std::move(*job));
    } else {
      damaged.push_back(number_in(newest_ended_));
    }
  }
  mark_damaged(damaged, warn);
  std::reverse(jobs.begin(), jobs.end());
  return jobs;
}

std::vector<AcceptedJob> JobRows::accepted(const Warn& warn) {
  std::vector<AcceptedJob> jobs;
  std::vector<std::uint32_t> damaged;
  while (accepted_.next()) {
    if (auto job = read_accepted(accepted_)) {
      jobs.push_back(std::move(*job));
    } else {
      damaged.push_back(number_in(accepted_));
    }
  }
  mark_damaged(damaged, warn);
  return jobs;
}

void JobRows::mark_damaged(const std::vector<std::uint32_t>& jobs, const Warn& warn) {
  for (const std::uint32_t job : jobs) {
    damaged_.set(std::int64_t{job}).run();
    warn("the record of job " + std::to_string(job) + " is damaged; the farm goes on without it");
  }
}

std::vector<std::uint32_t> JobRows::not_ended() { return numbers_in(not_ended_); }

std::vector<std::uint32_t> JobRows::beyond(const KeepRule& rule, double unix_s) {
  if (rule.jobs != 0) {
    beyond_count_.set(std::int64_t{kMaxClearedAtOnce}).set(std::int64_t{rule.jobs});
    return numbers_in(beyond_count_);
  }
  if (rule.days == 0) return {};
  beyond_time_.set(unix_s - rule.days * kSecondsPerDay).set(std::int64_t{kMaxClearedAtOnce});
  return numbers_in(beyond_time_);
}

}  // namespace graycube
