// The part of Rendering that takes what comes from the frontal and from neighbours.
#include <algorithm>
#include <string>

#include "node/rendering.hpp"

namespace graycube {

// ---- from the frontal

void Rendering::on_assigned(std::span<const std::uint32_t> tiles, Mail& mail) {
  if (generations_.is_on()) return on_assigned_here(tiles, mail);
  queue_.add_tiles(tiles);
  for (const std::uint32_t tile : tiles) {
    if (here_.is_own_tile(tile)) {
      queue_.expect_less(1);
    } else if (!domain_of(tile)) {
      return mail.fail("a tile of another macro-region was assigned");
    } else {
      helping_.took_over(1, 0);
    }
  }
  share_work(mail);
}

/// The same where boundaries slide: the tiles are in this node's macro-region of the moment.
void Rendering::on_assigned_here(std::span<const std::uint32_t> tiles, Mail& mail) {
  const Domain& here = *generations_.current_domain();
  for (const std::uint32_t tile : tiles) {
    const PixelRect rect = here_.plan.rect(tile);
    if (!here.holds(here.region_of_pixel(rect.x0, rect.y0)) ||
        !here.holds(here.region_of_pixel(rect.x1 - 1, rect.y1 - 1)))
      return mail.fail("a tile of another macro-region was assigned");
    generations_.assigned(tile);
  }
  queue_.add_tiles(tiles);
  done_.assigned(static_cast<std::uint32_t>(tiles.size()), queue_.tiles());
}

void Rendering::on_slide(const control::Slide& m, const SharedBytes& slice, Mail& mail) {
  if (!generations_.may_add(m)) return mail.drop("slide", "of no use here");
  SlideWork work{m.generation, {}, here_.seat.share(), slice};
  work.edges.columns = m.column_edges;
  work.edges.rows = m.row_edges;
  queue_.add_model(std::move(work));
}

/// No ray of an older generation is here any more, as the frontal holds all light of its tiles.
void Rendering::on_turn(const control::Turn& m, Mail& mail) {
  if (!generations_.turn(m)) return mail.drop("turn", "to a generation that is not held");
  here_.domain = generations_.current_domain();
}

void Rendering::on_dealt(Mail& mail) {
  queue_.expect_less(queue_.unassigned());
  pass_token(mail);
}

void Rendering::on_relieved(std::uint64_t tiles, Mail& mail) {
  queue_.expect_less(tiles);
  if (ending_) ending_->work_was_taken();
  pass_token(mail);
}

void Rendering::on_all_whole(Mail& mail) {
  if (ending_) ending_->all_are_whole();
  pass_token(mail);
}

void Rendering::on_lend(Rank owner, const SharedBytes& slice, Mail& mail) {
  if (!borrowing_.is_asked(owner)) return mail.drop("lend", "not asked for");
  if (!slice.empty()) return queue_.add_model(BorrowWork{owner, slice});
  const std::vector<RayTask> refused = borrowing_.was_refused(owner);
  flow_->release(refused.size());
  const Seat& seat = here_.seat;
  for (const RayTask& ray : refused)
    flow_->leave(seat.bit_of(seat.owner_of(ray.region)), {&ray, 1});
  // No evaluator may come by to send what is left.
  send(true, mail);
  pass_token(mail);
}

void Rendering::on_copy(Rank owner, const SharedBytes& slice, std::size_t horizon_bytes,
                        Mail& mail) {
  const bool is_neighbours = here_.seat.bit_of(owner) < here_.seat.links();
  if (!is_neighbours || here_.domain->grid() == nullptr)
    return mail.drop("copy", "not a neighbour's");
  queue_.add_model(CopyWork{owner, here_.seat.share_of(owner), slice, horizon_bytes});
}

void Rendering::on_ping(std::uint64_t ping, Mail& mail) {
  pass_token(mail, ping);
  if (has_begun_) flow_->answer_ping(ping, mail);
}

// ---- from neighbours

/// Where light goes back along the rays' ways, remembers whence these rays came. False when too
/// many are remembered: the job has failed then.
bool Rendering::open(std::uint32_t bit, std::span<RayTask> rays, Mail& mail) {
  if (light_.back() == nullptr || light_.back()->came(bit, rays)) return true;
  mail.fail_for_good(LightBack::kTooManyOpen);
  return false;
}

/// The rays are in this node's regions; or in the sender's own, for whom this node is to trace
/// them; or in a neighbour's: rays that left a copy of another neighbour's regions come this way.
void Rendering::on_rays(std::uint32_t bit, std::span<RayTask> rays, Mail& mail) {
  const Rank sender = mail.peer(bit);
  const bool is_help = !rays.empty() && here_.seat.owner_of(rays.front().region) == sender;
  const bool are_due = is_help ? helping_.copy_of(bit) && here_.seat.owns_all(sender, rays)
                               : here_.are_due(rays, helping_.is_on());
  if (!are_due) {
    mail.drop("rays", "for another macro-region");
    return mail.fail("node " + std::to_string(sender.value) + " sent rays for another node");
  }
  if (!generations_.hold(rays)) return mail.fail("rays came of a grid that is not held here");
  if (!open(bit, rays, mail)) return;
  if (ending_) ending_->work_came();
  tally_.rays_came(rays.size());
  if (is_help) return on_rays_to_help(bit, rays);
  bool go_on = false;
  for_each_region(std::span<const RayTask>(rays),
                  [&](RegionIndex region, std::span<const RayTask> run) {
                    if (here_.holds(region)) return keep(bit, run, mail);
                    go_on = flow_->pass_on(bit, here_.seat.bit_towards(region), run) || go_on;
                  });
  tally_.note_queue(held());
  share_work(mail);
  if (!go_on) return;
  if (all_evaluators_wait()) return flush_on_idle(mail);
  flow_->send(false, mail);
  flow_->grant(bit, mail);
}

/// Keeps received rays until an evaluator is free for them.
void Rendering::keep(std::uint32_t bit, std::span<const RayTask> rays, Mail& mail) {
  if (!fifo_) return queue_.add_received(rays, bit);
  fifo_->put(bit, rays, mail);
  fetch(mail);
}

void Rendering::on_handed(std::span<const std::byte> ray, Mail& mail) {
  if (!fifo_) return;
  if (const auto handed = fifo_->on_hand(ray, limits(), mail))
    queue_.add_received({&handed->ray, 1}, handed->bit);
}

void Rendering::on_rays_to_help(std::uint32_t bit, std::span<const RayTask> rays) {
  helping_.took_over(0, rays.size());
  helping_.has_given(bit);
  queue_.add_helped(here_.seat.peer(bit), bit, rays);
  tally_.note_queue(held());
}

void Rendering::on_class_rays(std::uint32_t bit, std::span<RayTask> rays, Mail& mail) {
  const bool are_due = here_.are_due(rays, helping_.is_on()) && generations_.hold(rays);
  if (are_due && !open(bit, rays, mail)) return;
  if (!are_due || !flow_->add_class_rays(bit, rays)) {
    mail.drop("class rays", "for another macro-region, or without credit");
    return mail.fail("a broken batch of class rays came from node " +
                     std::to_string(mail.peer(bit).value));
  }
  if (ending_) ending_->work_came();
  tally_.rays_came(rays.size());
  tally_.note_queue(held());
}

/// When all evaluators wait, none will come by to send the rest, so part of a batch is sent, too.
void Rendering::on_class_credit(std::uint32_t bit, std::span<const std::byte> batch, Mail& mail) {
  flow_->on_class_credit(bit, batch, limits(), all_evaluators_wait(), mail);
}

void Rendering::on_link_credit(std::uint32_t bit, std::span<const std::byte> batch, Mail& mail) {
  const bool is_free = flow_->on_link_credit(bit, batch, limits(), all_evaluators_wait(), mail);
  if (is_free && all_evaluators_wait()) flush_on_idle(mail);
}

/// Tiles of a neighbour, to be traced here in the copy of its regions.
void Rendering::on_tiles(std::uint32_t bit, std::span<const std::byte> batch, Mail& mail) {
  std::vector<std::uint32_t> tiles;
  const auto result = decode_assignment(batch, limits(), tiles);
  const auto* error = std::get_if<BatchError>(&result);
  const Rank sender = mail.peer(bit);
  const auto is_senders = [&](std::uint32_t tile) { return here_.owner_of_tile(tile) == sender; };
  if (error != nullptr || !helping_.is_on() || !helping_.copy_of(bit) ||
      !std::ranges::all_of(tiles, is_senders)) {
    mail.drop("tiles", error != nullptr ? to_string(*error) : "of regions that are not held here");
    return mail.fail("node " + std::to_string(sender.value) +
                     " sent tiles that can't be traced here");
  }
  if (ending_) ending_->work_came();
  helping_.has_given(bit);
  helping_.took_over(tiles.size(), 0);
  queue_.add_tiles(tiles);
}

void Rendering::on_sums(std::uint32_t bit, std::span<const std::byte> batch, Mail& mail) {
  if (light_.on_sums(bit, batch, limits(), mail) && ending_) ending_->work_came();
}

void Rendering::on_answers(std::uint32_t bit, std::span<const std::byte> batch, Mail& mail) {
  if (light_.on_answers(bit, batch, limits(), here_.plan, mail) && ending_) ending_->work_came();
}

void Rendering::on_offer(std::uint32_t bit, std::span<const std::byte> batch, BatchType type,
                         Mail& mail) {
  if (helping_.on_offer(bit, batch, type, limits(), mail)) share_work(mail);
}

void Rendering::on_token(std::span<const std::byte> batch, Mail& mail) {
  if (ending_ && ending_->on_token(batch, limits(), mail)) pass_token(mail);
}

}  // namespace graycube
