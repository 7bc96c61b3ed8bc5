/* The token of common/coordination/termination.cpp on a ring of N nodes, over links that are FIFO
 * but take any time. Nodes send each other a bounded amount of work; rank 0 must learn that all of it
 * is done, and never before it is.
 *
 *   -DPLAIN     the rules of 1983 without Safra's count: a node turns black when it sends. They
 *               assume that messages take no time, and spin finds how they detect too early.
 *   -DNOCOLOUR  the count without the colour: also detects too early.
 *   -DAPART     the token travels apart from the work and may overtake it anywhere; otherwise it
 *               waits its turn on the ring's links, which is kinder: a rule that is safe apart is
 *               safe there too.
 *   -DLOSSY     the first message of all is lost: rank 0 must never call the farm quiet, and in the
 *               end call the message lost.
 *   -DHASTY     nothing is lost, but rank 0 judges losses all the same: spin finds how two white
 *               rounds with one sum pass while a slow message is under way. So a loss is only ever
 *               suspected.
 *   -DLIVE      adds the claim that there is a verdict in the end, under weak fairness.
 */
#ifndef N
#define N 3
#endif
#if N < 2 || N > 3
#error "nodes have links to the two nodes beside them on the ring, and there must be no others"
#endif
#ifndef WORK
#define WORK 3  /* messages, of all nodes together */
#endif
#ifndef ROOM
#define ROOM 2  /* messages on a link */
#endif

#define NEXT(i) ((i + 1) % N)
#define BEFORE(i) ((i + N - 1) % N)
#define LINK(from, to) ((from) * N + (to))
#ifdef APART
#define RING(i) (N * N + (i))  /* from the node before to node i */
#define LINKS (N * N + N)
#else
#define RING(i) LINK(BEFORE(i), i)
#define LINKS (N * N)
#endif

/* is it the token; and if so: black, count, contribution batches */
chan link[LINKS] = [ROOM] of { bool, bool, short, byte };

byte budget = WORK;
byte in_flight = 0;        /* work on links, known to the checker alone */
byte batches_sent = 0;     /* of all nodes, known to the checker alone */
bool working[N] = true;
bool black[N];
short count[N];
byte batches[N];
bool holds[N];             /* the token, with these values */
bool token_black[N];
short token_count[N];
byte token_batches[N];
bool quiet = false, lost = false;

inline send_work(i, j) {
  budget--;
  count[i]++;
#if defined(PLAIN)
  black[i] = true;
#endif
#ifdef LOSSY
  if
  :: budget == WORK - 1 -> skip
  :: else -> in_flight++; link[LINK(i, j)]!false, false, 0, 0
  fi
#else
  in_flight++;
  link[LINK(i, j)]!false, false, 0, 0
#endif
}

inline receive(i, l) {
  link[l]?is_token, is_black, sum, held;
  if
  :: is_token ->
     holds[i] = true; token_black[i] = is_black; token_count[i] = sum; token_batches[i] = held
  :: else ->
     in_flight--; count[i]--; working[i] = true
#if !defined(PLAIN) && !defined(NOCOLOUR)
     ; black[i] = true
#endif
  fi;
  is_token = false; is_black = false; sum = 0; held = 0  /* fewer states */
}

/* Traces rays, so to speak. Before it turns passive a node flushes its contributions. */
proctype Worker(byte i) {
end:
  do
  :: atomic { working[i] && budget > 0 && nfull(link[LINK(i, NEXT(i))]) -> send_work(i, NEXT(i)) }
#if N > 2
  :: atomic { working[i] && budget > 0 && nfull(link[LINK(i, BEFORE(i))]) ->
       send_work(i, BEFORE(i)) }
#endif
  :: atomic { working[i] -> batches[i]++; batches_sent++; working[i] = false }
  od
}

/* A process for each link, so that weak fairness lets no link wait for ever behind another. */
proctype Inbox(byte i; byte l) {
  bool is_token, is_black;
  short sum;
  byte held;
end:
  do
  :: atomic { nempty(link[l]) -> receive(i, l) }
  od
}

inline hand_on(i, is_black, sum, held) {
  link[RING(NEXT(i))]!true, is_black, sum, held;
  black[i] = false
}

proctype Member(byte i) {
end:
  do
  :: atomic { holds[i] && !working[i] && nfull(link[RING(NEXT(i))]) ->
       hand_on(i, token_black[i] || black[i], token_count[i] + count[i],
               token_batches[i] + batches[i]);
       holds[i] = false; token_black[i] = false; token_count[i] = 0; token_batches[i] = 0 }
  od
}

#ifdef PLAIN
#define BALANCED(sum) true
#else
#define BALANCED(sum) (sum == 0)
#endif

/* No `end` label before the verdict: a ring that stops without one is an invalid end state. */
proctype Initiator() {
  bool white;
  short sum, stalled_sum;
  atomic { !working[0] && nfull(link[RING(NEXT(0))]) -> hand_on(0, false, 0, 0) }
  do
  :: atomic { holds[0] && !working[0] && nfull(link[RING(NEXT(0))]) ->
       white = !token_black[0] && !black[0];
       sum = token_count[0] + count[0];
       if
       :: white && BALANCED(sum) ->
          byte i;
          for (i : 0 .. (N - 1)) { assert(!working[i]) }
          assert(in_flight == 0);
#if !defined(PLAIN) && !defined(NOCOLOUR)
          assert(token_batches[0] + batches[0] == batches_sent);
#endif
#ifdef LOSSY
          assert(budget == WORK);  /* quiet only if nothing was ever sent, so nothing lost */
#endif
          quiet = true;
          break
#if defined(LOSSY) || defined(HASTY)
       :: white && sum != 0 && sum == stalled_sum ->
#ifdef HASTY
          assert(in_flight == 0);
#endif
          lost = true;
          break
#endif
       :: else ->
          stalled_sum = (white -> sum : 0);
          white = false; sum = 0;
          holds[0] = false; token_black[0] = false; token_count[0] = 0; token_batches[0] = 0;
          hand_on(0, false, 0, 0)
       fi }
  od
}

init {
  byte i;
  atomic {
    for (i : 0 .. (N - 1)) {
      run Worker(i);
      run Inbox(i, LINK(BEFORE(i), i));
#if N > 2
      run Inbox(i, LINK(NEXT(i), i));
#endif
#ifdef APART
      run Inbox(i, RING(i));
#endif
    }
    for (i : 1 .. (N - 1)) { run Member(i) }
    run Initiator();
    i = 0
  }
}

#ifdef LIVE
ltl verdict_in_the_end { <> (quiet || lost) }
#endif
