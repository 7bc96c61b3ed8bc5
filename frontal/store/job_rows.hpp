// The rows of a job store's tables, read and written as jobs.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "frontal/parts/job_store.hpp"
#include "frontal/store/database.hpp"
#include "frontal/store/set_aside.hpp"
#include "keep_rule.hpp"

namespace graycube {

/// At most so many jobs are cleared at once, since their files take time to remove.
inline constexpr std::uint32_t kMaxClearedAtOnce = 64;

/// Every function throws DatabaseError. Changes are to be made in a Transaction.
class JobRows {
 public:
  /// The database must have its tables, and outlive this.
  explicit JobRows(Database& database);

  void add(const AcceptedJob& job);
  void add_scene(std::uint32_t job, std::span<const std::byte> scene);
  /// The job has ended; its scene is dropped.
  void end(const EndedJob& job);
  void remove(std::uint32_t job);
  /// Counts that the job begins, as JobStore::begin() does.
  JobStore::Begun begin(std::uint32_t job);
  void got_on(std::uint32_t job);

  std::optional<KeyedJob> find_key(const std::string& key);
  /// Nothing if none was added.
  std::optional<Bytes> scene(std::uint32_t job);
  std::uint32_t last_number();
  /// A job that has ended. None for a row that can't be read.
  std::optional<EndedJob> ended(std::uint32_t job);
  /// Ended jobs, the newest `most`, oldest first. Rows that can't be read are named and marked.
  std::vector<EndedJob> newest_ended(std::size_t most, const Warn& warn);
  /// Jobs that have not ended, oldest first. Rows that can't be read are named and marked.
  std::vector<AcceptedJob> accepted(const Warn& warn);
  /// The numbers of all that have not ended, damaged ones too.
  std::vector<std::uint32_t> not_ended();
  /// Some of the jobs that the rule doesn't keep at that Unix time.
  std::vector<std::uint32_t> beyond(const KeepRule& rule, double unix_s);

 private:
  std::optional<EndedJob> read_ended(Statement& row);
  std::optional<AcceptedJob> read_accepted(Statement& row);
  void mark_damaged(const std::vector<std::uint32_t>& jobs, const Warn& warn);

  Statement add_, add_scene_, end_, drop_scene_, keep_statistics_, remove_, begin_, got_on_,
      by_key_, scene_, last_, ended_, newest_ended_, accepted_, not_ended_, damaged_, beyond_count_,
      beyond_time_;
};

}  // namespace graycube
