/* Losses, and what makes the picture the same all the same (docs/design/epochs.md): frontal/rendering
 * and node/node.cpp on a ring of N nodes. Each node has one tile, whose picture is two units of
 * light: one is made by the node itself, one by the node after it, to which it sends a ray. Nodes
 * die at any moment, LOSSES times in all, and what is on its way to or from a dead node may arrive or
 * not. Messages take any time, links are FIFO.
 *
 *   -DRESTARTS=1   the frontal dies, too, and another one begins with the tiles that were recorded.
 *   -DNOBARRIER    nodes are told to trace before all have dropped what is old: rays of the new
 *                  epoch meet nodes that are still in the old one, and their tiles stay open.
 *   -DNOSTAMPS     epochs of rays and light aren't looked at: light is counted twice.
 *   -DKEEPFILM     light of open tiles isn't forgotten: the picture is too bright.
 *   -DKEEPCREDIT   credit of open tiles isn't forgotten: a tile counts as whole before it is.
 *   -DKEEPRAYS     rays that a node holds survive its epoch, and are answered in the next.
 */
#ifndef N
#define N 3
#endif
#ifndef LOSSES
#define LOSSES 1
#endif
#ifndef RESTARTS
#define RESTARTS 0
#endif
#define UNITS 2        /* of light, and of credit, for each tile */
#define NOBODY 255
#define NEXT(i) (((i) + 1) % N)

mtype = { load, prepare, start, acknowledge, light };

/* epoch; start: is the node's tile open */
chan to_node[N] = [4] of { mtype, byte, bool };
/* epoch, tile */
chan to_frontal[N] = [4] of { mtype, byte, byte };
/* rays from the node before: epoch, tile */
chan link[N] = [3] of { byte, byte };

byte epoch = 0;            /* the frontal's */
bool acknowledged[N];
bool is_started = false;
byte film[N], credit[N];   /* by tile */
byte losses = 0, restarts = 0;
bool is_done = false;

bool has_job[N];           /* the nodes' */
byte epoch_of[N];
bool begins[N], sends[N];  /* its own light, and the ray, are still to be sent */
byte held[N];              /* the tile of the ray that it holds */
byte held_epoch[N];

inline forget(i) {
  has_job[i] = false; epoch_of[i] = 0; begins[i] = false; sends[i] = false;
  held[i] = NOBODY; held_epoch[i] = 0
}

inline drain_or_leave(channel) {
  if
  :: true -> do :: nempty(channel) -> channel?_, _ :: empty(channel) -> break od
  :: true -> skip
  fi
}

/* The frontal takes the next epoch: what isn't whole is forgotten. */
inline begin_epoch(lost) {
  epoch++;
  is_started = false;
  for (k : 0 .. (N - 1)) {
    acknowledged[k] = false;
    if
    :: credit[k] < UNITS ->
#ifndef KEEPFILM
       film[k] = 0;
#endif
#ifndef KEEPCREDIT
       credit[k] = 0;
#endif
       skip
    :: else -> skip
    fi;
    if
    :: k == lost -> to_node[k]!load, epoch, false
    :: else -> to_node[k]!prepare, epoch, false
    fi
  }
}

inline all_start() {
  is_started = true;
  for (k : 0 .. (N - 1)) { to_node[k]!start, epoch, (credit[k] < UNITS) }
}

inline take(i) {
  to_frontal[i]?what, when, tile;
  if
  :: what == acknowledge && when == epoch -> acknowledged[i] = true
#ifdef NOSTAMPS
  :: what == light ->
#else
  :: what == light && when == epoch ->
#endif
     film[tile]++; credit[tile]++;
     assert(film[tile] <= UNITS && credit[tile] <= UNITS)
  :: else -> skip
  fi;
  what = 0; when = 0; tile = 0
}

#define ALL_ACKNOWLEDGED (acknowledged[0] && acknowledged[1] && (N < 3 || acknowledged[N - 1]))
#define ALL_WHOLE (credit[0] == UNITS && credit[1] == UNITS && (N < 3 || credit[N - 1] == UNITS))

proctype Frontal() {
  mtype what;
  byte when, tile, k, lost;
  atomic { for (k : 0 .. (N - 1)) { to_node[k]!load, 0, false }; k = 0 }
  do
  :: atomic { nempty(to_frontal[0]) -> take(0) }
  :: atomic { nempty(to_frontal[1]) -> take(1) }
#if N > 2
  :: atomic { nempty(to_frontal[2]) -> take(2) }
#endif
#ifdef NOBARRIER
  :: atomic { !is_started -> all_start(); k = 0 }
#else
  :: atomic { !is_started && ALL_ACKNOWLEDGED -> all_start(); k = 0 }
#endif
  :: atomic { ALL_WHOLE ->
       for (k : 0 .. (N - 1)) { assert(film[k] == UNITS) };
       is_done = true; break }
  /* A node dies, and another process takes its place. */
  :: atomic { losses < LOSSES && !ALL_WHOLE ->
       select (lost : 0 .. (N - 1));
       losses++;
       forget(lost);
       do :: nempty(to_frontal[lost]) -> to_frontal[lost]?_, _, _ :: empty(to_frontal[lost]) -> break od;
       do :: nempty(to_node[lost]) -> to_node[lost]?_, _, _ :: empty(to_node[lost]) -> break od;
       drain_or_leave(link[lost]);
       drain_or_leave(link[NEXT(lost)]);
       begin_epoch(lost);
       k = 0; lost = 0 }
#if RESTARTS > 0
  /* The frontal dies, and its nodes with it. Of the whole tiles some were recorded. */
  :: atomic { restarts < RESTARTS && !ALL_WHOLE ->
       restarts++;
       for (k : 0 .. (N - 1)) {
         forget(k);
         do :: nempty(to_frontal[k]) -> to_frontal[k]?_, _, _ :: empty(to_frontal[k]) -> break od;
         do :: nempty(to_node[k]) -> to_node[k]?_, _, _ :: empty(to_node[k]) -> break od;
         do :: nempty(link[k]) -> link[k]?_, _ :: empty(link[k]) -> break od;
         acknowledged[k] = false;
         if
         :: credit[k] == UNITS -> skip
         :: true -> film[k] = 0; credit[k] = 0
         fi
       };
       epoch = 0; is_started = false;
       for (k : 0 .. (N - 1)) { to_node[k]!load, 0, false };
       k = 0 }
#endif
  od
}

proctype Node(byte i) {
  mtype what;
  byte when, tile;
  bool is_open;
end:
  do
  :: atomic { nempty(to_node[i]) && nfull(to_frontal[i]) ->
       to_node[i]?what, when, is_open;
       if
       :: what == load || (what == prepare && has_job[i] && when >= epoch_of[i]) ->
          has_job[i] = true; epoch_of[i] = when; begins[i] = false; sends[i] = false;
#ifndef KEEPRAYS
          held[i] = NOBODY; held_epoch[i] = 0;
#endif
          to_frontal[i]!acknowledge, when, 0
       :: what == start && has_job[i] && when == epoch_of[i] ->
          begins[i] = is_open; sends[i] = is_open
       :: else -> skip
       fi;
       what = 0; when = 0; is_open = false }
  :: atomic { begins[i] && nfull(to_frontal[i]) -> to_frontal[i]!light, epoch_of[i], i; begins[i] = false }
  :: atomic { sends[i] && nfull(link[NEXT(i)]) -> link[NEXT(i)]!epoch_of[i], i; sends[i] = false }
  :: atomic { nempty(link[i]) && held[i] == NOBODY ->
       link[i]?when, tile;
       if
#ifdef NOSTAMPS
       :: has_job[i] -> held[i] = tile; held_epoch[i] = when
#else
       :: has_job[i] && when == epoch_of[i] -> held[i] = tile; held_epoch[i] = when
#endif
       :: else -> skip
       fi;
       when = 0; tile = 0 }
  :: atomic { held[i] != NOBODY && nfull(to_frontal[i]) ->
#ifdef KEEPRAYS
       to_frontal[i]!light, epoch_of[i], held[i];
#else
       to_frontal[i]!light, held_epoch[i], held[i];
#endif
       held[i] = NOBODY; held_epoch[i] = 0 }
  od
}

init {
  byte i;
  atomic {
    for (i : 0 .. (N - 1)) { held[i] = NOBODY; run Node(i) }
    run Frontal();
    i = 0
  }
}

#ifdef LIVE
ltl every_tile_becomes_whole { <> is_done }
#endif
