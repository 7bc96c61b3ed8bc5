#include "subdivisions/span_list.hpp"

#include <algorithm>

namespace graycube {

SpanList push_spans(SpanStack& stack, const Spans& spans, std::uint32_t primitive, bool is_inverted,
                    double t0, double t1) {
  SpanList list{is_inverted, stack.size(), stack.size()};
  const auto add = [&](double t) {
    if (!(t < t1)) return;
    if (t < t0) {
      list.begins_inside = !list.begins_inside;
    } else if (stack.size() > list.first && stack.back().t == t) {
      stack.pop_back();
    } else {
      stack.push_back({t, primitive});
    }
  };
  for (int i = 0; i < spans.count; ++i) {
    add(spans.interval[static_cast<std::size_t>(i)].enter);
    add(spans.interval[static_cast<std::size_t>(i)].leave);
  }
  list.end = stack.size();
  return list;
}

SpanList combine(SpanStack& stack, const SpanList& a, const SpanList& b, bool is_and) {
  const auto joined = [&](bool in_a, bool in_b) { return is_and ? in_a && in_b : in_a || in_b; };
  bool in_a = a.begins_inside, in_b = b.begins_inside;
  bool inside = joined(in_a, in_b);
  const SpanList result{inside, a.first, 0};
  const std::size_t out = stack.size();
  for (std::size_t i = a.first, k = b.first; i < a.end || k < b.end;) {
    const bool takes_a = i < a.end && !(k < b.end && stack[k].t < stack[i].t);
    const bool takes_b = k < b.end && !(i < a.end && stack[i].t < stack[k].t);
    const SpanEnd next = takes_a ? stack[i] : stack[k];
    if (takes_a) {
      in_a = !in_a;
      ++i;
    }
    if (takes_b) {
      in_b = !in_b;
      ++k;
    }
    if (joined(in_a, in_b) == inside) continue;
    inside = !inside;
    stack.push_back(next);
  }
  const auto at = [&](std::size_t i) { return stack.begin() + static_cast<std::ptrdiff_t>(i); };
  stack.erase(at(result.first), at(out));
  return {result.begins_inside, result.first, stack.size()};
}

}  // namespace graycube
