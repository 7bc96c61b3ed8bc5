// What clients submit, from its arrival until it is a job that waits for its turn. Jobs get their
// numbers in the order in which their scenes came: while a long one is written, beside the
// mailroom, those behind it wait, however short they are.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <variant>

#include "frontal/admission/long_scene.hpp"
#include "frontal/parts/farm_log.hpp"
#include "frontal/parts/frontal_options.hpp"
#include "frontal/parts/job_queue.hpp"
#include "frontal/parts/job_store.hpp"
#include "frontal/parts/post.hpp"

namespace graycube {

/// Submissions that may wait behind a long scene, and the bytes of their scenes: four of the
/// longest. What comes beyond that is refused.
inline constexpr std::size_t kMaxWaitingSubmissions = 1000;
inline constexpr std::size_t kMaxWaitingSceneBytes = 4 * kMaxSubmitBytes;

struct Submission {
  PeerId from;
  control::Submit request;
  SharedBytes scene;
};

/// A job as it waits in the queue of a farm.
QueuedJob queued_job(const FrontalOptions& farm, control::JobInfo info,
                     const control::JobOptions& options, const Moment& now);

class Admission {
 public:
  /// All that is given must outlive this.
  Admission(const FrontalOptions& farm, JobStore& store, JobQueue& queue, FarmLog& log)
      : farm_(farm), store_(store), queue_(queue), log_(log) {}

  /// The answer to a client; nothing if it is posted later.
  std::optional<Answer> submit(Submission submission, const Moment& now);
  /// What is to be done for the long scene that came first, unless that is under way.
  std::optional<AdmissionWork> take_work(const Moment& now, Post& post);
  /// Answers the client whose scene it was, and those behind it up to the next long scene.
  void give_result(const AdmissionResult& result, const Moment& now, Post& post);
  bool is_at_work() const { return place_.has_value(); }
  /// Refuses what waits, as the farm stops; a scene that is under way still becomes a job.
  void close(Post& post);

 private:
  /// The number that a submission's job gets, unless its key is known already.
  struct Place {
    std::uint32_t number = 0;
    std::optional<KeyedJob> known{};
  };
  std::optional<Refusal> refusal_to_wait(const Submission& submission) const;
  std::variant<Place, Refusal> place_for(const control::Submit& request);
  Answer admit_short(Submission submission, const Moment& now);
  Answer admit(Submission submission, const Place& place, std::uint64_t content, const Moment& now);
  /// Takes the first of those that wait.
  Submission take_first();
  void answer_short_ones(const Moment& now, Post& post);
  Answer told(const control::Submit& request, Answer answer);

  const FrontalOptions& farm_;
  JobStore& store_;
  JobQueue& queue_;
  FarmLog& log_;
  /// In the order in which they came. Between calls the first one's scene is long.
  std::deque<Submission> waiting_;
  std::size_t waiting_bytes_ = 0;
  /// Of the first one, while its scene is under way. Nobody else is numbered meanwhile.
  std::optional<Place> place_;
};

}  // namespace graycube
