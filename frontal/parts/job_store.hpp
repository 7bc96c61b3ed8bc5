// Where jobs are kept: those that have ended, and those that are to be rendered. In memory for a
// private farm, else in a folder, so that another frontal goes on with them.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "film/film.hpp"
#include "proto/messages.hpp"
#include "transport/message.hpp"

namespace graycube {

/// A job that has ended: done, failed or cancelled.
struct EndedJob {
  control::JobInfo info;
  /// The statistics file; "{}" when nothing is known.
  std::string stats_json = "{}";
  bool has_stats() const { return stats_json != "{}"; }
  bool is_deadlocked = false;
};

/// A job that was accepted, and what its client asked for.
struct AcceptedJob {
  control::JobInfo info;
  control::JobOptions options;
  /// By which its client knows that it was accepted; empty if the client gave none.
  std::string key;
  /// Digest of all that was asked for, the scene's text too.
  std::uint64_t content = 0;
};

/// From so many bytes on a scene is written beside the frontal's other work: it would be held up
/// for too long.
inline constexpr std::size_t kLongScene = std::size_t{1} << 20;
inline bool is_long_scene(std::span<const std::byte> scene) { return scene.size() >= kLongScene; }

/// A job that was accepted under a key.
struct KeyedJob {
  std::uint32_t job = 0;
  std::uint64_t content = 0;
};

/// What can't be kept or read throws std::runtime_error, which says why.
class JobStore {
 public:
  virtual ~JobStore() = default;

  /// Keeps a job and its scene until it ends. A long scene must have been written.
  virtual void add(const AcceptedJob& job, std::span<const std::byte> scene) = 0;
  /// The job that was accepted under a key, if it is still known.
  virtual std::optional<KeyedJob> find_key(const std::string& key) = 0;
  /// Keeps a job that has ended. `picture` is empty (no pixels) unless it is done; then it must
  /// have been written.
  virtual void keep(const EndedJob& job, Picture picture) = 0;
  /// The picture of a job that is done, if it is in memory; else null. Valid until the next call.
  virtual const Picture* picture(std::uint32_t job) = 0;
  /// Whether there may be one that isn't in memory, so that it must be read and held.
  virtual bool must_read(std::uint32_t) const { return false; }
  /// Takes a picture that was read into memory, in place of another.
  virtual void hold(std::uint32_t, Picture) {}

  // Slow: another thread may call them, one at a time, while this one calls any other.

  /// Writes the long scene of a job that is about to be added.
  virtual void write_scene(std::uint32_t, std::span<const std::byte>) {}
  /// The scene of a job that has not ended, which was written.
  virtual Bytes read_scene(std::uint32_t) { return {}; }
  /// Writes the picture of a job that is about to be kept as done.
  virtual void write_picture(const control::JobInfo&, const Picture&) {}
  /// Nothing if there is none, or it can't be read.
  virtual std::optional<Picture> read_picture(std::uint32_t) { return std::nullopt; }

  // What an earlier frontal left. A store in memory has nothing.

  /// Its ended jobs, at most the newest kMaxJobsListed, oldest first.
  virtual std::vector<EndedJob> recover() { return {}; }
  /// Its jobs that had not ended, in the order in which they were accepted.
  virtual std::vector<AcceptedJob> recover_accepted() { return {}; }
  /// How often a job has begun to be rendered, this time included: since it got on, and ever. More
  /// than once only after frontals have ended.
  struct Begun {
    std::uint32_t since_it_got_on = 1, ever = 1;
  };
  /// A job begins to be rendered.
  virtual Begun begin(std::uint32_t) { return {}; }
  /// The scene of a job that has not ended; nothing if it must be read.
  virtual std::optional<Bytes> scene(std::uint32_t) { return std::nullopt; }
  /// The largest number that a job ever had; 0 if there never was one.
  virtual std::uint32_t last_number() { return 0; }
  /// A job that has ended, however old.
  virtual std::optional<EndedJob> ended(std::uint32_t) { return std::nullopt; }
  /// Clears some of the jobs that are not to be kept any longer at that Unix time; returns which.
  virtual std::vector<std::uint32_t> clear_old(double) { return {}; }

  // Records of the tiles of a job that is on, by which another frontal goes on with its picture.
  // They are dropped when the job ends.

  /// Whether the store takes them.
  virtual bool records_tiles() const { return false; }
  /// All that were made; the job isn't on yet.
  virtual Bytes recorded_tiles(std::uint32_t) { return {}; }
  /// Appends records, soon, without holding the caller up.
  virtual void record_tiles(std::uint32_t, Bytes) {}
  virtual void forget_tiles(std::uint32_t) {}
};

/// Keeps the last picture, and the keys of the newest jobs.
std::unique_ptr<JobStore> make_memory_store();

}  // namespace graycube
