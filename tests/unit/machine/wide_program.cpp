#include "wide_program.h"

#include <fmt/format.h>

#include <algorithm>
#include <random>
#include <vector>

namespace rg::test {
namespace {

class Generator {
 public:
  explicit Generator(uint64_t seed) : random_(seed) {}

  std::string make(uint32_t pieces) {
    for (uint32_t i = 0; i < pieces; ++i) add_piece(i);
    const std::string end = finish(), down = queue();
    return "module wide\nextent view = runtime(64, 32) max(128, 64)\nfeature rich: bool\ncondition sometimes\ncondition rarely\n"
           "interface Scene {\n  table: buffer u32[64] ready as storage in compute\n  maps: image rgba8 64x64 ready as sampled in fragment\n}\n"
           "technique halve(image source, inout image target) {\n  image half : rgba16f source / 2\n"
           "  pass down : compute" +
           down +
           " { read source as sampled  write half as storage }\n"
           "  pass up : compute { read half as sampled  update target as storage }\n}\n"
           "graph frame(scene: Scene, surface backbuffer: rgba8 view) {\n  buffer found : u32[64] readback\n" +
           text_ + end + "}\n";
  }

 private:
  uint32_t below(uint32_t n) { return static_cast<uint32_t>(random_() % n); }
  bool chance(uint32_t one_in) { return below(one_in) == 0; }
  // Each in a statement of its own, so that a seed gives the same program whichever compiler orders arguments.
  std::string queue() { return chance(2) ? "" : chance(4) ? " queue compute" : " queue compute may"; }
  std::string copies() { return chance(2) ? "" : chance(2) ? " queue transfer may" : " queue compute may"; }
  void line(const std::string& text) { text_ += "  " + text + "\n"; }
  void image(const std::string& name) { images_.push_back(name); }
  void buffer(const std::string& name) { buffers_.push_back(name); }
  bool any(const std::vector<std::string>& names, std::string& name) {
    if (!names.empty()) name = names[below(static_cast<uint32_t>(names.size()))];
    return !names.empty();
  }
  // Reads of what there is, for a pass that runs `in` these stages.
  std::string some_reads(const std::string& in) {
    std::string text, name;
    if (chance(2) && any(images_, name)) text += fmt::format("  read ri = {} as sampled in {}", name, in);
    if (chance(2) && any(buffers_, name)) text += fmt::format("  read rb = {} as {} in {}", name, chance(3) ? "uniform" : "storage", in);
    if (chance(6) && in == "fragment") text += "  read scene.table as storage in " + in;
    return text;
  }

  void add_piece(uint32_t i) {
    switch (below(15)) {
      case 0:
        return add_chain(i);
      case 1:
        return add_stencil(i);
      case 2:
        return add_indirect(i);
      case 3:
        return add_sharers(i, "update", " disjoint");
      case 4:
        return add_sharers(i, "atomic", "");
      case 5:
        return add_feature();
      case 6:
        return add_condition();
      case 7:
        return add_copies(i);
      case 8:
        return add_resolve(i);
      case 9:
        return add_technique();
      case 10:
        return add_history(i);
      case 11:
        return add_halves(i);
      case 12:
        return add_host(i);
      case 13:
        return add_async(i);
      default:
        return add_draw(i);
    }
  }

  void add_chain(uint32_t i) {
    line(fmt::format("image c{} : rgba16f view mips 6{}", i, chance(4) ? " no alias" : ""));
    const std::string reads = some_reads("compute"), on = queue();
    line(fmt::format("pass c{}_first : compute{} {{ write c{}.mip(0) as storage{} }}", i, on, i, reads));
    line(
        fmt::format("for mip in 1..mips(c{}) {{ pass c{}_down[mip] : compute{} {{ read source = c{}.mip(mip - 1) as sampled  write target = "
                    "c{}.mip(mip) as storage }} }}",
                    i, i, queue(), i, i));
    line(fmt::format("pass c{}_use : raster {{ read c{} as sampled in fragment  color backbuffer clear 0 }}", i, i));
  }

  void add_stencil(uint32_t i) {
    line(fmt::format("image s{} : d32f_s8 view", i));
    line(fmt::format("pass s{}_mark : raster {{ depth s{} clear 0.0  stencil s{} clear 0{} }}", i, i, i, some_reads("vertex, fragment")));
    if (chance(2))
      line(fmt::format("pass s{}_test : raster {{ depth s{} readonly  read d = s{} as sampled in fragment  color backbuffer clear 0 }}", i, i, i));
    line(fmt::format("buffer s{}_out : u32[64]", i));
    line(fmt::format("pass s{}_look : compute{} {{ read s = s{}.stencil as sampled  write s{}_out as storage }}", i, queue(), i, i));
    buffer(fmt::format("s{}_out", i));
  }

  void add_indirect(uint32_t i) {
    line(fmt::format("buffer a{} : u32[64]", i));
    line(
        fmt::format("pass a{}_fill : {} }}", i,
                    chance(2) ? fmt::format("transfer{} {{ fill a{} 1", copies(), i) : fmt::format("compute{} {{ write a{} as storage", queue(), i)));
    const std::string reads = some_reads("compute"), on = queue();
    line(fmt::format("pass a{}_go : compute{} {{ read args = a{} as indirect{} update scratch as storage }}", i, on, i, reads));
    need_scratch();
    buffer(fmt::format("a{}", i));
  }

  void add_sharers(uint32_t i, const std::string& verb, const std::string& how) {
    line(fmt::format("buffer h{} : u32[128]", i));
    line(fmt::format("pass h{}_zero : transfer{} {{ fill h{} 0 }}", i, copies(), i));
    for (uint32_t n = 0; n < 2 + below(2); ++n)
      line(fmt::format("pass h{}_{} : {} {{ {} h{} as storage in {}{} {} }}", i, n, n == 1 ? "raster" : "compute", verb, i,
                       n == 1 ? "fragment" : "compute", how, n == 1 ? "color backbuffer clear 0" : some_reads("compute")));
    buffer(fmt::format("h{}", i));
  }

  void add_feature() {
    std::string name;
    if (!any(buffers_, name)) return;
    const std::string copying = copies(), computing = queue();
    line(fmt::format("when rich {{ pass f{} : compute{} {{ update {} as storage }} }} else {{ pass g{} : transfer{} {{ fill {} 3 }} }}", count_,
                     computing, name, count_, copying, name));
    ++count_;
  }

  void add_condition() {
    std::string name;
    if (!any(chance(2) ? buffers_ : images_, name)) return;
    const std::string on = queue(), when = chance(2) ? "sometimes" : "rarely";
    line(fmt::format("if host {} {{ pass i{} : compute{} {{ update {} as storage }} }}", when, count_++, on, name));
  }

  void add_copies(uint32_t i) {
    line(fmt::format("image k{} : rgba16f view", i));
    line(fmt::format("image k{}_to : rgba16f view", i));
    line(fmt::format("pass k{}_make : raster {{ color k{} clear (0, 1, 0, 1){} }}", i, i, some_reads("fragment")));
    line(fmt::format("pass k{}_copy : transfer{} {{ copy k{} -> k{}_to }}", i, copies(), i, i));
    if (chance(2)) line(fmt::format("pass k{}_blit : transfer {{ blit k{}_to -> k{} linear }}", i, i, i));
    image(fmt::format("k{}", i)), image(fmt::format("k{}_to", i));
  }

  void add_resolve(uint32_t i) {
    line(fmt::format("image m{} : rgba16f view samples 4", i));
    line(fmt::format("image m{}_flat : rgba16f view", i));
    const std::string reads = some_reads("fragment");
    if (chance(2)) {
      line(fmt::format("pass m{}_draw : raster {{ color m{} clear 0  resolve m{} -> m{}_flat{} }}", i, i, i, i, reads));
    } else {  // passes of their own, which the rendering may take in
      line(fmt::format("pass m{}_wipe : transfer{} {{ clear m{} 0 }}", i, chance(4) ? " queue compute may" : "", i));
      line(fmt::format("pass m{}_draw : raster {{ color m{}{} }}", i, i, reads));
      line(fmt::format("pass m{}_resolve : transfer {{ resolve m{} -> m{}_flat }}", i, i, i));
    }
    image(fmt::format("m{}_flat", i));
  }

  void add_technique() {
    std::string from, to;
    if (!any(images_, from) || !any(images_, to) || from == to) return;
    line(fmt::format("use t{} = halve({}, {})", count_++, from, to));
  }

  void add_history(uint32_t i) {
    line(fmt::format("image p{} : rgba16f view history {} init clear 0", i, 1 + below(2)));
    const std::string reads = some_reads("compute"), on = queue();
    line(fmt::format("pass p{}_step : compute{} {{ read was = p{}.prev(1) as sampled  write p{} as storage{} }}", i, on, i, i, reads));
    image(fmt::format("p{}", i));
  }

  void add_halves(uint32_t i) {
    line(fmt::format("buffer b{} : u32[128]{}", i, chance(4) ? " persistent init clear 0" : ""));
    const std::string reads = some_reads("compute"), on = queue();
    line(fmt::format("pass b{}_low : compute{} {{ write b{}.bytes(0, 256) as storage{} }}", i, on, i, reads));
    line(fmt::format("pass b{}_high : {} }}", i,
                     chance(2) ? fmt::format("compute{} {{ write b{}.bytes(256, 256) as storage", queue(), i)
                               : fmt::format("raster {{ write b{}.bytes(256, 256) as storage in fragment covers  color backbuffer clear 0", i)));
    buffer(fmt::format("b{}", i));
  }

  void add_host(uint32_t i) {
    line(fmt::format("buffer o{} : u32[64] output", i));
    const std::string keep = chance(4) ? "  keep" : "", reads = some_reads("compute"), on = queue();
    line(fmt::format("pass o{}_make : compute{} {{ write o{} as storage{}{} }}", i, on, i, reads, keep));
    buffer(fmt::format("o{}", i));
  }

  // A pass that may overlap, and one that is declared to follow it.
  void add_async(uint32_t i) {
    line(fmt::format("image q{} : rgba16f view", i));
    line(fmt::format("buffer q{}_b : u32[64]", i));
    line(fmt::format("pass q{}_one : compute queue compute may {{ write q{} as storage }}", i, i));
    const std::string after = chance(2) ? fmt::format("  after q{}_one", i) : "", on = queue();
    line(fmt::format("pass q{}_two : compute{} {{ write q{}_b as storage{} }}", i, on, i, after));
    image(fmt::format("q{}", i)), buffer(fmt::format("q{}_b", i));
  }

  void add_draw(uint32_t i) {
    line(fmt::format("image d{} : rgba16f view{} layers 2", i, chance(2) ? " / 2" : ""));
    for (const int layer : {0, 1})
      line(fmt::format("pass d{}_{} : {} }}", i, layer,
                       chance(2) ? fmt::format("raster {{ color d{}.layer({}) clear 0{}", i, layer, some_reads("fragment"))
                                 : fmt::format("compute{} {{ write d{}.layer({}) as storage", queue(), i, layer)));
    image(fmt::format("d{}", i));
  }

  void need_scratch() {
    if (has_scratch_) return;
    has_scratch_ = true;
    text_ = "  buffer scratch : u32[64]\n  pass scratch_zero : transfer { fill scratch 0 }\n" + text_;
    buffer("scratch");
  }

  // Everything is read, so that most of it lives.
  std::string finish() {
    std::string text = "  pass resolve : compute {\n    write found as storage\n";
    for (const auto* names : {&images_, &buffers_})
      for (const std::string& name : *names)
        if (!chance(5)) text += fmt::format("    read {} as {}\n", name, names == &images_ ? "sampled" : "storage");
    return text + "  }\n  pass show : raster {\n    color backbuffer clear 0\n    read scene.maps as sampled in fragment\n  }\n";
  }

  std::mt19937_64 random_;
  std::string text_;
  std::vector<std::string> images_, buffers_;
  uint32_t count_ = 0;
  bool has_scratch_ = false;
};

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  for (size_t at = 0; at < text.size();) {
    const size_t end = std::min(text.find('\n', at), text.size());
    lines.push_back(text.substr(at, end - at));
    at = end + 1;
  }
  return lines;
}
std::string text_of(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  return text;
}

}  // namespace

std::string make_wide_program(uint64_t seed, uint32_t pieces) { return Generator(seed).make(pieces); }

std::string shrink(std::string text, const std::function<bool(const std::string&)>& fails) {
  std::vector<std::string> lines = lines_of(text);
  for (size_t size = std::max<size_t>(lines.size() / 2, 1); size > 0; size /= 2)
    for (size_t at = 0; at + size <= lines.size();) {
      std::vector<std::string> less = lines;
      less.erase(less.begin() + static_cast<ptrdiff_t>(at), less.begin() + static_cast<ptrdiff_t>(at + size));
      if (fails(text_of(less)))
        lines = std::move(less);
      else
        ++at;
    }
  return text_of(lines);
}

}  // namespace rg::test
