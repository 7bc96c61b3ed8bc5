// A database of SQLite and the statements that are asked of it. No other file knows that library.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

#include "transport/message.hpp"

struct sqlite3;
struct sqlite3_stmt;

namespace graycube {

/// Something could not be stored or read; what() names the file and says why.
struct DatabaseError : std::runtime_error {
  DatabaseError(const std::string& what, bool is_damage)
      : std::runtime_error(what), is_damaged(is_damage) {}
  /// The file is no database, or its contents contradict each other.
  bool is_damaged;
};

/// A statement that was prepared once. To be used again and again: set its values, in the order of
/// its question marks; then run it, or read its rows. Its database must outlive it.
class Statement {
 public:
  Statement(sqlite3* database, const char* sql);
  ~Statement();
  Statement(const Statement&) = delete;
  Statement& operator=(const Statement&) = delete;

  /// Texts and bytes must live until the statement has run.
  Statement& set(std::int64_t value);
  Statement& set(double value);
  Statement& set(std::string_view text);
  Statement& set(std::span<const std::byte> bytes);
  Statement& set_nothing();

  /// Runs it to its end; rows are dropped.
  void run();
  /// Reads the next row. False when there is none; then it can be used again.
  bool next();
  /// Drops the rows that are left, so that it can be used again.
  void reset() noexcept;

  // The columns of the row, from 0 on.
  std::int64_t integer(int column) const;
  std::string text(int column) const;
  Bytes bytes(int column) const;

 private:
  void check(int result) const;

  sqlite3* database_;
  sqlite3_stmt* statement_ = nullptr;
  int values_ = 0;
};

class Database {
 public:
  /// Opens the file, or makes it. Throws DatabaseError.
  explicit Database(const std::filesystem::path& file);
  ~Database();
  Database(const Database&) = delete;
  Database& operator=(const Database&) = delete;

  /// Runs one or more statements without values.
  void run(const char* sql);
  /// For statements.
  sqlite3* handle() { return database_; }
  std::int64_t integer(const char* sql);
  /// Throws a DatabaseError that tells of damage if the file's pages contradict each other. Reads
  /// all of it.
  void check_soundness();

 private:
  sqlite3* database_ = nullptr;
};

/// Changes that are all made or none: those between its making and commit().
class Transaction {
 public:
  explicit Transaction(Database& database) : database_(database) {
    database_.run("BEGIN IMMEDIATE");
  }
  ~Transaction();
  Transaction(const Transaction&) = delete;
  Transaction& operator=(const Transaction&) = delete;
  void commit();

 private:
  Database& database_;
  bool is_open_ = true;
};

}  // namespace graycube
