#include "frontal/store/database_store.hpp"

#include <algorithm>
#include <system_error>
#include <utility>

#include "frontal/store/database.hpp"
#include "frontal/store/job_files.hpp"
#include "frontal/store/job_rows.hpp"
#include "frontal/store/picture_folder.hpp"
#include "frontal/store/record_file.hpp"
#include "frontal/store/scene_folder.hpp"
#include "frontal/store/schema.hpp"
#include "frontal/store/store_lock.hpp"
#include "frontal/store/tile_writer.hpp"

namespace graycube {
namespace {

namespace fs = std::filesystem;

constexpr const char* kDatabaseFile = "jobs.sqlite";

/// A folder that is made here is this user's alone, whatever the umask. One that was there has the
/// rights that somebody wanted it to have.
fs::path made(fs::path folder) {
  std::error_code error;
  const bool is_new = !fs::exists(folder, error);
  fs::create_directories(folder, error);
  if (is_new && !error) fs::permissions(folder, fs::perms::owner_all, error);
  if (error) throw std::runtime_error(folder.string() + ": " + error.message());
  return folder;
}

std::unique_ptr<Database> open_sound(const fs::path& folder, const Warn& warn) {
  auto database = std::make_unique<Database>(folder / kDatabaseFile);
  database->check_soundness();
  prepare_tables(*database, folder, warn);
  return database;
}

/// A damaged database is set aside with its log and the scenes of its jobs, which belong to it.
std::unique_ptr<Database> open_database(const fs::path& folder, const Warn& warn) {
  try {
    return open_sound(folder, warn);
  } catch (const DatabaseError& e) {
    if (!e.is_damaged) throw;
    for (const char* ending : {"", "-wal", "-shm"}) {
      const fs::path file = (folder / kDatabaseFile).string() + ending;
      if (fs::exists(file)) set_aside(folder, file, e.what(), warn);
    }
    for (const fs::path& file : scene_files(folder)) set_aside(folder, file, e.what(), warn);
  }
  return open_sound(folder, warn);
}

class DatabaseStore : public JobStore {
 public:
  DatabaseStore(const fs::path& folder, const StoreOptions& options, Warn warn)
      : folder_(made(folder)),
        rule_(options.keep),
        warn_(std::move(warn)),
        lock_(folder_),
        database_(open_database(folder_, warn_)),
        rows_(*database_),
        pictures_(folder_, !options.is_passing, warn_),
        scenes_(folder_, !options.is_passing),
        writer_(warn_) {
    remove_unfinished_files(folder_);
    scenes_.keep_only(rows_.not_ended());
    if (options.is_passing) database_->run("PRAGMA synchronous = OFF");
  }

  void add(const AcceptedJob& job, std::span<const std::byte> scene) override {
    Transaction transaction(*database_);
    rows_.add(job);
    if (!is_long_scene(scene)) rows_.add_scene(job.info.job, scene);
    transaction.commit();
  }
  std::optional<KeyedJob> find_key(const std::string& key) override { return rows_.find_key(key); }
  void keep(const EndedJob& job, Picture picture) override {
    Transaction transaction(*database_);
    rows_.end(job);
    transaction.commit();
    if (!picture.rgb.empty()) pictures_.hold(job.info.job, std::move(picture));
    forget_tiles(job.info.job);
    const fs::path scene = scenes_.file(job.info.job);
    std::error_code ignored;
    if (fs::exists(scene, ignored)) writer_.remove(scene);
  }
  const Picture* picture(std::uint32_t job) override { return pictures_.held(job); }
  bool must_read(std::uint32_t job) const override {
    return pictures_.held(job) == nullptr && pictures_.is_there(job);
  }
  void hold(std::uint32_t job, Picture picture) override {
    pictures_.hold(job, std::move(picture));
  }
  void write_scene(std::uint32_t job, std::span<const std::byte> scene) override {
    scenes_.write(job, scene);
  }
  Bytes read_scene(std::uint32_t job) override { return scenes_.read(job); }
  void write_picture(const control::JobInfo& job, const Picture& picture) override {
    pictures_.write(job.job, picture, job.scene);
  }
  std::optional<Picture> read_picture(std::uint32_t job) override { return pictures_.read(job); }

  std::vector<EndedJob> recover() override { return rows_.newest_ended(kMaxJobsListed, warn_); }
  std::vector<AcceptedJob> recover_accepted() override { return rows_.accepted(warn_); }
  Begun begin(std::uint32_t job) override { return rows_.begin(job); }
  std::optional<Bytes> scene(std::uint32_t job) override { return rows_.scene(job); }
  std::uint32_t last_number() override {
    return std::max(rows_.last_number(), last_job_of_files(folder_));
  }
  std::optional<EndedJob> ended(std::uint32_t job) override { return rows_.ended(job); }

  bool records_tiles() const override { return true; }
  Bytes recorded_tiles(std::uint32_t job) override { return read_record_file(tiles_of(job)); }
  void record_tiles(std::uint32_t job, Bytes records) override {
    if (std::exchange(recorded_job_, job) != job) rows_.got_on(job);
    writer_.append(tiles_of(job), std::move(records));
  }
  void forget_tiles(std::uint32_t job) override {
    std::error_code ignored;
    if (job == recorded_job_ || fs::exists(tiles_of(job), ignored)) writer_.remove(tiles_of(job));
  }

  std::vector<std::uint32_t> clear_old(double unix_s) override {
    const auto old = rows_.beyond(rule_, unix_s);
    if (old.empty()) return old;
    Transaction transaction(*database_);
    for (const std::uint32_t job : old) rows_.remove(job);
    transaction.commit();
    for (const std::uint32_t job : old) pictures_.remove(job);
    return old;
  }

 private:
  fs::path tiles_of(std::uint32_t job) const { return job_file(folder_, job, ".tiles"); }

  fs::path folder_;
  KeepRule rule_;
  Warn warn_;
  StoreLock lock_;
  std::unique_ptr<Database> database_;
  JobRows rows_;
  PictureFolder pictures_;
  SceneFolder scenes_;
  TileWriter writer_;
  /// The job of which tiles were recorded last.
  std::uint32_t recorded_job_ = 0;
};

}  // namespace

std::unique_ptr<JobStore> open_database_store(const fs::path& folder, const StoreOptions& options,
                                              Warn warn) {
  return std::make_unique<DatabaseStore>(folder, options, std::move(warn));
}

}  // namespace graycube
