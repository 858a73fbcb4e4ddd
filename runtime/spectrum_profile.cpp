#include "runtime/spectrum_profile.h"

#include <algorithm>

#include "runtime/json_text.h"

namespace rg {

namespace {

std::string features_json(const SpectrumKernels& kernels, uint32_t mask) {
  std::string text = "[";
  for (size_t i = 0; i < kernels.features.size(); ++i)
    if ((mask >> i & 1) != 0) text += (text.size() == 1 ? "" : ", ") + json_quoted(kernels.features[i]);
  return text + "]";
}

// "[\n  row,\n  row\n]", for rows at some depth.
std::string list_json(const std::vector<std::string>& rows, const std::string& indent) {
  std::string text = "[";
  for (const std::string& row : rows) text += (text.size() == 1 ? "\n" : ",\n") + indent + " " + row;
  return text + (rows.empty() ? "]" : "\n" + indent + "]");
}

}  // namespace

size_t kernel_for(const SpectrumKernels& kernels, uint32_t mask) {
  size_t kernel = 0;
  while (kernel + 1 < kernels.sets.size() && (mask & ~kernels.sets[kernel]) != 0) ++kernel;
  return kernel;
}

SpectrumProfile::SpectrumProfile(const SpectrumKernels& kernels) : kernels_(kernels), times_(kernels.sets.size()) {}

void SpectrumProfile::add_scene(std::string_view name, double weight, std::span<const uint32_t> masks) {
  Scene& scene = scenes_.emplace_back(Scene{std::string(name), weight, {}});
  for (const uint32_t mask : masks) ++scene.groups[mask];
}

void SpectrumProfile::add_time(size_t kernel, double weight, double ms, uint64_t groups) {
  if (groups == 0) return;
  times_[kernel].ms += weight * ms;
  times_[kernel].groups += weight * static_cast<double>(groups);
}

void SpectrumProfile::add_time(size_t kernel, double weight, GraphInstance& graph, std::string_view pass, std::span<const uint32_t> masks) {
  const auto groups = std::count_if(masks.begin(), masks.end(), [&](uint32_t mask) { return kernel_for(kernels_, mask) == kernel; });
  const std::string name = std::string(pass) + "[" + std::to_string(kernel) + "]";
  for (const PassTime& time : graph.pass_times())
    if (time.pass == name) add_time(kernel, weight, time.ms, static_cast<uint64_t>(groups));
}

std::vector<std::pair<uint32_t, double>> SpectrumProfile::costs() const {
  std::vector<std::pair<uint32_t, double>> costs;
  for (size_t kernel = 0; kernel < times_.size(); ++kernel)
    if (times_[kernel].groups > 0) costs.emplace_back(kernels_.sets[kernel], 1000 * times_[kernel].ms / times_[kernel].groups);
  return costs;
}

std::string SpectrumProfile::json() const {
  std::vector<std::string> scenes, rows;
  for (const Scene& scene : scenes_) {
    std::vector<std::string> masks;
    for (const auto& [mask, groups] : scene.groups)
      masks.push_back("{\"features\": " + features_json(kernels_, mask) + ", \"tiles\": " + std::to_string(groups) + "}");
    scenes.push_back("{\"name\": " + json_quoted(scene.name) + ", \"weight\": " + json_number(scene.weight) +
                     ", \"masks\": " + list_json(masks, "  ") + "}");
  }
  for (const auto& [set, ms] : costs()) rows.push_back("{\"features\": " + features_json(kernels_, set) + ", \"ms\": " + json_number(ms, 6) + "}");
  std::string text = "{\n \"schema\": \"rgc-spectrum-1\",\n \"spectrum\": " + json_quoted(kernels_.name) +
                     ",\n \"features\": " + features_json(kernels_, ~0u) + ",\n \"scenes\": " + list_json(scenes, " ");
  if (!rows.empty()) text += ",\n \"costs\": " + list_json(rows, " ");
  return text + "\n}\n";
}

}  // namespace rg
