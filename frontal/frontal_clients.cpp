// What clients may ask of the frontal.
#include <algorithm>

#include "film/picture_files.hpp"
#include "frontal/frontal.hpp"
#include "proto/control.hpp"
#include "proto/model_slice.hpp"
#include "proto/picture_rows.hpp"

namespace graycube {
namespace {

/// Watchers hear of progress at most this often, and of every round of the token.
constexpr double kProgressInterval_s = 0.1;

}  // namespace

void Frontal::on_client(const PeerId& peer, const ControlMessage& message, const MessageView& raw) {
  if (const auto* submit = std::get_if<control::Submit>(&message)) {
    return on_submit(peer, *submit, raw.payload);
  }
  if (const auto* status = std::get_if<control::Status>(&message)) {
    const auto info = find_info(status->job);
    if (!info) return refuse(peer, status->job, FailureCode::kUnknownJob, "", "no such job");
    return send(peer, *info);
  }
  if (std::holds_alternative<control::List>(message)) return send_list(peer);
  if (const auto* watch = std::get_if<control::Watch>(&message)) return on_watch(peer, watch->job);
  if (const auto* cancel = std::get_if<control::Cancel>(&message)) {
    return on_cancel(peer, cancel->job);
  }
  if (std::holds_alternative<control::Nodes>(message)) return send_nodes(peer);
  if (const auto* fetch = std::get_if<control::Fetch>(&message)) return on_fetch(peer, *fetch);
  if (const auto* write = std::get_if<control::Write>(&message)) return on_write(peer, *write);
  if (std::holds_alternative<control::Down>(message)) {
    send(peer, control::Bye{});
    return go_down();
  }
  refuse(peer, 0, FailureCode::kBadRequest, "type",
         "'" + std::string(type_of(message)) + "' is not for a frontal");
}

void Frontal::refuse(const PeerId& peer, std::uint32_t job, FailureCode code, std::string where,
                     std::string why) {
  send(peer, control::Failed{job, code, {{std::move(where), std::move(why)}}});
}

void Frontal::on_submit(const PeerId& peer, const control::Submit& m,
                        std::span<const std::byte> scene) {
  if (going_down_) return refuse(peer, 0, FailureCode::kBusy, "", "the farm is going down");
  if (queue_.size() >= kMaxQueuedJobs) {
    return refuse(peer, 0, FailureCode::kBusy, "",
                  "the queue is full (" + std::to_string(kMaxQueuedJobs) + " jobs)");
  }
  if (scene.size() > kMaxSubmitBytes) {
    return refuse(peer, 0, FailureCode::kTooLarge, "", "the scene is too large");
  }
  if (m.options.algorithm == Algorithm::kSerial) {
    return refuse(peer, 0, FailureCode::kBadRequest, "--algorithm",
                  "serial runs in the command itself, without a farm");
  }
  if (is_encoded_model(scene) && !options_.is_private) {
    return refuse(peer, 0, FailureCode::kBadInput, m.scene_name,
                  "this farm compiles scenes itself: expected JSON or CBOR");
  }
  QueuedJob job;
  job.info.job = next_job_++;
  job.info.state = JobState::kQueued;
  job.info.scene = m.scene_name;
  job.info.algorithm = m.options.algorithm;
  job.info.nodes = options_.cube.nodes();
  job.info.submitted_s = unix_s_;
  job.submitted_at_s = now_s_;
  job.work = {job.info.job, m.scene_name,  Bytes(scene.begin(), scene.end()),
              m.options,    options_.cube, options_.replica_bytes};
  send(peer, control::Accepted{job.info.job});
  queue_.push_back(std::move(job));
}

std::optional<control::JobInfo> Frontal::find_info(std::uint32_t job) const {
  if (running_ && running_->info.job == job) {
    control::JobInfo info = running_->info;
    const control::Progress progress = progress_of(info);
    info.fraction = progress.fraction;
    info.eta_s = progress.eta_s;
    return info;
  }
  for (const QueuedJob& q : queue_) {
    if (q.info.job == job) return q.info;
  }
  for (const EndedJob& e : ended_) {
    if (e.info.job == job) return e.info;
  }
  return std::nullopt;
}

void Frontal::send_list(const PeerId& peer) {
  control::Jobs jobs;
  for (const EndedJob& e : ended_) jobs.jobs.push_back(e.info);
  if (running_) jobs.jobs.push_back(*find_info(running_->info.job));
  for (const QueuedJob& q : queue_) {
    if (!running_ || q.info.job != running_->info.job) jobs.jobs.push_back(q.info);
  }
  if (jobs.jobs.size() > kMaxJobsListed) {
    jobs.jobs.erase(jobs.jobs.begin(),
                    jobs.jobs.end() - static_cast<std::ptrdiff_t>(kMaxJobsListed));
  }
  send(peer, jobs);
}

void Frontal::send_nodes(const PeerId& peer) {
  control::NodeList list;
  for (std::uint32_t rank = 0; rank < nodes_.size(); ++rank) {
    const NodeRecord& n = nodes_[rank];
    control::NodeInfo info;
    info.rank = rank;
    info.gray = options_.cube.label_of(Rank{rank}).value;
    info.pid = n.pid;
    info.state = n.peer.empty()                    ? NodeState::kStarting
                 : running_ && running_->is_loaded ? NodeState::kBusy
                                                   : NodeState::kIdle;
    info.endpoint = n.endpoint;
    info.threads = n.threads;
    list.nodes.push_back(std::move(info));
  }
  send(peer, list);
}

void Frontal::on_watch(const PeerId& peer, std::uint32_t job) {
  const auto info = find_info(job);
  if (!info) return refuse(peer, job, FailureCode::kUnknownJob, "", "no such job");
  for (const EndedJob& e : ended_) {
    if (e.info.job != job) continue;
    if (e.info.state == JobState::kDone) return send(peer, control::Done{job, {e.stats_json}});
    FailureCode code = FailureCode::kFailed;
    if (e.info.state == JobState::kCancelled) code = FailureCode::kCancelled;
    if (e.is_deadlocked) code = FailureCode::kDeadlock;
    control::Failed failed{job, code, {{"", e.info.message}}, {}};
    if (e.has_stats()) failed.stats = RawObject{e.stats_json};
    return send(peer, failed);
  }
  watchers_[job].insert(peer);
  send(peer, progress_of(*info));
}

void Frontal::on_cancel(const PeerId& peer, std::uint32_t job) {
  if (running_ && running_->info.job == job) {
    end_job(JobState::kCancelled, FailureCode::kCancelled, {{"", "cancelled"}});
  } else {
    const auto queued = std::find_if(queue_.begin(), queue_.end(),
                                     [&](const QueuedJob& q) { return q.info.job == job; });
    if (queued == queue_.end()) {
      const auto info = find_info(job);
      if (!info) return refuse(peer, job, FailureCode::kUnknownJob, "", "no such job");
      return refuse(peer, job, FailureCode::kBadRequest, "", "the job has ended already");
    }
    end_queued(static_cast<std::size_t>(queued - queue_.begin()), JobState::kCancelled,
               FailureCode::kCancelled, "cancelled");
  }
  if (const auto info = find_info(job)) send(peer, *info);
}

void Frontal::end_queued(std::size_t index, JobState state, FailureCode code,
                         const std::string& why) {
  EndedJob job{queue_[index].info, "{}", false};
  queue_.erase(queue_.begin() + static_cast<std::ptrdiff_t>(index));
  job.info.state = state;
  job.info.finished_s = unix_s_;
  job.info.message = why;
  for (const PeerId& peer : watchers_[job.info.job]) refuse(peer, job.info.job, code, "", why);
  watchers_.erase(job.info.job);
  keep(std::move(job), {});
}

const Picture* Frontal::done_picture(const PeerId& peer, std::uint32_t job) {
  const auto info = find_info(job);
  const Picture* picture = info && info->state == JobState::kDone ? store_.picture(job) : nullptr;
  if (!info) {
    refuse(peer, job, FailureCode::kUnknownJob, "", "no such job");
  } else if (info->state != JobState::kDone) {
    refuse(peer, job, FailureCode::kNotDone, "",
           "the job is " + std::string(to_string(info->state)));
  } else if (picture == nullptr) {
    refuse(peer, job, FailureCode::kFailed, "", "the picture is not kept any longer");
  }
  return picture;
}

/// The picture needs no way through sockets: who asks is the one that has started this frontal, and
/// could write the files itself.
void Frontal::on_write(const PeerId& peer, const control::Write& m) {
  if (!options_.is_private) {
    return refuse(peer, m.job, FailureCode::kBadRequest, "type",
                  "only a private frontal writes files");
  }
  const Picture* picture = done_picture(peer, m.job);
  if (picture == nullptr) return;
  if (std::uint64_t{picture->width} * picture->height > kMostPixelsToWrite) {
    return refuse(peer, m.job, FailureCode::kTooLarge, "", "the picture has to be fetched");
  }
  const double began_s = cpu_seconds();
  const char* option = "-o";
  try {
    if (!m.exr.empty()) write_exr(m.exr, *picture, {find_info(m.job)->scene, options_.version});
    option = "--png";
    if (!m.png.empty()) write_png(m.png, *picture);
  } catch (const PictureError& e) {
    return refuse(peer, m.job, FailureCode::kFailed, option, e.what());
  }
  send(peer, control::Written{m.job, picture->width, picture->height, cpu_seconds() - began_s});
}

void Frontal::on_fetch(const PeerId& peer, const control::Fetch& m) {
  const Picture* picture = done_picture(peer, m.job);
  if (picture == nullptr) return;
  if (m.first_row >= picture->height) {
    return refuse(peer, m.job, FailureCode::kBadRequest, "first_row", "beyond the picture");
  }
  if (m.plane > 0 && !has_plane(picture->aovs, m.plane - 1)) {
    return refuse(peer, m.job, FailureCode::kBadRequest, "plane", "the picture has no such AOVs");
  }
  const std::size_t row_values = std::size_t{picture->width} * 3;
  const std::size_t most = std::max<std::size_t>(1, kPictureChunkBytes / (row_values * 4));
  control::Picture out;
  out.job = m.job;
  out.width = picture->width;
  out.height = picture->height;
  out.first_row = m.first_row;
  out.rows = static_cast<std::uint32_t>(
      std::min<std::size_t>({most, m.rows, picture->height - m.first_row}));
  out.plane = m.plane;
  out.aov = to_string(picture->aovs);
  const auto rows = [&](const auto& values) {
    return std::span(values).subspan(m.first_row * row_values, out.rows * row_values);
  };
  send(peer, out,
       m.plane == 0 ? encode_picture_rows(rows(picture->rgb))
                    : encode_picture_rows(rows(picture->aov_planes[m.plane - 1])));
}

control::Progress Frontal::progress_of(const control::JobInfo& info) const {
  control::Progress p;
  p.job = info.job;
  p.state = info.state;
  p.tiles = info.tiles;
  p.tiles_whole = info.tiles_whole;
  p.rounds = info.rounds;
  if (running_ && running_->info.job == info.job && running_->render) {
    p.fraction = info.tiles == 0 ? 1 : static_cast<double>(info.tiles_whole) / info.tiles;
    if (running_->is_started && p.fraction > 0) {
      p.eta_s = std::max(0.0, (now_s_ - running_->render_began_s) * (1 - p.fraction) / p.fraction);
    }
    if (info.rounds > 0) p.token = {running_->render->rounds(), running_->render->hops()};
  }
  return p;
}

void Frontal::report_progress(bool at_once) {
  if (!running_) return;
  if (!at_once && now_s_ - running_->last_progress_s < kProgressInterval_s) return;
  running_->last_progress_s = now_s_;
  const auto watchers = watchers_.find(running_->info.job);
  if (watchers == watchers_.end()) return;
  const control::Progress progress = progress_of(running_->info);
  for (const PeerId& peer : watchers->second) send(peer, progress);
}

}  // namespace graycube
