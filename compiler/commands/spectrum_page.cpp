#include "compiler/commands/spectrum_page.h"

#include <fmt/format.h>

#include <algorithm>

namespace rg::commands {
namespace {

constexpr double kWidth = 640, kHeight = 220, kLeft = 60, kBottom = 30;

constexpr const char* kStyle =
    "body{font:15px/1.5 system-ui,sans-serif;max-width:60rem;margin:2rem auto;padding:0 1rem;color:#1b1f24;background:#fff}"
    "table{border-collapse:collapse;margin:1rem 0}td,th{padding:.2rem .8rem;border-bottom:1px solid #d7dbe0;text-align:left}"
    "td.n{text-align:right;font-variant-numeric:tabular-nums}svg{margin:.5rem 0}text{font:12px system-ui,sans-serif;fill:#56606b}"
    ".bar{fill:#3b6ea8}.extra{color:#9a4b00}.line{fill:none;stroke:#3b6ea8;stroke-width:2}.floor{stroke:#9aa3ad;stroke-dasharray:4 4}"
    "@media(prefers-color-scheme:dark){body{color:#e2e6ea;background:#14181d}td,th{border-color:#343b44}text{fill:#9aa3ad}.extra{color:#f0a35e}}";

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) out += c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '&' ? "&amp;" : c == '"' ? "&quot;" : std::string(1, c);
  return out;
}

double y_of(double cost, double most) { return kHeight - kBottom - (kHeight - kBottom - 10) * cost / most; }

// Expected cost over the number of kernels, with the cost of a kernel for every mask as its floor.
std::string curve_plot(const SpectrumFacts& facts) {
  const double most = std::max(facts.one_kernel, facts.curve.empty() ? 1.0 : facts.curve.front()) * 1.05;
  const double step = (kWidth - kLeft - 20) / std::max<double>(1, static_cast<double>(facts.curve.size()) - 1);
  std::string points, marks;
  for (size_t k = 0; k < facts.curve.size(); ++k) {
    const double x = kLeft + step * static_cast<double>(k), y = y_of(facts.curve[k], most);
    points += fmt::format("{:.1f},{:.1f} ", x, y);
    marks += fmt::format(
        "<circle class=bar cx='{:.1f}' cy='{:.1f}' r=3><title>{} kernels: {:.4g}</title></circle>"
        "<text x='{:.1f}' y='{:.0f}' text-anchor=middle>{}</text>",
        x, y, k + 1, facts.curve[k], x, kHeight - 10, k + 1);
  }
  const double floor = y_of(facts.kernel_per_mask, most);
  return fmt::format(
      "<svg viewBox='0 0 {0} {1}' width={0} height={1} role=img aria-label='expected cost by number of kernels'>"
      "<line class=floor x1={2} x2={0} y1='{3:.1f}' y2='{3:.1f}'/><text x={2} y='{4:.1f}'>a kernel for every mask</text>"
      "<polyline class=line points='{5}'/>{6}<text x=0 y=14>{7:.4g}</text></svg>",
      kWidth, kHeight, kLeft, floor, floor - 4, points, marks, most);
}

// Share of the tiles of each kernel.
std::string share_plot(const SpectrumFacts& facts) {
  constexpr double kRow = 22;
  std::string bars;
  for (size_t k = 0; k < facts.kernels.size(); ++k) {
    const double y = kRow * static_cast<double>(k), width = (kWidth - 200) * facts.kernels[k].share;
    bars += fmt::format(
        "<rect class=bar x=30 y='{:.0f}' width='{:.1f}' height=16 /><text x=0 y='{:.0f}'>{}</text><text x='{:.1f}' y='{:.0f}'>{:.1f} %  {}</text>", y,
        width, y + 13, k, 36 + width, y + 13, 100 * facts.kernels[k].share, escaped(facts.kernels[k].features));
  }
  const double height = kRow * static_cast<double>(facts.kernels.size());
  return fmt::format("<svg viewBox='0 0 {0} {1}' width={0} height={1} role=img aria-label='tiles by kernel'>{2}</svg>", kWidth, height, bars);
}

std::string mask_table(const SpectrumFacts& facts) {
  constexpr size_t kShown = 100;
  std::string rows;
  for (size_t i = 0; i < std::min(kShown, facts.masks.size()); ++i) {
    const MaskFacts& row = facts.masks[i];
    rows += fmt::format("<tr><td class=n>{:.2f} %<td class=n>{}<td>{}<td class=extra>{}", 100 * row.share, row.kernel, escaped(row.features),
                        escaped(row.superfluous));
  }
  return "<table><tr><th>tiles<th>kernel<th>features of the tile<th>paid for in vain" + rows + "</table>";
}

std::string section(const SpectrumFacts& facts) {
  std::string text = fmt::format("<h1>{} of {}</h1>", escaped(facts.name), escaped(facts.pass));
  text += facts.measured ? fmt::format("<p>{:.0f} tiles in {} scenes.", facts.tiles, facts.scenes.size())
                         : std::string("<p>No profile: tiles are assumed, not measured.");
  text +=
      fmt::format(" Expected cost {:.4g}, {}; one kernel for all costs {:.4g} ({:.2f} times), a kernel for every mask {:.4g}.</p>", facts.expected,
                  facts.exact ? "the optimum" : fmt::format("within {:.2f} % of the optimum", 100 * (facts.expected - facts.bound) / facts.expected),
                  facts.one_kernel, facts.one_kernel / facts.expected, facts.kernel_per_mask);
  text += "<h2>What one more kernel is worth</h2>" + curve_plot(facts) + "<h2>Tiles by kernel</h2>" + share_plot(facts);
  return text + "<h2>Masks</h2>" + mask_table(facts);
}

}  // namespace

std::string spectrum_page(const std::vector<SpectrumFacts>& spectra) {
  std::string body;
  for (const SpectrumFacts& facts : spectra) body += section(facts);
  return fmt::format("<!doctype html><html lang=en><meta charset=utf-8><title>rgc spectrum</title><style>{}</style>{}</html>\n", kStyle, body);
}

}  // namespace rg::commands
