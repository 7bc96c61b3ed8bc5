/* The flow of rays between nodes (node/node_sending.cpp, node/node_work.cpp) on a ring of N; a 2-cube is
 * the ring of 4. Every ray must be traced in the end, whatever time the links take, and what a node holds
 * is bounded: by credit on each link and in its part of the inbox, by the windows of open tiles altogether.
 *
 * A tile here is one primary ray. A ray crosses at most HOPS boundaries, and whoever traces it sends on up
 * to FAN others. Evaluators take one ray at a time, from either link. A ray is in the inbox once it is sent,
 * but who looks for work may overlook it, as if it were on the link still. That allows more orders of events
 * than there really are. Left out are the token (token.pml) and the frontal's links, which carry only tiles
 * and contributions: a Window may look as late as it likes.
 *
 * With -DCLASSES a node is full while more than STALL rays wait to be sent (node/node_classes.cpp): then its evaluators
 * take only rays in places, of which every link has one for each class, and only while there is room kept for what
 * these may send on. A full node without credit sends from its outbox to free places, too.
 *
 * Without one of the rules:
 *   -DSTALL=n   as in 1987: an evaluator takes nothing while more than n rays wait to be sent.
 *   -DROOMLESS  with classes, rays in places are taken whether or not there is room for what they send on.
 *   -DKEEP      new credit sends full batches only, even where all evaluators wait.
 *   -DHOARD=n   credit returns once n rays of it are due, not half of it, and not when an evaluator finds
 *               nothing to do.
 *   -DEARLY     credit returns when rays arrive, not when an evaluator takes them.
 *   -DLOCAL     a tile counts as open until its rays have left its own node, not until all are traced.
 *   -DSILENT    contributions stay in a node whose evaluators find nothing to do.
 *   -DLIVE      adds the claim that all tiles become whole.
 */
#ifndef N
#define N 3
#endif
#if N < 3 || N > 4
#error "rings of 3 and 4 are what is checked"
#endif
#ifndef WINDOW
#define WINDOW 1   /* tiles that a node may have open */
#endif
#ifndef TILES
#define TILES 1    /* one after another in each place of a window */
#endif
#ifndef FAN
#define FAN 2
#endif
#ifndef HOPS
#define HOPS 1
#endif
#ifndef WAYS
#define WAYS 1     /* 1: rays go round the ring in one direction only; 2: either way */
#endif
#ifndef THREADS
#define THREADS 1  /* evaluators of a node */
#endif
#ifndef CREDIT
#define CREDIT 1   /* of a link, in rays; at least BATCH */
#endif
#ifndef BATCH
#define BATCH 1
#endif
#ifndef EAGER
#define EAGER BATCH  /* so many rays go out at once where nothing is under way */
#endif
#ifndef SOURCES
#define SOURCES N  /* nodes that have tiles, the first ones */
#endif
#ifndef LONG
#define LONG 2     /* no primary ray is started while so many rays wait to be sent */
#endif

#ifdef HOARD
#define DUE (HOARD)
#else
#define DUE ((CREDIT + 1) / 2)
#endif

/* Rays that descend from one tile at the same time: each becomes FAN others, HOPS times. */
#if HOPS == 1
#define WIDTH (FAN)
#elif HOPS == 2
#define WIDTH (FAN * FAN)
#else
#error "HOPS is 1 or 2"
#endif
#define PLACES (SOURCES * WINDOW)  /* for open tiles, in all windows */
#define BOUND (PLACES * WIDTH)     /* rays, anywhere */
/* The smaller number is the deeper ray. */
#define RAY(place, hops_left) ((hops_left) * PLACES + (place))
#define PLACE(ray) ((ray) % PLACES)
#define HOPS_LEFT(ray) ((ray) / PLACES)

/* Link i leads from node i to the next node, and link N + i to the one before. */
#define LINKS (WAYS * N)
#define FROM(l) ((l) % N)
#define NEXT(i) ((i + 1) % N)
#define BEFORE(i) ((i + N - 1) % N)

chan outbox[LINKS] = [BOUND] of { byte };
chan inbox[LINKS] = [CREDIT] of { byte };   /* on the link or received over it, deepest ray first */
chan grants[LINKS] = [CREDIT] of { byte };  /* on their way back to the link's sender */
#ifdef CLASSES
/* A received ray has crossed a link; the fewer it may still cross, the higher its class. */
#define AT(l, h) ((l) * HOPS + (h))
chan placed[LINKS * HOPS] = [1] of { byte };         /* on the link or received */
chan class_outbox[LINKS * HOPS] = [FAN] of { byte };
bool taken[LINKS * HOPS];                           /* as the link's sender knows, who hears later that it is free */
byte promised[N];                                   /* evaluators that may fill the highest class's outboxes */
#endif
chan tiles[N] = [WINDOW] of { byte };       /* by place, not started */
byte credit[LINKS] = CREDIT;
byte ungranted[LINKS];
byte working[N];
byte under_way[PLACES];  /* rays that descend from the tile, its primary ray too */
byte held_by[PLACES];    /* nodes that hold contributions of the tile, as bits */
#ifdef LOCAL
byte at_home[PLACES];    /* rays that have not left the tile's own node */
#endif
byte whole = 0;          /* places whose tiles are all done */

#if WAYS == 1
#define TO_SEND(i) len(outbox[i])
#define RECEIVED(i) len(inbox[BEFORE(i)])
#else
#define TO_SEND(i) (len(outbox[i]) + len(outbox[N + i]))
#define RECEIVED(i) (len(inbox[BEFORE(i)]) + len(inbox[N + NEXT(i)]))
#endif
#ifdef CLASSES
#if HOPS == 1
#define IN_CLASSES(l) (len(class_outbox[l]))
#else
#define IN_CLASSES(l) (len(class_outbox[AT(l, 0)]) + len(class_outbox[AT(l, 1)]))
#endif
#if WAYS == 1
#define CLASS_RAYS(i) IN_CLASSES(i)
#define CLASS_WAITS(i, h) (len(class_outbox[AT(i, h)]))
#define PLACED(i, h) MAY_TAKE_PLACED(i, BEFORE(i), h)
#else
#define CLASS_RAYS(i) (IN_CLASSES(i) + IN_CLASSES(N + i))
#define CLASS_WAITS(i, h) (len(class_outbox[AT(i, h)]) + len(class_outbox[AT(N + i, h)]))
#define PLACED(i, h) (MAY_TAKE_PLACED(i, BEFORE(i), h) || MAY_TAKE_PLACED(i, N + NEXT(i), h))
#endif
#define MAY_TAKE_PLACED(i, l, h) (len(placed[AT(l, h)]) > 0 && (!STALLED(i) || HAS_ROOM_AFTER(i, h)))
#if HOPS == 1
#define ANY_PLACED(i) PLACED(i, 0)
#else
#define ANY_PLACED(i) (PLACED(i, 0) || PLACED(i, 1))
#endif
#if HOPS == 1 || defined(ROOMLESS)
#define HAS_ROOM_AFTER(i, h) true
#else
#define HAS_ROOM_AFTER(i, h) (h == 0 || (CLASS_WAITS(i, 0) == 0 && promised[i] == 0))
#endif
#else
#define CLASS_RAYS(i) 0
#define ANY_PLACED(i) false
#endif
#ifdef STALL
#define STALLED(i) (TO_SEND(i) + CLASS_RAYS(i) > STALL)
#else
#define STALLED(i) false
#endif
#define MAY_START(i) (!STALLED(i) && len(tiles[i]) > 0 && TO_SEND(i) < LONG)
#define MAY_TAKE(i) ((!STALLED(i) && RECEIVED(i) > 0) || ANY_PLACED(i))

#ifdef CLASSES
inline send_to_places(l) {
  for (h : 0 .. (HOPS - 1)) {
    do
    :: len(class_outbox[AT(l, h)]) > 0 && credit[l] > 0 ->
       class_outbox[AT(l, h)]?sent; leave_home(sent, FROM(l)); inbox[l]!!sent; credit[l]--
    :: len(class_outbox[AT(l, h)]) > 0 && credit[l] == 0 && !taken[AT(l, h)] ->
       class_outbox[AT(l, h)]?sent; leave_home(sent, FROM(l)); taken[AT(l, h)] = true; placed[AT(l, h)]!sent
    :: else -> break
    od
  }
  do
  :: STALLED(FROM(l)) && credit[l] == 0 && len(outbox[l]) > 0 ->
     outbox[l]?<sent>;
     h = HOPS_LEFT(sent);
     if
     :: !taken[AT(l, h)] ->
        outbox[l]?sent; leave_home(sent, FROM(l)); taken[AT(l, h)] = true; placed[AT(l, h)]!sent
     :: else -> break
     fi
  :: else -> break
  od;
  sent = 0; h = 0
}
#endif

inline send_rays(l, partial) {
  do
  :: len(outbox[l]) > 0 && credit[l] > 0 &&
     (partial || (len(outbox[l]) >= BATCH && credit[l] >= BATCH) ||
      (len(outbox[l]) >= EAGER && credit[l] == CREDIT)) ->
     room = BATCH;
     do
     :: room > 0 && len(outbox[l]) > 0 && credit[l] > 0 ->
        outbox[l]?sent;
        leave_home(sent, FROM(l));
        assert(len(inbox[l]) < CREDIT);
        inbox[l]!!sent;
#ifdef EARLY
        grants[l]!1;
#endif
        credit[l]--; room--
     :: else -> room = 0; sent = 0; break
     od
  :: else -> break
  od
#ifdef CLASSES
  ;
  send_to_places(l)
#endif
}

inline grant(l) {
  if
  :: ungranted[l] > 0 -> assert(len(grants[l]) < CREDIT); grants[l]!ungranted[l]; ungranted[l] = 0
  :: else
  fi
}

inline flush_on_idle(i) {
  send_rays(i, true);
#ifndef HOARD
  grant(BEFORE(i));
#endif
#if WAYS == 2
  send_rays(N + i, true);
#ifndef HOARD
  grant(N + NEXT(i));
#endif
#endif
#ifndef SILENT
  for (tile : 0 .. (PLACES - 1)) { held_by[tile] = held_by[tile] & (255 - (1 << i)) }
  tile = 0
#endif
}

inline take_received(i, l) {
  inbox[l]?ray;
#ifndef EARLY
  ungranted[l]++;
  if
  :: ungranted[l] >= DUE -> grant(l)
  :: else
  fi;
#endif
  working[i]++;
  busy = true
}

#ifdef CLASSES
inline take_placed(i, l, h) {
  on_class = STALLED(i);
  placed[AT(l, h)]?ray;
  if
  :: on_class && h > 0 -> promised[i]++
  :: else
  fi;
  working[i]++;
  busy = true
}
#endif

inline come_home(r, i) {
#ifdef LOCAL
  if
  :: PLACE(r) / WINDOW == i -> at_home[PLACE(r)]++
  :: else
  fi
#else
  skip
#endif
}

inline leave_home(r, i) {
#ifdef LOCAL
  if
  :: PLACE(r) / WINDOW == i -> at_home[PLACE(r)]--
  :: else
  fi
#else
  skip
#endif
}

inline forward(l) {
#ifdef CLASSES
  if
  :: on_class -> assert(len(class_outbox[AT(l, HOPS_LEFT(ray) - 1)]) < FAN); class_outbox[AT(l, HOPS_LEFT(ray) - 1)]!(ray - PLACES)
  :: else -> assert(len(outbox[l]) < BOUND); outbox[l]!(ray - PLACES)
  fi;
#else
  assert(len(outbox[l]) < BOUND);
  outbox[l]!(ray - PLACES);
#endif
  under_way[PLACE(ray)]++;
  come_home(ray, FROM(l))
}

inline trace_ray(i) {
  if
  :: HOPS_LEFT(ray) > 0 ->
     for (child : 1 .. FAN) {
       if
       :: true -> forward(i)
#if WAYS == 2
       :: true -> forward(N + i)
#endif
       :: break
       fi
     }
     child = 0
  :: else
  fi;
  if
  :: HOPS_LEFT(ray) == HOPS -> leave_home(ray, i)
  :: else
  fi;
#ifdef CLASSES
  if
  :: on_class && HOPS_LEFT(ray) > 0 -> promised[i]--
  :: else
  fi;
  on_class = false;
#endif
  under_way[PLACE(ray)]--;
  held_by[PLACE(ray)] = held_by[PLACE(ray)] | (1 << i);
  ray = 0
}

inline give_result(i) {
  working[i]--;
  busy = false;
  send_rays(i, false);
#if WAYS == 2
  send_rays(N + i, false);
#endif
  assert(RECEIVED(i) + TO_SEND(i) + working[i] <= BOUND);
#ifdef CLASSES
  assert(TO_SEND(i) <= STALL + THREADS * FAN);
#endif
  if
  :: MAY_START(i) || MAY_TAKE(i)
  :: !MAY_START(i) -> flush_on_idle(i)  /* what there is to take may still be on the link */
  fi
}

proctype Evaluator(byte i) {
  bool busy;
  byte ray, child, tile, room, sent;
#ifdef CLASSES
  bool on_class;
  byte h;
#endif
end:
  do
  :: atomic { !busy && !STALLED(i) && len(inbox[BEFORE(i)]) > 0 -> take_received(i, BEFORE(i)) }
#if WAYS == 2
  :: atomic { !busy && !STALLED(i) && len(inbox[N + NEXT(i)]) > 0 -> take_received(i, N + NEXT(i)) }
#endif
#ifdef CLASSES
  :: atomic { !busy && MAY_TAKE_PLACED(i, BEFORE(i), 0) -> take_placed(i, BEFORE(i), 0) }
#if HOPS == 2
  :: atomic { !busy && MAY_TAKE_PLACED(i, BEFORE(i), 1) -> take_placed(i, BEFORE(i), 1) }
#endif
#if WAYS == 2
  :: atomic { !busy && MAY_TAKE_PLACED(i, N + NEXT(i), 0) -> take_placed(i, N + NEXT(i), 0) }
#if HOPS == 2
  :: atomic { !busy && MAY_TAKE_PLACED(i, N + NEXT(i), 1) -> take_placed(i, N + NEXT(i), 1) }
#endif
#endif
#endif
  :: atomic { !busy && MAY_START(i) -> tiles[i]?ray; ray = RAY(ray, HOPS); working[i]++; busy = true }
  :: atomic { busy -> trace_ray(i); give_result(i) }
  od
}

/* Takes in grants for link l. */
proctype Mailroom(byte l) {
  byte room, sent;
#ifdef CLASSES
  byte h;
#endif
end:
  do
#ifdef CLASSES
  :: atomic { taken[AT(l, 0)] && len(placed[AT(l, 0)]) == 0 -> taken[AT(l, 0)] = false; send_to_places(l) }
#if HOPS == 2
  :: atomic { taken[AT(l, 1)] && len(placed[AT(l, 1)]) == 0 -> taken[AT(l, 1)] = false; send_to_places(l) }
#endif
#endif
  :: atomic { len(grants[l]) > 0 ->
       grants[l]?sent;
       credit[l] = credit[l] + sent;
       sent = 0;
#ifdef KEEP
       send_rays(l, false)
#else
       /* Where all evaluators wait, none will come by to send the rest. */
       if
       :: MAY_START(FROM(l)) || MAY_TAKE(FROM(l)) || working[FROM(l)] > 0 -> send_rays(l, false)
       :: !MAY_START(FROM(l)) && working[FROM(l)] == 0 -> send_rays(l, true)
       fi
#endif
     }
  od
}

#ifdef LOCAL
#define CLOSED(place) (at_home[place] == 0)
#else
#define CLOSED(place) (under_way[place] == 0 && held_by[place] == 0)
#endif

/* The frontal's side of a place for an open tile. It has no `end` label: a farm that stops before all
 * tiles are whole is an invalid end state. */
proctype Window(byte place) {
  byte left = TILES;
  do
  :: atomic { CLOSED(place) && left > 0 ->
       left--; under_way[place]++; come_home(place, place / WINDOW); tiles[place / WINDOW]!place }
  :: atomic { CLOSED(place) && left == 0 -> whole++; break }
  od
}

init {
  byte i, k;
  atomic {
    for (i : 0 .. (N - 1)) {
      for (k : 1 .. THREADS) { run Evaluator(i) }
    }
    for (i : 0 .. (LINKS - 1)) { run Mailroom(i) }
    for (i : 0 .. (PLACES - 1)) { run Window(i) }
    i = 0; k = 0
  }
}

#ifdef LIVE
ltl every_tile_becomes_whole { <> (whole == PLACES) }
#endif
