#include "frontal/store/database.hpp"

#include <sqlite3.h>

namespace graycube {
namespace {

/// How long another process may hold the file, such as a person who looks at it with `sqlite3`.
constexpr int kBusy_ms = 2000;

[[noreturn]] void fail(sqlite3* database) {
  const char* file = sqlite3_db_filename(database, "main");
  const int code = sqlite3_errcode(database);
  throw DatabaseError(std::string(file != nullptr ? file : "") + ": " + sqlite3_errmsg(database),
                      code == SQLITE_CORRUPT || code == SQLITE_NOTADB);
}

}  // namespace

Statement::Statement(sqlite3* database, const char* sql) : database_(database) {
  check(sqlite3_prepare_v3(database_, sql, -1, SQLITE_PREPARE_PERSISTENT, &statement_, nullptr));
}
Statement::~Statement() { sqlite3_finalize(statement_); }

void Statement::check(int result) const {
  if (result != SQLITE_OK) fail(database_);
}

Statement& Statement::set(std::int64_t value) {
  check(sqlite3_bind_int64(statement_, ++values_, value));
  return *this;
}
Statement& Statement::set(double value) {
  check(sqlite3_bind_double(statement_, ++values_, value));
  return *this;
}
Statement& Statement::set(std::string_view text) {
  check(sqlite3_bind_text64(statement_, ++values_, text.data(), text.size(), SQLITE_STATIC,
                            SQLITE_UTF8));
  return *this;
}
Statement& Statement::set(std::span<const std::byte> bytes) {
  // Without a pointer it would be no bytes but nothing.
  const void* data = bytes.empty() ? "" : static_cast<const void*>(bytes.data());
  check(sqlite3_bind_blob64(statement_, ++values_, data, bytes.size(), SQLITE_STATIC));
  return *this;
}
Statement& Statement::set_nothing() {
  check(sqlite3_bind_null(statement_, ++values_));
  return *this;
}

void Statement::run() {
  while (next()) {
  }
}

bool Statement::next() {
  const int result = sqlite3_step(statement_);
  if (result == SQLITE_ROW) return true;
  if (result == SQLITE_DONE) {
    reset();
    return false;
  }
  // The reason would be lost by the reset, and without that the statement would stay in use.
  try {
    fail(database_);
  } catch (const DatabaseError&) {
    reset();
    throw;
  }
}

void Statement::reset() noexcept {
  sqlite3_reset(statement_);
  sqlite3_clear_bindings(statement_);
  values_ = 0;
}

std::int64_t Statement::integer(int column) const {
  return sqlite3_column_int64(statement_, column);
}
std::string Statement::text(int column) const {
  const auto* text = reinterpret_cast<const char*>(sqlite3_column_text(statement_, column));
  const int size = sqlite3_column_bytes(statement_, column);
  return text == nullptr ? std::string() : std::string(text, static_cast<std::size_t>(size));
}
Bytes Statement::bytes(int column) const {
  const auto* bytes = static_cast<const std::byte*>(sqlite3_column_blob(statement_, column));
  const int size = sqlite3_column_bytes(statement_, column);
  return bytes == nullptr ? Bytes() : Bytes(bytes, bytes + size);
}

Database::Database(const std::filesystem::path& file) {
  const int result =
      sqlite3_open_v2(file.c_str(), &database_,
                      SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE | SQLITE_OPEN_NOMUTEX, nullptr);
  if (result != SQLITE_OK) {
    const std::string why = database_ != nullptr ? sqlite3_errmsg(database_) : "out of memory";
    sqlite3_close(database_);
    throw DatabaseError(file.string() + ": " + why, false);
  }
  sqlite3_busy_timeout(database_, kBusy_ms);
}

Database::~Database() { sqlite3_close(database_); }

void Database::run(const char* sql) {
  if (sqlite3_exec(database_, sql, nullptr, nullptr, nullptr) != SQLITE_OK) fail(database_);
}

std::int64_t Database::integer(const char* sql) {
  Statement statement(database_, sql);
  return statement.next() ? statement.integer(0) : 0;
}

void Database::check_soundness() {
  Statement statement(database_, "PRAGMA quick_check(1)");
  const std::string found = statement.next() ? statement.text(0) : "no answer";
  if (found != "ok") {
    throw DatabaseError(std::string(sqlite3_db_filename(database_, "main")) + ": " + found, true);
  }
}

Transaction::~Transaction() {
  if (!is_open_) return;
  try {
    database_.run("ROLLBACK");
  } catch (const DatabaseError&) {
    // Some failures have rolled it back already.
  }
}

void Transaction::commit() {
  database_.run("COMMIT");
  is_open_ = false;
}

}  // namespace graycube
