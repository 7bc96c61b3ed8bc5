#include "frontal/admission/admission.hpp"

#include <stdexcept>
#include <utility>

#include "frontal/admission/submission.hpp"

namespace graycube {

QueuedJob queued_job(const FrontalOptions& farm, control::JobInfo info,
                     const control::JobOptions& options, const Moment& now) {
  QueuedJob job;
  job.submitted_at_s = now.now_s;
  job.work.job = info.job;
  job.work.scene_name = info.scene;
  job.work.options = options;
  job.work.cube = farm.cube;
  job.work.replica_bytes = farm.replica_bytes;
  job.info = std::move(info);
  return job;
}

std::optional<Answer> Admission::submit(Submission submission, const Moment& now) {
  const control::Submit request = submission.request;
  if (auto refusal = refusal_of(request, submission.scene, farm_.is_private))
    return told(request, *std::move(refusal));
  if (waiting_.empty() && !is_long_scene(submission.scene))
    return told(request, admit_short(std::move(submission), now));
  if (auto refusal = refusal_to_wait(submission)) return told(request, *std::move(refusal));
  waiting_bytes_ += submission.scene.size();
  waiting_.push_back(std::move(submission));
  return std::nullopt;
}

std::optional<Refusal> Admission::refusal_to_wait(const Submission& submission) const {
  if (waiting_.size() < kMaxWaitingSubmissions &&
      waiting_bytes_ + submission.scene.size() <= kMaxWaitingSceneBytes) {
    return std::nullopt;
  }
  return Refusal{0, FailureCode::kBusy, "",
                 "too many scenes are being taken at once; submit this one again later"};
}

std::variant<Admission::Place, Refusal> Admission::place_for(const control::Submit& request) {
  try {
    if (const auto known = request.key.empty() ? std::nullopt : store_.find_key(request.key))
      return Place{0, known};
  } catch (const std::runtime_error& e) {
    return Refusal{0, FailureCode::kFailed, "the job store", e.what()};
  }
  if (auto refusal = refusal_for_want_of_room(queue_)) return *std::move(refusal);
  return Place{queue_.next_number()};
}

Answer Admission::admit_short(Submission submission, const Moment& now) {
  const auto place = place_for(submission.request);
  if (const auto* refusal = std::get_if<Refusal>(&place)) return *refusal;
  const std::uint64_t content = content_of(submission.request, submission.scene);
  return admit(std::move(submission), std::get<Place>(place), content, now);
}

Answer Admission::admit(Submission submission, const Place& place, std::uint64_t content,
                        const Moment& now) {
  const control::Submit& request = submission.request;
  if (place.known) {
    if (place.known->content == content) return Reply{control::Accepted{place.known->job}};
    return Refusal{place.known->job, FailureCode::kBadRequest, "key",
                   "another scene or other options were submitted under this key"};
  }
  control::JobInfo info;
  info.job = place.number;
  info.scene = request.scene_name;
  info.algorithm = request.options.algorithm;
  info.nodes = farm_.cube.nodes();
  info.submitted_s = now.unix_s;
  try {
    // The number is told only once the store has it: it must be the job's after any end of this
    // process.
    store_.add({info, request.options, request.key, content}, submission.scene);
  } catch (const std::runtime_error& e) {
    return Refusal{0, FailureCode::kFailed, "the job store", e.what()};
  }
  log_.job_is_accepted(info, false);
  QueuedJob job = queued_job(farm_, std::move(info), request.options, now);
  job.work.scene = std::move(submission.scene);
  job.content = content;
  return Reply{control::Accepted{queue_.add(std::move(job))}};
}

Submission Admission::take_first() {
  Submission first = std::move(waiting_.front());
  waiting_.pop_front();
  waiting_bytes_ -= first.scene.size();
  return first;
}

void Admission::answer_short_ones(const Moment& now, Post& post) {
  while (!waiting_.empty() && !is_long_scene(waiting_.front().scene)) {
    Submission first = take_first();
    const control::Submit request = first.request;
    const PeerId from = first.from;
    post.answer(from, told(request, admit_short(std::move(first), now)));
  }
}

std::optional<AdmissionWork> Admission::take_work(const Moment& now, Post& post) {
  while (!place_ && !waiting_.empty()) {
    auto place = place_for(waiting_.front().request);
    if (auto* refusal = std::get_if<Refusal>(&place)) {
      const Submission first = take_first();
      post.answer(first.from, told(first.request, std::move(*refusal)));
      answer_short_ones(now, post);
      continue;
    }
    place_ = std::get<Place>(place);
    const Submission& first = waiting_.front();
    return AdmissionWork{first.request, first.scene, place_->number, &store_};
  }
  return std::nullopt;
}

void Admission::give_result(const AdmissionResult& result, const Moment& now, Post& post) {
  const Place place = *std::exchange(place_, std::nullopt);
  Submission first = take_first();
  const control::Submit request = first.request;
  const PeerId from = first.from;
  Answer answer = result.error.empty()
                      ? admit(std::move(first), place, result.content, now)
                      : Refusal{0, FailureCode::kFailed, "the job store", result.error};
  post.answer(from, told(request, std::move(answer)));
  answer_short_ones(now, post);
}

void Admission::close(Post& post) {
  const std::size_t under_way = place_ ? 1 : 0;
  while (waiting_.size() > under_way) {
    const Submission last = std::move(waiting_.back());
    waiting_.pop_back();
    waiting_bytes_ -= last.scene.size();
    post.answer(last.from, told(last.request, farm_goes_down()));
  }
}

Answer Admission::told(const control::Submit& request, Answer answer) {
  if (const auto* refusal = std::get_if<Refusal>(&answer)) {
    log_.submission_is_refused(
        request.scene_name, (refusal->where.empty() ? "" : refusal->where + ": ") + refusal->why);
  }
  return answer;
}

}  // namespace graycube
