#include "compiler/commands/spectrum_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace rg::commands {
namespace {

constexpr double kWidth = 720, kHeight = 240, kLeft = 56, kBottom = 34, kTop = 14;

constexpr const char* kStyle =
    "body{font:15px/1.5 system-ui,sans-serif;max-width:72rem;margin:2rem auto;padding:0 1rem;color:#1b1f24;background:#fff}"
    "h1{font-size:1.5rem}h2{font-size:1.1rem;margin-top:2rem}"
    "table{border-collapse:collapse;margin:1rem 0;font-size:14px}td,th{padding:.15rem .6rem;border-bottom:1px solid #d7dbe0;text-align:left}"
    "th.f{vertical-align:bottom;height:7.5rem;padding:0 .2rem;width:1.4rem}th.f "
    "span{writing-mode:vertical-rl;transform:rotate(180deg);font-weight:400}"
    "td.f{text-align:center;padding:0 .2rem}td.n{text-align:right;font-variant-numeric:tabular-nums}"
    ".has{display:inline-block;width:11px;height:11px;border-radius:50%;background:#3b6ea8}"
    ".vain{display:inline-block;width:7px;height:7px;border-radius:50%;border:2px solid #c8641b}"
    ".chip{display:inline-block;min-width:1.5rem;text-align:center;border-radius:4px;color:#111;padding:0 .3rem}"
    ".share{display:inline-block;height:9px;background:#3b6ea8;margin-right:.4rem}"
    "svg{margin:.5rem 0;max-width:100%;height:auto}text{font:12px system-ui,sans-serif;fill:#56606b}"
    ".line{fill:none;stroke:#3b6ea8;stroke-width:2}.dot{fill:#3b6ea8}.now{fill:#c8641b}.grid{stroke:#d7dbe0}.floor{stroke:#56606b;stroke-dasharray:4 "
    "4}"
    ".note{color:#56606b}"
    "@media(prefers-color-scheme:dark){body{color:#e2e6ea;background:#14181d}td,th{border-color:#343b44}text{fill:#9aa3ad}.grid{stroke:#343b44}"
    ".note{color:#9aa3ad}}";

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) out += c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '&' ? "&amp;" : c == '"' ? "&quot;" : std::string(1, c);
  return out;
}

// Hues a golden angle apart, as the debug view of the demo has them.
std::string color_of(uint32_t kernel) {
  const double hue = std::fmod(kernel * 0.618034 + 0.6, 1.0) * 360;
  return fmt::format("hsl({:.0f} 65% 66%)", hue);
}
std::string chip(uint32_t kernel) { return fmt::format("<span class=chip style='background:{}'>{}</span>", color_of(kernel), kernel); }

// ---- what one more kernel is worth

struct Scale {
  double least = 0, most = 1;
  double y(double cost) const { return kTop + (kHeight - kTop - kBottom) * (most - cost) / (most - least); }
};

// Costs do not begin at zero: what matters is how much of the way from one kernel to a kernel for every mask is gone.
Scale scale_of(const SpectrumFacts& facts) {
  const double most = std::max(facts.one_kernel, facts.curve.empty() ? 0 : facts.curve.front()),
               spread = std::max(most - facts.kernel_per_mask, 1e-9 * most);
  return {facts.kernel_per_mask - 0.08 * spread, most + 0.05 * spread};
}

std::string grid_lines(const Scale& scale) {
  std::string text;
  for (int i = 0; i <= 4; ++i) {
    const double cost = scale.least + (scale.most - scale.least) * i / 4, y = scale.y(cost);
    text += fmt::format("<line class=grid x1={} x2={} y1='{:.1f}' y2='{:.1f}'/><text x={} y='{:.1f}' text-anchor=end>{:.4g}</text>", kLeft, kWidth, y,
                        y, kLeft - 6, y + 4, cost);
  }
  return text;
}

std::string curve_plot(const SpectrumFacts& facts) {
  const Scale scale = scale_of(facts);
  const double step = (kWidth - kLeft - 30) / std::max<double>(1, static_cast<double>(facts.curve.size()) - 1);
  std::string points, marks;
  for (size_t k = 0; k < facts.curve.size(); ++k) {
    const double x = kLeft + 12 + step * static_cast<double>(k), y = scale.y(facts.curve[k]);
    const double saved = k == 0 ? 0 : 100 * (1 - facts.curve[k] / facts.curve[k - 1]);
    points += fmt::format("{:.1f},{:.1f} ", x, y);
    marks += fmt::format("<circle class={} cx='{:.1f}' cy='{:.1f}' r=4><title>{} kernels: {:.5g}, {:.2f} % less than with one fewer</title></circle>",
                         k + 1 == facts.kernels.size() ? "now" : "dot", x, y, k + 1, facts.curve[k], saved);
    marks += fmt::format("<text x='{:.1f}' y='{:.0f}' text-anchor=middle>{}</text>", x, kHeight - kBottom + 16, k + 1);
  }
  const double floor = scale.y(facts.kernel_per_mask);
  return fmt::format("<svg viewBox='0 0 {0} {1}' width={0} height={1} role=img aria-label='expected cost by number of kernels'>{2}", kWidth, kHeight,
                     grid_lines(scale)) +
         fmt::format(
             "<line class=floor x1={0} x2={1} y1='{2:.1f}' y2='{2:.1f}'/><text x={1} y='{3:.1f}' text-anchor=end>a kernel for every mask</text>",
             kLeft, kWidth, floor, floor - 5) +
         fmt::format("<polyline class=line points='{}'/>{}<text x={} y={} text-anchor=end>kernels</text></svg>", points, marks, kWidth, kHeight - 4);
}

// ---- tables

std::string feature_heads(const SpectrumFacts& facts) {
  std::string text;
  for (const std::string& feature : facts.features) text += "<th class=f><span>" + escaped(feature) + "</span>";
  return text;
}
std::string feature_cells(const SpectrumFacts& facts, uint32_t has, uint32_t in_vain) {
  std::string text;
  for (size_t i = 0; i < facts.features.size(); ++i)
    text += std::string("<td class=f>") + (has >> i & 1 ? "<span class=has></span>" : in_vain >> i & 1 ? "<span class=vain></span>" : "");
  return text;
}
std::string share_cell(double share, double largest) {
  return fmt::format("<td><span class=share style='width:{:.0f}px'></span>{:.2f} %", largest > 0 ? 120 * share / largest : 0, 100 * share);
}

std::string kernel_table(const SpectrumFacts& facts) {
  double largest = 0;
  for (const KernelFacts& kernel : facts.kernels) largest = std::max(largest, kernel.share);
  std::string rows;
  for (uint32_t k = 0; k < facts.kernels.size(); ++k) {
    const KernelFacts& kernel = facts.kernels[k];
    rows += "<tr><td>" + chip(k) + share_cell(kernel.share, largest) + fmt::format("<td class=n>{:.4g}", kernel.cost) +
            feature_cells(facts, kernel.set, 0);
  }
  return "<table><tr><th>kernel<th>tiles<th>cost" + feature_heads(facts) + rows + "</table>";
}

std::string mask_table(const SpectrumFacts& facts) {
  constexpr size_t kShown = 100;
  const size_t shown = std::min(kShown, facts.masks.size());
  std::string rows;
  for (size_t i = 0; i < shown; ++i) {
    const MaskFacts& row = facts.masks[i];
    rows += "<tr>" + share_cell(row.share, facts.masks[0].share) + "<td>" + chip(row.kernel) +
            fmt::format("<td class=n>{:.4g}<td class=n>{:.4g}<td class=n>{}", row.cost, row.own,
                        row.cost > row.own * (1 + 1e-9) ? fmt::format("+{:.1f} %", 100 * (row.cost / row.own - 1)) : "") +
            feature_cells(facts, row.mask, row.superfluous);
  }
  std::string text = "<p class=note><span class=has></span> a lamp of the tile has it, <span class=vain></span> its kernel has it in vain</p>";
  text += "<table><tr><th>tiles<th>kernel<th>cost<th>its own<th>in vain" + feature_heads(facts) + rows + "</table>";
  if (shown < facts.masks.size()) text += fmt::format("<p class=note>and {} more</p>", facts.masks.size() - shown);
  return text;
}

std::string costs_text(const SpectrumFacts& facts) {
  if (facts.costs == "times") return "measured times";
  return facts.costs == "statistics" ? "estimated from instructions and registers" : "measured times, and estimates in their unit";
}

std::string section(const SpectrumFacts& facts) {
  std::string scenes;
  for (const std::string& scene : facts.scenes) scenes += (scenes.empty() ? "" : ", ") + scene;
  std::string text = fmt::format("<h1>{} of {}</h1>", escaped(facts.name), escaped(facts.pass));
  text += facts.measured ? fmt::format("<p>{:.0f} tiles: {}.", facts.tiles, escaped(scenes))
                         : std::string("<p>No profile: tiles are assumed, not measured.");
  text +=
      fmt::format(" Costs are {}. Expected: <b>{:.4g}</b> a tile, {}; one kernel for all {:.4g} ({:.2f} times), a kernel for every mask {:.4g}.</p>",
                  costs_text(facts), facts.expected,
                  facts.exact ? "the optimum" : fmt::format("within {:.2f} % of the optimum", 100 * (facts.expected - facts.bound) / facts.expected),
                  facts.one_kernel, facts.one_kernel / facts.expected, facts.kernel_per_mask);
  text +=
      "<h2>What one more kernel is worth</h2>" + curve_plot(facts) + "<h2>Kernels, in the order in which they are tried</h2>" + kernel_table(facts);
  return text + "<h2>What tiles ask for</h2>" + mask_table(facts);
}

}  // namespace

std::string SpectrumFacts::names(uint32_t set) const {
  std::string text;
  for (size_t i = 0; i < features.size(); ++i)
    if (set >> i & 1) text += (text.empty() ? "" : " ") + features[i];
  return text.empty() ? "nothing" : text;
}

std::string spectrum_page(const std::vector<SpectrumFacts>& spectra) {
  std::string body;
  for (const SpectrumFacts& facts : spectra) body += section(facts);
  return fmt::format("<!doctype html><html lang=en><meta charset=utf-8><title>rgc spectrum</title><style>{}</style>{}</html>\n", kStyle, body);
}

}  // namespace rg::commands
