// The packer alone: frames of a generator, and, where RGC_PACKING names a folder, every .csv in it with lines "id,begin,end,bytes".
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>

#include "bench/rows.h"
#include "runtime/packing.h"

namespace rg::bench {
namespace {

using packing::Item;

// Transients of a frame at 3840x2160: images of full size down to a sixteenth, some with mips or layers, buffers of any size; most live for a few
// passes.
std::vector<Item> random_frame(uint32_t seed, size_t count, bool round_buffers) {
  std::mt19937_64 random(seed);
  const auto chance = [&](double share) { return static_cast<double>(random() >> 11) * 0x1p-53 < share; };
  const auto uniform = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
  const uint32_t passes = std::max<uint32_t>(4, static_cast<uint32_t>(static_cast<double>(count) / 2.2));
  std::vector<Item> items;
  while (items.size() < count) {
    double bytes = 0;
    const bool image = chance(0.62);
    if (image) {
      constexpr double kTexelBytes[] = {1, 2, 4, 4, 4, 8, 8, 16};
      const double scale = 1 << (chance(0.5) ? 0 : 1 + random() % 4);
      bytes = 3840.0 * 2160.0 / (scale * scale) * kTexelBytes[random() % 8] * (chance(0.15) ? 4.0 / 3 : 1) * (chance(0.05) ? 4 : 1);
    } else {
      bytes = std::exp2(8 + 16 * uniform());
    }
    const double kind = uniform();
    const uint32_t few = 1 + static_cast<uint32_t>(std::min(7.0, -2.5 * std::log(1 - uniform())));
    const uint32_t length = kind < 0.76 ? few : static_cast<uint32_t>(kind < 0.94 ? 4 + random() % 20 : 10 + random() % std::min(passes, 800u));
    const uint32_t begin = static_cast<uint32_t>(random() % passes);
    const uint64_t alignment = image || round_buffers ? 65536 : 256;
    items.push_back({packing::detail::align_up(static_cast<uint64_t>(bytes), alignment), alignment, begin, std::min(passes, begin + length)});
  }
  return items;
}

struct Tally {
  size_t runs = 0, at_bound = 0, within_percent = 0;
  double worst = 1, ms = 0, worst_ms = 0;
};

Tally pack_frames(size_t frames, size_t count, bool round_buffers) {
  Tally tally;
  for (uint32_t seed = 0; seed < frames; ++seed) {
    const std::vector<Item> items = random_frame(seed, count, round_buffers);
    packing::Placement placement;
    const double ms = median_ms(1, [&] { placement = packing::pack(items); });
    const double ratio = static_cast<double>(placement.heap_bytes) / static_cast<double>(placement.lower_bound_bytes);
    ++tally.runs;
    tally.at_bound += placement.heap_bytes == placement.lower_bound_bytes, tally.within_percent += ratio <= 1.01;
    tally.worst = std::max(tally.worst, ratio), tally.ms += ms, tally.worst_ms = std::max(tally.worst_ms, ms);
  }
  return tally;
}

void add_frames(Rows& rows, size_t frames, size_t count, bool round_buffers) {
  const Tally tally = pack_frames(frames, count, round_buffers);
  const double runs = static_cast<double>(tally.runs);
  const std::string prefix = "packing/frames_" + std::to_string(count) + (round_buffers ? "_64K/" : "_mixed/");
  rows.push_back({prefix + "at_bound", 100 * static_cast<double>(tally.at_bound) / runs, "%", {}, ""});
  rows.push_back({prefix + "within_1_percent", 100 * static_cast<double>(tally.within_percent) / runs, "%", {}, ""});
  rows.push_back({prefix + "worst", tally.worst, "ratio", 1.0, "the lower bound"});
  rows.push_back({prefix + "time", tally.ms / runs, "ms", {}, ""});
  rows.push_back({prefix + "worst_time", tally.worst_ms, "ms", {}, ""});
}

std::vector<Item> read_items(const std::filesystem::path& path) {
  std::vector<Item> items;
  std::ifstream file(path);
  std::string line;
  while (std::getline(file, line)) {
    unsigned long long id = 0, begin = 0, end = 0, bytes = 0;
    if (std::sscanf(line.c_str(), "%llu,%llu,%llu,%llu", &id, &begin, &end, &bytes) == 4)
      items.push_back({bytes, 1, static_cast<uint32_t>(begin), static_cast<uint32_t>(end)});
  }
  return items;
}

// "A.1048576.csv" is asked for in 1048576 bytes; a file without a number, at its bound.
void add_file(Rows& rows, const std::filesystem::path& path) {
  const std::vector<Item> items = read_items(path);
  if (items.empty()) return;
  const std::string name = "packing/" + path.stem().stem().string() + "/";
  const std::string number = path.stem().extension().string();
  const uint64_t bound = packing::lower_bound(items), capacity = number.size() > 1 ? std::strtoull(number.c_str() + 1, nullptr, 10) : bound;
  packing::Fit fit;
  const double fit_ms = median_ms(1, [&] { fit = packing::fit(items, capacity, 1'000'000'000); });
  rows.push_back({name + "fit", fit.fits ? 1.0 : 0.0, "bool", {}, "in " + std::to_string(capacity) + " bytes"});
  rows.push_back({name + "fit_time", fit_ms, "ms", {}, ""});
  packing::Placement placement;
  const double ms = median_ms(1, [&] { placement = packing::pack(items); });
  rows.push_back({name + "pack", static_cast<double>(placement.heap_bytes), "bytes", static_cast<double>(bound), "the lower bound; default effort"});
  rows.push_back({name + "pack_time", ms, "ms", {}, ""});
}

}  // namespace

Rows bench_packing(const std::string&) {
  Rows rows;
  for (const bool round_buffers : {true, false}) {
    add_frames(rows, 100, 40, round_buffers);
    add_frames(rows, 200, 100, round_buffers);
    add_frames(rows, 50, 300, round_buffers);
    add_frames(rows, 5, 10'000, round_buffers);
  }
  if (const char* folder = std::getenv("RGC_PACKING")) {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
      if (entry.path().extension() == ".csv") files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    for (const auto& file : files) add_file(rows, file);
  }
  return rows;
}

}  // namespace rg::bench
