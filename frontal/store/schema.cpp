#include "frontal/store/schema.hpp"

#include <array>
#include <string>

#include "frontal/store/earlier_records.hpp"
#include "frontal/store/job_rows.hpp"

namespace graycube {
namespace {

/// The write-ahead log lets a change be one write and one wait for the disk. `synchronous = FULL`
/// waits for it at every change: a job's number is told only after the disk has it, so that none is
/// used twice even if the machine loses power. NORMAL could lose the last numbers then.
constexpr const char* kHowItIsKept = R"sql(
  PRAGMA journal_mode = WAL;
  PRAGMA synchronous = FULL;
  PRAGMA foreign_keys = ON;
  PRAGMA journal_size_limit = 67108864;
)sql";

/// A job's `info` is its job_info message, its `request` its submit message (proto/FORMAT.md);
/// `state` is that of the info, or "damaged" when they can't be read; `begun` counts frontals that
/// have begun to render it and recorded nothing, `begun_ever` all that have begun. AUTOINCREMENT
/// remembers the largest number when its job is gone.
constexpr const char* kFirstTables = R"sql(
  CREATE TABLE jobs (
    number        INTEGER PRIMARY KEY AUTOINCREMENT CHECK (number BETWEEN 1 AND 4294967295),
    state         TEXT NOT NULL,
    info          TEXT NOT NULL,
    request       TEXT NOT NULL,
    submit_key    TEXT UNIQUE,
    content       INTEGER NOT NULL,
    is_deadlocked INTEGER NOT NULL DEFAULT 0,
    begun         INTEGER NOT NULL DEFAULT 0,
    begun_ever    INTEGER NOT NULL DEFAULT 0,
    finished_s    REAL
  );
  CREATE INDEX jobs_by_end ON jobs (finished_s);
  CREATE TABLE scenes (
    job  INTEGER PRIMARY KEY REFERENCES jobs (number) ON DELETE CASCADE,
    text BLOB NOT NULL
  );
  CREATE TABLE statistics (
    job  INTEGER PRIMARY KEY REFERENCES jobs (number) ON DELETE CASCADE,
    json TEXT NOT NULL
  );
)sql";

/// What leads from each version to the next, from version 0, which has no tables.
constexpr std::array kMigrations{kFirstTables};

}  // namespace

void prepare_tables(Database& database, const std::filesystem::path& folder, const Warn& warn) {
  database.run(kHowItIsKept);
  const std::int64_t version = database.integer("PRAGMA user_version");
  const auto newest = static_cast<std::int64_t>(kMigrations.size());
  if (version > newest) {
    throw DatabaseError(folder.string() + ": a newer Graycube has made this job store (version " +
                            std::to_string(version) + ", this one knows " + std::to_string(newest) +
                            ")",
                        false);
  }
  if (version == newest) return;
  Transaction transaction(database);
  for (std::int64_t v = version; v < newest; ++v) {
    database.run(kMigrations[static_cast<std::size_t>(v)]);
    if (v == 0) {
      JobRows rows(database);
      for (const EndedJob& job : read_earlier_records(folder, warn)) rows.end(job);
    }
  }
  database.run(("PRAGMA user_version = " + std::to_string(newest)).c_str());
  transaction.commit();
  if (version == 0) put_away_earlier_records(folder, warn);
}

}  // namespace graycube
