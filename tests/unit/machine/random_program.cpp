#include "random_program.h"

#include <fmt/format.h>

#include <algorithm>
#include <random>
#include <vector>

namespace rg::test {
namespace {

struct Place {  // one mip and layer of an image, a part of a buffer, or a whole resource
  std::string text;
  size_t resource = 0;
  bool buffer = false, depth = false, imported = false;
  bool defined = false;
};

class Generator {
 public:
  Generator(uint64_t seed, uint32_t passes) : random_(seed), passes_(passes) {}

  std::string make() {
    declare();
    define_histories();
    for (uint32_t i = 0; i < passes_; ++i) add_pass();
    finish();
    return "module random\nextent view = runtime(64, 32) max(64, 32)\ncondition sometimes\n"
           "interface Scene {\n  table: buffer u32[64] ready as storage in compute\n  maps: image rgba8 64x64 ready as sampled in fragment\n"
           "  state: buffer u32[64] ready as storage in compute\n}\n"
           "graph frame(scene: Scene, surface backbuffer: rgba8 view) {\n" +
           declarations_ + text_ + "}\n";
  }

 private:
  uint32_t below(uint32_t n) { return static_cast<uint32_t>(random_() % n); }
  bool chance(uint32_t one_in) { return below(one_in) == 0; }

  void add_place(std::string text, bool buffer, bool depth = false) { places_.push_back({std::move(text), resources_, buffer, depth, false, false}); }

  void declare() {
    for (uint32_t i = 0, n = 2 + below(3); i < n; ++i) declare_image(fmt::format("i{}", i));
    for (uint32_t i = 0, n = 1 + below(2); i < n; ++i) declare_buffer(fmt::format("b{}", i));
    declare("depth", "image depth : d32f view", false, true);
    declare("past", "image past : rgba16f view history 1 init clear 0", false);
    declare("count", "buffer count : u32[64] history 2 init clear 0", true);
    declare("cache", "image cache : rgba8 64x32 persistent init clear 0", false);
    declarations_ += "  buffer found : u32[64] readback\n";
    for (const char* name : {"scene.table", "scene.maps", "scene.state"}) {
      declare(name, "", std::string(name) != "scene.maps");
      places_.back().imported = places_.back().defined = true;
    }
    for (Place& place : places_)
      if (place.text == "cache") place.defined = true;
  }
  void declare(const std::string& name, const std::string& declaration, bool buffer, bool depth = false) {
    if (!declaration.empty()) declarations_ += "  " + declaration + "\n";
    add_place(name, buffer, depth);
    ++resources_;
  }
  void declare_image(const std::string& name) {
    const uint32_t mips = 1 + below(3), layers = 1 + below(2);
    declarations_ += fmt::format("  image {} : rgba16f view / {} mips {} layers {}\n", name, 1 + below(2), mips, layers);
    for (uint32_t mip = 0; mip < mips; ++mip)
      for (uint32_t layer = 0; layer < layers; ++layer) add_place(fmt::format("{}.mip({}).layer({})", name, mip, layer), false);
    ++resources_;
  }
  void declare_buffer(const std::string& name) {
    declarations_ += fmt::format("  buffer {} : u32[128]\n", name);
    if (chance(2)) {
      add_place(name + ".bytes(0, 256)", true);
      add_place(name + ".bytes(256, 256)", true);
    } else {
      add_place(name, true);
    }
    ++resources_;
  }

  void begin(const std::string& kind) {
    used_.clear();
    statements_.clear();
    kind_ = kind;
  }
  void end() { text_ += fmt::format("  pass p{} : {} {{\n{}  }}\n", count_++, kind_, statements_); }
  void state(const std::string& verb, const std::string& text) { statements_ += fmt::format("    {} a{} = {}\n", verb, used_.size(), text); }
  bool take(size_t place) {  // resources of one pass differ, so that no pass reads what it writes
    const bool free = std::find(used_.begin(), used_.end(), places_[place].resource) == used_.end();
    if (free) used_.push_back(places_[place].resource);
    return free;
  }

  size_t any(bool buffer) {
    for (;;) {
      const size_t place = below(static_cast<uint32_t>(places_.size()));
      if (places_[place].buffer == buffer && !places_[place].depth && places_[place].text != "scene.table" && places_[place].text != "scene.maps")
        return place;
    }
  }

  void read_some(const std::string& stage) {
    for (uint32_t i = below(4); i > 0; --i) {
      const size_t place = below(static_cast<uint32_t>(places_.size()));
      if (!places_[place].defined || !take(place)) continue;
      const bool history = places_[place].text == "past" || places_[place].text == "count";
      const std::string text = places_[place].text + (history && chance(2) ? ".prev(1)" : "");
      const char* role = places_[place].buffer                                                      ? "storage"
                         : places_[place].depth || chance(2) || places_[place].text == "scene.maps" ? "sampled"
                                                                                                    : "storage";
      if (places_[place].buffer && stage != "compute" && places_[place].text.find('.') == std::string::npos && chance(3)) role = "uniform";
      state("read", fmt::format("{} as {} in {}", text, role, stage));
    }
  }

  void add_pass() {
    const bool conditional = chance(8);
    if (conditional) text_ += "  if host sometimes {\n";
    switch (below(conditional ? 2 : 6)) {
      case 0:
        add_compute(conditional);
        break;
      case 1:
        add_raster(conditional);
        break;
      case 2:
        add_transfer();
        break;
      case 3:
        add_atomics();
        break;
      default:
        chance(2) ? add_compute(false) : add_raster(false);
        break;
    }
    if (conditional) text_ += "  }\n";
  }

  void write(const std::string& stage, bool updates_only) {
    const size_t place = any(chance(2));
    if (!take(place)) return;
    const bool update = updates_only || (places_[place].defined && chance(3));
    if (update && !places_[place].defined) return;
    state(update ? "update" : "write", fmt::format("{} as storage in {}", places_[place].text, stage));
    places_[place].defined = true;
  }
  void add_compute(bool updates_only) {
    begin("compute");
    write("compute", updates_only);
    if (chance(3)) write("compute", updates_only);
    read_some("compute");
    end();
  }

  void attach_depth(bool updates_only) {
    const auto depth =
        static_cast<size_t>(std::find_if(places_.begin(), places_.end(), [](const Place& place) { return place.depth; }) - places_.begin());
    if (updates_only && !places_[depth].defined) return;
    take(depth);
    const char* how = !places_[depth].defined || (!updates_only && chance(2)) ? " clear 0.0" : chance(2) ? " readonly" : "";
    state("depth", places_[depth].text + how);
    places_[depth].defined = true;
  }
  void add_raster(bool updates_only) {
    begin("raster");
    const size_t color = any(false);
    const bool attachable = places_[color].text.rfind("i", 0) == 0 || places_[color].text == "past";
    if (attachable && (places_[color].defined || !updates_only)) {
      take(color);
      state("color", places_[color].text + (updates_only                           ? " blend add(one, one)"
                                            : !places_[color].defined || chance(2) ? " clear 0"
                                            : chance(2)                            ? " covers"
                                                                                   : ""));
      places_[color].defined = true;
    } else {
      attach_depth(updates_only);
    }
    if (used_.empty()) write("fragment", updates_only);
    read_some(chance(3) ? "vertex" : chance(2) ? "vertex, fragment" : "fragment");
    end();
  }

  void add_transfer() {
    begin("transfer");
    const size_t place = any(chance(2));
    take(place);
    if (places_[place].buffer)
      statements_ += fmt::format("    fill {} {}\n", places_[place].text, below(9));
    else
      statements_ += fmt::format("    clear {} 0\n", places_[place].text);
    places_[place].defined = true;
    end();
  }

  void add_atomics() {
    const size_t place = any(true);
    if (!places_[place].defined) return;
    for (uint32_t i = 1 + below(3); i > 0; --i) {
      begin(chance(3) ? "raster" : "compute");
      take(place);
      state("atomic", fmt::format("{} as storage in {}", places_[place].text, kind_ == "raster" ? "fragment" : "compute"));
      if (kind_ == "raster") attach_depth(false);
      read_some(kind_ == "raster" ? "fragment" : "compute");
      end();
    }
  }

  void define_histories() {
    text_ +=
        "  pass accumulate : compute {\n    read past_before = past.prev(1) as sampled\n    read count_before = count.prev(2) as storage\n"
        "    write past as storage\n    write count as storage\n  }\n";
    for (Place& place : places_)
      if (place.text == "past" || place.text == "count") place.defined = true;
  }

  // Everything defined is read, so that much of it lives.
  void finish() {
    text_ += "  pass resolve : compute {\n    write found as storage\n";
    for (size_t i = 0; i < places_.size(); ++i)
      if (places_[i].defined && !places_[i].imported && !chance(4))
        text_ += fmt::format("    read r{} = {} as {}\n", i, places_[i].text, places_[i].buffer ? "storage" : "sampled");
    text_ += "  }\n  pass show : raster {\n    color backbuffer clear 0\n    read found_again = count as storage in fragment\n  }\n";
  }

  std::mt19937_64 random_;
  uint32_t passes_, count_ = 0;
  size_t resources_ = 0;
  std::vector<Place> places_;
  std::vector<size_t> used_;
  std::string declarations_, text_, statements_, kind_;
};

}  // namespace

std::string make_random_program(uint64_t seed, uint32_t passes) { return Generator(seed, passes).make(); }

}  // namespace rg::test
