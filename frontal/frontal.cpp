#include "frontal/frontal.hpp"

#include <exception>
#include <utility>

#include "check.hpp"
#include "frontal/admission/submission.hpp"
#include "frontal/parts/message_senders.hpp"
#include "overloaded.hpp"
#include "proto/control.hpp"

namespace graycube {
namespace {

/// Does work for the job that is on: a check that fails there ends that job, not the farm.
template <typename Work>
void in_job(Jobs& jobs, Work&& work) {
  try {
    const ChecksThrow checks_throw;
    work();
  } catch (const std::exception& e) {
    if (!jobs.fail_internally(e.what())) throw;
  }
}

}  // namespace

Frontal::Frontal(FrontalOptions options, JobStore& store)
    : options_(std::move(options)),
      door_(options_.secret),
      log_(options_.started_s),
      log_desk_(options_.pid),
      post_(options_.cube.nodes()),
      heartbeat_(options_.heartbeat_s),
      nodes_(options_.cube, {options_.silence_s, options_.start_patience_s}),
      jobs_(options_, store, post_, log_) {
  if (options_.most_nodes_on_hosts) hosts_.emplace(options_.silence_s);
}

bool Frontal::is_only_slow(Rank rank, std::uint64_t pid) const {
  return hosts_ ? hosts_->can_run(rank, now_s_) : options_.is_only_slow(pid);
}

void Frontal::on_time(const Moment& now) {
  now_s_ = now.now_s;
  log_.set_time(now.unix_s);
  jobs_.set_time(now);
  const double held_up_s = heartbeat_.held_up_s(now_s_);
  nodes_.was_held_up(held_up_s);
  if (hosts_) hosts_->was_held_up(held_up_s);
  log_desk_.answer_waits(now_s_, post_);
  if (is_going_down_) return;
  if (const auto ping = heartbeat_.take_ping(now_s_)) {
    post_.to_nodes(*ping);
    if (hosts_) post_.to_peers(hosts_->peers(), *ping);
    look_for_standstills();
  }
  if (hosts_) look_after_hosts();
  const auto is_slow = [this](Rank rank, std::uint64_t pid) { return is_only_slow(rank, pid); };
  for (const Rank rank : nodes_.take_silent(now_s_, is_slow)) lose(rank, "fell silent");
  in_job(jobs_, [&] { jobs_.check_time(); });
  get_on();
}

void Frontal::look_for_standstills() {
  if (const auto rank = jobs_.standing_still()) {
    nodes_.kill(*rank);
    lose(*rank, "answered, but was at the same piece of work for " +
                    std::to_string(static_cast<int>(options_.standstill_s)) + " seconds");
  }
  in_job(jobs_, [&] { jobs_.look_for_lost_messages(); });
}

void Frontal::on_message(const PeerId& peer, const MessageView& message) {
  const auto rank = nodes_.rank_of(peer);
  if (rank) nodes_.heard(*rank, now_s_);
  if (looks_like_batch(message.frame)) {
    if (rank) in_job(jobs_, [&] { jobs_.on_light(*rank, message.frame); });
    return get_on();
  }
  const auto decoded = decode(message.text());
  if (const auto* error = std::get_if<ControlError>(&decoded)) {
    return post_.answer(peer, Refusal{0, FailureCode::kBadRequest, error->field, error->why});
  }
  const auto& m = std::get<ControlMessage>(decoded);
  if (const auto* hello = std::get_if<control::Hello>(&m))
    return on_hello(peer, *hello, message.payload);
  if (!rank) return on_client(peer, m, message.payload);
  in_job(jobs_, [&] { on_node(*rank, m); });
  get_on();
}

/// Loads and starts the job that waits for nodes, once it can be.
void Frontal::get_on() {
  if (hosts_) serve_hosts();
  in_job(jobs_, [&] {
    if (jobs_.waits_to_be_loaded() && nodes_.all_here()) jobs_.load();
    if (jobs_.can_start()) jobs_.start(nodes_.incarnations());
  });
}

// ---- nodes

void Frontal::on_hello(const PeerId& peer, const control::Hello& m,
                       std::span<const std::byte> shown) {
  if (const char* problem = door_.problem_of(m, shown, node_folder_of(m))) {
    return log_.hello_is_refused(m.rank, problem);  // a stranger gets no answer
  }
  if (auto refusal = nodes_.hello(peer, m, now_s_)) return post_.answer(peer, *std::move(refusal));
  post_.set_node(Rank{m.rank}, peer);
  log_.node_is_here(Rank{m.rank}, m.pid);
  if (!nodes_.all_here()) return;
  log_.farm_is_up(options_.cube.nodes(), options_.endpoint);
  welcome();
  get_on();
}

/// Tells each node where the others listen for nodes of its host.
void Frontal::welcome() {
  control::Welcome welcome{options_.cube.nodes(), options_.version, nodes_.endpoints(),
                           heartbeat_.interval_ms()};
  if (!hosts_) return post_.to_nodes(welcome);
  const std::vector<std::string> local = nodes_.endpoints(), remote = nodes_.remote_endpoints();
  for (const auto& [host, ranks] : hosts_->nodes_by_host()) {
    for (std::uint32_t rank = 0; rank < local.size(); ++rank) {
      const auto other = hosts_->host_of(Rank{rank});
      welcome.endpoints[rank] =
          other && hosts_->are_local(host, *other) ? local[rank] : remote[rank];
    }
    post_.to_these_nodes(ranks, welcome);
  }
}

void Frontal::on_node(Rank rank, const ControlMessage& message) {
  std::visit(Overloaded{
                 [&](const control::WaitReport& m) {
                   jobs_.on_wait_report(rank, m, heartbeat_.last_ping());
                 },
                 [&](const control::Goodbye&) { nodes_.has_left(rank); },
                 [](const control::Hello&) {},
                 [&](const FromNode auto& m) { jobs_.on_node(rank, m); },
                 [](const FromClient auto&) {},
                 [](const FromHost auto&) {},
                 [](const FromFrontal auto&) {},
             },
             message);
}

void Frontal::on_node_exit(const Process& process, const std::string& how) {
  if (!nodes_.is_current(process)) return;
  nodes_.has_left(process.rank);
  if (!is_going_down_) lose(process.rank, how);
}

void Frontal::on_start_failure(const Process& process, const std::string& why) {
  if (!nodes_.is_current(process)) return;
  if (is_going_down_) return nodes_.has_left(process.rank);
  const bool has_other_host = hosts_ && hosts_->has_room(now_s_);
  if (has_other_host || !finds_host(process.rank, why))
    lose(process.rank, "can't be started: " + why);
}

/// New processes take the places of all nodes of a process, or host, that is lost, and the running
/// job goes on in another epoch.
void Frontal::lose(const std::vector<Rank>& ranks, const std::string& how) {
  std::vector<NodeLoss> losses;
  bool is_hopeless = false;
  for (const Rank r : ranks) {
    const NodeRegistry::Lost lost = nodes_.lose(r, now_s_);
    losses.push_back({r, lost.name, how, lost.silent_s});
    post_.set_node(r, {});
    // Hosts on which nodes don't start get none for a while, and others may join.
    is_hopeless = is_hopeless || (lost.is_hopeless && !hosts_);
  }
  // Such a node is alone: a guest's loss isn't hopeless.
  if (is_hopeless && !finds_host(ranks.front(), how)) {
    fatal_error_ = losses.front().name + ": " + how + "; its process couldn't be started " +
                   std::to_string(kMaxFailedStarts) + " times in a row";
    return go_down();
  }
  for (const NodeLoss& loss : losses) {
    if (!is_hopeless) nodes_.start(loss.rank, now_s_);
  }
  in_job(jobs_, [&] { jobs_.nodes_were_lost(losses); });
  get_on();
}

/// Gives the node, for which no process can be started, a place in another's, if there is one.
bool Frontal::finds_host(Rank rank, const std::string& why) {
  const auto hosting = nodes_.host(rank, now_s_);
  if (!hosting) return false;
  const auto& [guest, host] = *hosting;
  if (hosts_) hosts_->has_host(guest.rank, host.rank);
  post_.to_node(host.rank, control::Host{rank.value, guest.incarnation});
  const std::string name = "node " + std::to_string(rank.value);
  const std::string what = "can't be started (" + why + "): it runs in node " +
                           std::to_string(host.rank.value) + "'s process";
  log_.node_has_host(name, what);
  in_job(jobs_, [&] { jobs_.node_has_host({rank, name, what, 0}); });
  return true;
}

void Frontal::give_result(PreparationResult result) {
  in_job(jobs_, [&] { jobs_.give_result(std::move(result)); });
  get_on();
}

void Frontal::give_result(const RecutResult& cut) {
  in_job(jobs_, [&] { jobs_.give_result(cut); });
}

// ---- clients

void Frontal::on_client(const PeerId& peer, const ControlMessage& message,
                        const SharedBytes& payload) {
  using Given = std::optional<Answer>;
  const auto refuse_type = [&]() -> Given {
    return Refusal{0, FailureCode::kBadRequest, "type",
                   "'" + std::string(type_of(message)) + "' is not for a frontal"};
  };
  auto answer =
      std::visit(Overloaded{
                     [&](const control::Submit& m) { return submit(peer, m, payload); },
                     [&](const control::Status& m) -> Given { return jobs_.status(m.job); },
                     [&](const control::List&) -> Given { return jobs_.list(); },
                     [&](const control::Watch& m) -> Given { return jobs_.watch(peer, m.job); },
                     [&](const control::Cancel& m) -> Given { return jobs_.cancel(m.job); },
                     [&](const control::Nodes&) -> Given { return Reply{node_list()}; },
                     [&](const control::Fetch& m) { return fetch(peer, m); },
                     [&](const control::Write& m) { return write(peer, m); },
                     [&](const control::Log& m) -> Given {
                       log_desk_.ask(peer, m, now_s_, post_);
                       return std::nullopt;
                     },
                     [&](const control::Farm&) -> Given { return Reply{info()}; },
                     [&](const control::Metrics&) -> Given { return Reply{metrics()}; },
                     [](const control::Down&) -> Given { return Reply{control::Bye{}}; },
                     [&](const control::Hello&) { return refuse_type(); },
                     [&](const FromNode auto&) { return refuse_type(); },
                     [&](const FromHost auto&) { return refuse_type(); },
                     [&](const FromFrontal auto&) { return refuse_type(); },
                 },
                 message);
  if (answer) post_.answer(peer, *std::move(answer));
  if (std::holds_alternative<control::Down>(message)) go_down();
}

/// The files are written elsewhere, and the answer is sent when they are.
std::optional<Answer> Frontal::write(const PeerId& peer, const control::Write& m) {
  // A job that ends might take the picture's place in the store.
  if (is_writing_ || jobs_.job_that_is_on())
    return Refusal{m.job, FailureCode::kBusy, "", "another picture is written, or rendered"};
  auto work = jobs_.write(m);
  if (auto* refusal = std::get_if<Refusal>(&work)) return std::move(*refusal);
  writing_ = std::get<WritingWork>(std::move(work));
  writing_->peer = peer;
  is_writing_ = true;
  return std::nullopt;
}

void Frontal::give_result(WritingResult result) {
  is_writing_ = false;
  post_.answer(result.peer, std::move(result.answer));
}

/// A picture that is not in memory is read elsewhere, and the answer is sent when it is.
std::optional<Answer> Frontal::fetch(const PeerId& peer, const control::Fetch& m) {
  if (!jobs_.must_read(m.job)) return jobs_.fetch(m);
  if (fetches_.size() >= kMaxWaitingFetches)
    return Refusal{m.job, FailureCode::kBusy, "", "too many pictures are asked for at once"};
  fetches_.push_back({peer, m});
  return std::nullopt;
}

std::optional<ReadingWork> Frontal::take_reading() {
  if (is_reading_ || fetches_.empty()) return std::nullopt;
  is_reading_ = true;
  return jobs_.reading(fetches_.front().request.job);
}

void Frontal::give_result(ReadingResult result) {
  is_reading_ = false;
  const std::uint32_t job = result.job;
  jobs_.give_result(std::move(result));
  std::erase_if(fetches_, [&](const WaitingFetch& f) {
    if (f.request.job != job) return false;
    post_.answer(f.peer, jobs_.fetch(f.request));
    return true;
  });
}

void Frontal::give_result(KeepingResult result) { jobs_.give_result(std::move(result)); }

std::optional<Answer> Frontal::submit(const PeerId& peer, const control::Submit& m,
                                      SharedBytes scene) {
  if (is_going_down_) return farm_goes_down();
  return jobs_.submit({peer, m, std::move(scene)});
}

void Frontal::give_result(const AdmissionResult& result) {
  jobs_.give_result(result);
  // What was accepted meanwhile must not begin.
  if (is_going_down_) jobs_.stop();
}

control::NodeList Frontal::node_list() const {
  control::NodeList list = nodes_.list(jobs_.keep_nodes_busy());
  if (!hosts_) return list;
  for (control::NodeInfo& node : list.nodes) {
    if (const auto host = hosts_->host_of(Rank{node.rank})) node.host = hosts_->name_of(*host);
  }
  list.hosts = hosts_->list(now_s_);
  return list;
}

control::FarmInfo Frontal::info() const {
  control::FarmInfo info;
  info.pid = options_.pid;
  info.endpoint = options_.endpoint;
  info.version = options_.version;
  info.started_s = options_.started_s;
  info.nodes = options_.cube.nodes();
  info.nodes_here = nodes_.count_here();
  jobs_.count(info);
  return info;
}

control::FarmMetrics Frontal::metrics() const {
  control::FarmMetrics m;
  m.farm = info();
  jobs_.count(m);
  for (const control::NodeInfo& node : nodes_.list(jobs_.keep_nodes_busy()).nodes) {
    switch (node.state) {
      case NodeState::kStarting: ++m.nodes_starting; break;
      case NodeState::kIdle: ++m.nodes_idle; break;
      case NodeState::kBusy: ++m.nodes_busy; break;
      case NodeState::kLost: ++m.nodes_lost; break;
    }
  }
  m.frontal_cpu_s = cpu_.used_s();
  m.longest_turn_s = longest_turn_s_;
  return m;
}

std::vector<FarmEvent> Frontal::take_events() {
  std::vector<FarmEvent> events = log_.take();
  for (const FarmEvent& event : events) log_desk_.add(event);
  if (is_going_down_) log_desk_.end();
  if (!events.empty()) log_desk_.answer_waits(now_s_, post_);
  return events;
}

void Frontal::go_down() {
  if (is_going_down_) return;
  log_.farm_goes_down(fatal_error_);
  jobs_.stop();
  is_going_down_ = true;
  post_.to_nodes(control::Shutdown{});
  if (!hosts_) return;
  for (const Process& process : hosts_->waiting()) nodes_.has_left(process.rank);
  post_.to_peers(hosts_->peers(), control::Shutdown{});
}

}  // namespace graycube
