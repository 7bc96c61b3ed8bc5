// The tables of a job store, and how those of earlier versions become today's.
#pragma once

#include <filesystem>

#include "frontal/store/database.hpp"
#include "frontal/store/set_aside.hpp"

namespace graycube {

/// Sets how the database is kept, and brings its tables to today's version, one version after the
/// other (SQLite's `user_version`). A new database takes over the records of `folder` that earlier
/// frontals wrote. Throws DatabaseError, also when a newer Graycube has made it.
void prepare_tables(Database& database, const std::filesystem::path& folder, const Warn& warn);

}  // namespace graycube
