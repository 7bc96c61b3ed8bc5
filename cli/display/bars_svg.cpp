#include "cli/display/bars_svg.hpp"

#include <algorithm>
#include <array>
#include <cstdio>

namespace graycube {
namespace {

constexpr double kLeft = 190, kTop = 54, kWidth = 640, kHeight = 84, kGap = 34, kMaxBar = 36;

struct Part {
  const char* name;
  const char* color;
  double NodeTimes::*seconds;
};
constexpr std::array<Part, 5> kParts{{{"busy", "#2b8a3e", &NodeTimes::busy_s},
                                      {"blocked", "#c92a2a", &NodeTimes::blocked_s},
                                      {"FIFO", "#1864ab", &NodeTimes::fifo_wait_s},
                                      {"window", "#f08c00", &NodeTimes::window_s},
                                      {"idle", "#ced4da", &NodeTimes::idle_s}}};

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '<': out += "&lt;"; break;
      case '>': out += "&gt;"; break;
      case '&': out += "&amp;"; break;
      default: out += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
    }
  }
  return out;
}

std::string text_at(double x, double y, const std::string& text, int size = 13) {
  char head[128];
  std::snprintf(head, sizeof head, "<text x=\"%.1f\" y=\"%.1f\" font-size=\"%d\">", x, y, size);
  return head + escaped(text) + "</text>\n";
}

std::string rectangle(double x, double y, double width, double height, const char* color) {
  char line[192];
  std::snprintf(line, sizeof line,
                "<rect x=\"%.2f\" y=\"%.2f\" width=\"%.2f\" height=\"%.2f\" fill=\"%s\"/>\n", x, y,
                width, height, color);
  return line;
}

/// The parts of these rows' bars: none for FIFOs where none is a process apart.
std::vector<Part> parts_of(const std::vector<ComparedRow>& rows) {
  bool have_fifos = false;
  for (const ComparedRow& row : rows) {
    if (row.statistics.empty()) continue;
    for (const NodeTimes& node : figures_of(row.statistics).nodes)
      have_fifos = have_fifos || node.fifo_wait_s > 0;
  }
  std::vector<Part> parts(kParts.begin(), kParts.end());
  if (!have_fifos)
    std::erase_if(parts, [](const Part& p) { return p.seconds == &NodeTimes::fifo_wait_s; });
  return parts;
}

std::string node_bar(const NodeTimes& node, const std::vector<Part>& parts, double x, double y,
                     double width) {
  double total = 0;
  for (const Part& p : parts) total += node.*p.seconds;
  std::string svg;
  double bottom = y + kHeight;
  for (const Part& p : parts) {
    const double height = total > 0 ? kHeight * (node.*p.seconds) / total : 0;
    bottom -= height;
    svg += rectangle(x, bottom, width, height, p.color);
  }
  return svg;
}

}  // namespace

std::string bars_svg(const std::string& title, const std::vector<ComparedRow>& rows) {
  const double bottom = kTop + static_cast<double>(rows.size()) * (kHeight + kGap);
  char head[256];
  std::snprintf(head, sizeof head,
                "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%.0f\" height=\"%.0f\" "
                "font-family=\"sans-serif\">\n",
                kLeft + kWidth + 20, bottom);
  std::string svg = head + rectangle(0, 0, kLeft + kWidth + 20, bottom, "#ffffff");
  svg += text_at(10, 22, title, 15);
  double x = kLeft;
  const std::vector<Part> parts = parts_of(rows);
  for (const Part& p : parts) {
    svg += rectangle(x, 30, 12, 12, p.color) + text_at(x + 17, 41, p.name, 12);
    x += 90;
  }
  double y = kTop;
  for (const ComparedRow& row : rows) {
    svg += text_at(10, y + kHeight / 2, row.name);
    const bool has_bars = !row.statistics.empty();
    const bool has_picture =
        row.outcome == RowOutcome::kSame || row.outcome == RowOutcome::kReference;
    if (has_bars && !has_picture)
      svg += text_at(10, y + kHeight / 2 + 15, to_string(row.outcome), 11);
    if (!has_bars) {
      svg += text_at(kLeft, y + kHeight / 2, to_string(row.outcome) + ": " + row.why, 11);
    } else {
      const Figures f = figures_of(row.statistics);
      const double step = std::min(kMaxBar, kWidth / static_cast<double>(f.nodes.size()));
      for (std::size_t i = 0; i < f.nodes.size(); ++i) {
        svg += node_bar(f.nodes[i], parts, kLeft + static_cast<double>(i) * step, y, 0.9 * step);
      }
    }
    y += kHeight + kGap;
  }
  return svg + "</svg>\n";
}

}  // namespace graycube
