// What a daemon's job store still knows when it is opened again, and what damage does to it.
#include <sys/stat.h>
#include <unistd.h>

#include <fstream>

#include "catch.hpp"
#include "frontal/store/database.hpp"
#include "frontal/store/database_store.hpp"
#include "process/temporary_folder.hpp"
#include "proto/control.hpp"

using namespace graycube;
namespace fs = std::filesystem;

namespace {

constexpr double kNow_s = 1'800'000'000, kDay_s = 86'400;

Bytes bytes_of(const std::string& text) {
  const auto bytes = std::as_bytes(std::span(text));
  return Bytes(bytes.begin(), bytes.end());
}

AcceptedJob accepted(std::uint32_t number, const std::string& key = {}) {
  AcceptedJob job;
  job.info.job = number;
  job.info.scene = "scene " + std::to_string(number);
  job.info.submitted_s = kNow_s;
  job.options.samples = number + 1;
  job.key = key;
  job.content = 0xF000'0000'0000'0000 + number;
  return job;
}

EndedJob ended(std::uint32_t number, JobState state = JobState::kDone, double finished_s = kNow_s) {
  EndedJob job;
  job.info = accepted(number).info;
  job.info.state = state;
  job.info.finished_s = finished_s;
  return job;
}

Picture small_picture(float red) {
  Picture picture;
  picture.width = 2;
  picture.height = 1;
  picture.rgb = {red, 2, 3, 4, 5, 6};
  return picture;
}

/// Keeps a job that is done, as a frontal does.
void keep(JobStore& store, const EndedJob& job, const Picture& picture) {
  store.write_picture(job.info, picture);
  store.keep(job, picture);
}

void write(const fs::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
}

/// A store's folder, and what it has said.
struct Place {
  TemporaryFolder folder;
  std::vector<std::string> said;

  std::unique_ptr<JobStore> open(const KeepRule& rule = {}) {
    return open_database_store(folder.path(), {.keep = rule},
                               [this](const std::string& sentence) { said.push_back(sentence); });
  }
  bool has(const std::string& file) const { return fs::exists(folder / file); }
  void change(const std::string& sql) const { Database(folder / "jobs.sqlite").run(sql.c_str()); }
};

std::string why_not(Place& place) {
  try {
    place.open();
  } catch (const std::runtime_error& e) {
    return e.what();
  }
  return {};
}

}  // namespace

TEST_CASE("jobs that have not ended are there again, in order, with all that was asked for") {
  Place place;
  {
    const auto store = place.open();
    for (const std::uint32_t job : {4u, 5u, 6u})
      store->add(accepted(job, "key " + std::to_string(job)),
                 bytes_of("text " + std::to_string(job)));
    store->keep(ended(5, JobState::kCancelled), {});
  }
  const auto store = place.open();
  const auto left = store->recover_accepted();
  REQUIRE(left.size() == 2);
  CHECK(left[0].info == accepted(4).info);
  CHECK(left[1].info == accepted(6).info);
  CHECK(left[1].options == accepted(6).options);
  CHECK(left[1].key == "key 6");
  CHECK(left[1].content == accepted(6).content);
  CHECK(store->scene(6) == bytes_of("text 6"));
  CHECK_FALSE(store->scene(5));
  CHECK(store->last_number() == 6);
}

TEST_CASE("a long scene lies in a file of its own, which is read again and goes with its job") {
  Place place;
  const Bytes scene(kLongScene, std::byte{7});
  {
    const auto store = place.open();
    for (const std::uint32_t job : {1u, 2u}) {
      store->write_scene(job, scene);
      store->add(accepted(job), scene);
    }
    store->write_scene(3, scene);  // whose frontal dies before the job is accepted
    CHECK(place.has("job-3.scene"));
    store->keep(ended(1, JobState::kCancelled), {});
  }
  CHECK_FALSE(place.has("job-1.scene"));
  const auto store = place.open();
  CHECK_FALSE(place.has("job-3.scene"));
  CHECK(store->recover_accepted().size() == 1);
  CHECK_FALSE(store->scene(2));
  CHECK(store->read_scene(2) == scene);
  CHECK_THROWS_AS(store->read_scene(1), std::runtime_error);
}

TEST_CASE("the scenes of a database that is damaged are set aside with it") {
  Place place;
  const Bytes scene(kLongScene);
  {
    const auto store = place.open();
    store->write_scene(1, scene);
    store->add(accepted(1), scene);
  }
  write(place.folder / "jobs.sqlite", "no database");
  place.open();
  CHECK(place.has("damaged/job-1.scene"));
  CHECK_FALSE(place.has("job-1.scene"));
  CHECK(place.open()->last_number() == 1);
}

TEST_CASE("a job that was submitted under a key is found by it, after it has ended, too") {
  Place place;
  place.open()->add(accepted(3, "abc"), bytes_of("text"));
  keep(*place.open(), ended(3), small_picture(1));
  const auto store = place.open();
  const auto found = store->find_key("abc");
  REQUIRE(found);
  CHECK(found->job == 3);
  CHECK(found->content == accepted(3).content);
  CHECK_FALSE(store->find_key("abd"));
}

TEST_CASE("a done job is there again with its picture and statistics") {
  Place place;
  {
    const auto store = place.open();
    store->add(accepted(1), bytes_of("text"));
    EndedJob job = ended(1);
    job.stats_json = R"({"nodes":4})";
    keep(*store, job, small_picture(7));
  }
  const auto store = place.open();
  const auto jobs = store->recover();
  REQUIRE(jobs.size() == 1);
  CHECK(jobs[0].info == ended(1).info);
  CHECK(jobs[0].stats_json == R"({"nodes":4})");
  REQUIRE(store->must_read(1));
  CHECK(store->picture(1) == nullptr);
  CHECK(store->read_picture(1) == small_picture(7));
  store->hold(1, small_picture(7));
  CHECK_FALSE(store->must_read(1));
  REQUIRE(store->picture(1) != nullptr);
  CHECK(*store->picture(1) == small_picture(7));
  CHECK_FALSE(store->must_read(2));
  CHECK_FALSE(store->read_picture(2));
  CHECK(store->recover_accepted().empty());
}

TEST_CASE("a deadlock is known for one after a restart, and no other failure is") {
  Place place;
  EndedJob deadlocked = ended(1, JobState::kFailed);
  deadlocked.is_deadlocked = true;
  place.open()->keep(deadlocked, {});
  place.open()->keep(ended(2, JobState::kFailed), {});
  const auto jobs = place.open()->recover();
  REQUIRE(jobs.size() == 2);
  CHECK(jobs[0].is_deadlocked);
  CHECK_FALSE(jobs[1].is_deadlocked);
}

TEST_CASE("the newest jobs are listed, and older ones are found by their numbers") {
  Place place;
  const auto store = place.open();
  const auto most = static_cast<std::uint32_t>(kMaxJobsListed);
  for (std::uint32_t job = 1; job <= most + 2; ++job) store->keep(ended(job), {});
  const auto jobs = store->recover();
  REQUIRE(jobs.size() == kMaxJobsListed);
  CHECK(jobs.front().info.job == 3);
  CHECK(jobs.back().info.job == most + 2);
  REQUIRE(store->ended(2));
  CHECK(store->ended(2)->info == ended(2).info);
  CHECK_FALSE(store->ended(most + 3));
}

TEST_CASE("of ended jobs only the newest are kept if so wished, and no number is used again") {
  Place place;
  {
    const auto store = place.open({.jobs = 2});
    for (std::uint32_t job = 1; job <= 4; ++job) keep(*store, ended(job), small_picture(1));
    store->add(accepted(5), {});
    CHECK(store->clear_old(kNow_s) == std::vector<std::uint32_t>{2, 1});
    CHECK(store->clear_old(kNow_s).empty());
    CHECK_FALSE(place.has("job-2.exr"));
    CHECK(place.has("job-3.exr"));
    CHECK_FALSE(store->must_read(2));
    CHECK(store->recover_accepted().size() == 1);
    store->keep(ended(5), {});
  }
  {
    const auto store = place.open({.jobs = 1});
    store->clear_old(kNow_s);
    store->keep(ended(6), {});
  }
  place.change("DELETE FROM jobs");
  fs::remove(place.folder / "job-4.exr");
  CHECK(place.open()->last_number() == 6);
}

TEST_CASE("ended jobs are kept for days if so wished") {
  Place place;
  const auto store = place.open({.days = 30});
  store->keep(ended(1, JobState::kDone, kNow_s - 31 * kDay_s), {});
  store->keep(ended(2, JobState::kDone, kNow_s - 29 * kDay_s), {});
  store->add(accepted(3), {});
  CHECK(store->clear_old(kNow_s) == std::vector<std::uint32_t>{1});
  REQUIRE(store->recover().size() == 1);
  CHECK(store->recover()[0].info.job == 2);
}

TEST_CASE("a store is one process's, and another is told whose") {
  Place place;
  const auto store = place.open();
  CHECK(why_not(place).find("is in use by the farm of process " + std::to_string(::getpid())) !=
        std::string::npos);
}

TEST_CASE("records of earlier frontals are taken over once, and damaged ones set aside") {
  Place place;
  EndedJob done = ended(3), deadlocked = ended(4, JobState::kFailed);
  deadlocked.info.message = "--flow blocking: deadlock: node 0 waits for node 1";
  write(place.folder / "job-3.json",
        encode(done.info) + "\n" + encode(control::Done{3, {R"({"nodes":2})"}}) + "\n");
  write(place.folder / "job-4.json",
        encode(deadlocked.info) + "\n" + encode(control::Done{4, {"{}"}}) + "\n");
  write(place.folder / "job-5.json", "no record");
  write(place.folder / "job-6.json", encode(done.info) + "\n");
  for (int time = 0; time < 2; ++time) {
    const auto store = place.open();
    const auto jobs = store->recover();
    REQUIRE(jobs.size() == 2);
    CHECK(jobs[0].info == done.info);
    CHECK(jobs[0].stats_json == R"({"nodes":2})");
    CHECK(jobs[1].is_deadlocked);
    CHECK(store->last_number() == 6);
  }
  CHECK(place.has("imported/job-3.json"));
  CHECK(place.has("damaged/job-5.json"));
  CHECK(place.has("damaged/job-6.json"));
  CHECK(place.said.size() == 2);
}

TEST_CASE("records of tiles are there for the next frontal, in order, until their job ends") {
  Place place;
  {
    const auto store = place.open();
    store->add(accepted(1), {});
    CHECK(store->recorded_tiles(1).empty());
    for (const char* piece : {"first ", "second ", "third"})
      store->record_tiles(1, bytes_of(piece));
  }
  {
    const auto store = place.open();
    CHECK(store->recorded_tiles(1) == bytes_of("first second third"));
    store->record_tiles(1, bytes_of(", and more"));
    store->record_tiles(2, bytes_of("another's"));
  }
  {
    const auto store = place.open();
    CHECK(store->recorded_tiles(1) == bytes_of("first second third, and more"));
    CHECK(store->recorded_tiles(2) == bytes_of("another's"));
    store->keep(ended(1), {});
    store->forget_tiles(2);
    store->record_tiles(2, bytes_of("anew"));
  }
  CHECK_FALSE(place.has("job-1.tiles"));
  CHECK(place.open()->recorded_tiles(2) == bytes_of("anew"));
}

TEST_CASE("a damaged picture is named and set aside") {
  Place place;
  keep(*place.open(), ended(1), small_picture(1));
  fs::resize_file(place.folder / "job-1.exr", 40);
  const auto store = place.open();
  CHECK_FALSE(store->read_picture(1));
  REQUIRE(place.said.size() == 1);
  CHECK(place.said[0].find("job-1.exr is damaged") != std::string::npos);
  CHECK(place.has("damaged/job-1.exr"));
  CHECK(store->recover().size() == 1);
}

TEST_CASE("damaged records are named, once, and are in nobody's way") {
  Place place;
  {
    const auto store = place.open();
    for (const std::uint32_t job : {1u, 2u}) store->keep(ended(job), {});
    for (const std::uint32_t job : {3u, 4u}) store->add(accepted(job), bytes_of("text"));
  }
  place.change("UPDATE jobs SET info = 'rubbish' WHERE number IN (1, 3)");
  for (int time = 0; time < 2; ++time) {
    const auto store = place.open();
    CHECK(store->recover().size() == 1);
    REQUIRE(store->recover_accepted().size() == 1);
    CHECK(store->recover_accepted()[0].info.job == 4);
    CHECK(store->last_number() == 4);
  }
  REQUIRE(place.said.size() == 2);
  CHECK(place.said[0] == "the record of job 1 is damaged; the farm goes on without it");
}

TEST_CASE("a damaged database is set aside as a whole, and numbers go on beyond its pictures") {
  Place place;
  {
    const auto store = place.open();
    keep(*store, ended(7), small_picture(1));
    store->keep(ended(8), {});
  }
  const auto ruin =
      GENERATE(std::string("no database at all, but longer than its head of 100 bytes, "
                           "so that it can be told; and some more"),
               std::string("SQLite format 3\0 and then nothing that makes sense", 50));
  write(place.folder / "jobs.sqlite", ruin);
  const auto store = place.open();
  CHECK(store->recover().empty());
  CHECK(store->last_number() == 7);
  store->add(accepted(8), bytes_of("text"));
  CHECK(store->scene(8) == bytes_of("text"));
  REQUIRE_FALSE(place.said.empty());
  CHECK(place.said[0].find("jobs.sqlite is damaged") != std::string::npos);
  CHECK(place.has("damaged/jobs.sqlite"));
}

TEST_CASE("pages of a database that were overwritten are noticed when it is opened") {
  Place place;
  {
    const auto store = place.open();
    for (std::uint32_t job = 1; job <= 200; ++job) store->keep(ended(job), {});
  }
  std::fstream file(place.folder / "jobs.sqlite", std::ios::in | std::ios::out | std::ios::binary);
  file.seekp(2 * 4096);
  for (int i = 0; i < 4 * 4096; ++i) file.put('x');
  file.close();
  CHECK(place.open()->recover().empty());
  CHECK(place.has("damaged/jobs.sqlite"));
}

TEST_CASE("a store of a newer version is refused and stays as it is") {
  Place place;
  place.open()->keep(ended(1), {});
  place.change("PRAGMA user_version = 1000");
  CHECK(why_not(place).find("a newer Graycube has made this job store (version 1000") !=
        std::string::npos);
  place.change("PRAGMA user_version = 1");
  CHECK(place.open()->recover().size() == 1);
}

TEST_CASE("files that were not written whole are removed, and nobody else's") {
  Place place;
  place.open();
  for (const char* name : {"job-3.exr.part", ".graycube-12-0.tmp", "notes.txt", "job-x.exr"})
    write(place.folder / name, "half");
  place.open();
  CHECK_FALSE(place.has("job-3.exr.part"));
  CHECK_FALSE(place.has(".graycube-12-0.tmp"));
  CHECK(place.has("notes.txt"));
  CHECK(place.has("job-x.exr"));
}

TEST_CASE(
    "a folder that a store makes is its owner's alone, and one that was there stays as it is") {
  const TemporaryFolder folder;
  const auto rights_of = [](const fs::path& path) { return fs::status(path).permissions(); };
  const auto open = [](const fs::path& path) {
    open_database_store(path, {}, [](const std::string&) {});
  };
  const mode_t before = ::umask(0);
  open(folder.path() / "new");
  fs::create_directory(folder.path() / "old");
  open(folder.path() / "old");
  ::umask(before);
  CHECK(rights_of(folder.path() / "new") == fs::perms::owner_all);
  CHECK(rights_of(folder.path() / "old") == fs::perms::all);
}
