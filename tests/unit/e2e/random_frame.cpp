#include "random_frame.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <optional>
#include <random>

namespace rg::test {
namespace {

constexpr uint32_t kMultiplier = 0x9E3779B1u, kIncrement = 0x7F4A7C15u, kElements = 96;

uint32_t stir(uint32_t hash, uint32_t value) { return (hash ^ value) * kMultiplier + kIncrement; }

constexpr const char* kStir = "uint stir(uint hash, uint value) { return (hash ^ value) * 0x9E3779B1u + 0x7F4A7C15u; }\n";

struct Cell {         // one subresource of an image, or a whole buffer
  std::string place;  // "i1.mip(0).layer(1)"
  size_t resource = 0;
  uint32_t mip = 0;
  bool buffer = false;
  bool defined = false;  // in program order, so far
};
struct Declared {
  std::string name, declaration = {};
  bool buffer = false, history = false;
  uint32_t scale = 1;  // images: of the view
  std::vector<size_t> cells = {};
};

// Numbers of one frame by cell, and of the frame before.
struct Memory {
  std::vector<uint32_t> now, before;
};
using Effect = std::function<void(Memory&, std::vector<uint32_t>& found)>;

struct Source {  // something a pass reads
  std::string statement, fetch;
  std::function<uint32_t(const Memory&)> value;
};

class Generator {
 public:
  Generator(uint64_t seed, uint32_t passes) : random_(seed), passes_(passes) {}

  RandomFrame make(uint32_t frames) {
    declare();
    for (uint32_t i = 0; i < passes_; ++i) add_pass();
    finish_histories();
    RandomFrame frame;
    frame.files = files_;
    frame.files["random.rg"] = program();
    frame.probes = probes_;
    run(frames, frame);
    return frame;
  }

 private:
  uint32_t below(uint32_t n) { return static_cast<uint32_t>(random_() % n); }

  void declare() {
    const uint32_t images = 3 + below(4), buffers = 1 + below(3);
    for (uint32_t i = 0; i < images; ++i) declare_image(fmt::format("i{}", i), i == 0 && below(2) == 0);
    for (uint32_t i = 0; i < buffers; ++i) declare_buffer(fmt::format("b{}", i), i == 0 && below(2) == 0);
  }

  void declare_image(const std::string& name, bool history) {
    Declared image{.name = name, .history = history, .scale = 1 + below(2)};
    const uint32_t mips = history ? 1 : 1 + below(3), layers = history ? 1 : 1 + below(2);
    image.declaration =
        fmt::format("image {} : r32ui view / {} mips {} layers {}{}", name, image.scale, mips, layers, history ? " history 1 init clear 7" : "");
    for (uint32_t mip = 0; mip < mips; ++mip)
      for (uint32_t layer = 0; layer < layers; ++layer)
        add_cell(image, name + (mips > 1 ? fmt::format(".mip({})", mip) : "") + (layers > 1 ? fmt::format(".layer({})", layer) : ""), mip);
    declared_.push_back(image);
  }

  void declare_buffer(const std::string& name, bool history) {
    Declared buffer{.name = name, .buffer = true, .history = history};
    buffer.declaration = fmt::format("buffer {} : u32[{}]{}", name, kElements, history ? " history 1 init clear 7" : "");
    add_cell(buffer, name, 0);
    declared_.push_back(buffer);
  }

  void add_cell(Declared& declared, std::string place, uint32_t mip) {
    declared.cells.push_back(cells_.size());
    cells_.push_back({std::move(place), declared_.size(), mip, declared.buffer, false});
  }

  size_t any_cell() { return below(static_cast<uint32_t>(cells_.size())); }

  std::optional<size_t> defined_cell(const std::vector<size_t>& not_these) {
    for (int attempt = 0; attempt < 12; ++attempt) {
      const size_t cell = any_cell();
      if (!cells_[cell].defined || (cells_[cell].mip > 0 && !vanishes_with(not_these.front(), cell))) continue;
      if (std::find(not_these.begin(), not_these.end(), cell) == not_these.end()) return cell;
    }
    return std::nullopt;
  }

  // A pass that touches a mip is skipped where the image has no such mip; what it writes then must not be missed.
  bool vanishes_with(size_t target, size_t source) const {
    return cells_[target].resource == cells_[source].resource && cells_[target].mip >= cells_[source].mip;
  }

  void add_pass() {
    const size_t target = any_cell();
    switch (below(8)) {
      case 0:
        add_clear(target);
        break;
      case 1:
        add_copy(target);
        break;
      case 2:
        add_raster(target);
        break;
      case 3:
        add_atomic(target);
        break;
      default:
        add_compute(target, cells_[target].defined && below(3) == 0);
        break;
    }
    if (below(3) == 0) add_probe(target);
  }

  std::string next_name() { return fmt::format("p{}", count_++); }

  // Up to three sources: cells written before, or last frame's final contents of a history.
  std::vector<Source> pick_sources(size_t target) {
    std::vector<Source> sources;
    std::vector<size_t> taken{target};
    for (uint32_t i = below(4); i > 0; --i) {
      const std::string name = fmt::format("in{}", sources.size());
      const auto cell = defined_cell(taken);
      if (!cell) break;
      taken.push_back(*cell);
      sources.push_back(source(name, *cell, false));
    }
    for (size_t cell = 0; cell < cells_.size(); ++cell)
      if (declared_[cells_[cell].resource].history && below(3) == 0) sources.push_back(source(fmt::format("in{}", sources.size()), cell, true));
    return sources;
  }

  Source source(const std::string& name, size_t cell, bool previous) {
    const std::string place = cells_[cell].place + (previous ? ".prev(1)" : "");
    const bool storage = cells_[cell].buffer || below(4) == 0;
    Source result;
    result.statement = fmt::format("    read {} = {} as {}\n", name, place, storage ? "storage" : "sampled");
    if (cells_[cell].buffer)
      result.fetch = fmt::format("{}[min(uint(p.x), {}u)]", name, kElements - 1);
    else if (storage)
      result.fetch = fmt::format("imageLoad({0}, min(p, imageSize({0}) - 1)).r", name);
    else
      result.fetch = fmt::format("texelFetch({0}, min(p, textureSize({0}, 0) - 1), 0).r", name);
    result.value = [cell, previous](const Memory& memory) { return previous ? memory.before[cell] : memory.now[cell]; };
    return result;
  }

  std::string size_of(size_t cell) const {
    if (cells_[cell].buffer) return std::to_string(kElements);
    return cells_[cell].place;
  }

  static std::string hash_text(uint32_t seed, const std::vector<Source>& sources) {
    std::string text = fmt::format("  uint hash = {}u;\n", seed);
    for (const Source& each : sources) text += fmt::format("  hash = stir(hash, {});\n", each.fetch);
    return text;
  }

  static std::string statements(const std::vector<Source>& sources) {
    std::string text;
    for (const Source& each : sources) text += each.statement;
    return text;
  }

  Effect store_hash(size_t target, uint32_t seed, std::vector<Source> sources, bool update) {
    return [=](Memory& memory, std::vector<uint32_t>&) {
      uint32_t hash = seed;
      for (const Source& each : sources) hash = stir(hash, each.value(memory));
      memory.now[target] = update ? stir(hash, memory.now[target]) : hash;
    };
  }

  void add_compute(size_t target, bool update) {
    const std::string name = next_name();
    const uint32_t seed = static_cast<uint32_t>(random_());
    const std::vector<Source> sources = pick_sources(target);
    const bool buffer = cells_[target].buffer;
    text_ +=
        fmt::format("  pass {0} : compute {{\n    shader \"{0}.comp\" group {1}\n{2}    {3} target = {4} as storage\n    dispatch over {5}\n  }}\n",
                    name, buffer ? "64 1 1" : "8 8 1", statements(sources), update ? "update" : "write", cells_[target].place, size_of(target));
    std::string shader = std::string(kStir) + "void main() {\n  ivec2 p = ivec2(gl_GlobalInvocationID.xy);\n";
    shader += buffer ? fmt::format("  if (p.x >= {}) return;\n", kElements) : "  if (any(greaterThanEqual(p, imageSize(target)))) return;\n";
    shader += hash_text(seed, sources);
    if (update) shader += buffer ? "  hash = stir(hash, target[p.x]);\n" : "  hash = stir(hash, imageLoad(target, p).r);\n";
    shader += buffer ? "  target[p.x] = hash;\n}\n" : "  imageStore(target, p, uvec4(hash));\n}\n";
    files_[name + ".comp"] = shader;
    effects_.push_back(store_hash(target, seed, sources, update));
    cells_[target].defined = true;
  }

  void add_raster(size_t target) {
    if (cells_[target].buffer) return add_compute(target, false);
    const std::string name = next_name();
    const uint32_t seed = static_cast<uint32_t>(random_());
    const std::vector<Source> sources = pick_sources(target);
    text_ += fmt::format("  pass {0} : raster {{\n    fullscreen \"{0}.frag\"\n{1}    color target = {2}\n  }}\n", name, statements(sources),
                         cells_[target].place);
    files_[name + ".frag"] =
        std::string(kStir) + "void main() {\n  ivec2 p = ivec2(gl_FragCoord.xy);\n" + hash_text(seed, sources) + "  target = uvec4(hash);\n}\n";
    effects_.push_back(store_hash(target, seed, sources, false));
    cells_[target].defined = true;
  }

  void add_clear(size_t target) {
    const uint32_t value = below(1000);
    text_ += fmt::format("  pass {} : transfer {{ {} {} {} }}\n", next_name(), cells_[target].buffer ? "fill" : "clear", cells_[target].place, value);
    effects_.push_back([=](Memory& memory, std::vector<uint32_t>&) { memory.now[target] = value; });
    cells_[target].defined = true;
  }

  void add_copy(size_t target) {
    const auto source = defined_cell({target});
    if (!source || !same_shape(*source, target)) return add_clear(target);
    text_ += fmt::format("  pass {} : transfer {{ copy {} -> {} }}\n", next_name(), cells_[*source].place, cells_[target].place);
    effects_.push_back([from = *source, target](Memory& memory, std::vector<uint32_t>&) { memory.now[target] = memory.now[from]; });
    cells_[target].defined = true;
  }

  bool same_shape(size_t a, size_t b) const {
    if (cells_[a].buffer || cells_[b].buffer) return cells_[a].buffer && cells_[b].buffer;
    return declared_[cells_[a].resource].scale == declared_[cells_[b].resource].scale && cells_[a].mip == cells_[b].mip;
  }

  // Neighbouring passes that only add: their order is free, their sum is not.
  void add_atomic(size_t target) {
    if (!cells_[target].buffer || !cells_[target].defined) return add_compute(target, false);
    for (uint32_t i = 1 + below(3); i > 0; --i) {
      const std::string name = next_name();
      const uint32_t amount = 1 + below(100);
      text_ += fmt::format(
          "  pass {0} : compute {{\n    shader \"{0}.comp\" group 64 1 1\n    atomic target = {1} as storage\n    dispatch over {2}\n  }}\n", name,
          cells_[target].place, kElements);
      files_[name + ".comp"] = fmt::format(
          "void main() {{\n  if (gl_GlobalInvocationID.x < {}u) atomicAdd(target[gl_GlobalInvocationID.x], {}u);\n}}\n", kElements, amount);
      effects_.push_back([=](Memory& memory, std::vector<uint32_t>&) { memory.now[target] += amount; });
    }
  }

  // Least and greatest number of all texels or elements.
  void add_probe(size_t cell) {
    const std::string name = fmt::format("probe{}", probes_.size());
    const bool buffer = cells_[cell].buffer;
    text_ += fmt::format(
        "  pass {0} : compute {{\n    shader \"{0}.comp\" group {1}\n    read source = {2} as {3}\n    atomic least as storage\n    atomic greatest "
        "as storage\n"
        "    dispatch over {4}\n  }}\n",
        name, buffer ? "64 1 1" : "8 8 1", cells_[cell].place, buffer ? "storage" : "sampled", size_of(cell));
    files_[name + ".comp"] = fmt::format(
        "void main() {{\n  ivec2 p = ivec2(gl_GlobalInvocationID.xy);\n  if ({0}) return;\n  uint value = {1};\n"
        "  atomicMin(least[{2}], value);\n  atomicMax(greatest[{2}], value);\n}}\n",
        buffer ? fmt::format("p.x >= {}", kElements) : "any(greaterThanEqual(p, textureSize(source, 0)))",
        buffer ? "source[p.x]" : "texelFetch(source, p, 0).r", probes_.size());
    probes_.push_back(fmt::format("{} after p{}", cells_[cell].place, count_ - 1));
    effects_.push_back([=](Memory& memory, std::vector<uint32_t>& found) { found.push_back(memory.now[cell]); });
  }

  // A history that is not written in a frame would carry its contents on; here each is written, so that every frame differs.
  void finish_histories() {
    for (const Declared& declared : declared_)
      if (declared.history && !cells_[declared.cells[0]].defined) add_compute(declared.cells[0], false);
    add_compute(0, cells_[0].defined);
    add_probe(0);
  }

  std::string program() const {
    std::string text = "module random\n\nextent view = runtime(40, 24) max(64, 64)\n\ngraph frame() {\n";
    for (const Declared& declared : declared_) text += "  " + declared.declaration + "\n";
    const size_t n = probes_.size();
    text += fmt::format(
        "  buffer least : u32[{0}]\n  buffer greatest : u32[{0}]\n  buffer least_found : u32[{0}] readback\n  buffer greatest_found : u32[{0}] "
        "readback\n",
        n);
    text += "  pass start : transfer { fill least 4294967295  fill greatest 0 }\n";
    return text + text_ + "  pass finish : transfer { copy least -> least_found  copy greatest -> greatest_found }\n}\n";
  }

  void run(uint32_t frames, RandomFrame& frame) const {
    Memory memory{std::vector<uint32_t>(cells_.size()), std::vector<uint32_t>(cells_.size(), 7)};
    for (uint32_t i = 0; i < frames; ++i) {
      std::vector<uint32_t> found;
      for (const Effect& effect : effects_) effect(memory, found);
      frame.expected.push_back(found);
      memory.before = memory.now;
    }
  }

  std::mt19937_64 random_;
  uint32_t passes_, count_ = 0;
  std::vector<Declared> declared_;
  std::vector<Cell> cells_;
  std::string text_;
  std::map<std::string, std::string> files_;
  std::vector<Effect> effects_;
  std::vector<std::string> probes_;
};

}  // namespace

RandomFrame make_random_frame(uint64_t seed, uint32_t passes, uint32_t frames) { return Generator(seed, passes).make(frames); }

}  // namespace rg::test
