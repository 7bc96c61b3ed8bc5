#include "simulation/farm.hpp"

#include <algorithm>
#include <span>
#include <utility>

#include "process/clocks.hpp"
#include "simulation/message_doings.hpp"

namespace graycube::simulation {
namespace {

const PeerId kClient = "client";

PeerId peer_of(Rank rank, std::uint32_t incarnation) {
  return "node-" + std::to_string(rank.value) + "." + std::to_string(incarnation);
}

}  // namespace

Farm::Farm(const FarmOptions& options, Machine& machine)
    : options_(options),
      machine_(machine),
      cube_(*Hypercube::of_size(options.nodes)),
      processes_(options.nodes) {
  const std::size_t pools = machine.shared_cores() > 0 ? machine.hosts() : options.nodes + 1;
  const unsigned count = machine.shared_cores() > 0 ? machine.shared_cores() : machine.own_cores();
  for (std::size_t i = 0; i < pools; ++i) {
    cores_.push_back(std::make_unique<Cores>(timeline_, count));
  }
  for (std::uint32_t i = 0; i < options.nodes; ++i) {
    mailrooms_.push_back(std::make_unique<Thread>(cores_of(Rank{i})));
    fifos_.push_back(std::make_unique<Thread>(cores_of(Rank{i})));
  }
  mailrooms_.push_back(std::make_unique<Thread>(cores_of({})));
  FrontalOptions f{.cube = cube_,
                   .threads = options.threads,
                   .heartbeat_s = options.heartbeat_s,
                   .silence_s = options.silence_s,
                   .start_patience_s = 1e12,
                   .retries = options.retries,
                   .version = "simulated",
                   .replica_bytes = options.replica_bytes,
                   .limits = options.limits,
                   .hosts = options.hosts};
  frontal_ = std::make_unique<Frontal>(f, *store_);
  frontal_->set_cpu_meter({[this] { return frontal_cpu_s_; }, [] { return 0.0; }});
  in_frontal({}, [] {});
}

// ---- the frontal

/// Calls the frontal's brain and sends its messages, which takes a core as long as it should.
template <typename Call>
void Farm::in_frontal(PerUnit doings, Call&& call) {
  const double began_s = observe ? thread_cpu_seconds() : 0;
  call();
  // Long scenes are taken, and pictures kept, beside the frontal's mailroom, in no simulated time.
  while (auto w = frontal_->take_admission()) frontal_->give_result(admit_scene(*w));
  while (auto w = frontal_->take_keeping()) frontal_->give_result(keep_picture(*std::move(w)));
  auto out = std::make_shared<std::vector<Frontal::Outgoing>>(frontal_->take_outgoing());
  if (observe) observe(doings, thread_cpu_seconds() - began_s);
  for (const Frontal::Process& k : frontal_->take_kills()) kill(k);
  for (const Frontal::Process& p : frontal_->take_starts()) start(p);
  frontal_->take_hostings();  // hosts know of them by messages
  if (auto work = frontal_->take_work()) prepare(*work);
  if (auto work = frontal_->take_recut()) recut(*work);
  for (const Frontal::Outgoing& o : *out) {
    if (o.to != kClient) doings.add(passing({}, place_of(o.to), bytes_of(o.message)));
  }
  mailroom_of({}).ask({process_of({}), [this, doings] { return take({}, doings); },
                       [this, out] {
                         for (const Frontal::Outgoing& o : *out) deliver(o);
                       }});
}

void Farm::start(const Frontal::Process& started) {
  if (!can_start_) return fail_to_start(started);
  run_node(started, 1000 + started.incarnation);
}

void Farm::run_node(const Frontal::Process& started, std::uint64_t pid) {
  Process& p = processes_[started.rank.value];
  p = {};
  cut_until_s_.erase({started.rank, {}});
  p.node = std::make_unique<Node>(NodeIdentity{
      started.rank, started.incarnation, pid,
      "ipc:///simulated/" + std::to_string(started.rank.value), options_.threads, "simulated"});
  p.node->measure = [this, &p](control::NodeStats& stats) { fill_in(p, stats); };
  p.incarnation = started.incarnation;
  p.pid = pid;
  p.unreturned.assign(cube_.dimension(), 0);
  p.places_out.assign(cube_.dimension(), {});
  machine_.on_start(started.rank);
  const PeerId peer = peer_of(started.rank, started.incarnation);
  peers_[peer] = started.rank;
  const Message hello = p.node->hello();
  timeline_.at(machine_.arrival_s(started.rank, {}, bytes_of(hello), timeline_.now_s()),
               [this, peer, hello] { frontal_receives(peer, hello); });
}

/// Tells the frontal the time, also when no message comes.
void Farm::tick(unsigned render) {
  if (render != renders_) return;
  in_frontal({}, [this] { frontal_->on_time({timeline_.now_s(), timeline_.now_s()}); });
  // Often enough that it never seems held up where it looks for silence.
  const double often = options_.silence_s < 1e9 ? 0.5 : 1;
  timeline_.after(often * options_.heartbeat_s, [this, render] { tick(render); });
}

void Farm::frontal_receives(const PeerId& peer, const Message& message) {
  const auto arrive = [this, peer, message] {
    PerUnit doings;
    doings[Unit::kFrontalCall] = 1;
    if (looks_like_batch(message.frame)) {
      doings[Unit::kFrontalByte] = static_cast<double>(message.frame.size());
    }
    in_frontal(doings, [&] {
      frontal_->on_time({timeline_.now_s(), timeline_.now_s()});
      frontal_->on_message(peer, message);
    });
  };
  const PerUnit transport = passing(place_of(peer), {}, bytes_of(message));
  mailroom_of({}).ask({process_of({}), [this, transport] { return take({}, transport); }, arrive});
}

void Farm::prepare(const PreparationWork& work) {
  const double began_s = thread_cpu_seconds();
  auto result = std::make_shared<PreparationResult>(graycube::prepare(work, thread_cpu_seconds));
  outcome_.preparation_cpu_s += thread_cpu_seconds() - began_s;
  timeline_.after(
      0, [this, result] { in_frontal({}, [&] { frontal_->give_result(std::move(*result)); }); });
}

/// Cutting and encoding a slice is taken to cost what decoding and subdividing it does.
void Farm::recut(const RecutWork& work) {
  auto cut = std::make_shared<RecutResult>(graycube::recut(work, thread_cpu_seconds));
  PerUnit doings;
  doings[Unit::kBuildByte] = static_cast<double>(cut->bytes);
  // Not before the messages of the call that asked for it.
  timeline_.after(0, [this, cut, doings] {
    in_frontals_background(take({}, doings), [this, cut] {
      frontal_->on_time({timeline_.now_s(), timeline_.now_s()});
      frontal_->give_result(*cut);
    });
  });
}

/// A thread of the frontal works for that long, beside the mailroom, which goes first; then calls
/// the brain.
void Farm::in_frontals_background(double seconds, std::function<void()> call) {
  const double now_s = std::min(seconds, kTimeSlice_s);
  cores_of({}).ask({process_of({}), [now_s] { return now_s; },
                    [this, left_s = seconds - now_s, call = std::move(call)] {
                      left_s > 0 ? in_frontals_background(left_s, call) : in_frontal({}, call);
                    }});
}

void Farm::deliver(const Frontal::Outgoing& o) {
  if (o.to == kClient) return on_client_message(o.message);
  const auto found = peers_.find(o.to);
  if (found == peers_.end()) return;
  const Rank rank = found->second;
  const std::uint32_t incarnation = processes_[rank.value].incarnation;
  if (o.to != peer_of(rank, incarnation)) return;
  watch_to_node(o.message);
  if (on_sent) on_sent({}, rank, timeline_.now_s(), o.message);
  timeline_.at(machine_.arrival_s({}, rank, bytes_of(o.message), timeline_.now_s()),
               [this, rank, incarnation, message = o.message] {
                 node_receives(rank, incarnation, {}, message);
               });
}

void Farm::on_client_message(const Message& message) {
  const auto decoded = decode(message.text());
  const auto& m = std::get<ControlMessage>(decoded);
  if (const auto* accepted = std::get_if<control::Accepted>(&m)) {
    const Message watch = Message::of_text(encode(control::Watch{accepted->job}));
    in_frontal({}, [&] { frontal_->on_message(kClient, watch); });
  } else if (const auto* done = std::get_if<control::Done>(&m)) {
    outcome_.done = *done;
    outcome_.epochs = epoch_ + 1;
    outcome_.ended = true;
  } else if (const auto* failed = std::get_if<control::Failed>(&m)) {
    outcome_.failed = *failed;
    outcome_.ended = true;
  } else if (const auto* progress = std::get_if<control::Progress>(&m)) {
    outcome_.rounds = progress->rounds;
  }
}

// ---- the nodes

/// Calls a node's brain, has the mailroom send the brain's messages, and lets its evaluators look
/// for work.
template <typename Call>
void Farm::in_node(Rank rank, bool is_evaluator, PerUnit doings, Call&& call) {
  Process& p = processes_[rank.value];
  const double began_s = observe ? thread_cpu_seconds() : 0;
  call(*p.node);
  auto out = std::make_shared<std::vector<Node::Outgoing>>(p.node->take_outgoing());
  auto for_fifo = std::make_shared<std::vector<Bytes>>(p.node->take_for_fifo());
  for (const control::Host& guest : p.node->take_guests())
    run_node({Rank{guest.rank}, guest.incarnation}, p.pid);
  serve_fifo(p);
  doings[Unit::kNodeCall] = 1;
  add_sending(*out, doings);
  if (observe) observe(doings, thread_cpu_seconds() - began_s);
  watch_time(p);
  if (is_evaluator && !(out->empty() && for_fifo->empty())) doings[Unit::kWakeup] = 1;
  for (const Node::Outgoing& o : *out) doings.add(passing(rank, o.to, bytes_of(o.message)));
  add_sending_to_fifo(*for_fifo, doings);
  mailroom_of(rank).ask(
      {rank.value, [this, rank, doings] { return take(rank, doings); },
       [this, rank, out, for_fifo, order = p.fifo_order, incarnation = p.incarnation] {
         if (!is_alive(rank, incarnation)) return;
         for (const Node::Outgoing& o : *out) deliver(rank, o);
         if (order) deliver_to_fifo(rank, *order, *for_fifo);
       }});
  wake(rank);
}

void Farm::node_receives(Rank rank, std::uint32_t incarnation, Place from, const Message& message) {
  const PerUnit transport = passing(from, rank, bytes_of(message));
  const auto begin_receiving = [this, rank, incarnation, transport] {
    return is_alive(rank, incarnation) ? take(rank, transport) : 0;
  };
  const auto arrive = [this, rank, incarnation, from, message] {
    if (from) watch_batch(*from, rank, message.frame, false);
    if (!is_alive(rank, incarnation)) return;
    in_node(rank, false, receiving(message), [&](Node& node) {
      from ? node.on_neighbour(message.frame) : node.on_frontal(message);
    });
  };
  mailroom_of(rank).ask({rank.value, begin_receiving, arrive});
}

void Farm::deliver(Rank rank, const Node::Outgoing& o) {
  const std::uint32_t incarnation = processes_[rank.value].incarnation;
  const Place to = o.to;
  if (on_sent) on_sent(rank, to, timeline_.now_s(), o.message);
  if (is_cut(rank, to)) return;
  if (to) {
    watch_batch(rank, *to, o.message.frame, true);
  } else {
    watch_to_frontal(o.message);
  }
  const double at_s = machine_.arrival_s(rank, to, bytes_of(o.message), timeline_.now_s());
  timeline_.at(at_s, [this, rank, incarnation, to, message = o.message] {
    if (!to) return frontal_receives(peer_of(rank, incarnation), message);
    node_receives(*to, processes_[to->value].incarnation, rank, message);
  });
}

void Farm::node_receives_ray(Rank rank, std::uint32_t incarnation, const Bytes& answer) {
  const auto begin = [this, rank, incarnation, transport = handling(answer.size())] {
    return is_alive(rank, incarnation) ? take(rank, transport) : 0;
  };
  const auto arrive = [this, rank, incarnation, answer] {
    if (!is_alive(rank, incarnation)) return;
    PerUnit doings;
    doings[Unit::kRayIn] = 1;
    FifoStream stream;
    in_node(rank, false, doings, [&](Node& node) {
      const bool is_message =
          stream.take(answer, [&](FifoWord, std::span<const std::byte> ray) { node.on_fifo(ray); });
      if (!is_message) outcome_.violations.push_back("a FIFO answered nonsense");
    });
  };
  mailroom_of(rank).ask({rank.value, begin, arrive});
}

// ---- evaluators

/// An evaluator's turn on a core: it looks for a piece of work and does it.
struct Farm::Turn {
  Rank rank;
  std::uint32_t incarnation = 0, epoch = 0;
  std::optional<WorkResult> result;
  bool is_build = false, is_copying = false, is_primary = false, is_woken = false;
  double seconds = 0;
};

/// Tells all evaluators that wait that there may be work, as the threads of a process are told.
void Farm::wake(Rank rank) {
  Process& p = processes_[rank.value];
  if (!p.node->may_have_work()) return;
  const unsigned waiting = p.node->threads() - std::min(p.active, p.node->threads());
  p.active += waiting;
  for (unsigned i = 0; i < waiting; ++i) ask_for_turn(rank, true);
}

void Farm::ask_for_turn(Rank rank, bool is_woken) {
  auto turn = std::make_shared<Turn>();
  turn->rank = rank;
  turn->is_woken = is_woken;
  turn->incarnation = processes_[rank.value].incarnation;
  cores_of(rank).ask(
      {rank.value, [this, turn] { return begin(*turn); }, [this, turn] { end(*turn); }});
}

double Farm::begin(Turn& turn) {
  if (!is_alive(turn.rank, turn.incarnation)) return 0;
  Process& p = processes_[turn.rank.value];
  PerUnit waking;
  waking[Unit::kWakeup] = turn.is_woken ? 1 : 0;
  const double waking_s = take(turn.rank, waking);
  std::optional<Work> work;
  in_node(turn.rank, true, {}, [&](Node& node) {
    if (p.active <= node.threads()) work = node.take_work();
    if (!work) --p.active;
  });
  if (!work) return waking_s;
  // Copies, and slices that boundaries slid to, are for rays to come. If none come, one may still
  // be at work when the job is over.
  const bool is_sliding = std::holds_alternative<SlideWork>(work->what);
  turn.is_copying = is_sliding || std::holds_alternative<CopyWork>(work->what);
  turn.epoch = epoch_;
  if (!turn.is_copying) ++p.working;
  PerUnit doings;
  turn.is_build = std::holds_alternative<BuildWork>(work->what);
  turn.is_primary = std::holds_alternative<TileWork>(work->what);
  const auto* rays = std::get_if<RayWork>(&work->what);
  if (rays != nullptr) doings[Unit::kRay] = static_cast<double>(rays->rays.size());
  if (turn.is_primary || rays != nullptr) doings[Unit::kPiece] = 1;
  const auto count_slice = [&](const auto& piece) {
    if constexpr (requires { piece.slice; })
      doings[Unit::kBuildByte] = static_cast<double>(piece.slice.size());
  };
  std::visit(count_slice, work->what);
  const double began_s = observe ? thread_cpu_seconds() : 0;
  turn.result = processes_[turn.rank.value].bench->run(std::move(*work));
  const double took_s = observe ? thread_cpu_seconds() - began_s : 0;
  if (const auto* traced = std::get_if<Traced>(&turn.result->what)) {
    for (const std::uint64_t n : traced->step.rays.created)
      doings[Unit::kRay] += static_cast<double>(n);
    doings[Unit::kVisit] = traced->walk.visits();
    doings[Unit::kTest] = traced->walk.tests();
  }
  if (observe) observe(doings, took_s);
  turn.seconds = take(turn.rank, doings);
  if (turn.is_build || is_sliding) turn.result->build_s = turn.seconds;
  return waking_s + turn.seconds;
}

void Farm::end(Turn& turn) {
  if (!turn.result || !is_alive(turn.rank, turn.incarnation)) return;
  Process& p = processes_[turn.rank.value];
  if (!turn.is_copying && turn.epoch == epoch_) --p.working;
  last_change_s_ = timeline_.now_s();
  if (!turn.is_build && !turn.is_copying) p.busy_s += turn.seconds;
  if (turn.is_primary) p.last_primary_s = timeline_.now_s();
  PerUnit doings;
  if (const auto* traced = std::get_if<Traced>(&turn.result->what)) {
    doings[Unit::kReturn] = static_cast<double>(traced->step.returns.size());
  }
  in_node(turn.rank, true, doings, [&](Node& node) { node.give_result(std::move(*turn.result)); });
  ask_for_turn(turn.rank, false);
}

void Farm::tell_of_end(const Frontal::Process& process, bool was_started) {
  in_frontal({}, [&] {
    frontal_->on_time({timeline_.now_s(), timeline_.now_s()});
    was_started ? frontal_->on_node_exit(process, "killed by signal 9")
                : frontal_->on_start_failure(process, "no more processes");
  });
}

Outcome Farm::render(const std::string& scene_text, const control::JobOptions& options) {
  outcome_ = {};
  reports_ = 0;
  is_over_ = has_failed_ = false;
  render_began_s_ = -1;
  const double began_s = timeline_.now_s();
  const auto text = std::as_bytes(std::span(scene_text.data(), scene_text.size()));
  const Message submit = Message::of_text(encode(control::Submit{"simulated", options}),
                                          Bytes(text.begin(), text.end()));
  in_frontal({}, [&] { frontal_->on_message(kClient, submit); });
  for (const Fault& fault : std::exchange(faults_, {}))
    timeline_.after(fault.after_s, [this, fault] { happen(fault); });
  tick(renders_);
  while (!outcome_.ended && timeline_.now_s() - began_s < options_.stalled_s) timeline_.run_one();
  if (!outcome_.ended) outcome_.violations.push_back("the job has stalled");
  outcome_.render_s = render_began_s_ < 0 ? 0 : last_change_s_ - render_began_s_;
  outcome_.distribution_s = render_began_s_ < 0 ? 0 : render_began_s_ - began_s;
  ++renders_;
  if (outcome_.failed) collect_reports();
  return outcome_;
}

}  // namespace graycube::simulation
